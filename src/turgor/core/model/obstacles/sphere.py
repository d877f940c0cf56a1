"""Sphere: a rigid ball."""

from dataclasses import dataclass

import numpy as np

from turgor.core.model.obstacles.distances import from_center
from turgor.core.model.obstacles.outlines import rounded_block
from turgor.core.model.obstacles.rigid_shape import (
    SAME,
    Array,
    Distances,
    Ints,
    RigidShape,
    Vector,
    across,
    in_mm,
    positive,
)
from turgor.foundation.given import vector
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class Sphere(RigidShape):
    """A rigid ball.

    Parameters
    ----------
    center : (3,) floats [m]
        Its center.
    radius : float [m]
        More than 0.
    """

    center: Vector
    radius: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", vector(self.center, "sphere: center", "length"))
        positive("sphere: radius", self.radius)

    def text(self) -> str:
        """Return the shape and its place in words."""
        return f"sphere of radius {self.radius / mm:g} mm around {in_mm(self.center)}"

    def turned(self, axis: int, center: Vector) -> bool:
        """Whether its center is on the axis."""
        return bool(np.allclose(across(self.center, axis), across(center, axis), atol=SAME))

    def signed_distance(self, points: Array) -> Distances:
        """Compute the distance from the center, less the radius."""
        length, out, bend = from_center(points - np.array(self.center), np.eye(3), ROUND_OFF.zero * self.radius)
        return length - self.radius, out, bend

    def outline(self, place: Array, extent: Array) -> tuple[Array, Ints]:
        """Return triangles of the ball."""
        points, triangles = rounded_block(np.full(3, self.radius), self.radius)
        return points + self.center + place, triangles
