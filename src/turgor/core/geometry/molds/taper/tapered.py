"""Draft of a part: what lies in front of its tapered walls is cut off."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad.facets import Facets, edge_pairs, find_facets
from turgor.core.geometry.molds.parting import areas
from turgor.core.geometry.molds.taper.pull import Pull, space_behind
from turgor.core.geometry.molds.taper.walls import MARGIN, FlatFace, KnownFace, RoundFace, known_faces
from turgor.core.geometry.shapes.solids import cut

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Sine of the angle between two faces above which their inner corner is sharp where one of them is round, and below
#: which they continue each other.
SHARP, STRAIGHT = 0.25, 1e-3

#: A piece belongs to a wall if it is this close to the middle of one of its facets [CAD units].
TOUCHES = 1e-6


def tapered(shape: Any, pull: Pull, upright: Sequence[Array] = ()) -> Any:
    """Return a part whose walls along a pull have the draft; they stay in place in the plane of the pull.

    Between a wall and the wall with draft is a wedge. The part loses of each wedge what touches its wall. In an inner
    corner the wedge ends at the other wall with its draft.

    Parameters
    ----------
    shape : CAD shape
        Part on the side of the plane to which the pull points.
    pull : Pull
    upright : sequence of (3,) arrays [CAD units]
        Points of plane walls that stay.

    Returns
    -------
    CAD shape
        Walls that are neither plane nor round about the pull stay, and those with an inner corner at such a face.

    Examples
    --------
    >>> from math import radians, tan
    >>> from turgor.core.geometry.shapes.solids import box
    >>> block = box((0, 10e-3), (0, 10e-3), (0, 10e-3))
    >>> frustum = tapered(block, Pull(axis=2, side=1, height=0.0, draft=radians(2)))
    >>> top = 10 - 2 * 10 * tan(radians(2))
    >>> f"{frustum.mass:.6f}", f"{10 / 3 * (10**2 + 10 * top + top**2):.6f}"
    ('931.784408', '931.784408')
    """
    faces = list(dict.fromkeys(shape.faces))
    facets = find_facets(shape, faces)
    known = known_faces(faces, facets, pull)
    known = [replace(each, lacking=False) if _has(each, upright) else each for each in known]
    low, high = facets.points.min(axis=0), facets.points.max(axis=0)
    seams = _seams(facets, known)
    reach = float(np.linalg.norm(high - low)) + MARGIN
    removed = []
    for number, wall in enumerate(known):
        if wall is None or not wall.lacking:
            continue
        blocks = _blocks(number, known, seams, pull, reach)
        if blocks is None:
            continue
        tool = wall.wedge(pull, low, high)
        for face in tool.faces:
            face.name = faces[number].name
        removed += _touching(cut(tool, blocks) * shape, facets, number)
    return cut(shape, removed)


def _has(face: KnownFace, points: Sequence[Array]) -> TypeGuard[FlatFace]:
    """Whether one of some points is in the plane of a face."""
    return isinstance(face, FlatFace) and any(abs((each - face.point) @ face.normal) < TOUCHES for each in points)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Seam:
    """An edge of a facet, seen from one of the two faces that meet there.

    ``away`` leads in the plane of this face out of it; ``smooth`` is whether the other face continues this one.
    """

    face: int
    other: int
    ends: tuple[int, int]
    point: Array
    way: Array
    away: Array
    smooth: bool


def _seams(facets: Facets, known: list[KnownFace]) -> list[_Seam]:
    """Edges of the facets at which two faces have an inner corner."""
    pairs, edges, _ = edge_pairs(facets.triangles)
    points, seams = facets.points, []
    _, normals = areas(facets.corners())
    between = facets.face[pairs[:, 0]] != facets.face[pairs[:, 1]]
    for pair, edge in zip(pairs[between], edges[between], strict=True):
        start, end = points[edge]
        way = (end - start) / np.linalg.norm(end - start)
        for mine, other in (pair, pair[::-1]):
            spread = [points[np.setdiff1d(facets.triangles[each], edge)[0]] - start for each in (mine, other)]
            inward, outer = (each - (each @ way) * way for each in spread)
            rise = float(normals[mine] @ outer / np.linalg.norm(outer))
            a, b = int(facets.face[mine]), int(facets.face[other])
            flat = isinstance(known[a], FlatFace) and isinstance(known[b], FlatFace)
            if rise > STRAIGHT:
                away = -inward / np.linalg.norm(inward)
                smooth = not flat and rise < SHARP
                ends = (int(edge[0]), int(edge[1]))
                seams.append(_Seam(face=a, other=b, ends=ends, point=start, way=way, away=away, smooth=smooth))
    return seams


def _blocks(face: int, known: list[KnownFace], seams: list[_Seam], pull: Pull, reach: float) -> list[Any] | None:
    """What a wedge must spare: what lies behind the other faces of each inner corner; None if it is not known."""
    mine, blocks = [each for each in seams if each.face == face], []
    inner = {(each.face, each.other) for each in seams}
    for chain in _chains(mine, inner):
        spared = []
        for seam in {(each.other, each.smooth): each for each in chain}.values():
            other = known[seam.other]
            if isinstance(known[face], RoundFace) and abs(seam.way @ pull.along) > SHARP:
                if seam.smooth:
                    continue  # the wedge of a round wall ends there anyway
                return None
            if seam.smooth and isinstance(other, RoundFace):
                spared.append(space_behind(seam.point, -seam.away, reach))
            elif isinstance(other, FlatFace) or (isinstance(other, RoundFace) and other.outward):
                spared.append(other.inside(pull, reach))
            else:
                return None
        if spared:
            whole = spared[0]
            for each in spared[1:]:
                whole = whole * each
            blocks.append(whole)
    return blocks


def _chains(seams: list[_Seam], inner: set[tuple[int, int]]) -> list[list[_Seam]]:
    """Group seams that share corners, but where the other faces have an inner corner, too.

    Faces that meet in an outer corner bound one thing that stands on the wall, and what lies behind all of them is
    spared. Faces with an inner corner belong to two things.
    """
    chains: list[list[_Seam]] = []
    for seam in seams:
        joined, apart = [seam], []
        for chain in chains:
            meets = any(set(seam.ends) & set(each.ends) and (seam.other, each.other) not in inner for each in chain)
            if meets:
                joined += chain
            else:
                apart.append(chain)
        chains = [*apart, joined]
    return chains


def _touching(pieces: Any, facets: Facets, face: int) -> list[Any]:
    """Pieces that touch the middle of a facet of a face."""
    solids = list(pieces.solids)
    if len(solids) < 2:
        return solids
    middles = [occ.Vertex(occ.Pnt(*map(float, each))) for each in facets.corners(np.array([face])).mean(axis=1)]
    return [solid for solid in solids if any(solid.Distance(each) < TOUCHES for each in middles)]
