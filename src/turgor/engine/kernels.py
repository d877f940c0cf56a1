"""Compiled loops over quadratic cells: kinematics, residual and tangent of the mixed formulation.

The energy of a cell is ∫ W(Ī₁, Ī₂) + p (J − 1) − p² / (2κ) dV with quadratic displacement and linear mean stress p. In
hexahedra a few moments of J − 1 − p/κ over the cell are penalized, ½ Σ (∫ φₖ (J − 1 − p/κ) dV)², with the functions φ,
``penalty`` (c, q, k) in the loops, of `turgor.engine.stabilization`; in tetrahedra k is zero. A cell without
mean stresses of its own, for comparison with codes that have no mixed element, takes p = κ (J − 1) at each point. The
numbers of nodes and of mean stresses come as the lengths of two tuples, ``shape`` and ``modes``, so that the compiler
knows them and unrolls: one compiled version for each kind of cell.

Stress and tangent are formed once per point in the reference configuration (second Piola–Kirchhoff S and 4 ∂²W/∂C²),
pushed to ∂P/∂F and contracted with the shape function gradients; node loops run over contiguous arrays so that the
compiler vectorizes them. Laws in stretches bring the isochoric S and 4 ∂²W/∂C² along (`turgor.engine.spectral`): cell c
adds row ``rows[c]`` of them, none where that is negative. All of it is one file because numba keys its cache by the
file of the calling loop. Symbols follow the review's section 3.1.
"""

import numpy as np
from numba import njit, prange

_FAST = {"contract", "reassoc", "nsz", "arcp"}  # NaN keeps its meaning


@njit(cache=True, fastmath=_FAST)
def _gradient(shape, dN, Jinv, G):
    """Shape function gradients ∂N/∂X at one point, stored (3, nodes)."""
    for J in range(3):
        for a in range(len(shape)):
            G[J, a] = dN[a, 0] * Jinv[0, J] + dN[a, 1] * Jinv[1, J] + dN[a, 2] * Jinv[2, J]


@njit(cache=True, fastmath=_FAST)
def _deformation_gradient(shape, u, G, F):
    """F = I + ∂u/∂X with u stored (3, nodes)."""
    for i in range(3):
        for J in range(3):
            total = 1.0 if i == J else 0.0
            for a in range(len(shape)):
                total += u[i, a] * G[J, a]
            F[i, J] = total


@njit(cache=True, fastmath=_FAST)
def _cofactor(F, Cof):
    """Cofactor J F⁻ᵀ and the volume ratio J."""
    for i in range(3):
        i1, i2 = (i + 1) % 3, (i + 2) % 3
        for J in range(3):
            J1, J2 = (J + 1) % 3, (J + 2) % 3
            Cof[i, J] = F[i1, J1] * F[i2, J2] - F[i1, J2] * F[i2, J1]
    return F[0, 0] * Cof[0, 0] + F[0, 1] * Cof[0, 1] + F[0, 2] * Cof[0, 2]


@njit(cache=True, fastmath=_FAST)
def _load_cell(shape, nodes, u, ue):
    for a in range(len(shape)):
        for i in range(3):
            ue[i, a] = u[nodes[a], i]


@njit(cache=True, parallel=True, fastmath=_FAST)
def reference_geometry(shape, points, cells, dN, weights):
    """Inverse Jacobian (c, q, 3, 3) and volume weight (c, q) of the curved reference cells."""
    count, q_count = len(cells), len(weights)
    Jinv = np.empty((count, q_count, 3, 3))
    dV = np.empty((count, q_count))
    for c in prange(count):
        A = np.empty((3, 3))
        Cof = np.empty((3, 3))
        for q in range(q_count):
            for i in range(3):
                for k in range(3):
                    total = 0.0
                    for a in range(len(shape)):
                        total += points[cells[c, a], i] * dN[q, a, k]
                    A[i, k] = total
            det = _cofactor(A, Cof)
            for k in range(3):
                for i in range(3):
                    Jinv[c, q, k, i] = Cof[i, k] / det
            dV[c, q] = det * weights[q]
    return Jinv, dV


