"""Sections: planar outlines of straight edges and arcs in the y-z plane, and the solids that they sweep along x."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, ceil, cos, hypot, pi, sin, tan
from typing import Any

from turgor.core.geometry import occ
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.shapes.arcs import Point as Point  # part of this module's names
from turgor.core.geometry.shapes.arcs import edge_middle as edge_middle
from turgor.core.geometry.shapes.arcs import (
    edge_radius,
    segment_area,
    segment_centroid,
    split_edge,
)
from turgor.core.geometry.shapes.solids import Range
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.foundation.errors import TurgorError


@dataclass(frozen=True, slots=True, kw_only=True)
class Outline:
    """A closed outline in the y-z plane, counterclockwise seen from the tip, of straight edges and circular arcs.

    Area and centroid are computed from corners and arcs alone, so that they can check the CAD volumes.

    Parameters
    ----------
    corners : tuple of (2,) floats [m]
        Corners, as (y, z).
    arcs : tuple of float [rad]
        Angle through which each edge turns on its way to the next corner: 0 for a straight edge, positive where it
        turns to the left, at most a full turn less a little. The circle of an arc follows from it.

    Examples
    --------
    >>> quarter = Outline(corners=((0, 0), (1, 0), (0, 1)), arcs=(0, pi / 2, 0))
    >>> round(quarter.area / pi, 6)
    0.25
    """

    corners: tuple[Point, ...]
    arcs: tuple[float, ...]

    @property
    def edges(self) -> tuple[tuple[Point, Point, float], ...]:
        """Each edge as its start, its end and the angle through which it turns."""
        return tuple(zip(self.corners, self.corners[1:] + self.corners[:1], self.arcs, strict=True))

    @property
    def area(self) -> float:
        """Area inside [m²]: that of the polygon of the corners and of the circular segments on its edges."""
        return sum((a[0] * b[1] - b[0] * a[1]) / 2 + segment_area(a, b, arc) for a, b, arc in self.edges)

    @property
    def centroid(self) -> Point:
        """Center of the area [m]."""
        y = z = 0.0
        for a, b, arc in self.edges:
            triangle = (a[0] * b[1] - b[0] * a[1]) / 2
            y, z = y + triangle * (a[0] + b[0]) / 3, z + triangle * (a[1] + b[1]) / 3
            if arc:
                segment, (cy, cz) = segment_area(a, b, arc), segment_centroid(a, b, arc)
                y, z = y + segment * cy, z + segment * cz
        return y / self.area, z / self.area

    @property
    def perimeter(self) -> float:
        """Length of all edges [m]."""
        return sum(
            edge_radius(a, b, arc) * abs(arc) if arc else hypot(b[0] - a[0], b[1] - a[1]) for a, b, arc in self.edges
        )

    def moved(self, y: float = 0.0, z: float = 0.0) -> "Outline":
        """Return the outline moved by (y, z) [m]."""
        return Outline(corners=tuple((a + y, b + z) for a, b in self.corners), arcs=self.arcs)

    def turned(self, angle: float) -> "Outline":
        """Return the outline turned about x by an angle [rad], counterclockwise seen from the tip."""
        c, s = cos(angle), sin(angle)
        return Outline(corners=tuple((c * y - s * z, s * y + c * z) for y, z in self.corners), arcs=self.arcs)

    def cut_y(self, at: float = 0.0) -> "Outline":
        """Return the part with y >= ``at``, which must be in one piece."""
        return self._cut(0, at)

    def cut_z(self, at: float = 0.0) -> "Outline":
        """Return the part with z >= ``at``, which must be in one piece.

        Examples
        --------
        >>> round(disc(2.0).cut_y().cut_z().area / pi, 6)
        1.0
        """
        return self._cut(1, at)

    def below_z(self, at: float = 0.0) -> "Outline":
        """Return the part with z <= ``at``, which must be in one piece."""
        return self.turned(pi).cut_z(-at).turned(-pi)

    def _cut(self, axis: int, at: float) -> "Outline":
        tolerance = TOLERANCE.round_off * max(hypot(*corner) for corner in self.corners)
        pieces = []
        for start, end, arc in self.edges:
            pieces += [
                piece for piece in split_edge(start, end, arc, axis, at) if edge_middle(*piece)[axis] - at > tolerance
            ]
        corners: list[Point] = []
        arcs: list[float] = []
        for i, (start, end, arc) in enumerate(pieces):
            corners.append(start)
            arcs.append(arc)
            following = pieces[(i + 1) % len(pieces)][0]
            if hypot(following[0] - end[0], following[1] - end[1]) > tolerance:  # along the cut
                corners.append(end)
                arcs.append(0.0)
        return Outline(corners=tuple(corners), arcs=tuple(arcs))


def disc(radius: float, center: Point = (0.0, 0.0)) -> Outline:
    """Make a disc, as two half circles that meet on the z axis through its center.

    Examples
    --------
    >>> round(disc(1.0).area / pi, 6)
    1.0
    """
    return Outline(corners=((0.0, -radius), (0.0, radius)), arcs=(pi, pi)).moved(*center)


def half_disc(radius: float, center: Point = (0.0, 0.0)) -> Outline:
    """Make a half disc with its flat side down; turn it before moving it for another orientation.

    Examples
    --------
    >>> [round(value, 4) for value in half_disc(1.0).centroid]
    [0.0, 0.4244]
    """
    return Outline(corners=((radius, 0.0), (0.0, radius), (-radius, 0.0)), arcs=(pi / 2, pi / 2, 0.0)).moved(*center)


def ring_sector(inner: float, outer: float, start: float, stop: float) -> Outline:
    """Make the part of a ring between two angles, counted from +y towards +z.

    Parameters
    ----------
    inner, outer : float [m]
        Radii; an inner one of 0 makes a sector of a disc.
    start, stop : float [rad]
        Range of angles, less than a full turn.

    Examples
    --------
    >>> round(ring_sector(1.0, 2.0, 0.0, pi / 2).area / pi, 6)
    0.75
    >>> ring_sector(2.0, 1.0, 0.0, pi)
    Traceback (most recent call last):
    turgor.TurgorError: ring_sector: the inner radius is 2 m, the outer one 1 m; 0 <= inner < outer is needed.
    """
    if not 0 <= inner < outer:
        raise TurgorError(
            f"ring_sector: the inner radius is {inner:g} m, the outer one {outer:g} m; 0 <= inner < outer is needed."
        )
    if not 0 < stop - start < 2 * pi:
        raise TurgorError(
            f"ring_sector: it goes from {start:g} to {stop:g} rad; more than 0 and less than a full turn is needed."
        )
    pieces = ceil((stop - start) / pi * 1.01)  # arcs of less than half a turn
    angles = [start + (stop - start) * i / pieces for i in range(pieces + 1)]
    step = (stop - start) / pieces
    corners = [(outer * cos(angle), outer * sin(angle)) for angle in angles]
    arcs = [step] * pieces + [0.0]
    if inner > 0:
        corners += [(inner * cos(angle), inner * sin(angle)) for angle in reversed(angles)]
        arcs += [-step] * pieces + [0.0]
    else:
        corners.append((0.0, 0.0))
        arcs.append(0.0)
    return Outline(corners=tuple(corners), arcs=tuple(arcs))


def polygon(points: Sequence[Point]) -> Outline:
    """Make a polygon from its corners, counterclockwise seen from the tip.

    Examples
    --------
    >>> polygon([(0, 0), (2, 0), (0, 1)]).area
    1.0
    """
    return Outline(corners=tuple((float(y), float(z)) for y, z in points), arcs=(0.0,) * len(points))


def rectangle(y: Range, z: Range) -> Outline:
    """Make a rectangle from its ranges.

    Examples
    --------
    >>> rectangle((0, 2), (1, 4)).area
    6.0
    """
    return polygon([(y[0], z[0]), (y[1], z[0]), (y[1], z[1]), (y[0], z[1])])


def arch(radius: float, spring: float, bottom: float) -> Outline:
    """Make a half disc with its center at z = ``spring``, on straight sides down to z = ``bottom``.

    Examples
    --------
    >>> round(arch(1.0, 2.0, 0.0).area - 4.0 - pi / 2, 12)
    0.0
    """
    corners = ((radius, bottom), (radius, spring), (0.0, spring + radius), (-radius, spring), (-radius, bottom))
    return Outline(corners=corners, arcs=(0.0, pi / 2, pi / 2, 0.0, 0.0))


def rounded(points: Sequence[Point], radius: float) -> Outline:
    """Make a polygon whose corners are rounded with one radius; it must fit between them.

    Examples
    --------
    >>> round(rounded([(0, 0), (2, 0), (2, 2), (0, 2)], 1.0).area / pi, 6)
    1.0
    """
    corners: list[Point] = []
    arcs: list[float] = []
    for i, (y, z) in enumerate(points):
        (py, pz), (ny, nz) = points[i - 1], points[(i + 1) % len(points)]
        before, after = atan2(z - pz, y - py), atan2(nz - z, ny - y)
        turn = (after - before + pi) % (2 * pi) - pi
        back = radius * abs(tan(turn / 2))
        corners += [(y - back * cos(before), z - back * sin(before)), (y + back * cos(after), z + back * sin(after))]
        arcs += [turn, 0.0]
    return _without_empty_edges(Outline(corners=tuple(corners), arcs=tuple(arcs)))


def prism(outline: Outline, along: Range) -> Any:
    """Sweep an outline along x into a solid.

    Parameters
    ----------
    outline : Outline
        The section.
    along : (2,) floats [m]
        Range along x.

    Returns
    -------
    netgen.occ shape
        In CAD units; its volume is the area of the outline times the length.
    """
    x = along[0] / METERS_PER_CAD_UNIT
    edges = []
    for start, end, arc in outline.edges:
        a, b = _point(x, start), _point(x, end)
        edges.append(occ.ArcOfCircle(a, _point(x, edge_middle(start, end, arc)), b) if arc else occ.Segment(a, b))
    return occ.Face(occ.Wire(edges)).Extrude(occ.Vec((along[1] - along[0]) / METERS_PER_CAD_UNIT, 0, 0))


def tube(outer: Outline, inner: Outline, along: Range) -> Any:
    """Sweep the area between two outlines along x: a ring from two discs, or its half from two half discs."""
    return prism(outer, along) - prism(inner, along)


def _point(x: float, point: Point) -> Any:
    return occ.Pnt(x, point[0] / METERS_PER_CAD_UNIT, point[1] / METERS_PER_CAD_UNIT)


def _without_empty_edges(outline: Outline) -> Outline:
    size = max(hypot(*corner) for corner in outline.corners)
    edges = [(a, arc) for a, b, arc in outline.edges if hypot(b[0] - a[0], b[1] - a[1]) > 1e-9 * size]
    return Outline(corners=tuple(a for a, _ in edges), arcs=tuple(arc for _, arc in edges))
