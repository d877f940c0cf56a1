"""Fiber-reinforced bender: a half-round body to be wound with fibers, with a fabric on its flat side."""

from collections.abc import Mapping
from dataclasses import dataclass

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.ducts import check_inlet
from turgor.core.geometry.parts.layout import Layout, Prism, check_ends, check_fields
from turgor.core.geometry.rules import check_length, check_option
from turgor.core.geometry.shapes.sections import arch, half_disc
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class FiberReinforcedBender:
    """Half-round bender to be wound with fibers: they keep it from ballooning, the fabric below makes it bend.

    Fibers are wound around ``outside`` and ``strain_limiting_layer`` together, or with a skin around ``winding`` and
    ``strain_limiting_layer``. Radius, wall, base and length are about those of Polygerinos et al. (2015), not checked
    against the paper. End walls and skin were chosen here.

    Axes: x from the fixed end to the tip, z up, y across; the flat side of the body, with the strain-limiting layer,
    lies at z = 0, the mirror plane at y = 0.

    Parameters
    ----------
    radius : float [m]
        Radius of the half-round chamber.
    wall : float [m]
        Thickness of the wall around it.
    base : float [m]
        Thickness of the silicone between the chamber and the strain-limiting layer.
    skin : float [m]
        Thickness of the silicone around the fibers, the region ``skin``; 0 for none.
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
    >>> round(FiberReinforcedBender().cavity_volumes["cavity"] / 150e-3 * 2e6, 3)  # section of both halves, mm²
    100.531
    >>> FiberReinforcedBender(base=0)
    Traceback (most recent call last):
    turgor.TurgorError: base is 0 mm; allowed is 0.01 mm to 500 mm.
    """

    radius: float = 8 * mm
    wall: float = 2 * mm
    base: float = 2 * mm
    skin: float = 1 * mm
    length: float = 160 * mm
    end_wall: float = 5 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    inlet_side: str = "fixed"
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("radius", "wall", "base"):
            check_length(name, getattr(self, name), high=0.5 * m)
        check_option("skin", self.skin, high=0.5 * m)
        check_ends(self, "end_wall")
        check_inlet(
            self, end=2 * half_disc(self.radius).centroid[1], above=self.radius, inside=self.length - 2 * self.end_wall
        )

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return min(self.wall, self.base, self.end_wall, self.skin or self.wall)

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
            Region ``body`` and, with a skin, ``skin``; faces ``cavity``, ``strain_limiting_layer`` (the flat side of
            the body), ``fixed`` (the plane x = 0, or the block), ``tip`` (x = length), ``outside`` (the rest), with a
            skin ``winding`` (between body and skin, the flat side apart) and, for a half, ``symmetry_y``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        return self._layout.build()

    @property
    def _layout(self) -> Layout:
        half_width, whole = self.radius + self.wall, (0.0, self.length)
        body = arch(half_width, self.base, 0.0)
        pieces = [Prism(name="body", outline=body, along=whole, lateral="winding" if self.skin else "")]
        if self.skin:
            cover = arch(half_width + self.skin, self.base, -self.skin)
            pieces.append(Prism(name="skin", outline=cover, along=whole, hole=body))
        chamber, inside = half_disc(self.radius, (0.0, self.base)), (self.end_wall, self.length - self.end_wall)
        return Layout(
            title="fiber-reinforced bender",
            pieces=tuple(pieces),
            air=(Prism(name="cavity", outline=chamber, along=inside),),
            length=self.length,
            clamp_length=self.clamp_length,
            inlet_diameter=self.inlet_diameter,
            inlet_side=self.inlet_side,
            layer=0.0,
            mirrors="y" if self.symmetric else "",
            smallest_wall=self.smallest_wall,
        )
