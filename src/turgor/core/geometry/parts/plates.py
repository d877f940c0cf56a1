"""Plates: polygons swept along z or y into solids."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

from turgor.core.geometry import occ
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.shapes.solids import Range

Point = tuple[float, float]


def area(corners: Sequence[Point]) -> float:
    """Area of a polygon [m²], positive where its corners turn left.

    Examples
    --------
    >>> area([(0, 0), (2, 0), (0, 1)])
    1.0
    """
    pairs = zip(corners, [*corners[1:], corners[0]], strict=True)
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in pairs) / 2


def plan(corners: Sequence[Point], up: Range) -> Any:
    """Sweep a polygon of (x, y) corners [m] upwards, between two heights.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.solids import volume
    >>> round(volume(plan([(0, 0), (2e-3, 0), (0, 1e-3)], (0, 5e-3))) * 1e9, 9)  # mm³
    5.0
    """
    return _swept([(x, y, up[0]) for x, y in corners], (0.0, 0.0, up[1] - up[0]))


def profile(corners: Sequence[Point], across: Range) -> Any:
    """Sweep a polygon of (x, z) corners [m] across, between two places along y.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.solids import volume
    >>> round(volume(profile([(0, 0), (2e-3, 0), (0, 1e-3)], (-1e-3, 4e-3))) * 1e9, 9)  # mm³
    5.0
    """
    return _swept([(x, across[0], z) for x, z in corners], (0.0, across[1] - across[0], 0.0))


def _swept(corners: Sequence[tuple[float, ...]], by: tuple[float, ...]) -> Any:
    points = [occ.Pnt(*(value / METERS_PER_CAD_UNIT for value in corner)) for corner in corners]
    edges = [occ.Segment(a, b) for a, b in zip(points, [*points[1:], points[0]], strict=True)]
    return occ.Face(occ.Wire(edges)).Extrude(occ.Vec(*(value / METERS_PER_CAD_UNIT for value in by)))


def wire(corners: Sequence[tuple[float, float, float]]) -> Any:
    """Make a polyline through points [m]; glued to a solid, it splits the faces below it."""
    points = [occ.Pnt(*(value / METERS_PER_CAD_UNIT for value in corner)) for corner in corners]
    return occ.Wire([occ.Segment(a, b) for a, b in pairwise(points)])
