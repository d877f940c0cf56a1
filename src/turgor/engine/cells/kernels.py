"""Compiled loops over quadratic cells: kinematics, residual and tangent of the mixed formulation.

The energy of a cell is ∫ W(Ī₁, Ī₂) + p (J − 1) − p² / (2κ) dV with quadratic displacement and linear mean stress p. In
hexahedra a few moments of J − 1 − p/κ over the cell are penalized, ½ Σ (∫ φₖ (J − 1 − p/κ) dV)², with the functions φ,
``penalty`` (c, q, k) in the loops, of `turgor.engine.cells.stabilization`; in tetrahedra k is zero. A cell without
mean stresses of its own, for comparison with codes that have no mixed element, takes p = κ (J − 1) at each point. The
numbers of nodes and of mean stresses come as the lengths of two tuples, ``shape`` and ``modes``, so that the compiler
knows them and unrolls: one compiled version for each kind of cell.

Stress and tangent are formed once per point in the reference configuration (second Piola–Kirchhoff S and 4 ∂²W/∂C²),
pushed to ∂P/∂F and contracted with the shape function gradients; node loops run over contiguous arrays so that the
compiler vectorizes them. Laws in stretches bring the isochoric S and 4 ∂²W/∂C² along (`turgor.engine.cells.spectral`):
cell c adds row ``rows[c]`` of them, none where that is negative. All of it is one file, but for the deformation
gradients, because numba keys its cache by the file of the calling loop. Symbols follow the review's section 3.1.
"""

import numpy as np
from numba import njit, prange

from turgor.engine.cells.kernels_geometry import FAST, cofactor_at, deformation_gradient_at, gradient_at, load_cell


@njit(cache=True, fastmath=FAST)
def _mean_stress(modes, M, p, mean, J, compliance):
    """Mean stress at one point: interpolated, or κ (J − 1) in a cell that has none of its own."""
    if len(modes) == 0:
        return (J - 1.0) / compliance
    total = 0.0
    for m in range(len(modes)):
        total += M[m] * p[mean[m]]
    return total


@njit(cache=True, fastmath=FAST)
def _lost_volume(modes, J, mean, compliance):
    """J − 1 − p/κ: what the volume ratio misses of what the mean stress says; nothing where it follows from J."""
    if len(modes) == 0:
        return 0.0
    return J - 1.0 - mean * compliance


@njit(cache=True, fastmath=FAST)
def _bulk_modulus(modes, compliance):
    """κ where the mean stress is a function of the displacement, zero where it is an unknown."""
    if len(modes) == 0:
        return 1.0 / compliance
    return 0.0


@njit(cache=True, fastmath=FAST)
def _lost_moments(shape, modes, ue, p, mean, dN, M, Jinv, dV, compliance, penalty):
    """Moments ∫ φₖ (J − 1 − p/κ) dV of a cell, (k,)."""
    moments = np.zeros(penalty.shape[1])
    if len(moments) == 0:
        return moments
    G = np.empty((3, len(shape)))
    F = np.empty((3, 3))
    Cof = np.empty((3, 3))
    for q in range(len(dN)):
        gradient_at(shape, dN[q], Jinv[q], G)
        deformation_gradient_at(shape, ue, G, F)
        J = cofactor_at(F, Cof)
        lost = _lost_volume(modes, J, _mean_stress(modes, M[q], p, mean, J, compliance), compliance)
        for k in range(len(moments)):
            moments[k] += dV[q] * penalty[q, k] * lost
    return moments


