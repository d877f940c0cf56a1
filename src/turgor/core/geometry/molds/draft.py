"""Draft of a casting: the faces that lie along the way on which a half or a core is pulled, and what each lacks."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.facets import RoundFacets
from turgor.units import deg

Array = NDArray[np.float64]

#: Share of a face that has to lack draft, for the face to be listed: the tessellation of a round face leaves less.
LEAST_SHARE = 0.005

#: Round-off of an angle [rad]: normals have seven digits.
ANGLE = 1e-6

#: Most faces in a text.
MOST_FACES = 12


@dataclass(frozen=True, slots=True, kw_only=True)
class DraftlessFace:
    """A face of a casting with less draft than requested.

    Parameters
    ----------
    puller : str
        What is pulled along it: ``"halves"``, or the name of a core.
    area : float [CAD units²]
        Area without the requested draft.
    share : float
        This area as a share of the face.
    center : (3,) floats [CAD units]
        Middle of this area.
    draft : float [rad]
        Smallest draft of the face.
    """

    puller: str
    area: float
    share: float
    center: tuple[float, float, float]
    draft: float

    def text(self, requested: float) -> str:
        """Return the face in words, with the angle that is missing."""
        x, y, z = (round(each, 2) + 0.0 for each in self.center)
        part = "" if self.share > 1 - LEAST_SHARE else f", {self.share:.0%} of its face,"
        lacking = (requested - self.draft) / deg
        return (
            f"{self.area:.4g} mm²{part} around ({x:g}, {y:g}, {z:g}) mm: {self.draft / deg:.2g}°, {lacking:.2g}° less"
        )


def slopes(surface: RoundFacets, axis: int) -> Array:
    """Return the angle between each facet of a surface and an axis, from the true normals at its corners [rad]."""
    normal = surface.normals.mean(axis=1)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    return np.asarray(np.arcsin(np.clip(np.abs(normal[:, axis]), 0.0, 1.0)))


def draftless(surface: RoundFacets, axis: int, draft: float, puller: str) -> list[DraftlessFace]:
    """Return the faces with less draft than requested, the largest first.

    Parameters
    ----------
    surface : RoundFacets
        Surface of the casting that is pulled.
    axis : int
        Axis of the pull.
    draft : float [rad]
        Requested angle between a face and the pull.
    puller : str
        What is pulled.

    Returns
    -------
    list of DraftlessFace

    Examples
    --------
    >>> corners = np.array([[[0, 0, 0], [1, 0, 0], [0, 0, 1]]], dtype=float)
    >>> normals = np.array([[[0, 1, 0]] * 3], dtype=float)
    >>> wall = RoundFacets(corners=corners, normals=normals, face=np.array([0]), faces=[])
    >>> [each.area for each in draftless(wall, 2, 1 * deg, "halves")]
    [0.5]
    >>> draftless(wall, 1, 1 * deg, "halves")
    []
    """
    area, slope, face = surface.areas, slopes(surface, axis), surface.face
    steep, middle = slope < draft - ANGLE, surface.corners.mean(axis=1)
    faces = []
    for number in np.unique(face[steep]):
        rows = steep & (face == number)
        lacking, whole = float(area[rows].sum()), float(area[face == number].sum())
        if lacking > LEAST_SHARE * whole:
            x, y, z = np.average(middle[rows], axis=0, weights=area[rows]).tolist()
            faces.append(
                DraftlessFace(
                    puller=puller,
                    area=lacking,
                    share=lacking / whole,
                    center=(x, y, z),
                    draft=float(slope[rows].min()),
                )
            )
    return sorted(faces, key=lambda each: -each.area)


def draft_lines(faces: Iterable[DraftlessFace], draft: float) -> list[str]:
    """Write faces without draft, a line for each, below a line for what is pulled along them.

    Parameters
    ----------
    faces : iterable of DraftlessFace
    draft : float [rad]
        Requested draft.

    Returns
    -------
    list of str
    """
    groups: dict[str, list[DraftlessFace]] = {}
    for each in faces:
        groups.setdefault(each.puller, []).append(each)
    lines = []
    for puller, group in groups.items():
        lines.append(f"Faces with a draft below {draft / deg:g}° along the pull of the {puller}:")
        lines += [f"  {each.text(draft)}" for each in group[:MOST_FACES]]
        if len(group) > MOST_FACES:
            lines.append(f"  and {len(group) - MOST_FACES} smaller ones")
    return lines
