"""Compiled formulas of one Gauss point: stress and tangent of a law in invariants, in the reference configuration.

Second Piola–Kirchhoff stress S and material tangent D = 4 ∂²W/∂C² come from the derivatives of the energy by the
isochoric invariants and from the mean stress. Symmetric tensors have six components, 11 22 33 12 23 13. The functions
are called by the loops of `turgor.core.engine.cells.kernels`, which name this file in
`turgor.core.engine.compiled.calls`.
"""

from numba import njit

from turgor.core.engine.cells.kernels_geometry import FAST
from turgor.core.engine.compiled import INNER


@njit(**INNER, fastmath=FAST)
def strain_at(J, F, Cof, C, Ci):
    """C = Fᵀ F and C⁻¹ = Cofᵀ Cof / J² of a point, from its deformation gradient, the cofactor and J."""
    pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
    s = 1.0 / (J * J)
    for v in range(6):
        a, b = pairs[v]
        C[v] = F[0, a] * F[0, b] + F[1, a] * F[1, b] + F[2, a] * F[2, b]
        Ci[v] = s * (Cof[0, a] * Cof[0, b] + Cof[1, a] * Cof[1, b] + Cof[2, a] * Cof[2, b])


@njit(**INNER, fastmath=FAST)
def stress_at(C, Ci, given, s1, s2, T, S):
    """S = 2 (W₁ ∂Ī₁/∂C + W₂ ∂Ī₂/∂C) + p J C⁻¹ from ``given`` = (J, W₁, W₂, p).

    Also fills s1 = ∂Ī₁/∂C, s2 = ∂Ī₂/∂C and T = ∂I₂/∂C, and returns J, J^(−2/3), J^(−4/3), I₁ and I₂.
    """
    J, W1, W2, p = given
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
    return J, j, k, I1, I2


@njit(**INNER, fastmath=FAST)
def moduli_at(Ci, T, s1, s2, W, given, D):
    """D = 4 ∂²(W + pJ)/∂C∂C + κ J² C⁻¹ ⊗ C⁻¹ as a symmetric 6 × 6 array of tensor components.

    ``W`` are the five derivatives of the energy; ``given`` is what `stress_at` returns, the mean stress and κ.
    """
    W1, W2, W11, W12, W22 = W
    (J, j, k, I1, I2), p, bulk = given
    pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
    index = ((0, 3, 5), (3, 1, 4), (5, 4, 2))
    circle = 2.0 * (W1 * j * I1 / 3.0 + W2 * k * I2 * 2.0 / 3.0) - p * J
    dyad = 2.0 * (W1 * j * I1 / 9.0 + W2 * k * I2 * 4.0 / 9.0) + 0.5 * (p * J + bulk * J * J)
    by_delta, by_T, identity = 4.0 / 3.0 * W1 * j, 8.0 / 3.0 * W2 * k, 4.0 * W2 * k
    for w in range(6):  # all dyads as s1 ⊗ a + s2 ⊗ b + C⁻¹ ⊗ e + e ⊗ C⁻¹
        delta = 1.0 if w < 3 else 0.0
        a = 4.0 * (W11 * s1[w] + W12 * s2[w])
        b = 4.0 * (W12 * s1[w] + W22 * s2[w])
        e = dyad * Ci[w] - by_delta * delta - by_T * T[w]
        for v in range(6):
            D[v, w] = s1[v] * a + s2[v] * b + Ci[v] * e
    for v in range(6):
        e = dyad * Ci[v] - by_delta * (1.0 if v < 3 else 0.0) - by_T * T[v]
        g, h = pairs[v]
        for w in range(v + 1):
            c, d = pairs[w]
            value = D[v, w] + e * Ci[w]
            value += circle * (Ci[index[g][c]] * Ci[index[h][d]] + Ci[index[g][d]] * Ci[index[h][c]])
            if w < 3 and v < 3 and v != w:
                value += identity
            if v == w and v >= 3:
                value -= 0.5 * identity
            D[v, w] = value
            D[w, v] = value


@njit(**INNER, fastmath=FAST)
def add_stress(more, S):
    """Add six components to the stress."""
    for v in range(6):
        S[v] += more[v]


@njit(**INNER, fastmath=FAST)
def add_moduli(more, D):
    """Add a lower triangle, stored row by row, to the symmetric D."""
    at = 0
    for v in range(6):
        for w in range(v):
            D[v, w] += more[at]
            D[w, v] += more[at]
            at += 1
        D[v, v] += more[at]
        at += 1


@njit(**INNER, fastmath=FAST)
def push_forward(F, D, S, FD, A):
    """∂P/∂F (9 × 9, rows iJ) = F D Fᵀ + δ S, its blocks k ≥ i; ``FD`` (9, 6) is room to work in.

    A point does not take memory of its own: that costs as much as a tenth of its tangent.
    """
    index = ((0, 3, 5), (3, 1, 4), (5, 4, 2))
    for i in range(3):
        for J in range(3):
            for w in range(6):
                FD[3 * i + J, w] = (
                    F[i, 0] * D[index[0][J], w] + F[i, 1] * D[index[1][J], w] + F[i, 2] * D[index[2][J], w]
                )
    for r in range(9):
        for k in range(r // 3, 3):
            for L in range(3):
                A[r, 3 * k + L] = (
                    FD[r, index[0][L]] * F[k, 0] + FD[r, index[1][L]] * F[k, 1] + FD[r, index[2][L]] * F[k, 2]
                )
    for i in range(3):
        for J in range(3):
            for L in range(3):
                A[3 * i + J, 3 * i + L] += S[index[J][L]]


@njit(**INNER, fastmath=FAST)
def strain_change_at(F, H, E):
    """Change of Green's strain with the displacement gradient H of an update; shears count twice, as 2 E₁₂."""
    pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
    for v in range(6):
        a, b = pairs[v]
        total = 0.0
        for i in range(3):
            total += F[i, a] * H[i, b] + F[i, b] * H[i, a]
        E[v] = 0.5 * total if v < 3 else total
