"""Three extenders: extending cylinders that form an equilateral triangle between two plates."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import cos, pi, sin, sqrt

from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.extrusion import RangeName
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.chambers import arrangement
from turgor.core.geometry.parts.layout import Layout, Prism
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_fields, check_length, in_mm
from turgor.core.geometry.shapes.sections import Point, disc
from turgor.core.geometry.shapes.solids import face_names
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class ThreeExtenders:
    """Three parallel extending cylinders between two plates, in an equilateral triangle (Xavier et al. 2021, fig. 1g).

    The cylinder under pressure gets longer and tilts the upper plate away from it; equal pressures push the plate
    straight on. Radius, wall, length and caps of the cylinders are those of the reference extender of that paper (6.35
    mm, 2 mm, 100 mm, 5 mm). All other defaults were chosen here.

    In the published devices fibers keep the cylinders from ballooning; here they can be wound on the face ``winding``.
    The example job has no fibers, so its pressure is small.

    Axes: x from the lower plate (the fixed end) to the upper one (the tip). The first cylinder lies at +z, the others
    follow counterclockwise seen from the tip.

    Parameters
    ----------
    inner_radius : float [m]
        Radius of the cavities.
    wall : float [m]
        Thickness of the wall around them.
    length : float [m]
        Length of a cylinder from plate to plate, its caps included.
    cap : float [m]
        Thickness of the caps of a cylinder, which are of its silicone.
    side : float [m]
        Distance between the axes of two cylinders: the side of the triangle.
    plate_thickness : float [m]
        Thickness of both plates, which are round.
    plate_margin : float [m]
        How far the plates reach beyond the cylinders.
    inlet_diameter : float [m]
        Diameter of the air inlet of each cylinder through the lower plate; 0 leaves the inlets out.
    symmetric : bool
        Whether to model only the half with y >= 0, cut at the face ``symmetry_y``. It holds where the second and the
        third cylinder share one pressure: they are then one face, ``cavity_2``.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> robot = ThreeExtenders(length=60e-3, symmetric=True).build()
    >>> robot.regions
    ('plate', 'body')
    >>> robot.faces
    ('cavity_1', 'cavity_2', 'fixed', 'interface', 'outside', 'symmetry_y', 'tip', 'winding')
    >>> ThreeExtenders(side=10e-3)
    Traceback (most recent call last):
    turgor.TurgorError: side is 10 mm; allowed is 16.71 mm to 2000 mm, so that cylinders of 16.7 mm stay apart.
    """

    inner_radius: float = 6.35 * mm
    wall: float = 2 * mm
    length: float = 100 * mm
    cap: float = 5 * mm
    side: float = 30 * mm
    plate_thickness: float = 4 * mm
    plate_margin: float = 3 * mm
    inlet_diameter: float = 0.0
    symmetric: bool = False

    def __post_init__(self) -> None:
        check_fields(self)
        least = SMALLEST_LENGTH
        check_length("inner_radius", self.inner_radius, low=0.5 * mm, high=0.2 * m)
        check_length("wall", self.wall, low=0.1 * mm, high=0.2 * m)
        check_length("length", self.length, low=1 * mm, high=2 * m)
        why = f"so that a cavity remains within the length of {in_mm(self.length)}"
        check_length("cap", self.cap, low=0.1 * mm, high=(self.length - least) / 2, why=why)
        width = 2 * self.outer_radius
        why = f"so that cylinders of {in_mm(width)} stay apart"
        check_length("side", self.side, low=width + least, high=2 * m, why=why)
        check_length("plate_thickness", self.plate_thickness, low=0.1 * mm, high=0.2 * m)
        check_length("plate_margin", self.plate_margin, low=0.1 * mm, high=1 * m)
        if self.inlet_diameter:
            why = "less than the cavity; 0 leaves it out"
            check_length("inlet_diameter", self.inlet_diameter, high=2 * (self.inner_radius - least), why=why)

    @property
    def outer_radius(self) -> float:
        """Radius of a cylinder [m]."""
        return self.inner_radius + self.wall

    @property
    def plate_radius(self) -> float:
        """Radius of the plates [m]: side / √3 + outer_radius + plate_margin."""
        return self.side / sqrt(3) + self.outer_radius + self.plate_margin

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m], plates included."""
        return min(self.wall, self.cap, self.plate_thickness)

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of each cavity of the modeled part by the name of its face [m³], from the dimensions."""
        return self._layout.cavity_volumes

    @property
    def solid_volume(self) -> float:
        """Volume of silicone and plates of the modeled part [m³], from the dimensions."""
        return self._layout.solid_volume

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Regions ``plate`` (both) and ``body`` (the cylinders); faces ``cavity_1`` to ``cavity_3``, ``fixed`` (the
            plane x = 0), ``tip`` (the far side of the upper plate), ``winding`` (the cylinders' outside),
            ``interface`` (between cylinders and plates), ``outside`` (the rest) and, for a half, ``symmetry_y``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        geometry = self._layout.build()
        low, high = (x / METERS_PER_CAD_UNIT for x in (self._from, self._to))
        for face in geometry._cad.faces:
            (start, _, _), (end, _, _) = face.bounding_box
            if face.name == "outside" and abs(start - low) + abs(end - high) < 1e-3 * (high - low):
                face.name = "winding"
        names = (RangeName(name="winding", axis=0, low=self._from, high=self._to, ends=False),)
        sweep = replace(geometry._sweep, names=(*names, *geometry._sweep.names)) if geometry._sweep else None
        return replace(geometry, faces=face_names(geometry._cad), _sweep=sweep)

    @property
    def _from(self) -> float:
        """Where the cylinders begin [m]."""
        return self.plate_thickness

    @property
    def _to(self) -> float:
        return self.plate_thickness + self.length

    @property
    def _layout(self) -> Layout:
        end = self._to + self.plate_thickness
        plate = disc(self.plate_radius)
        pieces = [Prism(name="plate", outline=plate, along=along) for along in ((0.0, self._from), (self._to, end))]
        air, inside = [], (self._from + self.cap, self._to - self.cap)
        for name, number, _ in arrangement(3, self.symmetric):
            center = triangle_corner(self.side, number)
            pieces.append(Prism(name="body", outline=disc(self.outer_radius, center), along=(self._from, self._to)))
            air.append(Prism(name=name, outline=disc(self.inner_radius, center), along=inside))
            if self.inlet_diameter:
                air.append(Prism(name=name, outline=disc(self.inlet_diameter / 2, center), along=(0.0, inside[0])))
        return Layout(
            title="three extenders",
            pieces=tuple(pieces),
            air=tuple(air),
            length=end,
            mirrors="y" if self.symmetric else "",
            smallest_wall=self.smallest_wall,
        )


def triangle_corner(side: float, number: int) -> Point:
    """Corner of an equilateral triangle around the x axis as (y, z) [m], numbered as cavities are.

    Examples
    --------
    >>> [round(value, 4) for value in triangle_corner(3**0.5, 3)]
    [0.866, -0.5]
    """
    angle, radius = 2 * pi * (number - 1) / 3, side / sqrt(3)
    return -radius * sin(angle), radius * cos(angle)
