"""Compiled loop over quadratic cells: the tangent of the mixed formulation, see `turgor.core.engine.cells.kernels`."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.cells import kernels_geometry, kernels_point, kernels_volume
from turgor.core.engine.cells.kernels import Cells, Response
from turgor.core.engine.cells.kernels_geometry import (
    FAST,
    cofactor_at,
    deformation_gradient_at,
    load_cell,
    side_by_side,
    slopes_of,
)
from turgor.core.engine.cells.kernels_point import (
    add_moduli,
    add_stress,
    moduli_at,
    push_forward,
    strain_at,
    stress_at,
)
from turgor.core.engine.cells.kernels_volume import (
    PENALIZED,
    Cell,
    add_moment_gradients,
    bulk_modulus,
    lost_moments,
    mean_stress_at,
    penalty_stress_at,
)
from turgor.core.engine.compiled import INNER, LOOP, calls, over

Array = NDArray[np.float64]


@njit(**INNER, fastmath=FAST)
def _add_point(G, A, w, AG, K):
    """K += w Gᵀ A G for one point; K is (nodes, 6 pad), the blocks i ≤ k of a row of nodes side by side.

    Each block is padded to a multiple of four columns, and the length of a row is read from the array: with a length
    that it knows the compiler unrolls the loop before it finds that entries can be added four at a time.
    """
    pad, at = G.shape[1], 0
    for i in range(3):
        for k in range(i, 3):
            for J in range(3):
                a0 = w * A[3 * i + J, 3 * k]
                a1 = w * A[3 * i + J, 3 * k + 1]
                a2 = w * A[3 * i + J, 3 * k + 2]
                for b in range(pad):
                    AG[J, at + b] = a0 * G[0, b] + a1 * G[1, b] + a2 * G[2, b]
            at += pad
    for a in range(len(K)):
        g0 = G[0, a]
        g1 = G[1, a]
        g2 = G[2, a]
        for j in range(AG.shape[1]):
            K[a, j] += g0 * AG[0, j] + g1 * AG[1, j] + g2 * AG[2, j]


@njit(**INNER, fastmath=FAST)
def _block(i, k, pad):
    """First column of block i ≤ k."""
    return (i * (5 - i) // 2 + k) * pad


@njit(**INNER, fastmath=FAST)
def _add_penalty(shape, modes, u_part, p_part, K, Kup, Kpp):
    """Add Σ gₖ gₖᵀ with the gradients gₖ of the moments by displacements (k, 3, nodes) and mean stresses (k, m)."""
    if len(shape) < PENALIZED:
        return
    pad = K.shape[1] // 6
    for k in range(len(u_part)):
        for i in range(3):
            for j in range(i, 3):
                at = _block(i, j, pad)
                for a in range(len(shape)):
                    g = u_part[k, i, a]
                    for b in range(len(shape)):
                        K[a, at + b] += g * u_part[k, j, b]
        for m in range(len(modes)):
            for i in range(3):
                for a in range(len(shape)):
                    Kup[m, i, a] += p_part[k, m] * u_part[k, i, a]
            for n in range(m + 1):
                Kpp[m, n] += p_part[k, m] * p_part[k, n]


@njit(**INNER, fastmath=FAST)
def _pack(shape, modes, K, Kup, Kpp, out):
    """Lower triangle of the cell matrix, row by row: displacement unknowns node by node, then mean stresses."""
    pad, at = K.shape[1] // 6, 0
    for a in range(len(shape)):
        for i in range(3):
            for b in range(a + 1):
                last = i + 1 if b == a else 3
                for k in range(last):
                    out[at] = K[a, _block(i, k, pad) + b] if i <= k else K[b, _block(k, i, pad) + a]
                    at += 1
    for m in range(len(modes)):
        for a in range(len(shape)):
            for i in range(3):
                out[at] = Kup[m, i, a]
                at += 1
        for n in range(m + 1):
            out[at] = Kpp[m, n]
            at += 1


@njit(**LOOP, fastmath=FAST)
@calls(kernels_geometry, kernels_point, kernels_volume)
def _tangent(begin, end, out, cells, u, p, laws, geometric, use_geometric):
    shape, modes, nodes, mean, dN, M, Jinv, dV, compliance, penalty, unit = cells
    W, rows, stress, moduli = laws
    pad = (len(shape) + 3) // 4 * 4
    table, H = np.empty((len(shape), 3 * len(dN))), np.empty((3, 3 * len(dN)))
    ue, G, T9 = np.empty((3, len(shape))), np.empty((3, pad)), np.empty((3, len(shape)))
    slopes = np.empty((len(dN), 3, len(shape)))
    F, Cof = np.empty((3, 3)), np.empty((3, 3))
    C, Ci, S = np.empty(6), np.empty(6), np.empty(6)
    s1, s2, T = np.empty(6), np.empty(6), np.empty(6)
    D, FD, A, AG = np.empty((6, 6)), np.empty((9, 6)), np.empty((9, 9)), np.empty((3, 6 * pad))
    K, Kpp = np.empty((len(shape), 6 * pad)), np.empty((len(modes), len(modes)))
    Kup = np.empty((len(modes), 3, len(shape)))
    u_part, p_part = np.empty((penalty.shape[2], 3, len(shape))), np.empty((penalty.shape[2], len(modes)))
    G[:] = 0.0
    side_by_side(shape, dN, table)
    for q in range(len(dN)):
        for k in range(3):
            for a in range(len(shape)):
                slopes[q, k, a] = dN[q, a, k]
    for c in range(begin, end):
        K[:], Kpp[:], Kup[:], u_part[:], p_part[:] = 0.0, 0.0, 0.0, 0.0, 0.0
        cell = Cell(mean[c], Jinv[c], dV[c], compliance[c], penalty[c], unit)
        load_cell(shape, nodes[c], u, ue)
        slopes_of(shape, ue, table, H)
        moments = lost_moments(shape, modes, H, p, M, cell)
        for q in range(len(dN)):
            for J in range(3):
                j0, j1, j2 = Jinv[c, q, 0, J], Jinv[c, q, 1, J], Jinv[c, q, 2, J]
                for a in range(len(shape)):
                    G[J, a] = slopes[q, 0, a] * j0 + slopes[q, 1, a] * j1 + slopes[q, 2, a] * j2
            deformation_gradient_at(H, q, Jinv[c, q], unit, F)
            J = cofactor_at(F, Cof)
            pq = mean_stress_at(modes, M[q], p, mean[c], J, compliance[c])
            pq += geometric[c, q, 6] if use_geometric else penalty_stress_at(shape, penalty[c, q], moments)
            strain_at(J, F, Cof, C, Ci)
            scalars = stress_at(C, Ci, (J, W[0, c, q], W[1, c, q], pq), s1, s2, T, S)
            derivatives = (W[0, c, q], W[1, c, q], W[2, c, q], W[3, c, q], W[4, c, q])
            moduli_at(Ci, T, s1, s2, derivatives, (scalars, pq, bulk_modulus(modes, compliance[c])), D)
            if rows[c] >= 0:
                add_stress(stress[rows[c], q], S)
                add_moduli(moduli[rows[c], q], D)
            if use_geometric:
                for v in range(6):
                    S[v] = geometric[c, q, v]
            push_forward(F, D, S, FD, A)
            w = dV[c, q]
            _add_point(G, A, w, AG, K)
            for i in range(3):
                for a in range(len(shape)):
                    T9[i, a] = w * (Cof[i, 0] * G[0, a] + Cof[i, 1] * G[1, a] + Cof[i, 2] * G[2, a])
            add_moment_gradients(shape, modes, penalty[c, q], T9, (w, compliance[c], M[q]), u_part, p_part)
            for m in range(len(modes)):
                for i in range(3):
                    for a in range(len(shape)):
                        Kup[m, i, a] += M[q, m] * T9[i, a]
                for n in range(m + 1):
                    Kpp[m, n] -= w * compliance[c] * M[q, m] * M[q, n]
        _add_penalty(shape, modes, u_part, p_part, K, Kup, Kpp)
        _pack(shape, modes, K, Kup, Kpp, out[c])


def tangent(cells: Cells, u: Array, p: Array, laws: Response, geometric: Array, use_geometric: bool) -> Array:
    """Hessian of the energy by cell, lower triangles packed row by row.

    ``geometric`` (c, q, 7) of `extrapolated_stress` replaces the stress in the geometric stiffness, and the mean stress
    of the penalty, where ``use_geometric`` is set; the other parameters are those of `residual`.
    """
    unknowns = 3 * len(cells.shape) + len(cells.modes)
    out = np.empty((len(cells.nodes), unknowns * (unknowns + 1) // 2))
    over(len(out), _tangent, out, cells, u, p, laws, geometric, use_geometric)
    return out
