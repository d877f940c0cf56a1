"""Cut cells in two at chosen edges: the way to more cells through thin walls without more cells along them.

A tetrahedron is cut at one edge after another, in an order that all cells share, so that two neighbors cut the side
between them alike. Each part is an exact piece of its parent's curved shape: none turns inside out that was not.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.wedge import HIGH, LOW
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, TRIANGLE_EDGES, Mesh
from turgor.core.meshing.nodes.node_sets import refined_sets
from turgor.core.meshing.refining.refinement import Refinement

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def _turns() -> Ints:
    """Orders of the ten nodes that bring each edge to the place of the first one, without turning the cell over."""
    place = {frozenset(edge): 4 + i for i, edge in enumerate(TETRAHEDRON_EDGES)}
    rows = []
    for i, j in TETRAHEDRON_EDGES:
        k, m = (v for v in range(4) if v not in (i, j))
        if np.linalg.det(np.eye(4)[[i, j, k, m]]) < 0:
            k, m = m, k
        corners = (i, j, k, m)
        rows.append([*corners, *(place[frozenset((corners[a], corners[b]))] for a, b in TETRAHEDRON_EDGES)])
    return np.array(rows)


@dataclass(slots=True)
class _Nodes:
    """Nodes while cells are cut: positions, and the mid-side node of each new edge by the key of its ends."""

    points: Array
    keys: Ints
    mids: Ints

    def at(self, ends: Ints, position: Array) -> Ints:
        """Mid-side nodes of edges (e, 2), made at their positions (e, 3) where they are new."""
        keys = _keys(ends, 1 << 31)
        unique, first = np.unique(keys, return_index=True)
        new = ~np.isin(unique, self.keys)
        count = len(self.points)
        keys_all = np.concatenate([self.keys, unique[new]])
        mids_all = np.concatenate([self.mids, count + np.arange(int(new.sum()))])
        order = np.argsort(keys_all)
        self.keys, self.mids = keys_all[order], mids_all[order]
        self.points = np.concatenate([self.points, position[first[new]]])
        return self.of(ends)

    def of(self, ends: Ints) -> Ints:
        """Mid-side nodes of edges that are known."""
        return np.asarray(self.mids[np.searchsorted(self.keys, _keys(ends, 1 << 31))])


def _keys(ends: Ints, count: int) -> Ints:
    """One number for each pair of nodes, the same for both orders."""
    return np.asarray(ends.min(axis=1) * count + ends.max(axis=1), dtype=np.int64)


def split_edges(mesh: Mesh, edges: Ints) -> Mesh:
    """Cut every cell that has one of these edges in two there, and again where it has several.

    Parameters
    ----------
    mesh : Mesh
        Ten-node tetrahedra.
    edges : (e, 2) int array
        Vertices at the ends of the edges to be cut; each is the edge of some cell.

    Returns
    -------
    Mesh
        With the same names and findings. The mid-side nodes of the edges have become vertices.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> coarse = mesh(FastPneuNet(chambers=2, length=20e-3).build(), size=4e-3)
    >>> fine = split_edges(coarse, coarse.cells[:1, :2])
    >>> len(fine.cells) > len(coarse.cells), fine.vertex_count - coarse.vertex_count
    (True, 1)
    """
    return refine_tetrahedra(mesh, edges).mesh


def refine_tetrahedra(mesh: Mesh, edges: Ints) -> Refinement:
    """Cut the cells at these edges as `split_edges` does, and say which part of which cell each new cell is."""
    parts = _Parts.whole(mesh)
    edges = _on_both_cuts(mesh, edges)
    if not len(edges):
        return Refinement(mesh, parts.parent, parts.corners)
    ranks = _ranks(mesh, edges)
    nodes = _Nodes(points=mesh.points, keys=np.zeros(0, dtype=np.int64), mids=np.zeros(0, dtype=np.int64))
    while True:
        cut = _first_marked(parts.cells, TETRAHEDRON_EDGES, ranks)
        if (cut < 0).all():
            break
        parts = parts.halved(cut, nodes)
    parts = parts.chosen(np.argsort(parts.parent, kind="stable"))
    faces = {name: _cut_triangles(triangles, ranks, nodes) for name, triangles in mesh.faces.items()}
    used = np.concatenate([np.unique(parts.cells[:, :4]), np.unique(parts.cells[:, 4:])])
    number = np.full(len(nodes.points), -1, dtype=np.int64)
    number[used] = np.arange(len(used))
    fine = replace(
        mesh,
        points=nodes.points[used],
        cells=number[parts.cells],
        regions={name: np.flatnonzero(np.isin(parts.parent, region)) for name, region in mesh.regions.items()},
        faces={name: number[triangles] for name, triangles in faces.items()},
        node_sets=refined_sets(mesh, nodes.points[used], number[parts.cells]),
    )
    return Refinement(fine, parts.parent, parts.corners)


@dataclass(frozen=True, slots=True, eq=False)
class _Parts:
    """Cells while they are cut: nodes (c, 10), the cell each is a part of, and where its corners lie in that one."""

    cells: Ints
    parent: Ints
    corners: Array

    @staticmethod
    def whole(mesh: Mesh) -> "_Parts":
        count = len(mesh.cells)
        unit = np.vstack([np.zeros(3), np.eye(3)])
        return _Parts(mesh.cells, np.arange(count), np.broadcast_to(unit, (count, 4, 3)))

    def chosen(self, rows: Ints) -> "_Parts":
        return _Parts(self.cells[rows], self.parent[rows], self.corners[rows])

    def halved(self, cut: Ints, nodes: _Nodes) -> "_Parts":
        """Cut the parts that have an edge to be cut, by its place in the cell."""
        marked, turn = np.flatnonzero(cut >= 0), _turns()[cut[cut >= 0]]
        row = np.arange(len(marked))[:, None]
        first, second = _halved_cells(self.cells[marked][row, turn], nodes)
        near, far = self.corners[marked][row, turn[:, :4]].copy(), self.corners[marked][row, turn[:, :4]].copy()
        near[:, 1] = far[:, 0] = 0.5 * (near[:, 0] + near[:, 1])
        rest = self.chosen(np.flatnonzero(cut < 0))
        return _Parts(
            np.concatenate([rest.cells, first, second]),
            np.concatenate([rest.parent, self.parent[marked], self.parent[marked]]),
            np.concatenate([rest.corners, near, far]),
        )


def _ranks(mesh: Mesh, edges: Ints) -> tuple[Ints, Ints]:
    """Keys of the edges, sorted, and the place of each in the order of cutting: the longest first."""
    keys, first = np.unique(_keys(edges, 1 << 31), return_index=True)
    ends = mesh.leaders[edges[first]]  # images in the cuts of a wedge are cut alike
    length = np.linalg.norm(mesh.points[ends[:, 1]] - mesh.points[ends[:, 0]], axis=1)
    rank = np.empty(len(keys), dtype=np.int64)
    rank[np.lexsort((keys, _keys(ends, 1 << 31), -np.round(length / length.max(), 9)))] = np.arange(len(keys))
    return keys, rank


def _on_both_cuts(mesh: Mesh, edges: Ints) -> Ints:
    """Edges together with their images in the other cut of a wedge."""
    if mesh.wedge is None or not len(edges):
        return edges
    leaders, all_nodes = mesh.leaders, np.arange(len(mesh.points))
    high = np.flatnonzero(leaders != all_nodes)
    onto, back = np.full(len(mesh.points), -1), np.full(len(mesh.points), -1)
    onto[leaders[high]], back[high] = high, leaders[high]
    axis = np.intersect1d(mesh.face_nodes(LOW), mesh.face_nodes(HIGH))
    onto[axis] = back[axis] = axis
    known = np.unique(_keys(np.concatenate([mesh.cells[:, e] for e in TETRAHEDRON_EDGES]), 1 << 31))
    for image in (onto, back):
        moved = image[edges]
        moved = moved[(moved >= 0).all(axis=1)]
        moved = moved[np.isin(_keys(moved, 1 << 31), known)]
        edges = np.concatenate([edges, moved])
    return np.unique(np.sort(edges, axis=1), axis=0)


def _first_marked(nodes: Ints, sides: tuple[tuple[int, int], ...], ranks: tuple[Ints, Ints]) -> Ints:
    """Which edge of each cell or triangle is to be cut next, -1 where none is."""
    keys, rank = ranks
    best = np.full((len(nodes), len(sides)), len(keys), dtype=np.int64)
    for i, (a, b) in enumerate(sides):
        edges = _keys(nodes[:, [a, b]], 1 << 31)
        place = np.minimum(np.searchsorted(keys, edges), len(keys) - 1)
        best[:, i] = np.where(keys[place] == edges, rank[place], len(keys))
    return np.where(best.min(axis=1) < len(keys), best.argmin(axis=1), -1)


def _halved_cells(cells: Ints, nodes: _Nodes) -> tuple[Ints, Ints]:
    """Cut cells at their first edge; the new nodes lie where the curved parent has them."""
    a, b, c, d, ab, bc, ca, ad, bd, cd = cells.T
    x = nodes.points
    near_a, near_b = _quarters(x, a, b, ab)
    ends = [np.stack(pair, axis=1) for pair in ((a, ab), (ab, b), (ab, c), (ab, d))]
    places = [near_a, near_b, _middle(x, cells[:, [0, 1, 2, 4, 5, 6]]), _middle(x, cells[:, [0, 1, 3, 4, 8, 7]])]
    new = nodes.at(np.concatenate(ends), np.concatenate(places)).reshape(4, -1)
    first = np.stack([a, ab, c, d, new[0], new[2], ca, ad, new[3], cd], axis=1)
    second = np.stack([ab, b, c, d, new[1], bc, new[2], new[3], bd, cd], axis=1)
    return first, second


def _quarters(x: Array, a: Ints, b: Ints, ab: Ints) -> tuple[Array, Array]:
    """Points at one and three quarters of quadratic edges."""
    return (3 * x[a] + 6 * x[ab] - x[b]) / 8, (3 * x[b] + 6 * x[ab] - x[a]) / 8


def _middle(x: Array, triangles: Ints) -> Array:
    """Points of six-node triangles half way from the middle of the first edge to the third corner."""
    return np.einsum("k,tki->ti", np.array([-1, -1, 0, 2, 4, 4]) / 8, x[triangles])


def _cut_triangles(triangles: Ints, ranks: tuple[Ints, Ints], nodes: _Nodes) -> Ints:
    """Cut the triangles of a face as the cells next to them were cut."""
    turns = np.array([[0, 1, 2, 3, 4, 5], [1, 2, 0, 4, 5, 3], [2, 0, 1, 5, 3, 4]])
    while True:
        cut = _first_marked(triangles, TRIANGLE_EDGES, ranks)
        if (cut < 0).all():
            return triangles
        marked = np.flatnonzero(cut >= 0)
        a, b, c, ab, bc, ca = triangles[marked][np.arange(len(marked))[:, None], turns[cut[marked]]].T
        near_a, near_b, across = (nodes.of(np.stack(pair, axis=1)) for pair in ((a, ab), (ab, b), (ab, c)))
        first = np.stack([a, ab, c, near_a, across, ca], axis=1)
        second = np.stack([ab, b, c, near_b, bc, across], axis=1)
        triangles = np.concatenate([triangles[cut < 0], first, second])
