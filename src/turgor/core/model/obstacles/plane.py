"""Plane: a rigid half space."""

from dataclasses import dataclass

import numpy as np

from turgor.core.model.obstacles.rigid_shape import SAME, RigidShape, Vector, across, direction, in_mm, listed
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
    normal: Vector

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", vector(self.point, "plane: point", "length"))
        object.__setattr__(self, "normal", direction("plane: normal", self.normal))

    def text(self) -> str:
        """Return the shape and its place in words."""
        return f"plane through {in_mm(self.point)} with the normal ({listed(self.normal)})"

    def turned(self, axis: int, center: Vector) -> bool:
        """Whether the axis is its normal."""
        return bool(np.abs(across(self.normal, axis)).max() < SAME)
