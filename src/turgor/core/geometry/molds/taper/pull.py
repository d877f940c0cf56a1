"""A pull: the axis along which a half or a core is pulled, and how far walls recede on the way."""

from dataclasses import dataclass
from math import tan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Pull:
    """Axis of a pull, and the plane where walls stay in place.

    Parameters
    ----------
    axis : int
        Axis of the pull: 0, 1 or 2.
    side : int
        1 if the part narrows toward positive coordinates, else -1.
    height : float [CAD units]
        Place of the plane on the axis: the parting plane, or the opening of a core.
    draft : float [rad]
        Angle between a wall and the axis.
    """

    axis: int
    side: int
    height: float
    draft: float

    @property
    def along(self) -> Array:
        """Unit vector toward which the part narrows."""
        vector = np.zeros(3)
        vector[self.axis] = self.side
        return vector

    @property
    def across(self) -> tuple[int, int]:
        """The two other axes, so that they and the direction of the axis are right-handed."""
        return (self.axis + 1) % 3, (self.axis + 2) % 3

    def depth(self, points: Array) -> Array:
        """Return the distance of points (..., 3) from the plane [CAD units]."""
        return np.asarray(self.side * (points[..., self.axis] - self.height))

    def recess(self, depth: float) -> float:
        """Return how far a wall recedes at a depth [CAD units]."""
        return tan(self.draft) * depth


def polygon(corners: list[Array]) -> Any:
    """Return a plane face with these corners."""
    points = [occ.Pnt(*map(float, each)) for each in corners]
    sides = [occ.Segment(a, b) for a, b in zip(points, [*points[1:], points[0]], strict=True)]
    return occ.Face(occ.Wire(sides))


def space_behind(point: Array, normal: Array, reach: float) -> Any:
    """Return a block behind a plane with this normal, as large as a reach to all sides of the point."""
    first = np.cross(normal, np.eye(3)[int(np.abs(normal).argmin())])
    first *= reach / np.linalg.norm(first)
    second = np.cross(normal, first)
    square = polygon([point + a * first + b * second for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    return square.Extrude(occ.Vec(*map(float, -reach * normal)))
