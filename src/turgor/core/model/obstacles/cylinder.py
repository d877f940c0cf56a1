"""Cylinder: a rigid round bar."""

from dataclasses import dataclass

import numpy as np

from turgor.core.model.obstacles.rigid_shape import SAME, RigidShape, Vector, across, direction, in_mm, listed, positive
from turgor.foundation.given import vector
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class Cylinder(RigidShape):
    """A rigid round bar, endless or with flat ends.

    Parameters
    ----------
    center : (3,) floats [m]
        A point of its axis: the middle of a bar that has ends.
    axis : (3,) floats
        Direction of its axis; any length but zero.
    radius : float [m]
        More than 0.
    length : float [m], optional
        More than 0; endless if left out.
    """

    center: Vector
    axis: Vector
    radius: float
    length: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", vector(self.center, "cylinder: center", "length"))
        object.__setattr__(self, "axis", direction("cylinder: axis", self.axis))
        positive("cylinder: radius", self.radius)
        if self.length is not None:
            positive("cylinder: length", self.length)

    def text(self) -> str:
        """Return the shape and its place in words."""
        kind = "endless cylinder" if self.length is None else f"cylinder {self.length / mm:g} mm long"
        place = f"around {in_mm(self.center)} along ({listed(self.axis)})"
        return f"{kind} of radius {self.radius / mm:g} mm {place}"

    def turned(self, axis: int, center: Vector) -> bool:
        """Whether both axes are the same."""
        along = np.abs(across(self.axis, axis)).max() < SAME
        return bool(along and np.allclose(across(self.center, axis), across(center, axis), atol=SAME))