@njit(cache=True, fastmath=FAST)
def _moment_changes(shape, modes, ue, de, dp, mean, dN, M, Jinv, dV, compliance, penalty):
    """Changes of the moments of a cell with the updates of displacements ``de`` (3, nodes) and mean stresses, (k,)."""
    changes = np.zeros(penalty.shape[1])
    if len(changes) == 0:
        return changes
    G = np.empty((3, len(shape)))
    F = np.empty((3, 3))
    H = np.empty((3, 3))
    Cof = np.empty((3, 3))
    for q in range(len(dN)):
        gradient_at(shape, dN[q], Jinv[q], G)
        deformation_gradient_at(shape, ue, G, F)
        deformation_gradient_at(shape, de, G, H)
        cofactor_at(F, Cof)
        change = 0.0
        for i in range(3):
            H[i, i] -= 1.0
            for J in range(3):
                change += Cof[i, J] * H[i, J]
        for m in range(len(modes)):
            change -= compliance * M[q, m] * dp[mean[m]]
        for k in range(len(changes)):
            changes[k] += dV[q] * penalty[q, k] * change
    return changes


@njit(cache=True, fastmath=FAST)
def _penalty_stress(penalty, moments):
    """Mean stress of the penalty at one point: Σ φₖ mₖ."""
    total = 0.0
    for k in range(len(moments)):
        total += penalty[k] * moments[k]
    return total


@njit(cache=True, fastmath=FAST)
def _symmetric_inverse_times(J, Cof, Ci):
    """C⁻¹ = Cofᵀ Cof / J², symmetric, as six components 11 22 33 12 23 13."""
    s = 1.0 / (J * J)
    Ci[0] = s * (Cof[0, 0] * Cof[0, 0] + Cof[1, 0] * Cof[1, 0] + Cof[2, 0] * Cof[2, 0])
    Ci[1] = s * (Cof[0, 1] * Cof[0, 1] + Cof[1, 1] * Cof[1, 1] + Cof[2, 1] * Cof[2, 1])
    Ci[2] = s * (Cof[0, 2] * Cof[0, 2] + Cof[1, 2] * Cof[1, 2] + Cof[2, 2] * Cof[2, 2])
    Ci[3] = s * (Cof[0, 0] * Cof[0, 1] + Cof[1, 0] * Cof[1, 1] + Cof[2, 0] * Cof[2, 1])
    Ci[4] = s * (Cof[0, 1] * Cof[0, 2] + Cof[1, 1] * Cof[1, 2] + Cof[2, 1] * Cof[2, 2])
    Ci[5] = s * (Cof[0, 0] * Cof[0, 2] + Cof[1, 0] * Cof[1, 2] + Cof[2, 0] * Cof[2, 2])


@njit(cache=True, fastmath=FAST)
def _right_cauchy_green(F, C):
    C[0] = F[0, 0] * F[0, 0] + F[1, 0] * F[1, 0] + F[2, 0] * F[2, 0]
    C[1] = F[0, 1] * F[0, 1] + F[1, 1] * F[1, 1] + F[2, 1] * F[2, 1]
    C[2] = F[0, 2] * F[0, 2] + F[1, 2] * F[1, 2] + F[2, 2] * F[2, 2]
    C[3] = F[0, 0] * F[0, 1] + F[1, 0] * F[1, 1] + F[2, 0] * F[2, 1]
    C[4] = F[0, 1] * F[0, 2] + F[1, 1] * F[1, 2] + F[2, 1] * F[2, 2]
    C[5] = F[0, 0] * F[0, 2] + F[1, 0] * F[1, 2] + F[2, 0] * F[2, 2]


@njit(cache=True, fastmath=FAST)
def _stress(C, Ci, J, W1, W2, p, s1, s2, T, S):
    """S = 2 (W₁ ∂Ī₁/∂C + W₂ ∂Ī₂/∂C) + p J C⁻¹; also leaves s1 = ∂Ī₁/∂C, s2 = ∂Ī₂/∂C and T = ∂I₂/∂C."""
    j = J ** (-2.0 / 3.0)
    k = j * j
    I1 = C[0] + C[1] + C[2]
    trC2 = C[0] * C[0] + C[1] * C[1] + C[2] * C[2] + 2.0 * (C[3] * C[3] + C[4] * C[4] + C[5] * C[5])
    I2 = 0.5 * (I1 * I1 - trC2)
    for v in range(6):
        delta = 1.0 if v < 3 else 0.0
        T[v] = I1 * delta - C[v]
        s1[v] = j * (delta - I1 / 3.0 * Ci[v])
        s2[v] = k * (T[v] - 2.0 / 3.0 * I2 * Ci[v])
        S[v] = 2.0 * (W1 * s1[v] + W2 * s2[v]) + p * J * Ci[v]
    return j, k, I1, I2


