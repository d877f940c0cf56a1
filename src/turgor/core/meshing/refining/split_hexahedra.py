"""Cut hexahedra in two along whole sheets of a mesh.

An edge of a hexahedron cannot be cut alone: the edges opposite to it across its sides must be cut too, and so on
through the neighbors. All edges that hang together in this way cross one sheet of cells, which is cut in two.
"""

from dataclasses import replace
from functools import cache
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from turgor.core.meshing.cells import HEXAHEDRON, QUADRILATERAL
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.nodes.node_sets import refined_sets
from turgor.core.meshing.refining.refinement import Refinement

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Edges of a hexahedron by their direction in the cell, and of a quadrilateral by theirs.
CELL_EDGES = (((0, 1), (3, 2), (4, 5), (7, 6)), ((0, 3), (1, 2), (4, 7), (5, 6)), ((0, 4), (1, 5), (2, 6), (3, 7)))
SIDE_EDGES = (((0, 1), (3, 2)), ((0, 3), (1, 2)))

#: Reference coordinates of the corners of a square and a cube, in the node order of the cells.
_SQUARE = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
_CUBE = np.vstack([np.c_[_SQUARE, np.zeros(4)], np.c_[_SQUARE, np.ones(4)]])

#: Weights of corners at the nodes of parts are multiples of one over this.
_GRAIN = 64


def sheets(mesh: Mesh) -> Ints:
    """Number of the sheet that each cell lies in, by direction in the cell, (c, 3).

    Parameters
    ----------
    mesh : Mesh
        27-node hexahedra.
    """
    edges = np.sort(np.stack([mesh.cells[:, list(e)] for group in CELL_EDGES for e in group], axis=1), axis=2)
    keys = edges[..., 0] * len(mesh.points) + edges[..., 1]
    unique, place = np.unique(keys, return_inverse=True)
    place = place.reshape(-1, 3, 4)
    links = place[:, :, :1].repeat(3, axis=2).ravel(), place[:, :, 1:].ravel()
    graph = coo_matrix((np.ones(len(links[0]), dtype=np.int8), links), shape=(len(unique), len(unique)))
    return np.asarray(connected_components(graph, directed=False)[1][place[:, :, 0]], dtype=np.int64)


def refine_hexahedra(mesh: Mesh, chosen: Ints) -> Refinement:
    """Cut the chosen sheets in two.

    Parameters
    ----------
    mesh : Mesh
        27-node hexahedra.
    chosen : (s,) int array
        Numbers of sheets, as `sheets` gives them.

    Returns
    -------
    Refinement
        With the names of the mesh.
    """
    of_cell = sheets(mesh)
    cut = np.isin(of_cell, chosen)
    corners, parent = [], []
    for flags in product((False, True), repeat=3):
        cells = np.flatnonzero((cut == flags).all(axis=1))
        boxes = parts_of(flags)
        corners.append(np.tile(boxes, (len(cells), 1, 1)))
        parent.append(np.repeat(cells, len(boxes)))
    order = np.argsort(np.concatenate(parent), kind="stable")
    parents, places = np.concatenate(parent)[order], np.concatenate(corners)[order]
    at_nodes = np.einsum("nk,cki->cni", weights_at(reference_grid(3)), places)
    keys = node_keys(mesh.cells[parents, :8], weights_at(at_nodes.reshape(-1, 3)).reshape(*at_nodes.shape[:2], 8))
    numbers, first, count = _numbered(keys)
    points = _positions(mesh.points[mesh.cells[parents]], at_nodes).reshape(-1, 3)[first]
    known = dict(zip(keys.ravel().tolist(), numbers.ravel().tolist(), strict=True))
    assert len(points) == count
    fine = replace(
        mesh,
        points=points,
        cells=numbers,
        regions={name: np.flatnonzero(np.isin(parents, cells)) for name, cells in mesh.regions.items()},
        faces={name: _cut_sides(mesh, sides, chosen, of_cell, known) for name, sides in mesh.faces.items()},
        node_sets=refined_sets(mesh, points, numbers),
    )
    return Refinement(fine, parents, places)


def parts_of(flags: tuple[bool, ...]) -> Array:
    """Corners (b, 2**d, d) of the parts of a square or cube that is cut in two in the flagged directions."""
    unit = _CUBE if len(flags) == 3 else _SQUARE
    low = np.array(list(product(*(((0.0, 0.5) if cut else (0.0,)) for cut in flags))))
    return low[:, None] + unit * np.where(flags, 0.5, 1.0)


