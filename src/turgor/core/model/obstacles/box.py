"""Box: a rigid block."""

from dataclasses import dataclass, replace

import numpy as np

from turgor.core.model.obstacles.distances import outer
from turgor.core.model.obstacles.outlines import rounded_block
from turgor.core.model.obstacles.rigid_shape import Array, Distances, Ints, RigidShape, Vector, in_mm, over, positive
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import vector
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class Box(RigidShape):
    """A rigid block with its edges along x, y and z.

    Parameters
    ----------
    center : (3,) floats [m]
        Its center.
    size : (3,) floats [m]
        Its lengths, more than 0 each.
    rounding : float [m]
        Radius of its edges, from 0 to half the shortest length. A sharp edge touches a soft body in a line, where
        pressure and penetration are unbounded; steps also converge better with round edges.
    """

    center: Vector
    size: Vector
    rounding: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", vector(self.center, "box: center", "length"))
        object.__setattr__(self, "size", vector(self.size, "box: size", "length"))
        for length in self.size:
            positive("box: size", length)
        if not 0 <= self.rounding <= min(self.size) / 2:
            raise TurgorError(
                f"box: rounding is {self.rounding * 1e3:g} mm; allowed is 0 to half the shortest length, "
                f"{min(self.size) * 500:g} mm."
            )

    def text(self) -> str:
        """Return the shape and its place in words."""
        edges = f", its edges rounded by {self.rounding / mm:g} mm" if self.rounding else ""
        return f"box of {' × '.join(f'{length / mm:g}' for length in self.size)} mm around {in_mm(self.center)}{edges}"

    def signed_distance(self, points: Array) -> Distances:
        """Compute the distance to a smaller box with sharp edges, less the rounding."""
        from_center = points - np.array(self.center)
        outward = np.where(from_center < 0, -1.0, 1.0)
        beyond = np.abs(from_center) - (np.array(self.size) / 2 - self.rounding)
        face = np.eye(3)[beyond.argmax(axis=1)]
        distance, gradient, hessian = beyond.max(axis=1), outward * face, np.zeros((len(points), 3, 3))
        outside = np.flatnonzero(distance > ROUND_OFF.zero * min(self.size))
        above = np.maximum(beyond[outside], 0.0)
        free = (above > 0)[:, :, None] * np.eye(3)  # one direction next to a face, two to an edge, three at a corner
        length = np.linalg.norm(above, axis=1)
        distance[outside] = length
        gradient[outside] = outward[outside] * above / length[:, None]
        hessian[outside] = (free - outer(gradient[outside], gradient[outside])) / length[:, None, None]
        return distance - self.rounding, gradient, hessian

    def outline(self, place: Array, extent: Array) -> tuple[Array, Ints]:
        """Return triangles of the block."""
        points, triangles = rounded_block(np.array(self.size) / 2, self.rounding)
        return points + self.center + place, triangles

    def scaled(self, length: float) -> "Box":
        """Return the box in units of a length; half a size may be rounded to less than the rounding."""
        size = over(self.size, length)
        rounding = min(self.rounding / length, min(size) / 2)
        return replace(self, center=over(self.center, length), size=size, rounding=rounding)
