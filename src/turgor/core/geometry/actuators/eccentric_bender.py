"""Eccentric bender: a round body whose round chamber lies off its axis."""

from collections.abc import Mapping
from dataclasses import dataclass

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.ducts import check_inlet
from turgor.core.geometry.parts.layout import Layout, Prism, check_ends, check_fields
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_length, in_mm
from turgor.core.geometry.shapes.sections import disc
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class EccentricBender:
    """Round bender of one material: the wall above its chamber is thinner than the wall below, and stretches more.

    It is the third of the asymmetries of section 2 of Xavier, Fleming and Yong (2021): the void is placed off center.
    All dimensions were chosen here. The wall below is 2.5 times as thick as the wall above; two to three times bend
    most (the same paper, section 7.1, guideline 2).

    Axes: x from the fixed end to the tip along the axis of the body, z up, y across; the mirror plane is y = 0.

    Parameters
    ----------
    outer_radius : float [m]
        Radius of the body.
    inner_radius : float [m]
        Radius of the chamber.
    offset : float [m]
        How far the chamber's axis lies above that of the body.
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
    >>> bender = EccentricBender()
    >>> round(bender.upper_wall * 1e3, 3)  # mm
    2.0
    >>> EccentricBender(offset=4e-3)
    Traceback (most recent call last):
    turgor.TurgorError: offset is 4 mm; allowed is 0.01 mm to 3.49 mm, so that a wall remains above the cavity.
    """

    outer_radius: float = 8 * mm
    inner_radius: float = 4.5 * mm
    offset: float = 1.5 * mm
    length: float = 100 * mm
    end_wall: float = 5 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    inlet_side: str = "fixed"
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        least = SMALLEST_LENGTH
        check_length("outer_radius", self.outer_radius, low=1 * mm, high=0.5 * m)
        why = f"so that a wall remains within {in_mm(self.outer_radius)}"
        check_length("inner_radius", self.inner_radius, high=self.outer_radius - 2 * least, why=why)
        high = self.outer_radius - self.inner_radius - least
        check_length("offset", self.offset, high=high, why="so that a wall remains above the cavity")
        check_ends(self, "end_wall")
        check_inlet(self, end=2 * self.inner_radius, above=self.inner_radius, inside=self.length - 2 * self.end_wall)

    @property
    def upper_wall(self) -> float:
        """Thickness of the wall above the chamber, where it is thinnest [m]."""
        return self.outer_radius - self.inner_radius - self.offset

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return min(self.upper_wall, self.end_wall)

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
            Region ``body``; faces ``cavity``, ``fixed`` (the plane x = 0, or the block), ``tip`` (x = length),
            ``outside`` (the rest) and, for a half, ``symmetry_y``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        return self._layout.build()

    @property
    def _layout(self) -> Layout:
        chamber, inside = disc(self.inner_radius, (0.0, self.offset)), (self.end_wall, self.length - self.end_wall)
        return Layout(
            title="eccentric bender",
            pieces=(Prism(name="body", outline=disc(self.outer_radius), along=(0.0, self.length)),),
            air=(Prism(name="cavity", outline=chamber, along=inside),),
            length=self.length,
            clamp_length=self.clamp_length,
            inlet_diameter=self.inlet_diameter,
            inlet_side=self.inlet_side,
            mirrors="y" if self.symmetric else "",
            smallest_wall=self.smallest_wall,
        )
