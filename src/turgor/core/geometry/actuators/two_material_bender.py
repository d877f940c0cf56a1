"""Two-material bender: a round tube whose lower part is of another material."""

from collections.abc import Mapping
from dataclasses import dataclass

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.ducts import check_inlet
from turgor.core.geometry.parts.layout import Layout, Prism, check_ends, check_fields
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_length, in_mm
from turgor.core.geometry.shapes.sections import disc
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class TwoMaterialBender:
    """Round bender of two materials: the upper part stretches more than the stiffer part below.

    The upper part is the region ``body``, the lower one the region ``base``. Bending is largest when one of them is two
    to three times as stiff as the other (Xavier, Fleming and Yong 2021, section 7.1, guideline 2). A half-round bender
    of two materials is the `SemicircularBender`, whose base is a region of its own too. The radii are those of the
    tubes of Connolly et al. (2015), quoted and not checked against the paper. The rest was chosen here.

    Axes: x from the fixed end to the tip along the axis of the body, z up, y across; the mirror plane is y = 0.

    Parameters
    ----------
    inner_radius : float [m]
        Radius of the chamber.
    wall : float [m]
        Thickness of the wall around it.
    base_height : float [m]
        Height of the part of the other material, from the lowest line of the body; the radius makes equal halves.
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
    >>> TwoMaterialBender().build().regions
    ('body', 'base')
    >>> TwoMaterialBender(base_height=20e-3)
    Traceback (most recent call last):
    turgor.TurgorError: base_height is 20 mm; allowed is 0.01 mm to 16.69 mm, less than the diameter of 16.7 mm.
    """

    inner_radius: float = 6.35 * mm
    wall: float = 2 * mm
    base_height: float = 8.35 * mm
    length: float = 100 * mm
    end_wall: float = 5 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    inlet_side: str = "fixed"
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("inner_radius", "wall"):
            check_length(name, getattr(self, name), high=0.5 * m)
        why = f"less than the diameter of {in_mm(2 * self.outer_radius)}"
        check_length("base_height", self.base_height, high=2 * self.outer_radius - SMALLEST_LENGTH, why=why)
        check_ends(self, "end_wall")
        check_inlet(self, end=2 * self.inner_radius, above=self.inner_radius, inside=self.length - 2 * self.end_wall)

    @property
    def outer_radius(self) -> float:
        """Radius of the outside [m]."""
        return self.inner_radius + self.wall

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return min(self.wall, self.end_wall, self.base_height, 2 * self.outer_radius - self.base_height)

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
            Regions ``body`` and ``base``; faces ``cavity``, ``strain_limiting_layer`` (between body and base),
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
        round_, split, whole = disc(self.outer_radius), self.base_height - self.outer_radius, (0.0, self.length)
        inside = (self.end_wall, self.length - self.end_wall)
        return Layout(
            title="two-material bender",
            pieces=(
                Prism(name="body", outline=round_.cut_z(split), along=whole),
                Prism(name="base", outline=round_.below_z(split), along=whole),
            ),
            air=(Prism(name="cavity", outline=disc(self.inner_radius), along=inside),),
            length=self.length,
            clamp_length=self.clamp_length,
            inlet_diameter=self.inlet_diameter,
            inlet_side=self.inlet_side,
            layer=split,
            mirrors="y" if self.symmetric else "",
            smallest_wall=self.smallest_wall,
        )
