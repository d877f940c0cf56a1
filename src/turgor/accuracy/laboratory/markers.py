"""Marker tracks: points that a camera or a motion-capture system followed, and the angles that they give.

Three definitions of a bending angle are in use, and one finger has three values. For a center line that is an arc of
angle θ, clamped at its start:

- the *tangent angle* is the turn of the tip, θ: of the line through two markers near the tip, or of a plane on the tip;
- the *chord angle* is the turn of the line from the base to the tip, θ/2;
- the *three-point angle* is the turn between the line from the base to a middle marker and the line from there to the
  tip; with the marker in the middle of the arc, it is θ/2 as well.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.laboratory.read_experiment import read_experiment
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source

Array = NDArray[np.float64]

#: Definitions of an angle, and how many markers each needs.
ANGLES: Mapping[str, int] = {"tangent": 2, "chord": 2, "three_point": 3}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Tracks:
    """Markers followed through the frames of a recording.

    Parameters
    ----------
    drive : Column
        What the frames are counted by, such as time or pressure; the number of the frame where the file has neither.
    points : mapping of str to (n, d) array [m]
        Positions of each marker, with two or three coordinates.
    source : Source
        Where they came from.

    Examples
    --------
    >>> tracks = Tracks(drive=Column("time", "s", [0, 1]), source=Source(text="a camera"),
    ...                 points={"base": np.zeros((2, 2)), "tip": np.array([[0.1, 0.0], [0.0, 0.1]])})
    >>> tracks
    Tracks(2 frames: base, tip; from a camera)
    >>> print(tracks.angle("chord", "base", "tip")["bending_angle_deg"])
    [ 0. 90.]
    """

    drive: Column
    points: Mapping[str, Array]
    source: Source

    def __repr__(self) -> str:
        return f"Tracks({len(self.drive.values)} frames: {', '.join(self.points)}; from {self.source.text})"

    def of(self, name: str) -> Array:
        """Return the positions of a marker, (n, d) [m]; an unknown name fails with the near match."""
        if name not in self.points:
            raise unknown("marker", name, self.points)
        return self.points[name]

    def angle(self, definition: str, *markers: str, plane: Sequence[float] | None = None) -> Response:
        """Return a bending angle along the recording, as a change from the first frame.

        Parameters
        ----------
        definition : {"tangent", "chord", "three_point"}
            See the top of this page. The tangent angle takes two markers near the tip, the chord angle one at the base
            and one at the tip, the three-point angle one at the base, one in the middle and one at the tip.
        *markers : str
            Names of the markers, from the base to the tip.
        plane : (3,) floats, optional
            Normal of the plane in which the actuator bends, for tracks in space; the angle is that of the lines as seen
            along it. By default the plane in which the tip moves farthest.

        Returns
        -------
        Response
            The drive and ``bending_angle``: positive as the angle grows farthest.

        Raises
        ------
        TurgorError
            If the definition or a marker is unknown, or their number is wrong.
        """
        if definition not in ANGLES:
            raise unknown("definition of an angle", definition, ANGLES)
        if len(markers) != ANGLES[definition]:
            raise TurgorError(f"a {definition} angle needs {ANGLES[definition]} markers, not {len(markers)}.")
        places = [self.of(name) for name in markers]
        if places[0].shape[1] == 3:
            places = in_plane(places, None if plane is None else np.asarray(plane, dtype=float))
        turned = _directions(places[-2], places[-1])
        if definition == "three_point":
            turned = turned - _directions(places[0], places[1])
        turned = np.unwrap(np.where(np.isfinite(turned), turned, np.nan), period=2 * np.pi) if len(turned) else turned
        change = turned - turned[np.isfinite(turned)][0]
        sign = -1.0 if abs(np.nanmin(change)) > abs(np.nanmax(change)) else 1.0
        angle = Column("bending_angle", "deg", sign * change)
        detail = f"{definition.replace('_', '-')} angle of {', '.join(markers)}"
        return Response(columns=(self.drive, angle), source=Source(text=self.source.text, detail=detail))

    def displacement(self, name: str) -> Response:
        """Return how far a marker has moved from its first place: the drive and ``tip_displacement``."""
        away = self.of(name) - self.of(name)[0]
        column = Column("tip_displacement", "mm", np.linalg.norm(away, axis=1))
        return Response(columns=(self.drive, column), source=Source(text=self.source.text, detail=f"marker {name}"))

    def relative_to(self, *fixed: str) -> "Tracks":
        """Return the tracks as seen from three or more markers (two in a plane) on a body that should stand still.

        The motion of that body, as a best rigid one, is taken out of every marker: a clamp that yields, or a camera
        that shakes.

        Parameters
        ----------
        *fixed : str
            Markers on it.

        Raises
        ------
        TurgorError
            If there are too few.
        """
        places = np.stack([self.of(name) for name in fixed], axis=1) if fixed else np.empty((0, 0, 3))
        needed = places.shape[2]
        if places.shape[1] < needed:
            raise TurgorError(f"relative_to needs {needed} markers on the fixed body, not {len(fixed)}.")
        center, first = places.mean(axis=1), places[0].mean(axis=0)
        moved = {name: np.empty_like(track) for name, track in self.points.items()}
        for n in range(len(places)):
            turn = _best_turn(places[n] - center[n], places[0] - first)
            for name, track in self.points.items():
                moved[name][n] = turn @ (track[n] - center[n]) + first
        return Tracks(drive=self.drive, points=moved, source=self.source)


def read_tracks(
    path: str | Path,
    *,
    units: Mapping[str, str] | None = None,
    columns: Mapping[str, str] | Sequence[str] | None = None,
) -> Tracks:
    r"""Read marker tracks: a row for each frame, with columns ``tip_x_mm``, ``tip_y_mm`` and perhaps ``tip_z_mm``.

    Parameters
    ----------
    path, units, columns
        See `turgor.experiments.read_experiment`.

    Returns
    -------
    Tracks

    Raises
    ------
    TurgorError
        If no pair of columns ends in x and y, or a coordinate is in no unit of length.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder) / "video.csv"
    ...     _ = file.write_text("time (s),tip_x (mm),tip_y (mm)\n0,100,0\n0.1,99,4\n")
    ...     read_tracks(file)
    Tracks(2 frames: tip; from video.csv)
    """
    table = read_experiment(path, units=units, columns=columns)
    names = [name.removesuffix("_x") for name in table.names if name.endswith("_x") and f"{name[:-1]}y" in table]
    if not names:
        raise TurgorError(
            f"'{Path(path).name}' has no pair of columns such as tip_x (mm) and tip_y (mm); it has {', '.join(table)}."
        )
    points = {}
    for name in names:
        axes = [table.find(f"{name}_{axis}") for axis in "xyz" if f"{name}_{axis}" in table]
        if any(axis.si_unit != "m" for axis in axes):
            raise TurgorError(
                f"'{Path(path).name}': marker '{name}' is in no unit of length; scale pixels first, else write "
                "a unit, such as 'tip_x (mm)' or units={'tip_x': 'mm'}."
            )
        points[name] = np.column_stack([axis.values for axis in axes])
    drive = next((table.find(name) for name in ("pressure", "time") if name in table), None)
    return Tracks(
        drive=drive or Column("frame", "", np.arange(len(table), dtype=np.float64)), points=points, source=table.source
    )


def in_plane(places: Sequence[Array], normal: Array | None) -> list[Array]:
    """Return tracks in space as seen along the normal of a plane.

    Parameters
    ----------
    places : sequence of (n, 3) array [m]
        Tracks, the last one that of the tip.
    normal : (3,) array or None
        Where it is None: of the plane through the markers and the way of the tip.

    Returns
    -------
    list of (n, 2) array [m]
    """
    if normal is None:
        lines = np.concatenate([places[-1] - places[0], places[-1] - places[-1][0]])
        lines = lines[np.isfinite(lines).all(axis=1)]
        normal = np.linalg.svd(lines, full_matrices=True)[2][2]
    normal = normal / np.linalg.norm(normal)
    first = places[-1][0] - places[0][0]
    across = first - (first @ normal) * normal
    across = across / np.linalg.norm(across)
    basis = np.stack([across, np.cross(normal, across)], axis=1)
    return [place @ basis for place in places]


def _directions(start: Array, end: Array) -> Array:
    """Angle of the line from one track to another at every frame, (n,) [rad]."""
    along = end - start
    return np.arctan2(along[:, 1], along[:, 0])


def _best_turn(now: Array, first: Array) -> Array:
    """Rotation that takes points nearest to their first places (Kabsch 1976)."""
    left, _, right = np.linalg.svd(now.T @ first)
    keep = np.ones(len(left))
    keep[-1] = np.sign(np.linalg.det(left @ right))
    return np.asarray(right.T @ np.diag(keep) @ left.T)
