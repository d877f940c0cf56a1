"""Linear least squares with linear inequality constraints, which keep a fitted law stable."""

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]


def solve_constrained(A: Array, b: Array, G: Array, h: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Minimize ‖A x − b‖ subject to G x ≥ h.

    The problem is transformed into a least distance problem, and this into nonnegative least squares: C. L. Lawson and
    R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23.

    Parameters
    ----------
    A : (m, n) array
        Matrix of full column rank.
    b : (m,) array
        Right-hand side.
    G : (k, n) array
        Constraints, one per row.
    h : (k,) array
        Lower limits of the constraints.

    Returns
    -------
    x : (n,) array
        The solution.
    active : (k,) array of bool
        Which constraints are active.

    Examples
    --------
    >>> A, b = np.eye(2), np.array([1.0, -2.0])
    >>> x, active = solve_constrained(A, b, np.eye(2), np.zeros(2))
    >>> [round(float(value), 9) + 0 for value in x], active.tolist()
    ([1.0, 0.0], [False, True])
    """
    scale = np.linalg.norm(A, axis=0)
    scale[scale == 0] = 1.0
    A, G = A / scale, G / scale
    size = np.linalg.norm(G, axis=1)
    size[size == 0] = 1.0
    G, h = G / size[:, None], h / size
    x = np.linalg.lstsq(A, b, rcond=None)[0]
    limit = -ROUND_OFF.same * (np.abs(x).max(initial=0.0) + np.abs(h))
    if not (G @ x - h < limit).any():
        return x / scale, np.zeros(len(h), dtype=bool)
    Q, R = np.linalg.qr(A)
    back = np.linalg.pinv(R, rcond=1e-12)
    away = Q.T @ b
    E = np.vstack([(G @ back).T, (h - G @ back @ away)[None, :]])
    reach = np.linalg.norm(E, axis=0)
    reach[reach == 0] = 1.0
    target = np.zeros(len(E))
    target[-1] = 1.0
    weights, _ = nnls(E / reach, target, maxiter=50 * E.shape[1])
    rest = (E / reach) @ weights - target
    z = -rest[:-1] / rest[-1]
    return (back @ (z + away)) / scale, weights > 0
