"""Compiled loops over sampled Gauss points: isochoric stress, forces and tangent in reduced coordinates.

At a point the deformation gradient is linear in the reduced coordinates, F = I + Σ qₐ Gₐ, so forces and tangent are
those of `turgor.core.engine.cells.kernels` contracted with G. The mean stress is no part of them: its work is an exact
polynomial (`turgor.reduced.parts.polynomials`).
"""

# mypy: disallow-untyped-defs=False
# numba infers the types of the compiled loops, as in `turgor.core.engine.cells.kernels`

import numpy as np
from numba import njit

from turgor.core.engine.cells import kernels_geometry, kernels_point
from turgor.core.engine.cells.kernels_geometry import FAST, cofactor_at
from turgor.core.engine.cells.kernels_point import (
    add_moduli,
    add_stress,
    moduli_at,
    push_forward,
    strain_at,
    strain_change_at,
    stress_at,
)
from turgor.core.engine.compiled import LOOP, calls


@njit(**LOOP, fastmath=FAST)
@calls(kernels_geometry)
def invariants(F):
    """Isochoric invariants Ī₁, Ī₂ (p,) of deformation gradients (p, 3, 3); not numbers where J ≤ 0."""
    I1, I2, Cof = np.empty(len(F)), np.empty(len(F)), np.empty((3, 3))
    for p in range(len(F)):
        J = cofactor_at(F[p], Cof)
        first, second = 0.0, 0.0
        for i in range(3):
            for k in range(3):
                first += F[p, i, k] * F[p, i, k]
                second += Cof[i, k] * Cof[i, k]
        if J > 0:
            j = J ** (-2.0 / 3.0)
            I1[p], I2[p] = j * first, j * j * second
        else:
            I1[p], I2[p] = np.nan, np.nan
    return I1, I2


@njit(**LOOP, fastmath=FAST)
@calls(kernels_geometry, kernels_point)
def stresses(F, W, rows, more, moduli):
    """Isochoric S (p, 6) and 4 ∂²W/∂C² (p, 6, 6) from the derivatives (5, p) of the energy by the invariants.

    ``rows`` (p,) are places in ``more`` and ``moduli``, the stress and tangent of laws in stretches; −1 for none.
    """
    S, D = np.empty((len(F), 6)), np.empty((len(F), 6, 6))
    Cof, C, Ci = np.empty((3, 3)), np.empty(6), np.empty(6)
    s1, s2, T = np.empty(6), np.empty(6), np.empty(6)
    for p in range(len(F)):
        J = cofactor_at(F[p], Cof)
        strain_at(J, F[p], Cof, C, Ci)
        scalars = stress_at(C, Ci, (J, W[0, p], W[1, p], 0.0), s1, s2, T, S[p])
        derivatives = (W[0, p], W[1, p], W[2, p], W[3, p], W[4, p])
        moduli_at(Ci, T, s1, s2, derivatives, (scalars, 0.0, 0.0), D[p])
        if rows[p] >= 0:
            add_stress(more[rows[p]], S[p])
            add_moduli(moduli[rows[p]], D[p])
    return S, D


@njit(**LOOP, fastmath=FAST)
@calls(kernels_geometry, kernels_point)
def linearized(F, dF, S, D):
    """Stress S + D : ΔE (p, 6) for an update dF (p, 3, 3) of deformation gradients."""
    out, E = np.empty_like(S), np.empty(6)
    for p in range(len(F)):
        strain_change_at(F[p], dF[p], E)
        for v in range(6):
            total = S[p, v]
            for w in range(6):
                total += D[p, v, w] * E[w]
            out[p, v] = total
    return out


@njit(**LOOP, fastmath=FAST)
def forces(F, S, weights, G, starts):
    """Forces (g, r) on the reduced coordinates, summed over points starts[g] to starts[g + 1]; G is (p, 9, r)."""
    out = np.zeros((len(starts) - 1, G.shape[2]))
    for g in range(len(starts) - 1):
        for p in range(starts[g], starts[g + 1]):
            for i in range(3):
                f0, f1, f2 = F[p, i, 0], F[p, i, 1], F[p, i, 2]
                w = weights[p]
                p0 = w * (f0 * S[p, 0] + f1 * S[p, 3] + f2 * S[p, 5])
                p1 = w * (f0 * S[p, 3] + f1 * S[p, 1] + f2 * S[p, 4])
                p2 = w * (f0 * S[p, 5] + f1 * S[p, 4] + f2 * S[p, 2])
                for a in range(G.shape[2]):
                    out[g, a] += p0 * G[p, 3 * i, a] + p1 * G[p, 3 * i + 1, a] + p2 * G[p, 3 * i + 2, a]
    return out


