"""Planar faces: outlines as one flat CAD shape, split at their intersections."""

from collections.abc import Sequence
from typing import Any

from turgor.core.geometry import occ
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.shapes.sections import Outline, Point, edge_middle


def planar_faces(outlines: Sequence[Outline]) -> Any:
    """Make faces from outlines in the plane of the first two CAD axes, split at their intersections.

    Parameters
    ----------
    outlines : sequence of Outline
        Outlines, which may overlap, touch and lie within each other.

    Returns
    -------
    netgen.occ shape
        Faces that share their edges, in CAD units.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.sections import disc
    >>> len(planar_faces([disc(2e-3), disc(1e-3)]).faces)
    2
    """
    return occ.Glue([_face(outline) for outline in outlines])


def _face(outline: Outline) -> Any:
    edges = []
    for start, end, arc in outline.edges:
        a, b = _point(start), _point(end)
        edges.append(occ.ArcOfCircle(a, _point(edge_middle(start, end, arc)), b) if arc else occ.Segment(a, b))
    return occ.Face(occ.Wire(edges))


def _point(point: Point) -> Any:
    return occ.Pnt(point[0] / METERS_PER_CAD_UNIT, point[1] / METERS_PER_CAD_UNIT, 0)