@njit(cache=True, fastmath=FAST)
def _material_tangent(Ci, T, s1, s2, W, scalars, p, bulk, D):
    """D = 4 ∂²(W + pJ)/∂C∂C + κ J² C⁻¹ ⊗ C⁻¹ as a symmetric 6 × 6 array of tensor components."""
    W1, W2, W11, W12, W22 = W
    J, j, k, I1, I2 = scalars
    pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
    index = ((0, 3, 5), (3, 1, 4), (5, 4, 2))
    circle = 4.0 * (W1 * j * I1 / 3.0 + W2 * k * I2 * 2.0 / 3.0) - 2.0 * p * J
    dyad = 4.0 * (W1 * j * I1 / 9.0 + W2 * k * I2 * 4.0 / 9.0) + p * J + bulk * J * J
    for v in range(6):
        a, b = pairs[v]
        delta_v = 1.0 if v < 3 else 0.0
        for w in range(v + 1):
            c, d = pairs[w]
            delta_w = 1.0 if w < 3 else 0.0
            Cio = 0.5 * (Ci[index[a][c]] * Ci[index[b][d]] + Ci[index[a][d]] * Ci[index[b][c]])
            value = 4.0 * (W11 * s1[v] * s1[w] + W12 * (s1[v] * s2[w] + s2[v] * s1[w]) + W22 * s2[v] * s2[w])
            value += dyad * Ci[v] * Ci[w] + circle * Cio
            value -= 4.0 / 3.0 * W1 * j * (delta_v * Ci[w] + Ci[v] * delta_w)
            value -= 8.0 / 3.0 * W2 * k * (T[v] * Ci[w] + Ci[v] * T[w])
            identity = 0.0
            if v == w:
                identity = 1.0 if v < 3 else 0.5
            value += 4.0 * W2 * k * (delta_v * delta_w - identity)
            D[v, w] = value
            D[w, v] = value


@njit(cache=True, fastmath=FAST)
def _add_stress(more, S):
    for v in range(6):
        S[v] += more[v]


@njit(cache=True, fastmath=FAST)
def _add_tangent(more, D):
    """Add a lower triangle, stored row by row, to the symmetric D."""
    at = 0
    for v in range(6):
        for w in range(v):
            D[v, w] += more[at]
            D[w, v] += more[at]
            at += 1
        D[v, v] += more[at]
        at += 1


@njit(cache=True, fastmath=FAST)
def _push(F, D, S, A):
    """∂P/∂F (9 × 9, rows iJ) = F D Fᵀ + δ S."""
    index = ((0, 3, 5), (3, 1, 4), (5, 4, 2))
    FD = np.empty((9, 6))
    for i in range(3):
        for J in range(3):
            for w in range(6):
                FD[3 * i + J, w] = (
                    F[i, 0] * D[index[0][J], w] + F[i, 1] * D[index[1][J], w] + F[i, 2] * D[index[2][J], w]
                )
    for r in range(9):
        for k in range(3):
            for L in range(3):
                A[r, 3 * k + L] = (
                    FD[r, index[0][L]] * F[k, 0] + FD[r, index[1][L]] * F[k, 1] + FD[r, index[2][L]] * F[k, 2]
                )
    for i in range(3):
        for J in range(3):
            for L in range(3):
                A[3 * i + J, 3 * i + L] += S[index[J][L]]


