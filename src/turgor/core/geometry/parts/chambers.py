"""Sections of the chambers around the axis of an omnidirectional actuator."""

from dataclasses import dataclass
from math import asin, cos, hypot, pi, sin, sqrt

from turgor.core.geometry.shapes.sections import Outline, Point, disc, half_disc, polygon

SHAPES = (
    "circular",
    "semicircular_flat_inward",
    "semicircular_flat_outward",
    "ring_sector",
    "triangular_flat_outward",
    "triangular_apex_outward",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ChamberSection:
    """Section of one of several equal chambers around the x axis; the first lies at +z.

    Parameters
    ----------
    shape : str
        One of `SHAPES`.
    count : int
        Number of chambers around the axis.
    size : float [m]
        Diameter of a circle, flat side of a half circle, side of an equilateral triangle, depth of a ring sector.
    reach : float [m]
        Largest distance of the chamber from the axis.
    web : float [m]
        Thickness of the walls between ring sectors; not used by the others.

    Examples
    --------
    >>> section = ChamberSection(shape="circular", count=3, size=8e-3, reach=10.5e-3, web=2e-3)
    >>> round(section.between * 1e3, 3), round(section.nearest * 1e3, 3)  # mm
    (3.258, 2.5)
    """

    shape: str
    count: int
    size: float
    reach: float
    web: float

    def outline(self, number: int = 1) -> Outline:
        """Outline of a chamber, numbered from 1 at +z counterclockwise seen from the tip."""
        return self._first().turned(2 * pi * (number - 1) / self.count)

    @property
    def height(self) -> float:
        """Extent of the chamber along the radius through its middle [m]."""
        if self.shape.startswith("semicircular"):
            return self.size / 2
        return self.size * sqrt(3) / 2 if self.shape.startswith("triangular") else self.size

    @property
    def top(self) -> float:
        """Distance from the axis to the outermost point in the middle of the chamber [m]."""
        flat = self.shape in ("semicircular_flat_outward", "triangular_flat_outward")
        return sqrt(self.reach**2 - (self.size / 2) ** 2) if flat else self.reach

    @property
    def nearest(self) -> float:
        """Smallest distance of the chamber from the axis [m]."""
        return self.top - self.height

    @property
    def between(self) -> float:
        """Thickness of the wall between two neighbors where it is thinnest [m]."""
        half, radius = pi / self.count, self.size / 2
        if self.shape == "ring_sector":
            return self.web
        if self.shape == "circular":
            return 2 * ((self.top - radius) * sin(half) - radius)
        if self.shape == "semicircular_flat_outward":
            return 2 * (self.top * sin(half) - radius)
        corners = [(radius, self.nearest)]
        if self.shape == "triangular_flat_outward":
            corners = [(radius, self.top), (0.0, self.nearest)]
        return 2 * min(z * sin(half) - y * cos(half) for y, z in corners)

    def middle(self, number: int = 1) -> Point:
        """Position of the inlet: the centroid of a chamber, or the middle of a ring sector, as (y, z) [m]."""
        height = (self.nearest + self.reach) / 2 if self.shape == "ring_sector" else self._first().centroid[1]
        angle = 2 * pi * (number - 1) / self.count
        return -height * sin(angle), height * cos(angle)

    @property
    def room(self) -> float:
        """Radius of a circle around the `middle` that fits into the chamber [m]."""
        radius = self.size / 2
        if self.shape == "circular":
            return radius
        if self.shape.startswith("semicircular"):
            return 4 * radius / (3 * pi)
        if self.shape.startswith("triangular"):
            return radius / sqrt(3)
        return min(self.size / 2, self.middle()[1] * sin(pi / self.count) - self.web / 2)

    def _first(self) -> Outline:
        radius, top, low = self.size / 2, self.top, self.nearest
        if self.shape == "circular":
            return disc(radius, (0.0, top - radius))
        if self.shape == "semicircular_flat_inward":
            return half_disc(radius, (0.0, low))
        if self.shape == "semicircular_flat_outward":
            return half_disc(radius).turned(pi).moved(0.0, top)
        if self.shape == "triangular_flat_outward":
            return polygon([(0.0, low), (radius, top), (-radius, top)])
        if self.shape == "triangular_apex_outward":
            return polygon([(-radius, low), (radius, low), (0.0, top)])
        return self._ring_sector()

    def _ring_sector(self) -> Outline:
        """A ring sector with sides half a web away from the planes between neighbors."""
        inner, outer = (pi / self.count - asin(self.web / 2 / r) for r in (self.nearest, self.reach))
        right_low, right_top = (
            (r * sin(angle), r * cos(angle)) for r, angle in ((self.nearest, inner), (self.reach, outer))
        )
        return Outline(
            corners=(right_low, right_top, (-right_top[0], right_top[1]), (-right_low[0], right_low[1])),
            arcs=(0.0, 2 * outer, 0.0, -2 * inner),
        )


def largest_size(section: ChamberSection, bore_radius: float, wall: float) -> float:
    """Largest size of a chamber that leaves a wall to its neighbors and to a central bore [m].

    Examples
    --------
    >>> section = ChamberSection(shape="circular", count=3, size=8e-3, reach=10.5e-3, web=2e-3)
    >>> round(largest_size(section, 0.0, 1e-3) * 1e3, 3)  # mm
    9.21
    """
    low, high = 0.0, 2 * section.reach
    for _ in range(60):  # both walls get thinner as the chamber grows
        middle = (low + high) / 2
        tried = ChamberSection(
            shape=section.shape, count=section.count, size=middle, reach=section.reach, web=section.web
        )
        low, high = (middle, high) if _fits(tried, bore_radius, wall) else (low, middle)
    return low


def _fits(section: ChamberSection, bore_radius: float, wall: float) -> bool:
    clear = section.between >= wall and section.nearest >= bore_radius + (wall if bore_radius else 0.0)
    if section.shape != "ring_sector":
        return clear
    narrow = hypot(section.web / 2, wall / 2)  # the sides of the sector stay apart at its inner radius
    return clear and section.nearest * sin(pi / section.count) >= narrow


def arrangement(count: int, half: bool) -> list[tuple[str, int, bool]]:
    """Name and number of each modeled cavity around the axis, and whether the mirror plane y = 0 cuts through it.

    In the half with y >= 0 a cavity carries the name of the pair that it makes with its mirror image.

    Parameters
    ----------
    count : int
        Number of cavities of the whole actuator, the first at +z, the others counterclockwise seen from the tip.
    half : bool
        Whether only the half with y >= 0 is modeled.

    Examples
    --------
    >>> arrangement(2, False)
    [('cavity_1', 1, False), ('cavity_2', 2, False)]
    >>> arrangement(3, True)
    [('cavity_1', 1, True), ('cavity_2', 3, False)]
    """
    if not half:
        return [(f"cavity_{i}", i, False) for i in range(1, count + 1)]
    mirrored = [(count + 1 - i) % count + 1 for i in range(1, count // 2 + 2)]
    return [(f"cavity_{i}", number, number == i) for i, number in enumerate(mirrored, start=1)]
