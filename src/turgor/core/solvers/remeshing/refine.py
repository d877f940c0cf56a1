"""Refine: cut the cells that carry most of the error, as many as the growth of the mesh allows."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.rings import rings_of
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.refining.refinement import Refinement
from turgor.core.meshing.refining.split import refine_tetrahedra
from turgor.core.meshing.refining.split_hexahedra import CELL_EDGES, refine_hexahedra, sheets
from turgor.core.solvers.remeshing.settings import REMESHING

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Cells that each cell becomes where all edges are cut.
ALL_CUT = 8.0


def refined(mesh: Mesh, shares: Array, growth: float) -> Refinement:
    """Refine a mesh where the error comes from.

    Parameters
    ----------
    mesh : Mesh
        Ten-node tetrahedra or 27-node hexahedra.
    shares : (c, 1) or (c, 3) array
        Each cell's share of the error, of hexahedra by direction: what `error_indicator` gives.
    growth : float
        Cells of the refined mesh over those of this one, aimed at; 8 refines all.

    Returns
    -------
    Refinement
    """
    if mesh.cell_type is TETRAHEDRON:
        return _tetrahedra(mesh, shares[:, 0], growth)
    return _hexahedra(mesh, shares, growth)


def _tetrahedra(mesh: Mesh, shares: Array, growth: float) -> Refinement:
    count = len(mesh.cells)
    target = count if growth >= ALL_CUT else int(np.ceil((growth - 1) * count / REMESHING.new_cells))
    marked = np.argsort(-shares, kind="stable")[: max(1, min(target, count))]
    edges = mesh.cells[marked][:, np.array(TETRAHEDRON.edges)].reshape(-1, 2)
    edges = np.unique(np.sort(edges, axis=1), axis=0)
    return refine_tetrahedra(mesh, edges)


def ring_sheets(mesh: Mesh, of_cell: Ints) -> Ints:
    """Sheets of an axisymmetric mesh whose edges run around the axis: cutting them adds no degree of freedom."""
    ring = rings_of(mesh).leader
    rings = []
    for direction, edges in enumerate(CELL_EDGES):
        ends = ring[mesh.cells[:, np.array(edges)]]
        rings.append(of_cell[(ends[..., 0] == ends[..., 1]).any(axis=1), direction])
    return np.unique(np.concatenate(rings))


def _hexahedra(mesh: Mesh, shares: Array, growth: float) -> Refinement:
    """Cut the sheets that gain most for their cells, one after another."""
    of_cell = sheets(mesh)
    count = int(of_cell.max()) + 1
    around = ring_sheets(mesh, of_cell) if mesh.revolved else np.zeros(0, dtype=np.int64)
    shares = np.where(np.isin(of_cell, around), 0.0, shares)
    shares = shares / shares.sum()
    error, cells = np.zeros(count), np.zeros(count)
    np.add.at(error, of_cell, shares)
    np.add.at(cells, of_cell, 1.0)
    order = np.argsort(-error / cells, kind="stable")[: count - len(around)]
    chosen = len(order)
    for number in range(1, len(order) + 1):
        parts = 2.0 ** np.isin(of_cell, order[:number]).sum(axis=1)
        if parts.sum() > growth * len(of_cell):
            chosen = max(1, number - 1)
            break
    return refine_hexahedra(mesh, order[:chosen])
