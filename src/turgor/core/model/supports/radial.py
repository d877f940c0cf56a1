"""Radial: a cylindrical face that keeps its radius."""

from dataclasses import dataclass

from turgor.core.model.supports.support import Support


@dataclass(frozen=True, slots=True)
class Radial(Support):
    """Hold the radius of a cylindrical face: no displacement normal to the face; it may slide in the face.

    A dense winding of inextensible hoops does the same: the face keeps its radius, whatever the pressure, and is free
    to stretch along the axis and to turn about it.

    Parameters
    ----------
    face : str
        Name of a face that lies on one cylinder, or on a half or a quarter of it.
    axis : (3,) floats
        Direction of the axis of the cylinder; where it lies is found from the face.
    """

    face: str
    axis: tuple[float, float, float] = (1.0, 0.0, 0.0)

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{self.face} does not move radially, around the axis {self.axis}."