@njit(cache=True, parallel=True, fastmath=_FAST)
def kinematics(shape, cells, u, dN, Jinv):
    """Isochoric invariants Ī₁, Ī₂ and volume ratio J at all points; J ≤ 0 gives NaN invariants."""
    count, q_count = len(cells), len(dN)
    I1 = np.empty((count, q_count))
    I2 = np.empty((count, q_count))
    ratio = np.empty((count, q_count))
    for c in prange(count):
        ue = np.empty((3, len(shape)))
        G = np.empty((3, len(shape)))
        F = np.empty((3, 3))
        Cof = np.empty((3, 3))
        _load_cell(shape, cells[c], u, ue)
        for q in range(q_count):
            _gradient(shape, dN[q], Jinv[c, q], G)
            _deformation_gradient(shape, ue, G, F)
            J = _cofactor(F, Cof)
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
    return I1, I2, ratio


@njit(cache=True, parallel=True, fastmath=_FAST)
def deformation_gradients(shape, cells, u, dN, Jinv):
    """Deformation gradient F (c, q, 3, 3) at all points, for results."""
    count, q_count = len(cells), len(dN)
    out = np.empty((count, q_count, 3, 3))
    for c in prange(count):
        ue = np.empty((3, len(shape)))
        G = np.empty((3, len(shape)))
        _load_cell(shape, cells[c], u, ue)
        for q in range(q_count):
            _gradient(shape, dN[q], Jinv[c, q], G)
            _deformation_gradient(shape, ue, G, out[c, q])
    return out


@njit(cache=True, fastmath=_FAST)
def _mean_stress(modes, M, p, mean, J, compliance):
    """Mean stress at one point: interpolated, or κ (J − 1) in a cell that has none of its own."""
    if len(modes) == 0:
        return (J - 1.0) / compliance
    total = 0.0
    for m in range(len(modes)):
        total += M[m] * p[mean[m]]
    return total


@njit(cache=True, fastmath=_FAST)
def _lost_volume(modes, J, mean, compliance):
    """J − 1 − p/κ: what the volume ratio misses of what the mean stress says; nothing where it follows from J."""
    if len(modes) == 0:
        return 0.0
    return J - 1.0 - mean * compliance


@njit(cache=True, fastmath=_FAST)
def _bulk_modulus(modes, compliance):
    """κ where the mean stress is a function of the displacement, zero where it is an unknown."""
    if len(modes) == 0:
        return 1.0 / compliance
    return 0.0


@njit(cache=True, fastmath=_FAST)
def _lost_moments(shape, modes, ue, p, mean, dN, M, Jinv, dV, compliance, penalty):
    """Moments ∫ φₖ (J − 1 − p/κ) dV of a cell, (k,)."""
    moments = np.zeros(penalty.shape[1])
    if len(moments) == 0:
        return moments
    G = np.empty((3, len(shape)))
    F = np.empty((3, 3))
    Cof = np.empty((3, 3))
    for q in range(len(dN)):
        _gradient(shape, dN[q], Jinv[q], G)
        _deformation_gradient(shape, ue, G, F)
        J = _cofactor(F, Cof)
        lost = _lost_volume(modes, J, _mean_stress(modes, M[q], p, mean, J, compliance), compliance)
        for k in range(len(moments)):
            moments[k] += dV[q] * penalty[q, k] * lost
    return moments


@njit(cache=True, fastmath=_FAST)
def _penalty_stress(penalty, moments):
    """Mean stress of the penalty at one point: Σ φₖ mₖ."""
    total = 0.0
    for k in range(len(moments)):
        total += penalty[k] * moments[k]
    return total