@njit(cache=True, parallel=True, fastmath=FAST)
def residual(shape, modes, cells, mean, u, p, dN, M, Jinv, dV, W1, W2, rows, stress, compliance, penalty):
    """Gradient of the energy by cell: internal forces (node by node), then volume constraints."""
    count, q_count = len(cells), len(dN)
    out = np.empty((count, 3 * len(shape) + len(modes)))
    for c in prange(count):
        ue = np.empty((3, len(shape)))
        G = np.empty((3, len(shape)))
        F = np.empty((3, 3))
        Cof = np.empty((3, 3))
        P = np.empty((3, 3))
        C = np.empty(6)
        Ci = np.empty(6)
        s1 = np.empty(6)
        s2 = np.empty(6)
        T = np.empty(6)
        S = np.empty(6)
        load_cell(shape, cells[c], u, ue)
        out[c, :] = 0.0
        moments = _lost_moments(shape, modes, ue, p, mean[c], dN, M, Jinv[c], dV[c], compliance[c], penalty[c])
        for q in range(q_count):
            gradient_at(shape, dN[q], Jinv[c, q], G)
            deformation_gradient_at(shape, ue, G, F)
            J = cofactor_at(F, Cof)
            pq = _mean_stress(modes, M[q], p, mean[c], J, compliance[c])
            _right_cauchy_green(F, C)
            _symmetric_inverse_times(J, Cof, Ci)
            lost = _lost_volume(modes, J, pq, compliance[c])
            extra = _penalty_stress(penalty[c, q], moments)
            _stress(C, Ci, J, W1[c, q], W2[c, q], pq + extra, s1, s2, T, S)
            if rows[c] >= 0:
                _add_stress(stress[rows[c], q], S)
            w = dV[c, q]
            for i in range(3):
                P[i, 0] = w * (F[i, 0] * S[0] + F[i, 1] * S[3] + F[i, 2] * S[5])
                P[i, 1] = w * (F[i, 0] * S[3] + F[i, 1] * S[1] + F[i, 2] * S[4])
                P[i, 2] = w * (F[i, 0] * S[5] + F[i, 1] * S[4] + F[i, 2] * S[2])
            for a in range(len(shape)):
                for i in range(3):
                    out[c, 3 * a + i] += P[i, 0] * G[0, a] + P[i, 1] * G[1, a] + P[i, 2] * G[2, a]
            volume = w * (lost - extra * compliance[c])
            for m in range(len(modes)):
                out[c, 3 * len(shape) + m] += M[q, m] * volume
    return out


@njit(cache=True, parallel=True, fastmath=FAST)
def extrapolated_stress(
    shape, modes, cells, mean, u, p, du, dp, dN, M, Jinv, dV, W, rows, stress, material, compliance, penalty
):
    """Stress S + D : ΔE linearized about (u, p) for the update (du, dp), (c, q, 6).

    It enters the geometric stiffness of the next iteration in place of the stress itself: the mixed integration
    point iteration of Magisano, Leonetti and Garcea (2017), doi 10.1016/j.cma.2016.10.023.
    """
    count, q_count = len(cells), len(dN)
    out = np.empty((count, q_count, 6))
    for c in prange(count):
        ue = np.empty((3, len(shape)))
        de = np.empty((3, len(shape)))
        G = np.empty((3, len(shape)))
        F = np.empty((3, 3))
        H = np.empty((3, 3))
        Cof = np.empty((3, 3))
        C = np.empty(6)
        Ci = np.empty(6)
        s1 = np.empty(6)
        s2 = np.empty(6)
        T = np.empty(6)
        S = np.empty(6)
        D = np.empty((6, 6))
        E = np.empty(6)
        load_cell(shape, cells[c], u, ue)
        load_cell(shape, cells[c], du, de)
        moments = _lost_moments(shape, modes, ue, p, mean[c], dN, M, Jinv[c], dV[c], compliance[c], penalty[c])
        changes = _moment_changes(shape, modes, ue, de, dp, mean[c], dN, M, Jinv[c], dV[c], compliance[c], penalty[c])
        for q in range(q_count):
            gradient_at(shape, dN[q], Jinv[c, q], G)
            deformation_gradient_at(shape, ue, G, F)
            deformation_gradient_at(shape, de, G, H)
            for i in range(3):
                H[i, i] -= 1.0
            J = cofactor_at(F, Cof)
            pq = _mean_stress(modes, M[q], p, mean[c], J, compliance[c])
            dpq = 0.0
            for m in range(len(modes)):
                dpq += M[q, m] * dp[mean[c, m]]
            pq += _penalty_stress(penalty[c, q], moments)
            dpq += _penalty_stress(penalty[c, q], changes)
            _right_cauchy_green(F, C)
            _symmetric_inverse_times(J, Cof, Ci)
            j, k, I1, I2 = _stress(C, Ci, J, W[0, c, q], W[1, c, q], pq, s1, s2, T, S)
            derivatives = (W[0, c, q], W[1, c, q], W[2, c, q], W[3, c, q], W[4, c, q])
            bulk = _bulk_modulus(modes, compliance[c])
            _material_tangent(Ci, T, s1, s2, derivatives, (J, j, k, I1, I2), pq, bulk, D)
            if rows[c] >= 0:
                _add_stress(stress[rows[c], q], S)
                _add_tangent(material[rows[c], q], D)
            pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
            for v in range(6):
                a, b = pairs[v]
                total = 0.0
                for i in range(3):
                    total += F[i, a] * H[i, b] + F[i, b] * H[i, a]
                E[v] = 0.5 * total if v < 3 else total  # shear counted twice, as 2 E₁₂
            for v in range(6):
                total = S[v] + dpq * J * Ci[v]
                for w in range(6):
                    total += D[v, w] * E[w]
                out[c, q, v] = total
    return out


