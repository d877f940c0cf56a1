"""Fiber-reinforced cylinder: a round tube to be wound with fibers, with or without a skin."""

from collections.abc import Mapping
from dataclasses import dataclass

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.ducts import check_inlet
from turgor.core.geometry.parts.layout import Layout, Prism, check_ends, check_fields
from turgor.core.geometry.rules import check_length, check_option
from turgor.core.geometry.shapes.sections import disc
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class FiberReinforcedCylinder:
    """Round tube to be wound with fibers, and a thin skin around them.

    Hoops make it extend, two opposite helices extend or contract it, one helix twists it (Xavier, Fleming and Yong
    2021, section 7.2, guidelines 6 to 8; a single helix has no mirror plane, see `TwistingTube`). They are wound on the
    face ``outside``, or on the face ``winding`` below the skin. Radius, wall and length are those of Connolly et al.
    (2015), quoted and not checked against the paper. Caps and skin were chosen here.

    Axes: x from the fixed end to the tip, on the axis of the tube.

    Parameters
    ----------
    inner_radius : float [m]
        Radius of the cavity.
    wall : float [m]
        Thickness of the wall around it.
    skin : float [m]
        Thickness of the silicone around the fibers, the region ``skin``; 0 for none.
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
    symmetric : bool
        Whether to model only the quarter with y >= 0 and z >= 0, cut at the faces ``symmetry_y`` and ``symmetry_z``.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> part = FiberReinforcedCylinder(skin=1e-3).build()
    >>> part.regions, "winding" in part.faces
    (('body', 'skin'), True)
    >>> FiberReinforcedCylinder(skin=-1e-3)
    Traceback (most recent call last):
    turgor.TurgorError: skin is -1 mm; allowed is 0 (none) or 0.01 mm to 500 mm.
    """

    inner_radius: float = 6.35 * mm
    wall: float = 2 * mm
    skin: float = 0.0
    length: float = 160 * mm
    cap: float = 5 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    inlet_side: str = "fixed"
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("inner_radius", "wall"):
            check_length(name, getattr(self, name), high=0.5 * m)
        check_option("skin", self.skin, high=0.5 * m)
        check_ends(self, "cap")
        check_inlet(
            self, end=2 * self.inner_radius, above=self.inner_radius, inside=self.length - 2 * self.cap, quarter=True
        )

    @property
    def outer_radius(self) -> float:
        """Radius of the winding, the body's outside [m]."""
        return self.inner_radius + self.wall

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return min(self.wall, self.cap, self.skin or self.wall)

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
            Region ``body`` and, with a skin, ``skin``; faces ``cavity``, ``fixed`` (the plane x = 0, or the block),
            ``tip`` (x = length), ``outside`` (the rest: the whole lateral surface), with a skin ``winding`` (between
            body and skin) and, for a quarter, ``symmetry_y`` and ``symmetry_z``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        return self._layout.build()

    @property
    def _layout(self) -> Layout:
        body, whole = disc(self.outer_radius), (0.0, self.length)
        pieces = [Prism(name="body", outline=body, along=whole, lateral="winding" if self.skin else "")]
        if self.skin:
            pieces.append(Prism(name="skin", outline=disc(self.outer_radius + self.skin), along=whole, hole=body))
        return Layout(
            title="fiber-reinforced cylinder",
            pieces=tuple(pieces),
            air=(Prism(name="cavity", outline=disc(self.inner_radius), along=(self.cap, self.length - self.cap)),),
            length=self.length,
            clamp_length=self.clamp_length,
            inlet_diameter=self.inlet_diameter,
            inlet_side=self.inlet_side,
            mirrors="yz" if self.symmetric else "",
            smallest_wall=self.smallest_wall,
        )
