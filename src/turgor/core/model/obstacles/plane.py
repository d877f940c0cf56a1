"""Plane: a rigid half space."""

from dataclasses import dataclass, field

import numpy as np

from turgor.core.model.obstacles.outlines import frame, span
from turgor.core.model.obstacles.rigid_shape import (
    DIRECTION,
    SAME,
    Array,
    Distances,
    Ints,
    RigidShape,
    Vector,
    across,
    direction,
    in_mm,
    listed,
)
from turgor.foundation.given import vector


@dataclass(frozen=True, slots=True, kw_only=True)
class Plane(RigidShape):
    """A rigid half space.

    Parameters
    ----------
    point : (3,) floats [m]
        Any point of its surface.
    normal : (3,) floats
        Direction out of the rigid side, towards the actuator; any length but zero.

    Examples
    --------
    >>> Plane(point=(0, 0, -0.01), normal=(0, 0, 2)).normal
    (0.0, 0.0, 1.0)
    """

    point: Vector
    normal: Vector = field(metadata=DIRECTION)

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", vector(self.point, "plane: point", "length"))
        object.__setattr__(self, "normal", direction("plane: normal", self.normal))

    def text(self) -> str:
        """Return the shape and its place in words."""
        return f"plane through {in_mm(self.point)} with the normal ({listed(self.normal)})"

    def turned(self, axis: int, center: Vector) -> bool:
        """Whether the axis is its normal."""
        return bool(np.abs(across(self.normal, axis)).max() < SAME)

    @property
    def facing(self) -> Vector:
        """The normal."""
        return self.normal

    @property
    def middle(self) -> Vector:
        """Its point, for it has no middle."""
        return self.point

    def not_graspable(self, fingers: int) -> str:
        """A plane has no far side."""
        return "it is a plane, which has no far side; take a cylinder, sphere, box or STL file."

    def signed_distance(self, points: Array) -> Distances:
        """Compute the distance along the normal."""
        normal = np.array(self.normal)
        distance = (points - np.array(self.point)) @ normal
        return distance, np.tile(normal, (len(points), 1)), np.zeros((len(points), 3, 3))

    def outline(self, place: Array, extent: Array) -> tuple[Array, Ints]:
        """Return a rectangle that covers the projection of the actuator, with a margin."""
        axes = np.stack(frame(np.array(self.normal)))
        low, high = span(np.array(self.point) + place, axes, extent)
        corners = np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]])
        return np.array(self.point) + corners @ axes + place, np.array([[0, 1, 2], [0, 2, 3]])