@njit(cache=True, fastmath=_FAST)
def _symmetric_inverse_times(J, Cof, Ci):
    """C⁻¹ = Cofᵀ Cof / J², symmetric, as six components 11 22 33 12 23 13."""
    s = 1.0 / (J * J)
    Ci[0] = s * (Cof[0, 0] * Cof[0, 0] + Cof[1, 0] * Cof[1, 0] + Cof[2, 0] * Cof[2, 0])
    Ci[1] = s * (Cof[0, 1] * Cof[0, 1] + Cof[1, 1] * Cof[1, 1] + Cof[2, 1] * Cof[2, 1])
    Ci[2] = s * (Cof[0, 2] * Cof[0, 2] + Cof[1, 2] * Cof[1, 2] + Cof[2, 2] * Cof[2, 2])
    Ci[3] = s * (Cof[0, 0] * Cof[0, 1] + Cof[1, 0] * Cof[1, 1] + Cof[2, 0] * Cof[2, 1])
    Ci[4] = s * (Cof[0, 1] * Cof[0, 2] + Cof[1, 1] * Cof[1, 2] + Cof[2, 1] * Cof[2, 2])
    Ci[5] = s * (Cof[0, 0] * Cof[0, 2] + Cof[1, 0] * Cof[1, 2] + Cof[2, 0] * Cof[2, 2])


@njit(cache=True, fastmath=_FAST)
def _right_cauchy_green(F, C):
    C[0] = F[0, 0] * F[0, 0] + F[1, 0] * F[1, 0] + F[2, 0] * F[2, 0]
    C[1] = F[0, 1] * F[0, 1] + F[1, 1] * F[1, 1] + F[2, 1] * F[2, 1]
    C[2] = F[0, 2] * F[0, 2] + F[1, 2] * F[1, 2] + F[2, 2] * F[2, 2]
    C[3] = F[0, 0] * F[0, 1] + F[1, 0] * F[1, 1] + F[2, 0] * F[2, 1]
    C[4] = F[0, 1] * F[0, 2] + F[1, 1] * F[1, 2] + F[2, 1] * F[2, 2]
    C[5] = F[0, 0] * F[0, 2] + F[1, 0] * F[1, 2] + F[2, 0] * F[2, 2]


@njit(cache=True, fastmath=_FAST)
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


@njit(cache=True, fastmath=_FAST)
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


@njit(cache=True, fastmath=_FAST)
def _add_stress(more, S):
    for v in range(6):
        S[v] += more[v]


@njit(cache=True, fastmath=_FAST)
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


@njit(cache=True, fastmath=_FAST)
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


@njit(cache=True, parallel=True, fastmath=_FAST)
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
        _load_cell(shape, cells[c], u, ue)
        out[c, :] = 0.0
        moments = _lost_moments(shape, modes, ue, p, mean[c], dN, M, Jinv[c], dV[c], compliance[c], penalty[c])
        for q in range(q_count):
            _gradient(shape, dN[q], Jinv[c, q], G)
            _deformation_gradient(shape, ue, G, F)
            J = _cofactor(F, Cof)
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


@njit(cache=True, parallel=True, fastmath=_FAST)
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
        _load_cell(shape, cells[c], u, ue)
        _load_cell(shape, cells[c], du, de)
        moments = _lost_moments(shape, modes, ue, p, mean[c], dN, M, Jinv[c], dV[c], compliance[c], penalty[c])
        for q in range(q_count):
            _gradient(shape, dN[q], Jinv[c, q], G)
            _deformation_gradient(shape, ue, G, F)
            _deformation_gradient(shape, de, G, H)
            for i in range(3):
                H[i, i] -= 1.0
            J = _cofactor(F, Cof)
            pq = _mean_stress(modes, M[q], p, mean[c], J, compliance[c])
            dpq = 0.0
            for m in range(len(modes)):
                dpq += M[q, m] * dp[mean[c, m]]
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


@njit(cache=True, fastmath=_FAST)
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


@njit(cache=True, fastmath=_FAST)
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


@njit(cache=True, fastmath=_FAST)
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


@njit(cache=True, parallel=True, fastmath=_FAST)
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
        _load_cell(shape, cells[c], u, ue)
        moments = _lost_moments(shape, modes, ue, p, mean[c], dN, M, Jinv[c], dV[c], compliance[c], penalty[c])
        u_part = np.zeros((len(moments), 3, len(shape)))
        p_part = np.zeros((len(moments), len(modes)))
        for q in range(q_count):
            _gradient(shape, dN[q], Jinv[c, q], G)
            _deformation_gradient(shape, ue, G, F)
            J = _cofactor(F, Cof)
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
