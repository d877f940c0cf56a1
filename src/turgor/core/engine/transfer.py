"""Transfer: carry the fields of a state to a refined mesh, whose cells are exact pieces of the cells before."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.element import element_of, tables_with
from turgor.core.engine.cells.internal_variables import Memory
from turgor.core.engine.cells.reference import reference_nodes, smooth_basis, tables_at
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.refining.refinement import Refinement
from turgor.core.meshing.refining.split_films import FilmRefinement
from turgor.core.model.model import Model
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]


def transfer_to(mesh: Mesh, refinement: Refinement | FilmRefinement) -> "Transfer | FilmTransfer":
    """Return what carries fields from a mesh to its refinement."""
    return FilmTransfer(refinement) if isinstance(refinement, FilmRefinement) else Transfer(mesh, refinement)


class FilmTransfer:
    """Carry fields between films without a solid, which have displacements only.

    Parameters
    ----------
    refinement : FilmRefinement
    """

    def __init__(self, refinement: FilmRefinement) -> None:
        self._fine = refinement

    def nodal(self, values: Array) -> Array:
        """Values at the nodes of the finer mesh, as `Transfer.nodal`."""
        return np.asarray(np.einsum("na,nak->nk", self._fine.shares, values[self._fine.nodes]))

    def mean_stress(self, _model: Model, fine: Model, _values: Array) -> Array:
        """Mean stresses of the finer model: none."""
        return np.zeros(element_of(fine).mean_count)

    def memory(self, memory: Memory | None) -> Memory | None:
        """Internal variables of films: none."""
        return memory


class Transfer:
    """Carry fields from a mesh to its refinement.

    Parameters
    ----------
    mesh : Mesh
        The coarser mesh.
    refinement : Refinement
        The finer one.
    """

    def __init__(self, mesh: Mesh, refinement: Refinement) -> None:
        self._mesh, self._fine = mesh, refinement
        flat = np.rint(refinement.corners.reshape(len(refinement.parent), -1) / ROUND_OFF.mesh_digits)
        _, first, self._kind = np.unique(flat, axis=0, return_index=True, return_inverse=True)
        self._kinds = refinement.corners[first]  # the few ways in which a part lies in its parent
        self._kind = self._kind.ravel()

    @property
    def mesh(self) -> Mesh:
        """The finer mesh."""
        return self._fine.mesh

    def nodal(self, values: Array) -> Array:
        """Values at the nodes of the finer mesh, (n', k), of a field with values (n, k) at the nodes; exact."""
        nodes = self._mesh.cell_type.nodes
        out = np.empty((len(self._fine.mesh.points), values.shape[1]))
        for kind, corners in enumerate(self._kinds):
            at = self._inside(reference_nodes(nodes), corners)
            parts = np.flatnonzero(self._kind == kind)
            known = values[self._mesh.cells[self._fine.parent[parts]]]
            out[self._fine.mesh.cells[parts]] = np.einsum(
                "na,cak->cnk", tables_at(nodes, at, np.ones(len(at))).N, known
            )
        return out

    def forces(self, values: Array) -> Array:
        """Nodal forces (n', k) that have the resultants of those (n, k): at the nodes that both meshes have."""
        own = reference_nodes(self._mesh.cell_type.nodes)
        out = np.zeros((len(self._fine.mesh.points), values.shape[1]))
        for kind, corners in enumerate(self._kinds):
            apart = np.abs(self._inside(own, corners)[:, None] - own).max(axis=2)
            here, there = np.nonzero(apart < ROUND_OFF.mesh_digits)
            parts = np.flatnonzero(self._kind == kind)
            old = self._mesh.cells[self._fine.parent[parts]][:, there]
            out[self._fine.mesh.cells[parts][:, here]] = values[old]
        return out

    def mean_stress(self, model: Model, fine: Model, values: Array) -> Array:
        """Mean stresses of the finer model, (m',), of those (m,) of the model."""
        before, after = element_of(model), element_of(fine)
        out = np.zeros(after.mean_count)
        if not before.modes:
            return out
        nodes = self._mesh.cell_type.nodes
        for kind, corners in enumerate(self._kinds):
            parts = np.flatnonzero(self._kind == kind)
            linear = tables_at(nodes, corners, np.ones(len(corners))).M
            out[after.mean[parts]] = values[before.mean[self._fine.parent[parts]]] @ linear.T
        return out

    def memory(self, memory: Memory | None) -> Memory | None:
        """Internal variables of the rubber by a linear fit in each coarser cell, and those of cables as they are."""
        if memory is None:
            return None
        stress = {name: np.stack([self._fitted(name, each) for each in every]) for name, every in memory.stress.items()}
        largest = {name: np.maximum(self._fitted(name, each), 0.0) for name, each in memory.largest.items()}
        flow = {name: np.stack([self._flowed(name, each) for each in every]) for name, every in memory.flow.items()}
        cables = {name: each for name, each in memory.bonds.items() if name.startswith("cable ")}
        return Memory(stress=stress, largest=largest, flow=flow, bonds=cables)

    def _flowed(self, region: str, values: Array) -> Array:
        """Internal variables (c', q, 10) of a network that flows, which keeps its volume."""
        out = self._fitted(region, values)
        volume = np.linalg.det(out[..., :9].reshape(*out.shape[:2], 3, 3))
        out[..., :9] /= np.cbrt(volume)[..., None]
        out[..., 9] = np.maximum(out[..., 9], 0.0)
        return out

    def _fitted(self, region: str, values: Array) -> Array:
        """Values (c', q, ...) at the points of a region's parts, from those (c, q, ...) of its cells."""
        nodes = self._mesh.cell_type.nodes
        r = tables_with(nodes, values.shape[1])
        fit = np.linalg.pinv(smooth_basis(nodes, r.points))
        cells, parts = self._mesh.regions[region], self._fine.mesh.regions[region]
        place = np.empty(len(self._mesh.cells), dtype=np.int64)
        place[cells] = np.arange(len(cells))
        out = np.empty((len(parts), *values.shape[1:]))
        for kind, corners in enumerate(self._kinds):
            chosen = np.flatnonzero(self._kind[parts] == kind)
            table = smooth_basis(nodes, self._inside(r.points, corners)) @ fit
            known = values[place[self._fine.parent[parts[chosen]]]]
            out[chosen] = np.einsum("pq,cq...->cp...", table, known)
        return out

    def _inside(self, points: Array, corners: Array) -> Array:
        """Reference coordinates in the parent of reference coordinates (n, 3) in a part with these corners."""
        nodes = self._mesh.cell_type.nodes
        return np.asarray(tables_at(nodes, points, np.ones(len(points))).M @ corners)
