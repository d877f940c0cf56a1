"""Semicircular bender: one half-round chamber above a flat bottom with a strain-limiting layer."""

from collections.abc import Mapping
from dataclasses import dataclass

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.ducts import check_inlet
from turgor.core.geometry.parts.layout import Layout, Prism, check_ends, check_fields
from turgor.core.geometry.rules import check_length, check_option
from turgor.core.geometry.shapes.sections import arch, half_disc, rectangle
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class SemicircularBender:
    """Bender with one half-round chamber: the round wall stretches, the layer below the flat floor does not.

    The half round is called the best of the single-chamber sections for bending (Xavier, Fleming and Yong 2021, section
    7.1, guideline 6). Computed, that holds where hoops keep its wall and a stiff base stays flat: then it bends 8 %
    further than a round chamber of the same area. On a base that bulges it becomes round itself and bends a third as
    far as the round one; without hoops a lying rectangle bends further. Without fibers it balloons at higher pressure;
    `FiberReinforcedBender` has fibers. The radius and the wall are those of Polygerinos et al. (2015), quoted and not
    checked against the paper. The rest was chosen here.

    Axes: x from the fixed end to the tip, z up, y across; the bottom lies at z = 0, the mirror plane at y = 0.

    Parameters
    ----------
    radius : float [m]
        Radius of the half-round chamber.
    wall : float [m]
        Thickness of the wall around it.
    floor : float [m]
        Thickness of the silicone between the chamber and the strain-limiting layer.
    base : float [m]
        Thickness of the silicone below the strain-limiting layer; 0 leaves it out, and the layer is the bottom itself.
    layer : float [m]
        Thickness of the strain-limiting layer as a thin solid region between floor and base; 0 for a sheet without
        thickness, a face.
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
    >>> bender = SemicircularBender()
    >>> round(bender.cavity_volumes["cavity"] * 2e9)  # of both halves, mm³
    9048
    >>> SemicircularBender(end_wall=60e-3)
    Traceback (most recent call last):
    turgor.TurgorError: end_wall is 60 mm; allowed is 0.01 mm to 49.995 mm, so that a cavity remains in 100 mm.
    """

    radius: float = 8 * mm
    wall: float = 2 * mm
    floor: float = 1.5 * mm
    base: float = 1.5 * mm
    layer: float = 0.0
    length: float = 100 * mm
    end_wall: float = 5 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    inlet_side: str = "fixed"
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("radius", "wall", "floor"):
            check_length(name, getattr(self, name), high=0.5 * m)
        check_option("base", self.base, high=0.5 * m)
        check_option("layer", self.layer, high=10 * mm)
        check_ends(self, "end_wall")
        check_inlet(
            self, end=2 * half_disc(self.radius).centroid[1], above=self.radius, inside=self.length - 2 * self.end_wall
        )

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return min(self.wall, self.floor, self.base or self.floor, self.end_wall)

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
            them, or the bottom where there is no base; a region of that name where it has a thickness),
            ``fixed`` (the plane x = 0, or the block), ``tip`` (x = length), ``outside`` (the rest)
            and, for a half, ``symmetry_y``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        return self._layout.build()

    @property
    def _layout(self) -> Layout:
        top, half_width, whole = self.base + self.layer, self.radius + self.wall, (0.0, self.length)
        floor_top, across = top + self.floor, (-half_width, half_width)
        body, base = arch(half_width, floor_top, top), rectangle(across, (0.0, self.base))
        sheet = Prism(name="strain_limiting_layer", outline=rectangle(across, (self.base, top)), along=whole)
        inside = (self.end_wall, self.length - self.end_wall)
        return Layout(
            title="semicircular bender",
            pieces=(
                Prism(name="body", outline=body, along=whole),
                *((sheet,) if self.layer else ()),
                *((Prism(name="base", outline=base, along=whole),) if self.base else ()),
            ),
            air=(Prism(name="cavity", outline=half_disc(self.radius, (0.0, floor_top)), along=inside),),
            length=self.length,
            clamp_length=self.clamp_length,
            inlet_diameter=self.inlet_diameter,
            inlet_side=self.inlet_side,
            layer=None if self.layer else self.base,
            mirrors="y" if self.symmetric else "",
            smallest_wall=self.smallest_wall,
        )
