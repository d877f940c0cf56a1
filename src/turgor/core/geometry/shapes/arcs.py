"""Arcs: an edge of an outline from one corner to the next, straight or along a circle."""

from math import atan2, cos, hypot, pi, sin, tan

from turgor.core.geometry.shapes.tolerances import TOLERANCE

Point = tuple[float, float]


def edge_radius(a: Point, b: Point, arc: float) -> float:
    """Return the radius of the circle of an arc."""
    return hypot(b[0] - a[0], b[1] - a[1]) / (2 * abs(sin(arc / 2)))


def edge_center(a: Point, b: Point, arc: float) -> Point:
    """Center of the circle of an arc: left of the chord where it turns left by less than half a turn."""
    away = 1 / (2 * tan(arc / 2))
    return (a[0] + b[0]) / 2 - (b[1] - a[1]) * away, (a[1] + b[1]) / 2 + (b[0] - a[0]) * away


def edge_middle(a: Point, b: Point, arc: float) -> Point:
    """Point halfway along an edge that turns through an angle.

    Examples
    --------
    >>> edge_middle((-1.0, 0.0), (1.0, 0.0), pi / 2)[1] < 0  # a left turn passes on the right of its chord
    True
    """
    away = tan(arc / 4) / 2
    return (a[0] + b[0]) / 2 + (b[1] - a[1]) * away, (a[1] + b[1]) / 2 - (b[0] - a[0]) * away


def segment_area(a: Point, b: Point, arc: float) -> float:
    """Area between an arc and its chord, negative where the arc turns right."""
    return edge_radius(a, b, arc) ** 2 * (arc - sin(arc)) / 2 if arc else 0.0


def segment_centroid(a: Point, b: Point, arc: float) -> Point:
    """Center of the area between an arc and its chord."""
    (cy, cz), (my, mz) = edge_center(a, b, arc), edge_middle(a, b, arc)
    share = 4 * sin(abs(arc) / 2) ** 3 / (3 * (abs(arc) - sin(abs(arc))))  # from the center
    return cy + share * (my - cy), cz + share * (mz - cz)


def split_edge(start: Point, end: Point, arc: float, axis: int, at: float) -> list[tuple[Point, Point, float]]:
    """Cut an edge where coordinate ``axis`` is ``at``."""
    if not arc:
        low, high = start[axis] - at, end[axis] - at
        shares = [low / (low - high)] if low * high < 0 else []
        places = [tuple(a + share * (b - a) for a, b in zip(start, end, strict=True)) for share in shares]
    else:
        center, radius = edge_center(start, end, arc), edge_radius(start, end, arc)
        first = atan2(start[1] - center[1], start[0] - center[0])
        shares = _crossings(first, arc, axis, (at - center[axis]) / radius)
        angles = [first + share * arc for share in shares]
        places = [(center[0] + radius * cos(angle), center[1] + radius * sin(angle)) for angle in angles]
    exact = [(at, place[1]) if axis == 0 else (place[0], at) for place in places]
    points, bounds = [start, *exact, end], [0.0, *shares, 1.0]
    return [(points[i], points[i + 1], (bounds[i + 1] - bounds[i]) * arc) for i in range(len(points) - 1)]


def _crossings(first: float, arc: float, axis: int, height: float) -> list[float]:
    """Shares of an arc, in order, at which it crosses the line at ``height`` radii from its center."""
    if abs(height) >= 1:
        return []
    base = atan2((1 - height**2) ** 0.5, height)
    shares = []
    for angle in (base, -base) if axis == 0 else (pi / 2 - base, pi / 2 + base):
        for turn in (-2, -1, 0, 1, 2):
            share = (angle + 2 * pi * turn - first) / arc
            if TOLERANCE.round_off < share < 1 - TOLERANCE.round_off:
                shares.append(share)
    return sorted(shares)
