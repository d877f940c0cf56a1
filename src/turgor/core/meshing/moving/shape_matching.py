"""Matched: the parts of two CAD shapes of one construction, brought into one order."""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from turgor.core.meshing.moving.curves import Curve
from turgor.core.meshing.moving.parts import Parts
from turgor.core.meshing.moving.settings import MOVING
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def matched(known: Parts, parts: Parts, name: str) -> Parts:
    """Bring the parts of a shape into the order of those of a similar one.

    The CAD kernel numbers parts by where they are, so the order may change with a dimension. Vertices are matched with
    the nearest ones, and in the order of the construction where this does not fit edges and faces, as after a motion
    beyond their distances. Edges are matched by their vertices, faces by their edges.

    Parameters
    ----------
    known : Parts
    parts : Parts
    name : str
        Of the geometry.

    Returns
    -------
    Parts

    Raises
    ------
    TurgorError
        If the shape has other vertices, edges or faces.
    """
    sizes = [(len(each.vertices), len(each.curves), len(each.surfaces)) for each in (known, parts)]
    if sizes[0] == sizes[1]:
        nearest = np.asarray(cKDTree(parts.vertices).query(known.vertices)[1], dtype=np.int64)
        for vertices in (nearest, np.arange(len(known.vertices))):
            ordered = _reordered(known, parts, vertices)
            if ordered is not None:
                return ordered
    raise TurgorError(
        f"the CAD shape of '{name}' has other faces or edges there, so the nodes of its tetrahedra cannot follow; "
        "a dimension is at a value where an edge appears or vanishes."
    )


def _reordered(known: Parts, parts: Parts, vertices: Ints) -> Parts | None:
    """The parts in the order of known ones, of which the vertices are given; None where others do not fit."""
    if len(np.unique(vertices)) < len(vertices):
        return None
    number = np.argsort(vertices)
    ends = [tuple(int(number[i]) for i in each) for each in parts.ends]
    edges = _paired(
        [frozenset(each) for each in known.ends],
        [frozenset(each) for each in ends],
        lambda one, other: _away(
            known.curves[one].samples[MOVING.samples // 2], parts.curves[other].samples[MOVING.samples // 2]
        ),
    )
    if edges is None:
        return None
    place = {edge: number for number, edge in enumerate(edges)}
    rims = [frozenset(place[edge] for edge in rim) for rim in parts.rims]
    faces = _paired(
        list(zip(known.rims, known.names, strict=True)),
        list(zip(rims, parts.names, strict=True)),
        lambda one, other: _away(known.surfaces[one].center, parts.surfaces[other].center),
    )
    if faces is None:
        return None
    curves = (
        _directed(curve, own, parts.curves[edge], ends[edge])
        for curve, own, edge in zip(known.curves, known.ends, edges, strict=True)
    )
    surfaces = tuple(parts.surfaces[face] for face in faces)
    return replace(known, vertices=parts.vertices[vertices], curves=tuple(curves), surfaces=surfaces)


def _paired(
    known: Sequence[Hashable], others: Sequence[Hashable], away: Callable[[int, int], float]
) -> list[int] | None:
    """Place of the partner of each known key, the nearest one of those that are equal; None where one has no own."""
    places: dict[Hashable, list[int]] = {}
    for place, key in enumerate(others):
        places.setdefault(key, []).append(place)
    partners = []
    for number, key in enumerate(known):
        unpaired = places.get(key, [])
        if not unpaired:
            return None
        partners.append(unpaired[0] if len(unpaired) == 1 else min(unpaired, key=lambda place: away(number, place)))
        unpaired.remove(partners[-1])
    return partners


def _directed(known: Curve, own: tuple[int, ...], curve: Curve, ends: tuple[int, ...]) -> Curve:
    """A curve in the direction of a known one."""
    turned = own != ends
    if len(ends) == 1:
        quarter = MOVING.samples // 4  # a sample by which the direction of a closed curve is determined
        forward, backward = curve.samples[quarter], curve.samples[MOVING.samples - 1 - quarter]
        turned = _away(known.samples[quarter], forward) > _away(known.samples[quarter], backward)
    return Curve(curve.edge, curve.high, curve.low, curve.scale) if turned else curve


def _away(one: Array, other: Array) -> float:
    return float(np.linalg.norm(one - other))
