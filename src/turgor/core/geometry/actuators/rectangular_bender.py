"""Rectangular bender: one chamber of rectangular section above a strain-limiting layer."""

from collections.abc import Mapping
from dataclasses import dataclass

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.ducts import check_inlet
from turgor.core.geometry.parts.layout import Layout, Prism, check_ends, check_fields
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_length, check_option, in_mm
from turgor.core.geometry.shapes.sections import Outline, rectangle
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class RectangularBender:
    """Bender with one chamber of rectangular section: the top stretches, the layer below the floor does not.

    All dimensions were chosen here. The envelope is about that of the fast PneuNet. The chamber is about ten times as
    long as wide, which is best for the force at the tip (Xavier, Fleming and Yong 2021, section 7.1, guideline 5).

    Axes: x from the fixed end to the tip, z up, y across; the bottom lies at z = 0, the mirror plane at y = 0.

    Parameters
    ----------
    width, height : float [m]
        Outer section, floor and base included.
    side_wall, top_wall : float [m]
        Thickness of the walls next to and above the chamber.
    floor : float [m]
        Thickness of the silicone between the chamber and the strain-limiting layer.
    base : float [m]
        Thickness of the silicone below the strain-limiting layer; 0 leaves it out, and the layer is the bottom itself.
    length : float [m]
        Length from the fixed end to the tip, end walls included; 1 mm to 2 m.
    end_wall : float [m]
        Thickness of the walls that close the chamber at both ends.
    clamp_length : float [m]
        Length of a solid block before the fixed end whose whole outside is fixed, as in a clamp; 0 for none. It comes
        on top of the length: the fixed end stays at x = 0.
    inlet_diameter : float [m]
        Diameter of an air inlet, 0 for none. Its wall belongs to the face ``cavity``, and the cavity's volume counts up
        to its opening.
    inlet_side : str
        ``"fixed"``: the inlet leads along x through the fixed end (and the block); ``"top"``: it leads from the cavity,
        close to the fixed end, straight up.
    symmetric : bool
        Whether to model only the half with y >= 0, cut at the face ``symmetry_y``.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> round(RectangularBender().cavity_volumes["cavity"] * 2e9)  # of both halves, mm³
    7500
    >>> RectangularBender(side_wall=7e-3)
    Traceback (most recent call last):
    turgor.TurgorError: side_wall is 7 mm; allowed is 0.01 mm to 6.995 mm, less than half the width of 14 mm.
    """

    width: float = 14 * mm
    height: float = 12.5 * mm
    side_wall: float = 2 * mm
    top_wall: float = 2 * mm
    floor: float = 1.5 * mm
    base: float = 1.5 * mm
    length: float = 110 * mm
    end_wall: float = 5 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    inlet_side: str = "fixed"
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        least = SMALLEST_LENGTH
        for name in ("width", "height"):
            check_length(name, getattr(self, name), low=1 * mm, high=1 * m)
        why = f"less than half the width of {in_mm(self.width)}"
        check_length("side_wall", self.side_wall, high=(self.width - least) / 2, why=why)
        why = f"so that a cavity remains within the height of {in_mm(self.height)}"
        check_option("base", self.base, high=self.height - 3 * least, why=why)
        check_length("floor", self.floor, high=self.height - self.base - 2 * least, why=why)
        check_length("top_wall", self.top_wall, high=self.height - self.base - self.floor - least, why=why)
        check_ends(self, "end_wall")
        check_inlet(
            self,
            end=min(self._chamber.corners[2][0] * 2, self._chamber_height),
            above=self._chamber.corners[2][0],
            inside=self.length - 2 * self.end_wall,
        )

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return min(self.side_wall, self.top_wall, self.floor, self.base or self.floor, self.end_wall)

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of the cavity of the modeled part [m³], from the dimensions."""
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
            Regions ``body`` and, where there is one, ``base``; faces ``cavity``, ``strain_limiting_layer`` (between
            them, or the bottom where there is no base),
            ``fixed`` (the plane x = 0, or the block), ``tip`` (x = length), ``outside`` (the rest)
            and, for a half, ``symmetry_y``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        return self._layout.build()

    @property
    def _chamber_height(self) -> float:
        return self.height - self.base - self.floor - self.top_wall

    @property
    def _chamber(self) -> Outline:
        half, bottom = self.width / 2 - self.side_wall, self.base + self.floor
        return rectangle((-half, half), (bottom, bottom + self._chamber_height))

    @property
    def _layout(self) -> Layout:
        across, whole = (-self.width / 2, self.width / 2), (0.0, self.length)
        pieces = [Prism(name="body", outline=rectangle(across, (self.base, self.height)), along=whole)]
        if self.base:
            pieces.append(Prism(name="base", outline=rectangle(across, (0.0, self.base)), along=whole))
        inside = (self.end_wall, self.length - self.end_wall)
        return Layout(
            title="rectangular bender",
            pieces=tuple(pieces),
            air=(Prism(name="cavity", outline=self._chamber, along=inside),),
            length=self.length,
            clamp_length=self.clamp_length,
            inlet_diameter=self.inlet_diameter,
            inlet_side=self.inlet_side,
            layer=self.base,
            mirrors="y" if self.symmetric else "",
            smallest_wall=self.smallest_wall,
        )
