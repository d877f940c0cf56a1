"""Prism: an outline swept along x, a piece of a `Layout`."""

from dataclasses import dataclass
from typing import Any

from turgor.core.geometry.shapes.sections import Outline, prism
from turgor.core.geometry.shapes.solids import Range, name_plane


@dataclass(frozen=True, slots=True, kw_only=True)
class Prism:
    """An outline swept along x: a piece of a region, or of a cavity.

    Parameters
    ----------
    name : str
        Region that it belongs to; for a piece of a cavity, the name of the cavity's face.
    outline : Outline
        Section of the whole actuator; `Layout` cuts it at the mirror planes.
    along : (2,) floats [m]
        Range along x.
    hole : Outline or None
        Outline of a hole inside the outline.
    lateral : str
        Name of the faces along x where another region covers them; empty for no name of their own.
    """

    name: str
    outline: Outline
    along: Range
    hole: Outline | None = None
    lateral: str = ""

    @property
    def volume(self) -> float:
        """Volume [m³]."""
        area = self.outline.area - (self.hole.area if self.hole else 0.0)
        return area * (self.along[1] - self.along[0])

    def solid(self) -> Any:
        """Build the CAD shape."""
        outer = prism(self.outline, self.along)
        shape = outer - prism(self.hole, self.along) if self.hole else outer
        if self.lateral:
            for face in shape.faces:
                face.name = self.lateral
            for x in self.along:
                name_plane(shape, 0, x, "")
        return shape