@njit(cache=True, fastmath=FAST)
def _add_point(shape, G, A, w, T9, K):
    """K += w Gᵀ A G for one point; K is (3, 3, nodes, nodes), blocks i ≤ k only."""
    for i in range(3):
        for k in range(i, 3):
            for J in range(3):
                a0 = w * A[3 * i + J, 3 * k]
                a1 = w * A[3 * i + J, 3 * k + 1]
                a2 = w * A[3 * i + J, 3 * k + 2]
                for b in range(len(shape)):
                    T9[J, b] = a0 * G[0, b] + a1 * G[1, b] + a2 * G[2, b]
            for a in range(len(shape)):
                g0 = G[0, a]
                g1 = G[1, a]
                g2 = G[2, a]
                for b in range(len(shape)):
                    K[i, k, a, b] += g0 * T9[0, b] + g1 * T9[1, b] + g2 * T9[2, b]


@njit(cache=True, fastmath=FAST)
def _add_penalty(shape, modes, u_part, p_part, K, Kup, Kpp):
    """Add Σ gₖ gₖᵀ with the gradients gₖ of the moments by displacements (k, 3, nodes) and mean stresses (k, m)."""
    for k in range(len(u_part)):
        for i in range(3):
            for j in range(i, 3):
                for a in range(len(shape)):
                    g = u_part[k, i, a]
                    for b in range(len(shape)):
                        K[i, j, a, b] += g * u_part[k, j, b]
        for m in range(len(modes)):
            for i in range(3):
                for a in range(len(shape)):
                    Kup[m, i, a] += p_part[k, m] * u_part[k, i, a]
            for n in range(m + 1):
                Kpp[m, n] += p_part[k, m] * p_part[k, n]


@njit(cache=True, fastmath=FAST)
def _pack(shape, modes, K, Kup, Kpp, out):
    """Lower triangle of the cell matrix, row by row: displacement unknowns node by node, then mean stresses."""
    at = 0
    for a in range(len(shape)):
        for i in range(3):
            for b in range(a + 1):
                last = i + 1 if b == a else 3
                for k in range(last):
                    out[at] = K[i, k, a, b] if i <= k else K[k, i, b, a]
                    at += 1
    for m in range(len(modes)):
        for a in range(len(shape)):
            for i in range(3):
                out[at] = Kup[m, i, a]
                at += 1
        for n in range(m + 1):
            out[at] = Kpp[m, n]
            at += 1


