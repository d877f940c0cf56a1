"""Contracting tube: the bladder and the end pieces of a McKibben muscle."""

from collections.abc import Mapping
from dataclasses import dataclass

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.ducts import check_inlet
from turgor.core.geometry.parts.layout import Layout, Prism, check_ends, check_fields
from turgor.core.geometry.rules import check_length
from turgor.core.geometry.shapes.sections import disc
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class ContractingTube:
    """Bladder of a McKibben muscle: a thin tube between two stiffer end pieces.

    With fibers at less than 54.7° to the axis it contracts under pressure (Xavier, Fleming and Yong 2021, section 7.2,
    guideline 8). They are wound on the face ``outside``. All dimensions were chosen here; a small muscle has about
    these.

    Axes: x from the fixed end to the tip, on the axis of the tube.

    Parameters
    ----------
    inner_radius : float [m]
        Radius of the cavity.
    wall : float [m]
        Thickness of the wall around it.
    length : float [m]
        Length from the fixed end to the tip, end pieces included; 1 mm to 2 m.
    cap : float [m]
        Length of the end pieces, which are the region ``cap``.
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
        Whether to model only the quarter with y >= 0 and z >= 0, cut at the faces ``symmetry_y`` and ``symmetry_z``.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> ContractingTube().build().regions
    ('body', 'cap')
    >>> ContractingTube(wall=0)
    Traceback (most recent call last):
    turgor.TurgorError: wall is 0 mm; allowed is 0.01 mm to 500 mm.
    """

    inner_radius: float = 5 * mm
    wall: float = 1 * mm
    length: float = 100 * mm
    cap: float = 6 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    inlet_side: str = "fixed"
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("inner_radius", "wall"):
            check_length(name, getattr(self, name), high=0.5 * m)
        check_ends(self, "cap")
        check_inlet(
            self, end=2 * self.inner_radius, above=self.inner_radius, inside=self.length - 2 * self.cap, quarter=True
        )

    @property
    def outer_radius(self) -> float:
        """Radius of the outside [m]."""
        return self.inner_radius + self.wall

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return min(self.wall, self.cap)

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of the cavity of the modeled part [m³], from the dimensions."""
        return self._layout.cavity_volumes

    @property
    def solid_volume(self) -> float:
        """Volume of the bladder and the end pieces of the modeled part [m³], from the dimensions."""
        return self._layout.solid_volume

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Regions ``body`` (the bladder) and ``cap``; faces ``cavity``, ``fixed`` (the plane x = 0, or the block),
            ``tip`` (x = length), ``interface`` (between body and caps), ``outside`` (the rest: the whole lateral
            surface) and, for a quarter, ``symmetry_y`` and ``symmetry_z``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        return self._layout.build()

    @property
    def _layout(self) -> Layout:
        outer, inner, end = disc(self.outer_radius), disc(self.inner_radius), self.length - self.cap
        return Layout(
            title="contracting tube",
            pieces=(
                Prism(name="body", outline=outer, along=(self.cap, end)),
                Prism(name="cap", outline=outer, along=(0.0, self.cap)),
                Prism(name="cap", outline=outer, along=(end, self.length)),
            ),
            air=(Prism(name="cavity", outline=inner, along=(self.cap, end)),),
            length=self.length,
            clamp_length=self.clamp_length,
            inlet_diameter=self.inlet_diameter,
            inlet_side=self.inlet_side,
            mirrors="yz" if self.symmetric else "",
            smallest_wall=self.smallest_wall,
        )
