"""Isochoric stresses in the reference configuration, of rubber that relaxes or softens.

Symmetric tensors are arrays (..., 6) of the components 11 22 33 12 23 13. With C̄ = J^(−2/3) C, a constant tensor h has
the energy ½ h : C̄; its stress and tangent are written here once, for a homogeneous test and for any array of points.
"""

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.symmetric import PAIRS

Array = NDArray[np.float64]

_PLACE = ((0, 3, 5), (3, 1, 4), (5, 4, 2))
_TWICE = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])


def scaled_stress(S: Array, C: Array) -> Array:
    """Return the scaled isochoric stress J^(2/3) S, the form of the internal variables.

    Parameters
    ----------
    S : (..., 6) array [Pa]
        Isochoric stress, the mean stress left out: S : C = 0.
    C : (..., 6) array [-]
        Right Cauchy–Green tensor.

    Examples
    --------
    >>> stretched = np.array([4.0, 4.0, 4.0, 0.0, 0.0, 0.0])  # J = 8
    >>> scaled_stress(np.array([2.0, -1.0, -1.0, 0.0, 0.0, 0.0]), stretched).round(9)
    array([ 8., -4., -4.,  0.,  0.,  0.])
    """
    return np.asarray(np.cbrt(_determinant(C))[..., None] * S)


def isochoric_stress(h: Array, C: Array) -> Array:
    """Second Piola–Kirchhoff stress J^(−2/3) (h − ⅓ (h : C) C⁻¹) of a remembered stress, derived from ½ h : C̄.

    Parameters
    ----------
    h : (..., 6) array [Pa]
        As from `remembered_stress`.
    C : (..., 6) array [-]
        Right Cauchy–Green tensor at the end of the step.

    Returns
    -------
    (..., 6) array [Pa]

    Examples
    --------
    >>> isochoric_stress(np.array([3.0, 0, 0, 0, 0, 0]), np.array([1.0, 1, 1, 0, 0, 0]))
    array([ 2., -1., -1.,  0.,  0.,  0.])
    """
    inverse, scale = _inverse(C)
    return np.asarray(scale[..., None] * (h - (_product(h, C) / 3.0)[..., None] * inverse))


def isochoric_tangent(h: Array, C: Array) -> Array:
    """Material tangent 4 ∂²(½ h : C̄)/∂C² of a remembered stress.

    Parameters
    ----------
    h : (..., 6) array [Pa]
        As from `remembered_stress`.
    C : (..., 6) array [-]
        Right Cauchy–Green tensor.

    Returns
    -------
    (..., 21) array [Pa]
        Lower triangle of the symmetric 6 × 6 array of tensor components, row by row.

    Examples
    --------
    >>> isochoric_tangent(np.array([3.0, 0, 0, 0, 0, 0]), np.array([1.0, 1, 1, 0, 0, 0]))[:3].round(3)
    array([-1.333, -1.333,  2.667])
    """
    inverse, scale = _inverse(C)
    along = 2.0 / 3.0 * scale * _product(h, C)
    # component by component, each contiguous: several times faster for many points
    H = np.ascontiguousarray(np.moveaxis(2.0 / 3.0 * scale[..., None] * h, -1, 0))
    inv = np.ascontiguousarray(np.moveaxis(inverse, -1, 0))
    out = np.empty((*C.shape[:-1], 21))
    at = 0
    for v, (a, b) in enumerate(PAIRS):
        for w, (c, d) in enumerate(PAIRS[: v + 1]):
            cross = inv[_PLACE[a][c]] * inv[_PLACE[b][d]] + inv[_PLACE[a][d]] * inv[_PLACE[b][c]]
            dyad = inv[v] * inv[w]
            out[..., at] = along * (0.5 * cross + dyad / 3.0) - H[v] * inv[w] - inv[v] * H[w]
            at += 1
    return out


def _determinant(C: Array) -> Array:
    return np.asarray(
        C[..., 0] * (C[..., 1] * C[..., 2] - C[..., 4] ** 2)
        - C[..., 3] * (C[..., 3] * C[..., 2] - C[..., 4] * C[..., 5])
        + C[..., 5] * (C[..., 3] * C[..., 4] - C[..., 1] * C[..., 5])
    )


def _inverse(C: Array) -> tuple[Array, Array]:
    """C⁻¹ by components, and J^(−2/3)."""
    determinant = _determinant(C)
    inverse = np.empty_like(C)
    for v, (a, b) in enumerate(PAIRS):
        a1, a2, b1, b2 = (a + 1) % 3, (a + 2) % 3, (b + 1) % 3, (b + 2) % 3
        inverse[..., v] = (
            C[..., _PLACE[a1][b1]] * C[..., _PLACE[a2][b2]] - C[..., _PLACE[a1][b2]] * C[..., _PLACE[a2][b1]]
        ) / determinant
    return inverse, 1.0 / np.cbrt(determinant)


def _product(first: Array, second: Array) -> Array:
    return np.asarray((first * second) @ _TWICE)
