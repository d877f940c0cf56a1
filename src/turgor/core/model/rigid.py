"""Rigid bodies from STL files."""

from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.surface.crossing import crossings, winding
from turgor.core.model.obstacles import RigidSurface
from turgor.foundation.errors import TurgorError, near_file, near_match
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import UNITS

if TYPE_CHECKING:
    from turgor.core.meshing.exchange.formats.stl import Triangles

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class RigidFile:
    """A rigid body from an STL file, with the arguments of `read_rigid`.

    Parameters
    ----------
    file : Path
        The file.
    unit : str
        Unit of length of the file.
    sha256 : str
        Content of the file that is meant, as a lock file notes it; taken from the file where it is empty.

    Raises
    ------
    TurgorError
        If there is no such file, or its content is another one.

    Examples
    --------
    >>> RigidFile(file=Path("mug.stl"))
    Traceback (most recent call last):
    turgor.TurgorError: there is no STL file 'mug.stl'.
    """

    file: Path
    unit: str = "mm"
    sha256: str = ""

    def __post_init__(self) -> None:
        _check_there(Path(self.file))
        digest = sha256(Path(self.file).read_bytes()).hexdigest()
        if self.sha256 and self.sha256 != digest:
            raise TurgorError(
                f"sha256 is {self.sha256[:12]}…, but the content of '{self.file}' has {digest[:12]}…: the file has "
                "changed since; take the old one, or remove the key to go on with the new one."
            )
        object.__setattr__(self, "sha256", digest)

    def read(self) -> RigidSurface:
        """Read the body."""
        return read_rigid(self.file, self.unit)


def read_rigid(path: str | Path, unit: str = "mm") -> RigidSurface:
    """Read a rigid body for an obstacle from an STL file, binary or text.

    Corners that are nearly at the same place become one. Normals point out of the body afterwards, whichever way the
    file has them; a shell within another is a void.

    Parameters
    ----------
    path : str or Path
        The file.
    unit : str
        Unit of length of the file, ``"mm"``, ``"cm"``, ``"m"``, ``"um"`` or ``"in"``; STL files do not state it.

    Returns
    -------
    RigidSurface
        Named like the file.

    Raises
    ------
    TurgorError
        If there is no such file, it is no STL file, or its surface is open, crosses itself, has triangles without an
        area or triangles that are wound against their neighbors.

    Examples
    --------
    >>> read_rigid("mug.stl")
    Traceback (most recent call last):
    turgor.TurgorError: there is no STL file 'mug.stl'.
    """
    from turgor.core.geometry.cad.facets import weld  # here: they load the CAD kernel, and every job loads this file
    from turgor.core.geometry.cad.stl import read_stl
    from turgor.core.meshing.exchange.formats.stl import Triangles

    file, lengths = Path(path), UNITS["length"]
    if unit not in lengths:
        hint = near_match(str(unit), lengths) or "."
        raise TurgorError(f"unit is {unit!r}{hint} Known: {', '.join(lengths)}.")
    _check_there(file)
    points, triangles = weld(read_stl(file).reshape(-1, 3))
    triangles = triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]
    _check(file, points, triangles)
    surface = _outward(file, Triangles(points=points, triangles=triangles))
    return RigidSurface(points=surface.points * lengths[unit], triangles=surface.triangles, name=file.stem)


def _check_there(file: Path) -> None:
    if not file.is_file():
        there = sorted(entry.name for entry in file.parent.glob("*.stl")) if file.parent.is_dir() else []
        raise TurgorError(f"there is no STL file '{file}'{near_file(file, there)}")


def _check(file: Path, points: Array, triangles: Ints) -> None:
    """Refuse a surface that has no inside or no normals; the places are in the unit of the file."""
    directed = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    edges, place, count = np.unique(np.sort(directed, axis=1), axis=0, return_inverse=True, return_counts=True)
    if not len(triangles):
        raise TurgorError(f"'{file}' has no triangle with an area; export it again.")
    if (count != 2).any():
        single, many = int((count == 1).sum()), int((count > 2).sum())
        raise TurgorError(
            f"'{file}' is no closed surface: {single} edges belong to one triangle only and {many} to more than two, "
            f"{_around(points[edges[count != 2]])}; a rigid body needs an inside, so repair it or export a solid."
        )
    forward = np.bincount(place.ravel(), weights=directed[:, 0] < directed[:, 1])
    if (forward != 1).any():
        raise TurgorError(
            f"'{file}' has triangles that are wound against their neighbors along {int((forward != 1).sum())} edges, "
            f"{_around(points[edges[forward != 1]])}; make its normals consistent and export it again."
        )
    from turgor.core.geometry.shapes.tolerances import TOLERANCE

    flat = _heights(points[triangles]) <= TOLERANCE.round_off * float(np.ptp(points, axis=0).max())
    if flat.any():
        raise TurgorError(
            f"'{file}' has {int(flat.sum())} triangles without an area, the first "
            f"{_around(points[triangles[flat][:1]])}; repair it, or export it with another resolution."
        )
    crossing = crossings(points, triangles)
    if len(crossing):
        raise TurgorError(
            f"'{file}' crosses itself: {len(crossing)} pairs of triangles cut through each other, the first "
            f"{_around(points[triangles[crossing[:1, 0]]])}; join the bodies in the CAD program (a union)."
        )


def _around(corners: Array) -> str:
    x, y, z = corners.reshape(-1, 3).mean(axis=0)
    return f"around ({x:.4g}, {y:.4g}, {z:.4g}) in units of the file"


def _heights(corners: Array) -> Array:
    """Height of each triangle over its longest side."""
    sides = corners - np.roll(corners, 1, axis=1)
    twice = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    return np.asarray(twice / np.linalg.norm(sides, axis=2).max(axis=1))


def _outward(file: Path, surface: "Triangles") -> "Triangles":
    """Turn each shell outwards, those within an odd number of others inwards."""
    shells = surface.shells()
    corners = [shell.points[shell.triangles] for shell in shells]
    turned, start = [], 0
    for i, shell in enumerate(shells):
        if abs(shell.volume) <= ROUND_OFF.zero * float(np.ptp(shell.points, axis=0).max()) ** 3:
            raise TurgorError(f"'{file}' encloses no volume {_around(shell.points)}; export a solid.")
        inside = sum(abs(winding(corners[i][0].mean(axis=0), corners[j])) > 0.5 for j in range(i))
        sign = -1 if inside % 2 else 1
        turned.append(start + (shell.triangles if sign * shell.volume > 0 else shell.triangles[:, ::-1]))
        start += len(shell.points)
    return replace(surface, points=np.concatenate([s.points for s in shells]), triangles=np.concatenate(turned))
