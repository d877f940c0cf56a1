"""Compiled loop for the stress that rubber remembers.

The formulas are those of `turgor.core.materials.history.isochoric`, at many points.
"""

# mypy: disallow-untyped-defs=False
# numba infers the types of the compiled loops, as in `turgor.core.engine.cells.kernels`

import numpy as np
from numba import njit

from turgor.core.engine.compiled import LOOP

_FAST = {"contract", "reassoc", "nsz", "arcp"}  # NaN keeps its meaning


@njit(**LOOP, fastmath=_FAST)
def _right_cauchy_green(f, C, inverse):
    """C and its inverse by components; the determinant of C is returned."""
    C[0] = f[0, 0] * f[0, 0] + f[1, 0] * f[1, 0] + f[2, 0] * f[2, 0]
    C[1] = f[0, 1] * f[0, 1] + f[1, 1] * f[1, 1] + f[2, 1] * f[2, 1]
    C[2] = f[0, 2] * f[0, 2] + f[1, 2] * f[1, 2] + f[2, 2] * f[2, 2]
    C[3] = f[0, 0] * f[0, 1] + f[1, 0] * f[1, 1] + f[2, 0] * f[2, 1]
    C[4] = f[0, 1] * f[0, 2] + f[1, 1] * f[1, 2] + f[2, 1] * f[2, 2]
    C[5] = f[0, 0] * f[0, 2] + f[1, 0] * f[1, 2] + f[2, 0] * f[2, 2]
    inverse[0] = C[1] * C[2] - C[4] * C[4]
    inverse[1] = C[0] * C[2] - C[5] * C[5]
    inverse[2] = C[0] * C[1] - C[3] * C[3]
    inverse[3] = C[4] * C[5] - C[3] * C[2]
    inverse[4] = C[3] * C[5] - C[0] * C[4]
    inverse[5] = C[3] * C[4] - C[1] * C[5]
    determinant = C[0] * inverse[0] + C[3] * inverse[3] + C[5] * inverse[5]
    for v in range(6):
        inverse[v] /= determinant
    return determinant


@njit(**LOOP, fastmath=_FAST)
def _add(h, product, Ci, stress, tangent):
    """J^(−2/3) (h − ⅓ (h : C) C⁻¹) and its derivative, h and the product scaled by J^(−2/3) already."""
    pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
    place = ((0, 3, 5), (3, 1, 4), (5, 4, 2))
    at = 0
    for v in range(6):
        a, b = pairs[v]
        stress[v] += h[v] - product / 3.0 * Ci[v]
        for w in range(v + 1):
            c, d = pairs[w]
            cross = Ci[place[a][c]] * Ci[place[b][d]] + Ci[place[a][d]] * Ci[place[b][c]]
            value = product * (0.5 * cross + Ci[v] * Ci[w] / 3.0) - h[v] * Ci[w] - Ci[v] * h[w]
            tangent[at] += 2.0 / 3.0 * value
            at += 1


@njit(**LOOP, fastmath=_FAST)
def add_known_stress(F, rows, known, scale, stress, tangent):
    """Add stress and tangent of a known tensor, divided by a scale, in place.

    ``known`` (c, q, 6) belongs to the cells ``rows`` (c,) of ``F`` (s, q, 3, 3), ``stress`` (s, q, 6) and ``tangent``
    (s, q, 21), lower triangles.
    """
    for c in range(len(rows)):
        row = rows[c]
        C = np.empty(6)
        inverse = np.empty(6)
        h = np.empty(6)
        for q in range(F.shape[1]):
            j = _right_cauchy_green(F[row, q], C, inverse) ** (-1.0 / 3.0) / scale
            product = 0.0
            for v in range(6):
                h[v] = j * known[c, q, v]
                product += h[v] * C[v] if v < 3 else 2.0 * h[v] * C[v]
            _add(h, product, inverse, stress[row, q], tangent[row, q])
