"""Compiled formulas of the volume of a cell: its mean stress, and the moments of volume that are penalized.

``shape`` and ``modes`` are tuples as long as a cell has nodes and mean stresses; ``H`` (3, 3 q) are the slopes of the
displacement in the reference cell, ``M`` (q, m) the shape functions of the mean stress. The functions are called by the
loops of `turgor.core.engine.cells.kernels`, which name this file in `turgor.core.engine.compiled.calls`.

Only hexahedra have moments that are penalized. Functions of moments return at once for other cells: numba knows the
length of ``shape`` before it looks at the rest, and leaves that out. This spares a fifth of the time to compile.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.cells import kernels_geometry
from turgor.core.engine.cells.kernels_geometry import FAST, cofactor_at, deformation_gradient_at
from turgor.core.engine.compiled import INNER, calls
from turgor.core.meshing.cells import HEXAHEDRON_20

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Nodes of the cells that have penalized moments.
PENALIZED = HEXAHEDRON_20.nodes


class Cell(NamedTuple):
    """One cell, as the functions of its volume take it.

    Parameters
    ----------
    mean : (m,) int array
        Its mean stresses.
    Jinv, dV : (q, 3, 3), (q,) arrays
        Inverse Jacobians and volumes of its Gauss points.
    compliance : float
        1/κ.
    penalty : (q, k) array
        Functions φₖ.
    unit : float
        As in `turgor.core.engine.cells.kernels.Cells`.
    """

    mean: Ints
    Jinv: Array
    dV: Array
    compliance: float
    penalty: Array
    unit: float


@njit(**INNER, fastmath=FAST)
def mean_stress_at(modes, M, p, mean, J, compliance):
    """Mean stress at one point: interpolated, or κ (J − 1) in a cell that has none of its own."""
    if len(modes) == 0:
        return (J - 1.0) / compliance
    total = 0.0
    for m in range(len(modes)):
        total += M[m] * p[mean[m]]
    return total


@njit(**INNER, fastmath=FAST)
def lost_volume_at(modes, J, mean, compliance):
    """J − 1 − p/κ: what the volume ratio misses of what the mean stress says; nothing where it follows from J."""
    if len(modes) == 0:
        return 0.0
    return J - 1.0 - mean * compliance


@njit(**INNER, fastmath=FAST)
def bulk_modulus(modes, compliance):
    """κ where the mean stress is a function of the displacement, zero where it is an unknown."""
    if len(modes) == 0:
        return 1.0 / compliance
    return 0.0


@njit(**INNER, fastmath=FAST)
@calls(kernels_geometry)
def lost_moments(shape, modes, H, p, M, cell):
    """Moments ∫ φₖ (J − 1 − p/κ) dV of a cell, (k,)."""
    mean, Jinv, dV, compliance, penalty, unit = cell
    if len(shape) < PENALIZED:
        return penalty[0]  # empty
    moments = np.zeros(penalty.shape[1])
    F = np.empty((3, 3))
    Cof = np.empty((3, 3))
    for q in range(len(dV)):
        deformation_gradient_at(H, q, Jinv[q], unit, F)
        J = cofactor_at(F, Cof)
        lost = lost_volume_at(modes, J, mean_stress_at(modes, M[q], p, mean, J, compliance), compliance)
        for k in range(len(moments)):
            moments[k] += dV[q] * penalty[q, k] * lost
    return moments


@njit(**INNER, fastmath=FAST)
@calls(kernels_geometry)
def moment_changes(shape, modes, H, update, M, cell):
    """Changes of the moments of a cell, (k,), with an ``update``: the slopes of displacements, and mean stresses."""
    mean, Jinv, dV, compliance, penalty, unit = cell
    if len(shape) < PENALIZED:
        return penalty[0]  # empty
    changes = np.zeros(penalty.shape[1])
    dH, dp = update
    F = np.empty((3, 3))
    dF = np.empty((3, 3))
    Cof = np.empty((3, 3))
    for q in range(len(dV)):
        deformation_gradient_at(H, q, Jinv[q], unit, F)
        deformation_gradient_at(dH, q, Jinv[q], 0.0, dF)
        cofactor_at(F, Cof)
        change = 0.0
        for i in range(3):
            for J in range(3):
                change += Cof[i, J] * dF[i, J]
        for m in range(len(modes)):
            change -= compliance * M[q, m] * dp[mean[m]]
        for k in range(len(changes)):
            changes[k] += dV[q] * penalty[q, k] * change
    return changes


@njit(**INNER, fastmath=FAST)
def penalty_stress_at(shape, penalty, moments):
    """Mean stress of the penalty at one point: Σ φₖ mₖ."""
    if len(shape) < PENALIZED:
        return 0.0
    total = 0.0
    for k in range(len(moments)):
        total += penalty[k] * moments[k]
    return total


@njit(**INNER, fastmath=FAST)
def add_moment_gradients(shape, modes, penalty, by_u, by_p, u_part, p_part):
    """Add a point to the gradients of the moments by displacements (k, 3, nodes) and mean stresses (k, m).

    ``by_u`` (3, nodes) is its gradient of the volume, and ``by_p`` its volume, 1/κ and the shape functions (m,) of the
    mean stress.
    """
    if len(shape) < PENALIZED:
        return
    w, compliance, M = by_p
    for k in range(len(penalty)):
        for i in range(3):
            for a in range(len(shape)):
                u_part[k, i, a] += penalty[k] * by_u[i, a]
        for m in range(len(modes)):
            p_part[k, m] -= penalty[k] * w * compliance * M[m]
