"""Cells cut at a mirror plane: tetrahedra that reach across it become tetrahedra with sides on it.

Nodes near the plane are moved onto it first, along its normal, where this does not change the shape of the body. Then
each cell is cut in two at one of its edges across the plane after another, in an order that all cells share, so that
neighbors cut the side between them alike. New nodes lie where the curved parent has them.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, TRIANGLE_EDGES, Mesh
from turgor.core.meshing.nodes.node_sets import with_new_middles
from turgor.core.meshing.surface import outer_triangles

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class CutSettings:
    """When a node is moved onto a plane at which cells are cut.

    Parameters
    ----------
    near : float
        A node is moved if the plane cuts one of its edges within this share of the length: cells that are cut there
        would be thin. At 0.1 the flattest parts have a shape of 0.1, and a coarse round body loses 2e-4 of its volume;
        at 0.2 it is 0.2 and 1e-3, at 0.05 it is 0.04 (`test_cut_cells`).
    steep, turned : float
        Sines of the largest angles between the plane's normal and the surface on which a node is moved, of the mean
        normal around the node and of each side there: along plane walls across the plane the shape of the body stays,
        and round ones turn by less than this within an element.
    smallest : float
        No cell may lose more than all but this share of its volume when its nodes are moved.
    """

    near: float = 0.1
    steep: float = 0.1
    turned: float = 0.35
    smallest: float = 0.3


CUT = CutSettings()


def cut_at_plane(mesh: Mesh, axis: int) -> Mesh:
    """Cut the cells that reach across the plane at coordinate 0 of an axis.

    Parameters
    ----------
    mesh : Mesh
        Ten-node tetrahedra; nodes on the plane have the coordinate 0 exactly.
    axis : int
        0, 1 or 2.

    Returns
    -------
    Mesh
        The whole body with the same regions, faces and node sets; no cell of it reaches across the plane.
    """
    mesh = replace(mesh, points=_on_plane(mesh, axis))
    edges = _across(mesh, axis)
    cut = _Cut(ends=edges, first=len(mesh.points))
    places, at = _crossings(mesh, edges, axis)
    unit = np.vstack([np.zeros(3), np.eye(3)])
    corners, parent, local = cut.pieces(mesh.cells[:, :4], TETRAHEDRON_EDGES, unit, at)
    pairs = corners[:, np.array(TETRAHEDRON_EDGES)]
    middle_local = local[:, np.array(TETRAHEDRON_EDGES)].mean(axis=2)
    keys, row, place = np.unique(_keys(pairs.reshape(-1, 2)), return_index=True, return_inverse=True)
    middles = _mapped(mesh.points[mesh.cells[parent[row // 6]]], middle_local.reshape(-1, 3)[row])
    points = np.vstack([mesh.points, places])
    ends = pairs.reshape(-1, 2)[row]
    flat = (points[ends, axis] == 0).all(axis=1)
    known, old = _old_middles(mesh, keys)
    number = np.where(known, old, len(points) + np.arange(len(keys)))
    cells = np.hstack([corners, number[place].reshape(-1, 6)])
    points = np.vstack([points, middles])
    points[number[flat], axis] = 0.0
    faces = {}
    for name, sides in mesh.faces.items():
        cut_sides, _, _ = cut.pieces(sides[:, :3], TRIANGLE_EDGES, np.zeros((3, 3)), at)
        rims = cut_sides[:, np.array(TRIANGLE_EDGES)].reshape(-1, 2)
        faces[name] = np.hstack([cut_sides, number[np.searchsorted(keys, _keys(rims))].reshape(-1, 3)])
    return _numbered(mesh, points, cells, parent, faces, edges)


def _numbered(mesh: Mesh, points: Array, cells: Ints, parent: Ints, faces: dict[str, Ints], edges: Ints) -> Mesh:
    """The mesh of the pieces: vertices first, with regions and node sets."""
    used = np.concatenate([np.unique(cells[:, :4]), np.unique(cells[:, 4:])])
    new = np.full(len(points), -1, dtype=np.int64)
    new[used] = np.arange(len(used))
    sets = {}
    for name, nodes in mesh.node_sets.items():
        members = np.isin(np.arange(len(points)), nodes)
        members[len(mesh.points) : len(mesh.points) + len(edges)] = members[edges].all(axis=1)
        members = with_new_middles(cells, members, np.arange(len(points)) >= len(mesh.points) + len(edges))
        sets[name] = new[np.flatnonzero(members)]
    return replace(
        mesh,
        points=points[used],
        cells=new[cells],
        regions={name: np.flatnonzero(np.isin(parent, rows)) for name, rows in mesh.regions.items()},
        faces={name: new[sides] for name, sides in faces.items()},
        node_sets={name: rows[rows >= 0] for name, rows in sets.items()},
    )


def _on_plane(mesh: Mesh, axis: int) -> Array:
    """Points of the mesh with vertices near the plane moved onto it, and mid-side nodes half as far as their ends."""
    height, count = mesh.points[:, axis], len(mesh.points)
    ends = _across(mesh, axis)
    share = np.abs(height[ends]) / np.abs(height[ends]).sum(axis=1, keepdims=True)
    moved = np.zeros(count, dtype=bool)
    moved[ends[share < CUT.near]] = True
    moved &= ~_on_steep_sides(mesh, axis)
    before = _corner_volumes(mesh.points, mesh.cells)
    while True:
        points = _moved(mesh, moved, axis)
        bad = _corner_volumes(points, mesh.cells) < CUT.smallest * before
        if not (bad & moved[mesh.cells[:, :4]].any(axis=1)).any():
            return points
        moved[mesh.cells[bad, :4]] = False


def _moved(mesh: Mesh, moved: Flags, axis: int) -> Array:
    shift = np.where(moved, -mesh.points[:, axis], 0.0)
    for k, edge in enumerate(TETRAHEDRON_EDGES):
        shift[mesh.cells[:, 4 + k]] = shift[mesh.cells[:, list(edge)]].mean(axis=1)
    points = mesh.points.copy()
    points[:, axis] += shift
    points[moved, axis] = 0.0
    return points


def _on_steep_sides(mesh: Mesh, axis: int) -> Flags:
    """Which nodes are on the surface, or on a named face, where it does not stand across the plane."""
    sides = np.concatenate([outer_triangles(mesh), *mesh.faces.values()])
    a, b, c = (mesh.points[sides[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    steep = np.abs(normal[:, axis]) > CUT.turned * np.linalg.norm(normal, axis=1)
    mean = np.zeros((len(mesh.points), 3))
    for k in range(3):
        np.add.at(mean, sides[:, k], normal)
    nodes = np.abs(mean[:, axis]) > CUT.steep * np.linalg.norm(mean, axis=1)
    nodes[sides[steep]] = True
    return np.asarray(nodes)


def _corner_volumes(points: Array, cells: Ints) -> Array:
    a, b, c, d = (points[cells[:, k]] for k in range(4))
    return np.asarray(np.einsum("ci,ci->c", b - a, np.cross(c - a, d - a)) / 6)


def _across(mesh: Mesh, axis: int) -> Ints:
    """Edges (e, 2) with ends on both sides of the plane, the lower number first, sorted."""
    height = mesh.points[:, axis]
    edges = np.sort(mesh.cells[:, np.array(TETRAHEDRON_EDGES)].reshape(-1, 2), axis=1)
    edges = np.unique(edges[height[edges].prod(axis=1) < 0], axis=0)
    return np.asarray(edges)


def _crossings(mesh: Mesh, edges: Ints, axis: int) -> tuple[Array, Array]:
    """Points (e, 3) where the plane cuts quadratic edges, and their places from 0 to 1 along the edges."""
    all_edges = np.sort(mesh.cells[:, np.array(TETRAHEDRON_EDGES)].reshape(-1, 2), axis=1)
    keys, first = np.unique(_keys(all_edges), return_index=True)
    middle = mesh.cells[:, 4:].reshape(-1)[first][np.searchsorted(keys, _keys(edges))]
    a, b, m = mesh.points[edges[:, 0]], mesh.points[edges[:, 1]], mesh.points[middle]
    c0, c1, c2 = a[:, axis], (4 * m - 3 * a - b)[:, axis], (2 * a + 2 * b - 4 * m)[:, axis]
    # the root between 0 and 1, in the form that does not cancel
    q = -0.5 * (c1 + np.where(c1 < 0, -1.0, 1.0) * np.sqrt(np.maximum(c1**2 - 4 * c2 * c0, 0.0)))
    with np.errstate(divide="ignore", invalid="ignore"):
        roots = np.stack([c0 / q, q / c2])
    inside = np.where((roots > 0) & (roots < 1), roots, np.inf)
    at = inside.min(axis=0)
    places = a + at[:, None] * (4 * m - 3 * a - b) + at[:, None] ** 2 * (2 * a + 2 * b - 4 * m)
    places[:, axis] = 0.0
    return places, at


@dataclass(frozen=True, slots=True, eq=False)
class _Cut:
    """Edges that are cut, in the order in which cells are cut at them, and the number of the first new node."""

    ends: Ints
    first: int

    def pieces(
        self, corners: Ints, edges: tuple[tuple[int, int], ...], unit: Array, at: Array
    ) -> tuple[Ints, Ints, Array]:
        """Cut cells or triangles with corners (c, k) at their edges.

        Returns the corners of the pieces, the cell of each, and the coordinates of their corners in it.
        """
        keys, corners = _keys(self.ends), corners.copy()
        parent, local = np.arange(len(corners)), np.broadcast_to(unit, (len(corners), *unit.shape)).copy()
        while len(keys):
            pairs = np.sort(corners[:, np.array(edges)], axis=2)
            places = np.minimum(np.searchsorted(keys, _keys(pairs.reshape(-1, 2))), len(keys) - 1)
            places = places.reshape(pairs.shape[:2])
            ranks = np.where(keys[places] == _keys(pairs.reshape(-1, 2)).reshape(places.shape), places, len(keys))
            rows = np.flatnonzero(ranks.min(axis=1) < len(keys))
            if not len(rows):
                break
            which, rank = ranks[rows].argmin(axis=1), ranks[rows].min(axis=1)
            one, other = np.array(edges)[which].T
            begin = np.where(corners[rows, one] == self.ends[rank, 0], one, other)
            end = one + other - begin
            middle = local[rows, begin] + at[rank][:, None] * (local[rows, end] - local[rows, begin])
            near, near_local = corners[rows].copy(), local[rows].copy()
            count = np.arange(len(rows))
            near[count, end], near_local[count, end] = self.first + rank, middle
            corners[rows, begin], local[rows, begin] = self.first + rank, middle
            corners, local = np.concatenate([corners, near]), np.concatenate([local, near_local])
            parent = np.concatenate([parent, parent[rows]])
        return corners, parent, local


def _keys(ends: Ints) -> Ints:
    """One number for each pair of nodes, the same for both orders."""
    return np.asarray(ends.min(axis=1) * (1 << 31) + ends.max(axis=1), dtype=np.int64)


def _old_middles(mesh: Mesh, keys: Ints) -> tuple[Flags, Ints]:
    """Which edges are those of the mesh, and their mid-side nodes."""
    edges = mesh.cells[:, np.array(TETRAHEDRON_EDGES)].reshape(-1, 2)
    known, first = np.unique(_keys(edges), return_index=True)
    place = np.minimum(np.searchsorted(known, keys), len(known) - 1)
    return known[place] == keys, mesh.cells[:, 4:].reshape(-1)[first[place]]


def _mapped(nodes: Array, local: Array) -> Array:
    """Places (p, 3) in curved cells with nodes (p, 10, 3) at their coordinates (p, 3)."""
    weights = np.column_stack([1 - local.sum(axis=1), local])
    shapes = [weights * (2 * weights - 1), *(4 * weights[:, [i]] * weights[:, [j]] for i, j in TETRAHEDRON_EDGES)]
    return np.asarray(np.einsum("pk,pki->pi", np.hstack(shapes), nodes))
