"""Compiled loops for laws in principal stretches: eigenvectors of C, and one chain rule to stress and tangent.

With λ̄ = J^(−1/3) λ, hᵢⱼ = ∂²W/∂ln λ̄ᵢ ∂ln λ̄ⱼ and P the projector on the deviator, the Kirchhoff stresses are
τ = P ∂W/∂ln λ̄ and their slopes c = P h P. Then Sᵢ = τᵢ/λᵢ², Dᵢⱼ = cᵢⱼ/(λᵢ²λⱼ²) − 2 δᵢⱼ τᵢ/λᵢ⁴, and a turn of the
principal axes adds Gᵢⱼ = (Sⱼ − Sᵢ)/(λⱼ² − λᵢ²), whose limit for equal stretches is ¼ (Dᵢᵢ + Dⱼⱼ) − ½ Dᵢⱼ; see Simo
and Taylor (1991), doi 10.1016/0045-7825(91)90100-K. The eigenvectors come from Jacobi's rotations, which stay
orthogonal to round-off however close the stretches are. In a foam, whose law has the change of volume, λ̄ is λ and
nothing is projected: P is the identity.
"""

# mypy: disallow-untyped-defs=False
# numba infers the types of the compiled loops, as in `turgor.core.engine.cells.kernels`

import numpy as np
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.compiled import LOOP, over
from turgor.foundation.symmetric import PAIRS

Array = NDArray[np.float64]

_FAST = {"contract", "reassoc", "nsz", "arcp"}  # NaN keeps its meaning

#: Relative distance of two squared stretches below which the limit replaces the quotient: there the limit is off by
#: the square of it, the quotient by round-off over it, both below 1e-10.
CLOSE = 1e-5

TANGENT = 21  # lower triangle of the symmetric 6 × 6 tangent, row by row


@njit(**LOOP, fastmath=_FAST)
def _rotate(A, N, p, q):
    """One Jacobi rotation that makes A[p, q] zero; the columns of N follow."""
    if A[p, q] == 0.0:
        return
    theta = 0.5 * (A[q, q] - A[p, p]) / A[p, q]
    if abs(theta) > 1e150:
        t = 0.5 / theta
    else:
        t = 1.0 / (abs(theta) + np.sqrt(theta * theta + 1.0))
        if theta < 0.0:
            t = -t
    c = 1.0 / np.sqrt(t * t + 1.0)
    s = t * c
    shift = t * A[p, q]
    A[p, p] -= shift
    A[q, q] += shift
    A[p, q] = 0.0
    A[q, p] = 0.0
    r = 3 - p - q
    first, second = A[r, p], A[r, q]
    A[r, p] = c * first - s * second
    A[r, q] = s * first + c * second
    A[p, r] = A[r, p]
    A[q, r] = A[r, q]
    for i in range(3):
        first, second = N[i, p], N[i, q]
        N[i, p] = c * first - s * second
        N[i, q] = s * first + c * second


@njit(**LOOP, fastmath=_FAST)
def _principal_axes(A, N):
    """Eigenvectors of a symmetric A as columns of N; A is left with its eigenvalues on the diagonal."""
    for i in range(3):
        for j in range(3):
            N[i, j] = 1.0 if i == j else 0.0
    for _ in range(30):
        off = abs(A[0, 1]) + abs(A[0, 2]) + abs(A[1, 2])
        if not off > 1e-17 * (A[0, 0] + A[1, 1] + A[2, 2]):
            break
        _rotate(A, N, 0, 1)
        _rotate(A, N, 0, 2)
        _rotate(A, N, 1, 2)


@njit(**LOOP, fastmath=_FAST)
def _principal_stretches(begin, end, out, F):
    stretches, directions, scale = out
    q_count = F.shape[1]
    C = np.empty((3, 3))
    for c in range(begin, end):
        for q in range(q_count):
            f = F[c, q]
            J = (
                f[0, 0] * (f[1, 1] * f[2, 2] - f[1, 2] * f[2, 1])
                - f[0, 1] * (f[1, 0] * f[2, 2] - f[1, 2] * f[2, 0])
                + f[0, 2] * (f[1, 0] * f[2, 1] - f[1, 1] * f[2, 0])
            )
            for i in range(3):
                for j in range(3):
                    C[i, j] = f[0, i] * f[0, j] + f[1, i] * f[1, j] + f[2, i] * f[2, j]
            _principal_axes(C, directions[c, q])
            scale[c, q] = J ** (1.0 / 3.0) if J > 0.0 else np.nan
            for i in range(3):
                stretches[i, c, q] = np.sqrt(C[i, i]) / scale[c, q]


