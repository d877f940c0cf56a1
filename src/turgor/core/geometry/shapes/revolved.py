"""Revolved solids: an outline in the half plane next to an axis along x, turned about that axis."""

from math import degrees, pi
from typing import Any

from turgor.core.geometry import occ
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.shapes.arcs import Point, edge_middle
from turgor.core.geometry.shapes.sections import Outline

#: Full turn, the half with y >= 0 and the quarter with y >= 0 and z >= 0 [rad].
WHOLE, HALF, QUARTER = 2 * pi, pi, pi / 2


def revolved(outline: Outline, turn: float = WHOLE, center: Point = (0.0, 0.0)) -> Any:
    """Turn an outline about an axis along x into a solid.

    Parameters
    ----------
    outline : Outline
        The profile, as (x, distance from the axis), counterclockwise with x to the right; nothing lies below the axis.
    turn : float [rad]
        `WHOLE`, or on the x axis also `HALF` or `QUARTER`.
    center : (2,) floats [m]
        Position of the axis, as (y, z).

    Returns
    -------
    netgen.occ shape
        In CAD units; its volume is `revolved_volume`.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.sections import rectangle
    >>> from turgor.core.geometry.shapes.solids import volume
    >>> profile = rectangle((0, 1e-3), (0, 2e-3))
    >>> [round(volume(revolved(profile, turn)) / revolved_volume(profile, turn), 9) for turn in (WHOLE, HALF, QUARTER)]
    [1.0, 1.0, 1.0]
    """
    across = (1.0, 0.0) if turn == QUARTER else (0.0, -1.0)  # start of the turn about +x

    def place(point: Point) -> Any:
        scale = METERS_PER_CAD_UNIT
        y, z = (center[i] + across[i] * point[1] for i in (0, 1))
        return occ.Pnt(point[0] / scale, y / scale, z / scale)

    edges = []
    for start, end, arc in outline.edges:
        a, b = place(start), place(end)
        edges.append(occ.ArcOfCircle(a, place(edge_middle(start, end, arc)), b) if arc else occ.Segment(a, b))
    return occ.Face(occ.Wire(edges)).Revolve(occ.Axis(place((0.0, 0.0)), occ.X), degrees(turn))


def revolved_volume(outline: Outline, turn: float = WHOLE) -> float:
    """Volume of a revolved outline [m³]: its area times the path of its centroid (Pappus).

    Examples
    --------
    >>> from turgor.core.geometry.shapes.sections import rectangle
    >>> round(revolved_volume(rectangle((0, 1), (0, 2))) / pi, 9)
    4.0
    """
    return turn * outline.centroid[1] * outline.area
