"""Split of a part by a plane, so that its bottom can have another material."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from turgor.core.geometry import occ
from turgor.core.geometry.cad.facets import find_facets
from turgor.core.geometry.cad.selectors import direction
from turgor.core.geometry.directions import Vector
from turgor.core.geometry.rules import as_length
from turgor.foundation.errors import TurgorError
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class SplitPlane:
    """Plane that splits a part; the part below it becomes a region of its own.

    Exactly one of position and thickness is needed.

    Parameters
    ----------
    normal : str or (3,) tuple
        Upward normal of the plane: ``"+z"`` cuts off the bottom, ``"-z"`` the top.
    position : float, optional [m]
        Coordinate of the plane along the normal, from the origin of the file.
    thickness : float, optional [m]
        Thickness of the layer that is cut off, from the lowest point of the part along the normal.
    below : str
        Name of the region below the plane.
    interface : str
        Name of the face in the plane.

    Examples
    --------
    >>> SplitPlane(thickness=2e-3).normal
    (0.0, 0.0, 1.0)
    """

    normal: Vector | str = "+z"
    position: float | None = None
    thickness: float | None = None
    below: str = "base"
    interface: str = "strain_limiting_layer"

    def __post_init__(self) -> None:
        object.__setattr__(self, "normal", direction("normal", self.normal))
        if (self.position is None) == (self.thickness is None):
            given = "neither a position nor" if self.position is None else "both a position and"
            raise TurgorError(
                f"split has {given} a thickness; give one, the position of its plane or the thickness of the layer."
            )
        if self.position is not None:
            object.__setattr__(self, "position", as_length("position", self.position))
        if self.thickness is not None:
            object.__setattr__(self, "thickness", as_length("thickness", self.thickness))


def split_bodies(bodies: list[Any], names: list[str], split: SplitPlane) -> tuple[list[Any], list[str]]:
    """Cut bodies by a plane.

    Parameters
    ----------
    bodies : list of CAD solids
        In CAD units.
    names : list of str
        Region of each.
    split : SplitPlane
        The plane.

    Returns
    -------
    bodies, names : lists
        The pieces above the plane with their names, those below it with the name of the split.

    Raises
    ------
    TurgorError
        If the plane misses the part.
    """
    up = np.array(split.normal)
    # not the kernel's boxes: they grow by 0.01 mm once a body has been triangulated
    points = np.concatenate([find_facets(body, list(dict.fromkeys(body.faces))).points for body in bodies])
    low, high = float((points @ up).min()), float((points @ up).max())
    at = low + split.thickness / mm if split.thickness is not None else (split.position or 0.0) / mm
    slack = 1e-6 * (high - low)
    if not low + slack < at < high - slack:
        key = "thickness" if split.thickness is not None else "position"
        shown = (at - low, 0.0, high - low) if key == "thickness" else (at, low, high)
        raise TurgorError(
            f"{key} of the split is {shown[0]:.6g} mm; allowed is between {shown[1]:.6g} and {shown[2]:.6g} mm, "
            f"where the part is along {tuple(split.normal)}."
        )
    point = up * at
    half = occ.HalfSpace(occ.Pnt(*map(float, point)), occ.Vec(*map(float, up)))
    pieces: list[Any] = []
    regions: list[str] = []
    for body, name in zip(bodies, names, strict=True):
        for part, region in ((body - half, name), (body * half, split.below)):
            pieces += list(part.solids)
            regions += [region] * len(list(part.solids))
    return pieces, regions
