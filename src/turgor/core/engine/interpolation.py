"""Interpolation: carry the fields of a state to another mesh of the same body, whatever its cells."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.element import element_of
from turgor.core.engine.cells.reference import reference_nodes, tables_at
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.model import Model

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Cells whose centers are nearest to a point, among which the one that holds it is looked for.
CANDIDATES = 24

#: Newton's steps to the place of a point in a cell with curved sides.
PLACINGS = 6


class Interpolation:
    """Carry fields from one mesh to another of the same body.

    Parameters
    ----------
    mesh : Mesh
        Where fields are known.
    other : Mesh
        Where they are wanted.
    """

    def __init__(self, mesh: Mesh, other: Mesh) -> None:
        self._mesh, self._other = mesh, other
        every = np.arange(len(mesh.cells))
        self._cell, self._at = _placed(mesh, every, other.points)

    def nodal(self, values: Array) -> Array:
        """Values (n', k) at the nodes of the other mesh, of a field with values (n, k) at the nodes of the first."""
        nodes = self._mesh.cell_type.nodes
        shares = tables_at(nodes, self._at, np.ones(len(self._at))).N
        return np.asarray(np.einsum("pa,pak->pk", shares, values[self._mesh.cells[self._cell]]))

    def mean_stress(self, model: Model, other: Model, values: Array) -> Array:
        """Mean stresses (m',) of the other model, of those (m,) of the first; they jump where materials meet."""
        before, after = element_of(model), element_of(other)
        out = np.zeros(after.mean_count)
        if not before.modes:
            return out
        nodes, corners = self._mesh.cell_type.nodes, after.mean.shape[1]
        for name, cells in self._other.regions.items():
            if name not in self._mesh.regions or not len(cells):
                continue
            places, first = np.unique(after.mean[cells], return_index=True)
            points = self._other.points[self._other.cells[cells][:, :corners].ravel()[first]]
            cell, at = _placed(self._mesh, self._mesh.regions[name], points)
            linear = tables_at(nodes, at, np.ones(len(at))).M
            out[places] = np.einsum("pa,pa->p", linear, values[before.mean[cell]])
        return out


def _placed(mesh: Mesh, cells: Ints, points: Array) -> tuple[Ints, Array]:
    """Among some cells of a mesh, the one that holds each point (p, 3), and the point's reference coordinates in it."""
    from scipy.spatial import cKDTree  # slow to load, and few runs have a second mesh

    nodes = mesh.cell_type.nodes
    corners = mesh.points[mesh.cells[cells]]
    count = min(CANDIDATES, len(cells))
    near = cKDTree(corners.mean(axis=1)).query(points, k=count)[1].reshape(len(points), count)
    best, place, most = np.zeros(len(points), dtype=np.int64), np.zeros((len(points), 3)), np.full(len(points), -np.inf)
    left = np.arange(len(points))
    for k in range(count):
        at = _reference(nodes, corners[near[left, k]], points[left])
        inside = _inside(nodes, at)
        better = inside > most[left]
        chosen = left[better]
        best[chosen], place[chosen], most[chosen] = near[chosen, k], at[better], inside[better]
        left = left[most[left] < 0]
        if not len(left):
            break
    return cells[best], place


def _reference(nodes: int, corners: Array, points: Array) -> Array:
    """Reference coordinates (p, 3) of points in cells with these nodes (p, n, 3)."""
    middle = reference_nodes(nodes).mean(axis=0)
    at = np.broadcast_to(middle, points.shape).copy()
    for _ in range(PLACINGS):
        tables = tables_at(nodes, at, np.ones(len(at)))
        off = points - np.einsum("pa,pai->pi", tables.N, corners)
        slope = np.einsum("pai,paj->pij", corners, tables.dN)
        at = np.clip(at + np.linalg.solve(slope, off[:, :, None])[:, :, 0], middle - 2.0, middle + 2.0)
    return at


def _inside(nodes: int, at: Array) -> Array:
    """How far reference coordinates are inside: negative outside."""
    if nodes == 10:
        return np.minimum(at.min(axis=1), 1.0 - at.sum(axis=1))
    return np.minimum(at.min(axis=1), 1.0 - at.max(axis=1))
