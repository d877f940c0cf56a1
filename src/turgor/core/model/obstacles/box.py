"""Box: a rigid block."""

from dataclasses import dataclass

from turgor.core.model.obstacles.rigid_shape import RigidShape, Vector, in_mm, positive
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import vector
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