@cache
def reference_grid(dimension: int) -> Array:
    """Reference coordinates of the nodes of a 27-node hexahedron or a nine-node quadrilateral."""
    kind, corners = (HEXAHEDRON, _CUBE) if dimension == 3 else (QUADRILATERAL, _SQUARE)
    mids = [(corners[a] + corners[b]) / 2 for a, b in kind.edges]
    sides = [corners[list(side[:4])].mean(axis=0) for side in HEXAHEDRON.sides] if dimension == 3 else []
    return np.vstack([corners, mids, *sides, corners.mean(axis=0)])


def weights_at(points: Array) -> Array:
    """Linear shape functions of the corners (n, 4 or 8) at reference coordinates (n, 2 or 3)."""
    unit = _CUBE if points.shape[-1] == 3 else _SQUARE
    return np.asarray(np.where(unit == 1, points[:, None], 1 - points[:, None]).prod(axis=2))


def node_keys(corners: Ints, weights: Array) -> NDArray[np.uint64]:
    """One number for each node, the same in every cell and side that shares it: corners hashed by their weights."""
    mixed = (corners.astype(np.uint64) + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    mixed = (mixed ^ (mixed >> np.uint64(29))) * np.uint64(0xBF58476D1CE4E5B9)
    mixed ^= mixed >> np.uint64(32)
    shares = np.rint(weights * _GRAIN).astype(np.uint64)
    return np.asarray((mixed[:, None, :] * shares).sum(axis=2, dtype=np.uint64))


def _numbered(keys: NDArray[np.uint64]) -> tuple[Ints, Ints, int]:
    """Numbers (c, n) of nodes by their keys, corners first; where each stands first; how many there are."""
    unique, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    inverse = inverse.reshape(keys.shape)
    is_corner = np.zeros(len(unique), dtype=bool)
    is_corner[inverse[:, :8]] = True
    order = np.argsort(~is_corner, kind="stable")
    number = np.empty(len(unique), dtype=np.int64)
    number[order] = np.arange(len(unique))
    return number[inverse], first[order], len(unique)


def _positions(x: Array, at: Array) -> Array:
    """Points (c, n, 3) of cells with nodes at x (c, 27, 3), at reference coordinates (c, n, 3)."""
    grid = np.rint(2 * reference_grid(3)).astype(int)  # 0, 1, 2 along each direction
    factors = np.stack([2 * (at - 0.5) * (at - 1), 4 * at * (1 - at), 2 * at * (at - 0.5)], axis=-1)
    shape = factors[:, :, 0][..., grid[:, 0]] * factors[:, :, 1][..., grid[:, 1]] * factors[:, :, 2][..., grid[:, 2]]
    return np.asarray(np.einsum("cna,cai->cni", shape, x))


def _cut_sides(mesh: Mesh, sides: Ints, chosen: Ints, of_cell: Ints, known: dict[int, int]) -> Ints:
    """Cut the sides of a face as the cells next to them were cut."""
    if not len(sides):
        return sides
    cut = _cut_edges(mesh, chosen, of_cell)
    count, out, order = len(mesh.points), [], []
    flags_of = np.stack([np.isin(_edge_keys(sides[:, list(group[0])], count), cut) for group in SIDE_EDGES], axis=1)
    for flags in product((False, True), repeat=2):
        rows = np.flatnonzero((flags_of == flags).all(axis=1))
        for box in parts_of(flags):
            at = weights_at(reference_grid(2)) @ box
            keys = node_keys(sides[rows, :4], np.broadcast_to(weights_at(at), (len(rows), 9, 4)))
            out.append(np.array([known[key] for key in keys.ravel().tolist()], dtype=np.int64).reshape(-1, 9))
            order.append(rows)
    return np.ascontiguousarray(np.concatenate(out)[np.argsort(np.concatenate(order), kind="stable")])


def _edge_keys(ends: Ints, count: int) -> Ints:
    return np.asarray(ends.min(axis=1) * count + ends.max(axis=1))


def _cut_edges(mesh: Mesh, chosen: Ints, of_cell: Ints) -> Ints:
    """Keys of the edges that cross a chosen sheet."""
    keys = [
        _edge_keys(mesh.cells[np.isin(of_cell[:, direction], chosen)][:, list(edge)], len(mesh.points))
        for direction, group in enumerate(CELL_EDGES)
        for edge in group
    ]
    return np.unique(np.concatenate(keys))
