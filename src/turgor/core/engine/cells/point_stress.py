"""Stress and moduli at points with known deformation gradients, for what is no cell of a solid mesh.

A section (`turgor.fast_models.section`) has deformation gradients that its own unknowns give. The laws are those of
the cells; this loop turns what they say into the first Piola–Kirchhoff stress and its derivative.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.cells import kernels_geometry, kernels_point
from turgor.core.engine.cells.cell_materials import Isochoric
from turgor.core.engine.cells.kernels_geometry import FAST, cofactor_at
from turgor.core.engine.cells.kernels_point import add_moduli, add_stress, moduli_at, push_forward, strain_at, stress_at
from turgor.core.engine.compiled import LOOP, calls

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def isochoric_invariants(F: Array) -> tuple[Array, Array, Array]:
    """Isochoric invariants Ī₁, Ī₂ and the volume ratio J of deformation gradients (..., 3, 3).

    Examples
    --------
    >>> [float(value) for value in isochoric_invariants(2.0 * np.eye(3))]  # a change of volume alone
    [3.0, 3.0, 8.0]
    """
    cofactor = np.stack(
        [np.cross(F[..., (i + 1) % 3, :], F[..., (i + 2) % 3, :]) for i in range(3)],
        axis=-2,
    )
    J = (F[..., 0, :] * cofactor[..., 0, :]).sum(axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        scale = J ** (-2.0 / 3.0)
    return scale * (F**2).sum(axis=(-1, -2)), scale**2 * (cofactor**2).sum(axis=(-1, -2)), J


def stress_and_moduli(F: Array, p: Array, laws: Isochoric, rows: Ints) -> tuple[Array, Array, Array]:
    """First Piola–Kirchhoff stress, its derivative by F, and the cofactor of F.

    Parameters
    ----------
    F : (c, q, 3, 3) array
        Deformation gradients.
    p : (c, q) array
        Mean stresses, which do not depend on F.
    laws : Isochoric
        What the laws say there.
    rows : (c,) int array
        Row of each cell in ``laws.stress``; −1 for none.

    Returns
    -------
    P, A, cofactor : (c, q, 9), (c, q, 9, 9), (c, q, 9) arrays
        Components iJ in the order 11 12 13 21 ...
    """
    P, A, cofactor = _at_points(F, p, laws.derivatives, rows, laws.stress, laws.tangent)
    return np.asarray(P), np.asarray(A), np.asarray(cofactor)


@njit(**LOOP, fastmath=FAST)
@calls(kernels_geometry, kernels_point)
def _at_points(F, p, W, rows, stress, moduli):
    count, points = p.shape
    P, A, cofactor = np.empty((count, points, 9)), np.empty((count, points, 9, 9)), np.empty((count, points, 9))
    Cof = np.empty((3, 3))
    C, Ci, S, s1, s2, T = np.empty(6), np.empty(6), np.empty(6), np.empty(6), np.empty(6), np.empty(6)
    D, FD = np.empty((6, 6)), np.empty((9, 6))
    index = ((0, 3, 5), (3, 1, 4), (5, 4, 2))
    for c in range(count):
        for q in range(points):
            f = F[c, q]
            J = cofactor_at(f, Cof)
            strain_at(J, f, Cof, C, Ci)
            scalars = stress_at(C, Ci, (J, W[0, c, q], W[1, c, q], p[c, q]), s1, s2, T, S)
            derivatives = (W[0, c, q], W[1, c, q], W[2, c, q], W[3, c, q], W[4, c, q])
            moduli_at(Ci, T, s1, s2, derivatives, (scalars, p[c, q], 0.0), D)
            if rows[c] >= 0:
                add_stress(stress[rows[c], q], S)
                add_moduli(moduli[rows[c], q], D)
            push_forward(f, D, S, FD, A[c, q])
            for i in range(6):
                for j in range(3 * (i // 3 + 1), 9):
                    A[c, q, j, i] = A[c, q, i, j]
            for i in range(3):
                for j in range(3):
                    cofactor[c, q, 3 * i + j] = Cof[i, j]
                    total = 0.0
                    for k in range(3):
                        total += f[i, k] * S[index[k][j]]
                    P[c, q, 3 * i + j] = total
    return P, A, cofactor
