"""Levels: a mesh of quadratic tetrahedra as a fine level, and its vertices as a coarse one."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.system import System
from turgor.core.meshing.cells import TETRAHEDRON

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Levels:
    """Data of a mesh for a two-level preconditioner.

    Parameters
    ----------
    parents : (n, 2) int array
        Coarse nodes that a node lies between: the ends of its edge, or twice the vertex that it is.
    free : (n, 3) bool array
        Components of displacement that are not prescribed.
    vertices : (v,) int array
        Node of each coarse node.
    mass : (m, m) sparse matrix
        Products of the shape functions of mean stress, over the shear modulus; lower triangle.
    """

    parents: NDArray[np.int32]
    free: NDArray[np.bool_]
    vertices: Ints
    mass: sp.csc_matrix

    @property
    def nodes(self) -> int:
        """Nodes of the fine level."""
        return len(self.parents)


def levels_of(system: System) -> Levels | None:
    """Find the levels of a system; None where its equations are others than those that were measured.

    These are the tetrahedra with mean stress, without reference points, rigid obstacles that move, tied components and
    directions of their own at nodes.
    """
    element, mesh = system.element, system.model.mesh
    plain = system.terms.symmetric and not len(system.carriers) and system.supports_are_plain
    alone = system.size == 3 * system.node_count + element.mean_count
    if mesh.cell_type is not TETRAHEDRON or not element.modes or not (plain and alone):
        return None
    cells = system.cells
    vertices = np.unique(cells[:, : TETRAHEDRON.corners])
    number = np.full(system.node_count, -1, dtype=np.int32)
    number[vertices] = np.arange(len(vertices))
    parents = np.stack([number, number], axis=1)
    ends = np.array(TETRAHEDRON.edges)[:, :2]
    parents[cells[:, TETRAHEDRON.corners :]] = number[cells[:, ends]]
    if (parents < 0).any():
        return None  # nodes without cells
    free = ~system.prescribed[: 3 * system.node_count].reshape(-1, 3)
    return Levels(parents, free, vertices, _mass(system))


def _mass(system: System) -> sp.csc_matrix:
    """Integral of the products of the shape functions of mean stress, over the shear modulus."""
    element, model = system.element, system.model
    compliance = np.empty(len(system.cells))
    for name, material in model.region_materials.items():
        compliance[model.mesh.regions[name]] = system.stress_scale / material.law.shear_modulus
    shapes = element.tables.M[:, : len(element.modes)]
    products = np.einsum("cq,qa,qb->cab", system.dV * compliance[:, None], shapes, shapes)
    rows = np.broadcast_to(element.mean[:, :, None], products.shape).ravel()
    columns = np.broadcast_to(element.mean[:, None, :], products.shape).ravel()
    size = element.mean_count
    return sp.tril(sp.csc_matrix((products.ravel(), (rows, columns)), shape=(size, size))).tocsc()
