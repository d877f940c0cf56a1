"""Twisting tube: a round tube for one helix of fiber."""

from collections.abc import Mapping
from dataclasses import dataclass

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.ducts import check_inlet
from turgor.core.geometry.parts.layout import Layout, Prism, check_ends, check_fields
from turgor.core.geometry.rules import check_length
from turgor.core.geometry.shapes.sections import disc
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class TwistingTube:
    """Round tube for a single helix of fiber, which makes it twist under pressure.

    The twist is largest with fibers about 30° from the circumference, which is 60° from the axis (Xavier, Fleming and
    Yong 2021, section 7.2, guideline 6). The best angle depends on the pressure: for a tube of Elastosil M4601 (0.12
    MPa) it is 65° from the axis at 6 kPa and 59° at 62 kPa. The fibers are wound on the face ``outside``. A helix has
    no mirror plane, so the tube is always modeled whole. Radius, wall and the length of about 160 mm are those of
    Connolly et al. (2015), quoted and not checked against the paper. The caps were chosen here.

    Axes: x from the fixed end to the tip, on the axis of the tube.

    Parameters
    ----------
    inner_radius : float [m]
        Radius of the cavity.
    wall : float [m]
        Thickness of the wall around it.
    length : float [m]
        Length from the fixed end to the tip, caps included; 1 mm to 2 m.
    cap : float [m]
        Thickness of the caps at both ends.
    clamp_length : float [m]
        Length of a solid block before the fixed end whose whole outside is fixed, as in a clamp; 0 for none. It comes
        on top of the length: the fixed end stays at x = 0.
    inlet_diameter : float [m]
        Diameter of an air inlet, 0 for none. Its wall belongs to the face ``cavity``, and the cavity's volume counts up
        to its opening.
    inlet_side : str
        ``"fixed"``: the inlet leads along x through the fixed end (and the block); ``"top"``: it leads from the cavity,
        close to the fixed end, straight up.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> round(TwistingTube().cavity_volumes["cavity"] * 1e9)  # mm³
    19002
    >>> TwistingTube(wall=0)
    Traceback (most recent call last):
    turgor.TurgorError: wall is 0 mm; allowed is 0.01 mm to 500 mm.
    """

    inner_radius: float = 6.35 * mm
    wall: float = 2 * mm
    length: float = 160 * mm
    cap: float = 5 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    inlet_side: str = "fixed"

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("inner_radius", "wall"):
            check_length(name, getattr(self, name), high=0.5 * m)
        check_ends(self, "cap")
        check_inlet(self, end=2 * self.inner_radius, above=self.inner_radius, inside=self.length - 2 * self.cap)

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
        """Volume of the silicone of the modeled part [m³], from the dimensions."""
        return self._layout.solid_volume

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Region ``body``; faces ``cavity``, ``fixed`` (the plane x = 0, or the block), ``tip`` (x = length) and
            ``outside`` (the rest: the whole lateral surface).

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        return self._layout.build()

    @property
    def _layout(self) -> Layout:
        inside = (self.cap, self.length - self.cap)
        return Layout(
            title="twisting tube",
            pieces=(Prism(name="body", outline=disc(self.outer_radius), along=(0.0, self.length)),),
            air=(Prism(name="cavity", outline=disc(self.inner_radius), along=inside),),
            length=self.length,
            clamp_length=self.clamp_length,
            inlet_diameter=self.inlet_diameter,
            inlet_side=self.inlet_side,
            smallest_wall=self.smallest_wall,
        )
