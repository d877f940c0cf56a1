"""Indicator: the share of each cell in the error, by comparing the stress with a smoothed one (Zienkiewicz, Zhu 1987).

The stress of quadratic cells jumps between them. Averaged at the vertices, and linear in between, it is nearer to the
exact one (doi 10.1002/nme.1620240206). The energy of the difference shows where cells are too large; its size is no
error of any measure. Averages stop where the mean stress may jump, because there the exact stress jumps too.
"""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.element import tables_with
from turgor.core.engine.cells.mean_stress_jumps import numbers_at_borders
from turgor.core.engine.cells.reference import reference_nodes, smooth_basis
from turgor.core.engine.fields import cell_fields
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.solvers.solution import State

Array = NDArray[np.float64]


def error_indicator(state: State) -> Array:
    """Estimate each cell's share of the squared error in energy: what `squared_errors` gives, over its sum."""
    squared = squared_errors(state)
    whole = squared.sum()
    return np.asarray(squared / whole if whole > 0 else np.full(squared.shape, 1 / squared.size))


def squared_errors(state: State) -> Array:
    """Estimate each cell's squared error in energy.

    Parameters
    ----------
    state : State

    Returns
    -------
    (c, 1) or (c, 3) array [J]
        Up to a factor that is equal on all meshes. Those of hexahedra are divided among the three directions of the
        cell, by how much the stress bends along each.
    """
    model, mesh = state.model, state.model.mesh
    fields = cell_fields(model, state.displacement, state.mean_stress, state.memory, state.load_factor)
    stress = fields.cauchy.reshape(*fields.cauchy.shape[:2], 9)
    nodes, corners = mesh.cell_type.nodes, mesh.cell_type.corners
    r = tables_with(nodes, stress.shape[1])
    basis = smooth_basis(nodes, r.points)
    to_corners = smooth_basis(nodes, reference_nodes(nodes)[:corners]) @ np.linalg.pinv(basis)
    numbers, count = numbers_at_borders(model)
    volume = fields.weight.sum(axis=1)
    total = np.bincount(numbers.ravel(), np.repeat(volume, corners), minlength=count)
    at_corners = np.einsum("aq,cqk->cak", to_corners, stress) * volume[:, None, None]
    weight = np.where(total > 0, total, 1.0)  # no cell has the numbers of vertices that follow others
    smooth = np.empty((count, 9))
    for k in range(9):
        smooth[:, k] = np.bincount(numbers.ravel(), at_corners[..., k].ravel(), minlength=count) / weight
    difference = np.einsum("qa,cak->cqk", r.M[:, :corners], smooth[numbers]) - stress
    out = np.einsum("cqk,cq->c", difference**2, fields.weight)
    for name, material in model.region_materials.items():
        out[mesh.regions[name]] /= material.law.shear_modulus
    return np.asarray(out[:, None] * _directions(stress, mesh.cell_type is HEXAHEDRON))


def _directions(stress: Array, hexahedra: bool) -> Array:
    """Shares of the directions of each cell: squared second differences of the stress over the 3 × 3 × 3 points."""
    if not hexahedra:
        return np.ones((len(stress), 1))
    grid = stress.reshape(len(stress), 3, 3, 3, -1)  # first coordinate slowest, as the quadrature has it
    bends = np.stack([np.diff(grid, 2, axis=1 + d).reshape(len(stress), -1) for d in range(3)], axis=1)
    squared = np.einsum("cdk,cdk->cd", bends, bends)
    total = squared.sum(axis=1, keepdims=True)
    return np.asarray(np.where(total > 0, squared / np.where(total > 0, total, 1.0), 1 / 3))