@njit(**LOOP, fastmath=FAST)
@calls(kernels_geometry, kernels_point)
def stiffened(F, S, D, weights, G):
    """W (F D Fᵀ + δ S) G (p, 9, r), whose product with G is the tangent; S is that of the geometric part.

    It is as short as G.
    """
    count = G.shape[2]
    out, a = np.empty(G.shape, G.dtype), np.empty(9, G.dtype)
    FD, A = np.empty((9, 6)), np.zeros((9, 9))
    for p in range(len(F)):
        push_forward(F[p], D[p], S[p], FD, A)
        for i in range(9):
            for k in range(3 * (i // 3)):
                A[i, k] = A[k, i]
        for i in range(9):
            for k in range(9):
                a[k] = weights[p] * A[i, k]
            for b in range(count):  # one pass over a row takes half of the time of nine
                out[p, i, b] = (
                    (a[0] * G[p, 0, b] + a[1] * G[p, 1, b] + a[2] * G[p, 2, b])
                    + (a[3] * G[p, 3, b] + a[4] * G[p, 4, b] + a[5] * G[p, 5, b])
                    + (a[6] * G[p, 6, b] + a[7] * G[p, 7, b] + a[8] * G[p, 8, b])
                )
    return out


@njit(**LOOP, fastmath=FAST)
def constraint_forms(F, weights, out):
    """Add Σ w cof(Fᵢ, Fⱼ) : Fₖ / 6 over points to ``out`` (triples i ≤ j ≤ k, m), for weights (p, m).

    F (p, R, 9) are the parts of a deformation gradient Σ q̂ᵢ Fᵢ, whose determinant is the sum of all i, j, k.
    """
    count, modes = F.shape[1], weights.shape[1]
    X = np.empty((3, 3))
    for p in range(len(F)):
        at = 0
        for i in range(count):
            A = F[p, i]
            for j in range(i, count):
                B = F[p, j]
                for r in range(3):
                    r1, r2 = 3 * ((r + 1) % 3), 3 * ((r + 2) % 3)
                    for s in range(3):
                        s1, s2 = (s + 1) % 3, (s + 2) % 3
                        X[r, s] = (
                            A[r1 + s1] * B[r2 + s2] + B[r1 + s1] * A[r2 + s2]
                            - A[r1 + s2] * B[r2 + s1] - B[r1 + s2] * A[r2 + s1]
                        ) / 6.0  # fmt: skip
                for k in range(j, count):
                    value = 0.0
                    for r in range(3):
                        for s in range(3):
                            value += X[r, s] * F[p, k, 3 * r + s]
                    for m in range(modes):
                        out[at, m] += weights[p, m] * value
                    at += 1


@njit(**LOOP, fastmath=FAST)
def fiber_strains(share, shares, modes, weights):
    """Stretches λ (k,) of fibers whose tension is a share (k,) of their stiffness, and their strains.

    These are ∫ θ ½ (λ² − 1) (m,), with the derivatives (m, m) by the coordinates of the tension; ``shares`` (m, k) are
    the modes θ over the stiffness.
    """
    count, total = modes.shape
    stretch, slope, strains, change = np.empty(total), np.empty(total), np.empty(count), np.empty((count, count))
    for p in range(total):
        stretch[p] = 1.0 / (1.0 - share[p])
        slope[p] = weights[p] * stretch[p] * stretch[p] * stretch[p]
    for a in range(count):
        strain = 0.0
        for p in range(total):
            strain += modes[a, p] * weights[p] * 0.5 * (stretch[p] * stretch[p] - 1.0)
        strains[a] = strain
        for b in range(a + 1):
            value = 0.0
            for p in range(total):
                value += shares[a, p] * slope[p] * modes[b, p]
            change[a, b] = change[b, a] = value
    return stretch, strains, change
