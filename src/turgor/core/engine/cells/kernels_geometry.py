"""Compiled loops over quadratic cells: geometry at rest, deformation gradients and invariants.

Loops in other files that call functions of this one name it in `turgor.core.engine.compiled.calls`.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.compiled import INNER, LOOP, over

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

FAST = {"contract", "reassoc", "nsz", "arcp"}  # NaN keeps its meaning


@njit(**INNER, fastmath=FAST)
def side_by_side(shape, dN, table):
    """Lay the reference gradients (q, nodes, 3) out as a table (nodes, 3 q), its points side by side."""
    for q in range(len(dN)):
        for a in range(len(shape)):
            for k in range(3):
                table[a, 3 * q + k] = dN[q, a, k]


@njit(**INNER, fastmath=FAST)
def slopes_of(shape, u, table, H):
    """Reference gradients (3, 3 q) of what the nodes of one cell have, stored (3, nodes), at all of its points.

    The sum over the nodes is unrolled, because the compiler knows how many there are; it sums several points at a time.
    """
    for i in range(3):
        for j in range(H.shape[1]):
            total = 0.0
            for a in range(len(shape)):
                total += u[i, a] * table[a, j]
            H[i, j] = total


@njit(**INNER, fastmath=FAST)
def deformation_gradient_at(H, q, Jinv, unit, F):
    """F = I + ∂u/∂X at one point, from the slopes of the displacement in the reference cell.

    A ``unit`` of 0 leaves the identity out: the slopes are those of positions, or of an update.
    """
    for i in range(3):
        for J in range(3):
            F[i, J] = H[i, 3 * q] * Jinv[0, J] + H[i, 3 * q + 1] * Jinv[1, J] + H[i, 3 * q + 2] * Jinv[2, J]
        F[i, i] += unit


@njit(**INNER, fastmath=FAST)
def cofactor_at(F, Cof):
    """Cofactor J F⁻ᵀ and the volume ratio J."""
    for i in range(3):
        i1, i2 = (i + 1) % 3, (i + 2) % 3
        for J in range(3):
            J1, J2 = (J + 1) % 3, (J + 2) % 3
            Cof[i, J] = F[i1, J1] * F[i2, J2] - F[i1, J2] * F[i2, J1]
    return F[0, 0] * Cof[0, 0] + F[0, 1] * Cof[0, 1] + F[0, 2] * Cof[0, 2]


@njit(**INNER, fastmath=FAST)
def load_cell(shape, nodes, u, ue):
    """Values at the nodes of one cell, stored (3, nodes)."""
    for a in range(len(shape)):
        for i in range(3):
            ue[i, a] = u[nodes[a], i]


@njit(**LOOP, fastmath=FAST)
def reference_geometry(shape, points, cells, dN, weights):
    """Inverse Jacobian (c, q, 3, 3) and volume weight (c, q) of the curved reference cells."""
    count, q_count = len(cells), len(weights)
    Jinv = np.empty((count, q_count, 3, 3))
    dV = np.empty((count, q_count))
    A = np.empty((3, 3))
    Cof = np.empty((3, 3))
    for c in range(count):
        for q in range(q_count):
            for i in range(3):
                for k in range(3):
                    total = 0.0
                    for a in range(len(shape)):
                        total += points[cells[c, a], i] * dN[q, a, k]
                    A[i, k] = total
            det = cofactor_at(A, Cof)
            for k in range(3):
                for i in range(3):
                    Jinv[c, q, k, i] = Cof[i, k] / det
            dV[c, q] = det * weights[q]
    return Jinv, dV


@njit(**LOOP, fastmath=FAST)
def _kinematics(begin, end, out, shape, cells, u, dN, Jinv, unit):
    I1, I2, ratio = out
    table, ue, H = np.empty((len(shape), 3 * len(dN))), np.empty((3, len(shape))), np.empty((3, 3 * len(dN)))
    F, Cof = np.empty((3, 3)), np.empty((3, 3))
    side_by_side(shape, dN, table)
    for c in range(begin, end):
        load_cell(shape, cells[c], u, ue)
        slopes_of(shape, ue, table, H)
        for q in range(len(dN)):
            deformation_gradient_at(H, q, Jinv[c, q], unit, F)
            J = cofactor_at(F, Cof)
            first = 0.0
            second = 0.0
            for i in range(3):
                for k in range(3):
                    first += F[i, k] * F[i, k]
                    second += Cof[i, k] * Cof[i, k]  # tr Cof C = I₂
            ratio[c, q] = J
            if J > 0:
                j = J ** (-2.0 / 3.0)
                I1[c, q] = j * first
                I2[c, q] = j * j * second
            else:
                I1[c, q] = np.nan
                I2[c, q] = np.nan


def kinematics(
    shape: tuple[int, ...], cells: Ints, u: Array, dN: Array, Jinv: Array, unit: float = 1.0
) -> tuple[Array, Array, Array]:
    """Isochoric invariants Ī₁, Ī₂ and volume ratio J at all points; J ≤ 0 gives NaN invariants.

    ``u`` are displacements, or positions where ``unit`` is 0.
    """
    count, q_count = len(cells), len(dN)
    out = np.empty((count, q_count)), np.empty((count, q_count)), np.empty((count, q_count))
    over(count, _kinematics, out, shape, cells, u, dN, Jinv, unit)
    return out


@njit(**LOOP, fastmath=FAST)
def _deformation_gradients(begin, end, out, shape, cells, u, dN, Jinv, unit):
    table, ue, H = np.empty((len(shape), 3 * len(dN))), np.empty((3, len(shape))), np.empty((3, 3 * len(dN)))
    side_by_side(shape, dN, table)
    for c in range(begin, end):
        load_cell(shape, cells[c], u, ue)
        slopes_of(shape, ue, table, H)
        for q in range(len(dN)):
            deformation_gradient_at(H, q, Jinv[c, q], unit, out[c, q])


def deformation_gradients(
    shape: tuple[int, ...], cells: Ints, u: Array, dN: Array, Jinv: Array, unit: float = 1.0
) -> Array:
    """Deformation gradient F (c, q, 3, 3) at all points, for results; ``unit`` as in `kinematics`."""
    out = np.empty((len(cells), len(dN), 3, 3))
    over(len(cells), _deformation_gradients, out, shape, cells, u, dN, Jinv, unit)
    return out
