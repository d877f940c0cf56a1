"""Sides: the triangles of a mesh on its surface and between its regions, and their edges."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import TRIANGLE_EDGES, Mesh
from turgor.core.meshing.surface import cell_sides, corner_keys

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Sides:
    """Triangles on the surface of a mesh and between its regions, and their edges.

    Parameters
    ----------
    triangles : (f, 6) int array
    edges : (e, 3) int array
        Both ends, the lower one first, and the node between; sorted by the ends.
    edge_of : (f, 3) int array
        Edges of each triangle, in the order of `TRIANGLE_EDGES`.
    shortest : (n,) array [m]
        Length of the shortest of these edges at each node; infinite elsewhere.
    """

    triangles: Ints
    edges: Ints
    edge_of: Ints
    shortest: Array

    def rows(self, pairs: Ints) -> Ints:
        """Rows (p,) of the edges between pairs of nodes (p, 2); -1 where there is none."""
        count = len(self.shortest)
        keys = self.edges[:, 0] * count + self.edges[:, 1]
        low, high = np.sort(pairs, axis=1).T
        requested = low * count + high
        place = np.minimum(np.searchsorted(keys, requested), len(keys) - 1)
        return np.asarray(np.where(keys[place] == requested, place, -1))


def sides_of(mesh: Mesh) -> Sides:
    """Find the triangles on the surface of a mesh of tetrahedra and between its regions.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    Sides
    """
    triangles, count = _triangles(mesh), len(mesh.points)
    ends = np.sort(np.concatenate([triangles[:, pair] for pair in TRIANGLE_EDGES]), axis=1)
    middles = triangles[:, 3:].T.ravel()
    _, first, edge_of = np.unique(ends[:, 0] * count + ends[:, 1], return_index=True, return_inverse=True)
    edges = np.column_stack([ends[first], middles[first]])
    length = np.linalg.norm(mesh.points[edges[:, 1]] - mesh.points[edges[:, 0]], axis=1)
    shortest = np.full(count, np.inf)
    for column in edges.T:
        np.minimum.at(shortest, column, length)
    return Sides(triangles, edges, edge_of.reshape(3, -1).T, shortest)


def _triangles(mesh: Mesh) -> Ints:
    """Sides of cells of which the neighbor is missing, of another region, or beyond a named face; each once."""
    sides, count = cell_sides(mesh.cells), len(mesh.points)
    region = np.empty(len(mesh.cells), dtype=np.int64)
    for number, cells in enumerate(mesh.regions.values()):
        region[cells] = number
    keys = corner_keys(sides, count)
    _, first, where, times = np.unique(keys, return_index=True, return_inverse=True, return_counts=True)
    of_side = np.repeat(region, len(sides) // len(mesh.cells))
    unlike = np.zeros(len(first), dtype=bool)
    np.logical_or.at(unlike, where, of_side != of_side[first][where])
    named = [corner_keys(face, count) for face in mesh.faces.values() if len(face)]
    known = np.isin(keys[first], np.concatenate([np.zeros(0, dtype=np.int64), *named]))
    return np.asarray(sides[np.sort(first[(times == 1) | unlike | known])])