@njit(cache=True, parallel=True, fastmath=FAST)
def tangent(
    shape, modes, cells, mean, u, p, dN, M, Jinv, dV, W, rows, stress, material, volume, geometric, use_geometric
):
    """Hessian of the energy by cell, lower triangles packed row by row.

    ``stress`` (s, q, 6) and ``material`` (s, q, 21), lower triangles, are those of laws in stretches; ``volume`` is
    the pair of compliance (c,) and penalty (c, q, k); ``geometric``
    (c, q, 6) replaces the stress in the geometric stiffness where ``use_geometric`` is set.
    """
    count, q_count = len(cells), len(dN)
    unknowns = 3 * len(shape) + len(modes)
    compliance, penalty = volume
    out = np.empty((count, unknowns * (unknowns + 1) // 2))
    for c in prange(count):
        ue = np.empty((3, len(shape)))
        G = np.empty((3, len(shape)))
        F = np.empty((3, 3))
        Cof = np.empty((3, 3))
        C = np.empty(6)
        Ci = np.empty(6)
        s1 = np.empty(6)
        s2 = np.empty(6)
        T = np.empty(6)
        S = np.empty(6)
        D = np.empty((6, 6))
        A = np.empty((9, 9))
        T9 = np.empty((3, len(shape)))
        K = np.zeros((3, 3, len(shape), len(shape)))
        Kup = np.zeros((len(modes), 3, len(shape)))
        Kpp = np.zeros((len(modes), len(modes)))
        load_cell(shape, cells[c], u, ue)
        moments = _lost_moments(shape, modes, ue, p, mean[c], dN, M, Jinv[c], dV[c], compliance[c], penalty[c])
        u_part = np.zeros((len(moments), 3, len(shape)))
        p_part = np.zeros((len(moments), len(modes)))
        for q in range(q_count):
            gradient_at(shape, dN[q], Jinv[c, q], G)
            deformation_gradient_at(shape, ue, G, F)
            J = cofactor_at(F, Cof)
            pq = _mean_stress(modes, M[q], p, mean[c], J, compliance[c])
            pq += _penalty_stress(penalty[c, q], moments)
            _right_cauchy_green(F, C)
            _symmetric_inverse_times(J, Cof, Ci)
            j, k, I1, I2 = _stress(C, Ci, J, W[0, c, q], W[1, c, q], pq, s1, s2, T, S)
            derivatives = (W[0, c, q], W[1, c, q], W[2, c, q], W[3, c, q], W[4, c, q])
            bulk = _bulk_modulus(modes, compliance[c])
            _material_tangent(Ci, T, s1, s2, derivatives, (J, j, k, I1, I2), pq, bulk, D)
            if rows[c] >= 0:
                _add_stress(stress[rows[c], q], S)
                _add_tangent(material[rows[c], q], D)
            if use_geometric:
                for v in range(6):
                    S[v] = geometric[c, q, v]
            _push(F, D, S, A)
            w = dV[c, q]
            _add_point(shape, G, A, w, T9, K)
            for i in range(3):
                for a in range(len(shape)):
                    T9[i, a] = w * (Cof[i, 0] * G[0, a] + Cof[i, 1] * G[1, a] + Cof[i, 2] * G[2, a])
            for k in range(len(moments)):
                phi = penalty[c, q, k]
                for i in range(3):
                    for a in range(len(shape)):
                        u_part[k, i, a] += phi * T9[i, a]
                for m in range(len(modes)):
                    p_part[k, m] -= phi * w * compliance[c] * M[q, m]
            for m in range(len(modes)):
                for i in range(3):
                    for a in range(len(shape)):
                        Kup[m, i, a] += M[q, m] * T9[i, a]
                for n in range(m + 1):
                    Kpp[m, n] -= w * compliance[c] * M[q, m] * M[q, n]
        _add_penalty(shape, modes, u_part, p_part, K, Kup, Kpp)
        _pack(shape, modes, K, Kup, Kpp, out[c])
    return out