def principal_stretches(F: Array) -> tuple[Array, Array, Array]:
    """Isochoric principal stretches (3, c, q), principal directions of C as columns (c, q, 3, 3), and J^(1/3) (c, q).

    J ≤ 0 gives NaN stretches.
    """
    points = F.shape[:2]
    out = np.empty((3, *points)), np.empty((*points, 3, 3)), np.empty(points)
    over(len(F), _principal_stretches, out, F)
    return out


@njit(**LOOP, fastmath=_FAST)
def _principal_response(bar, scale, W1, W2, share, S, D):
    """Principal stresses S (3), and D (3, 3) with the shear moduli Gᵢⱼ of equal or unequal stretches, returned.

    ``share`` of the means is taken away: 1 projects on the deviator, 0 does not.
    """
    mean = 0.0
    for i in range(3):
        mean += share * bar[i] * W1[i] / 3.0
    h = np.empty((3, 3))
    total = 0.0
    rows = np.zeros(3)
    at = ((0, 3, 5), (3, 1, 4), (5, 4, 2))
    for i in range(3):
        for j in range(3):
            h[i, j] = bar[i] * bar[j] * W2[at[i][j]]
            if i == j:
                h[i, j] += bar[i] * W1[i]
            rows[i] += share * h[i, j] / 3.0
            total += share * h[i, j] / 9.0
    x = np.empty(3)
    for i in range(3):
        x[i] = (scale * bar[i]) ** 2
        S[i] = (bar[i] * W1[i] - mean) / x[i]
    for i in range(3):
        for j in range(3):
            D[i, j] = (h[i, j] - rows[i] - rows[j] + total) / (x[i] * x[j])
        D[i, i] -= 2.0 * S[i] / x[i]
    G = np.empty(3)
    for k in range(3):
        i, j = PAIRS[3 + k]
        gap = x[j] - x[i]
        if abs(gap) > CLOSE * (x[i] + x[j]):
            G[k] = (S[j] - S[i]) / gap
        else:
            G[k] = 0.25 * (D[i, i] + D[j, j]) - 0.5 * D[i, j]
    return G


@njit(**LOOP, fastmath=_FAST)
def _spectral_response(begin, end, out, stretches, directions, scale, W1, W2, projected):
    stress, tangent = out
    q_count = scale.shape[1]
    S = np.empty(3)
    D = np.empty((3, 3))
    M = np.empty((6, 6))  # dyads of the principal directions, then nᵢ⊗nⱼ + nⱼ⊗nᵢ, by component
    DM = np.empty((3, 6))
    for c in range(begin, end):
        for q in range(q_count):
            G = _principal_response(stretches[:, c, q], scale[c, q], W1[:, c, q], W2[:, c, q], projected[c], S, D)
            N = directions[c, q]
            for k in range(6):
                i, j = PAIRS[k]
                for v in range(6):
                    a, b = PAIRS[v]
                    M[k, v] = N[a, i] * N[b, j] if i == j else N[a, i] * N[b, j] + N[a, j] * N[b, i]
            for i in range(3):
                for v in range(6):
                    DM[i, v] = D[i, 0] * M[0, v] + D[i, 1] * M[1, v] + D[i, 2] * M[2, v]
            at = 0
            for v in range(6):
                stress[c, q, v] = S[0] * M[0, v] + S[1] * M[1, v] + S[2] * M[2, v]
                for w in range(v + 1):
                    value = M[0, v] * DM[0, w] + M[1, v] * DM[1, w] + M[2, v] * DM[2, w]
                    for k in range(3):
                        value += G[k] * M[3 + k, v] * M[3 + k, w]
                    tangent[c, q, at] = value
                    at += 1


def spectral_response(
    stretches: Array, directions: Array, scale: Array, W1: Array, W2: Array, projected: Array | None = None
) -> tuple[Array, Array]:
    """Stress S (c, q, 6) and tangent 4 ∂²W/∂C∂C, lower triangles (c, q, 21).

    ``W1`` (3, c, q) and ``W2`` (6, c, q) are the derivatives of the energy by the isochoric principal stretches, where
    ``projected`` (c,) is 1, as in all cells by default. Where it is 0 they are those by the stretches themselves, and
    the scale is 1.
    """
    out = np.empty((*scale.shape, 6)), np.empty((*scale.shape, TANGENT))
    shares = np.ones(len(scale)) if projected is None else projected
    over(len(scale), _spectral_response, out, stretches, directions, scale, W1, W2, shares)
    return out
