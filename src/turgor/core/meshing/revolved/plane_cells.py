"""Plane cells: triangles and quadrilaterals of a plane mesh as quadrilaterals of nine nodes that fit each other."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.coinciding_points import same_places
from turgor.core.meshing.exchange.formats.raw import Block
from turgor.core.meshing.sweeping.hexahedra import TURNED_OVER

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Edge = tuple[int, int]

#: Thirds of a triangle and quarters of a square, by the places of their corners in natural coordinates. Each begins at
#: a corner of the cell and runs from there to the middle of the edge that begins there.
_CENTER = (1 / 3, 1 / 3)
_THIRDS = (
    ((0.0, 0.0), (0.5, 0.0), _CENTER, (0.0, 0.5)),
    ((1.0, 0.0), (0.5, 0.5), _CENTER, (0.5, 0.0)),
    ((0.0, 1.0), (0.0, 0.5), _CENTER, (0.5, 0.5)),
)
_QUARTERS = (
    ((0.0, 0.0), (0.5, 0.0), (0.5, 0.5), (0.0, 0.5)),
    ((1.0, 0.0), (1.0, 0.5), (0.5, 0.5), (0.5, 0.0)),
    ((1.0, 1.0), (0.5, 1.0), (0.5, 0.5), (1.0, 0.5)),
    ((0.0, 1.0), (0.0, 0.5), (0.5, 0.5), (0.5, 1.0)),
)
_WHOLE = (((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)),)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PlaneCells:
    """Quadrilaterals of nine nodes.

    Parameters
    ----------
    points : (n, 2) array
        The points of the file, and further ones after them.
    quads : (q, 9) int array
        Corners counterclockwise, mid-side nodes, the middle.
    groups : dict of str to (g,) int array
        Quadrilaterals of each group of the file.
    edges : dict of Edge to tuple of Edge
        For the ends of each edge of the file, the lower one first, the ends of its parts.
    was_cut : bool
        Whether the cells were cut: one triangle is enough.
    """

    points: Array
    quads: Ints
    groups: dict[str, Ints]
    edges: dict[Edge, tuple[Edge, ...]]
    was_cut: bool


def plane_cells(points: Array, blocks: Sequence[Block]) -> PlaneCells:
    """Make quadrilaterals of nine nodes out of plane cells of any kind.

    Triangles are cut into three. All other cells are then cut into four, so that they fit.

    Parameters
    ----------
    points : (n, 2) array
    blocks : sequence of Block
        Triangles of 3 or 6 nodes and quadrilaterals of 4, 8 or 9.

    Returns
    -------
    PlaneCells

    Examples
    --------
    >>> from turgor.core.meshing.exchange.formats.raw import KINDS
    >>> corners = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    >>> cells = plane_cells(corners, [Block(kind=KINDS["triangle3"], nodes=np.array([[0, 1, 2]]))])
    >>> len(cells.quads), len(cells.points), cells.edges[0, 1]
    (3, 19, ((0, 3), (3, 1)))
    """
    cut = any(block.kind.corners == 3 for block in blocks)
    nodes, start, parts, count = [points], len(points), [], 0
    groups: dict[str, Ints] = {}
    for block in blocks:
        pieces = _THIRDS if block.kind.corners == 3 else _QUARTERS if cut else _WHOLE
        places = np.array([_nine(np.array(piece)) for piece in pieces]).reshape(-1, 2)
        new = np.einsum("pn,cni->cpi", _shapes(places, block.kind.nodes), points[block.nodes])
        parts.append(start + np.arange(new.shape[0] * new.shape[1]).reshape(-1, 9))
        nodes.append(new.reshape(-1, 2))
        for name, rows in block.groups.items():
            own = count + (len(pieces) * rows[:, None] + np.arange(len(pieces))).ravel()
            groups[name] = np.concatenate([groups[name], own]) if name in groups else own
        start, count = start + new.shape[0] * new.shape[1], count + len(pieces) * len(block.nodes)
    quads = np.concatenate(parts)
    number, first = same_places(np.concatenate(nodes))
    leader = first[number]  # a point of the file where there is one, since those come first
    used = np.unique(leader[quads])
    extra = used[used >= len(points)]
    row = np.arange(start)
    row[extra] = len(points) + np.arange(len(extra))
    quads = row[leader[quads]]
    every = np.concatenate([points, np.concatenate(nodes)[extra]])
    return PlaneCells(
        points=every,
        quads=_counterclockwise(every, quads),
        groups=groups,
        edges=_parts_of_edges(blocks, quads, row[leader], cut),
        was_cut=cut,
    )


def _nine(corners: Array) -> Array:
    """Corners (4, 2), the middles of the sides, and the middle of a square."""
    middles = (corners + np.roll(corners, -1, axis=0)) / 2
    return np.concatenate([corners, middles, corners.mean(axis=0)[None]])


def _shapes(at: Array, nodes: int) -> Array:
    """Shape functions (p, nodes) of a kind of plane cell at places in natural coordinates from 0 to 1."""
    s, t = at.T
    if nodes in (3, 6):
        a, b, c = 1 - s - t, s, t
        if nodes == 3:
            return np.stack([a, b, c], axis=1)
        return np.stack([*(v * (2 * v - 1) for v in (a, b, c)), 4 * a * b, 4 * b * c, 4 * c * a], axis=1)
    x, y = 2 * s - 1, 2 * t - 1
    signs = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    linear = [(1 + p * x) * (1 + q * y) / 4 for p, q in signs]
    if nodes == 4:
        return np.stack(linear, axis=1)
    middles = [(1 - x**2) * (1 - y) / 2, (1 + x) * (1 - y**2) / 2, (1 - x**2) * (1 + y) / 2, (1 - x) * (1 - y**2) / 2]
    corners = [one - (middles[k] + middles[k - 1]) / 2 for k, one in enumerate(linear)]
    if nodes == 8:
        return np.stack([*corners, *middles], axis=1)
    bubble = (1 - x**2) * (1 - y**2)
    return np.stack([*(c + bubble / 4 for c in corners), *(m - bubble / 2 for m in middles), bubble], axis=1)


def _counterclockwise(points: Array, quads: Ints) -> Ints:
    a, b, c, d = (points[quads[:, i]] for i in range(4))
    first, second = c - a, d - b
    clockwise = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0] < 0
    return np.where(clockwise[:, None], quads[:, TURNED_OVER], quads)


def _parts_of_edges(blocks: Sequence[Block], quads: Ints, row: Ints, cut: bool) -> dict[Edge, tuple[Edge, ...]]:
    """The parts of each edge of the cells of a file; ``quads`` begin as the parts of the cells do."""
    out: dict[Edge, tuple[Edge, ...]] = {}
    start = 0
    for block in blocks:
        corners = block.kind.corners
        end = start + (corners if cut else 1) * len(block.nodes)
        own, start = quads[start:end].reshape(len(block.nodes), -1, 9), end
        for k in range(corners):
            ends = np.sort(row[block.nodes[:, [k, (k + 1) % corners]]], axis=1)
            middle = own[:, k if cut else 0, 1]
            for (a, b), m in zip(ends.tolist(), middle.tolist(), strict=True):
                out[a, b] = ((a, m), (m, b)) if cut else ((a, b),)
    return out
