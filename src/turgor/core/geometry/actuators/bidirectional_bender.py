"""Bidirectional bender: two chambers above each other, with a wall between them."""

from collections.abc import Mapping
from dataclasses import dataclass

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.layout import Layout, Prism, check_ends, check_fields
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_length, check_option, in_mm
from turgor.core.geometry.shapes.sections import Outline, rectangle
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class BidirectionalBender:
    """Bender with a chamber above and a chamber below its middle wall: it bends away from the one under pressure.

    ``cavity_1`` lies above the middle wall and bends the actuator down, ``cavity_2`` lies below and bends it up; equal
    pressure in both only extends it. The face ``strain_limiting_layer`` halves the middle wall: a material for it puts
    a sheet there, without one it is plain silicone. All dimensions were chosen here.

    Axes: x from the fixed end to the tip, z up, y across; z = 0 halves the middle wall, the mirror plane is y = 0.

    Parameters
    ----------
    width, height : float [m]
        Outer section, both chambers included.
    side_wall : float [m]
        Thickness of the walls next to the chambers.
    outer_wall : float [m]
        Thickness of the walls above the upper and below the lower chamber.
    middle_wall : float [m]
        Thickness of the wall between the chambers.
    length : float [m]
        Length from the fixed end to the tip, end walls included; 1 mm to 2 m.
    end_wall : float [m]
        Thickness of the walls that close the chambers at both ends.
    clamp_length : float [m]
        Length of a solid block before the fixed end whose whole outside is fixed, as in a clamp; 0 for none. It comes
        on top of the length: the fixed end stays at x = 0.
    inlet_diameter : float [m]
        Diameter of an air inlet along x through the fixed end for each chamber, 0 for none. Its wall belongs to the
        chamber's face, and the cavity's volume counts up to its opening.
    symmetric : bool
        Whether to model only the half with y >= 0, cut at the face ``symmetry_y``.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> sorted(BidirectionalBender().cavity_volumes)
    ['cavity_1', 'cavity_2']
    >>> BidirectionalBender(middle_wall=18e-3)
    Traceback (most recent call last):
    turgor.TurgorError: middle_wall is 18 mm; allowed is 0.02 mm to 15.98 mm, so that two cavities remain \
within the height of 20 mm.
    """

    width: float = 14 * mm
    height: float = 20 * mm
    side_wall: float = 2 * mm
    outer_wall: float = 2 * mm
    middle_wall: float = 3 * mm
    length: float = 110 * mm
    end_wall: float = 5 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        least = SMALLEST_LENGTH
        for name in ("width", "height"):
            check_length(name, getattr(self, name), low=1 * mm, high=1 * m)
        why = f"less than half the width of {in_mm(self.width)}"
        check_length("side_wall", self.side_wall, high=(self.width - least) / 2, why=why)
        why = f"so that two cavities remain within the height of {in_mm(self.height)}"
        check_length("outer_wall", self.outer_wall, high=self.height / 2 - 2 * least, why=why)
        high = self.height - 2 * self.outer_wall - 2 * least
        check_length("middle_wall", self.middle_wall, low=2 * least, high=high, why=why)
        check_ends(self, "end_wall")
        high = min(self.width - 2 * self.side_wall, self.chamber_height)
        check_option("inlet_diameter", self.inlet_diameter, high=high, why="so that it ends in the cavity")

    @property
    def chamber_height(self) -> float:
        """Height of each chamber [m]."""
        return (self.height - self.middle_wall) / 2 - self.outer_wall

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]; the middle wall counts half, because the layer halves it."""
        return min(self.side_wall, self.outer_wall, self.middle_wall / 2, self.end_wall)

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of each cavity of the modeled part [m³], from the dimensions."""
        return self._layout.cavity_volumes

    @property
    def solid_volume(self) -> float:
        """Volume of the silicone of the modeled part [m³], from the dimensions."""
        return self._layout.solid_volume

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Region ``body``; faces ``cavity_1`` (above) and ``cavity_2`` (below), ``strain_limiting_layer`` (z = 0),
            ``fixed`` (the plane x = 0, or the block), ``tip`` (x = length), ``outside`` (the rest) and, for a half,
            ``symmetry_y``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        return self._layout.build()

    @property
    def _layout(self) -> Layout:
        across, half, whole = (-self.width / 2, self.width / 2), self.height / 2, (0.0, self.length)
        halves = (rectangle(across, (0.0, half)), rectangle(across, (-half, 0.0)))
        inside = (self.end_wall, self.length - self.end_wall)
        return Layout(
            title="bidirectional bender",
            pieces=tuple(Prism(name="body", outline=outline, along=whole) for outline in halves),
            air=(
                Prism(name="cavity_1", outline=self._chamber(self.middle_wall / 2), along=inside),
                Prism(
                    name="cavity_2", outline=self._chamber(-self.middle_wall / 2 - self.chamber_height), along=inside
                ),
            ),
            length=self.length,
            clamp_length=self.clamp_length,
            inlet_diameter=self.inlet_diameter,
            layer=0.0,
            mirrors="y" if self.symmetric else "",
            smallest_wall=self.smallest_wall,
        )

    def _chamber(self, bottom: float) -> Outline:
        half = self.width / 2 - self.side_wall
        return rectangle((-half, half), (bottom, bottom + self.chamber_height))
