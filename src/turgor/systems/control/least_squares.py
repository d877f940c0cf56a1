"""Linear least squares in a few unknowns under linear limits.

The problem min ‖A x − b‖² with C x ≤ d becomes the least distance problem min ‖z‖² by the factors of A, and this one a
problem of least squares with unknowns that are not negative (Lawson and Hanson, Solving Least Squares Problems, 1974,
chapter 23).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

from turgor.systems.control.settings import CONTROL

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Limited:
    """A solution under limits.

    Parameters
    ----------
    x : (n,) array
    active : (m,) bool array
        Which limits the solution leans on.
    """

    x: Array
    active: NDArray[np.bool_]


def least_squares(A: Array, b: Array, C: Array, d: Array) -> Limited | None:
    """Minimize ‖A x − b‖² under C x ≤ d.

    Parameters
    ----------
    A : (k, n) array
        Of full rank.
    b : (k,) array
    C : (m, n) array
    d : (m,) array

    Returns
    -------
    Limited or None
        None where no x fulfills the limits.

    Examples
    --------
    >>> least_squares(np.eye(2), np.array([3.0, 1.0]), np.array([[1.0, 0.0]]), np.array([2.0]))
    Limited(x=array([2., 1.]), active=array([ True]))
    """
    Q, R = np.linalg.qr(A)
    free = np.linalg.solve(R, Q.T @ b)
    if (C @ free <= d).all():
        return Limited(free, np.zeros(len(d), dtype=bool))
    G = -np.linalg.solve(R.T, C.T).T
    h = C @ free - d
    size = max(1.0, float(np.abs(h).max()))
    matrix = np.vstack([G.T, h / size])
    aim = np.zeros(len(matrix))
    aim[-1] = 1.0
    factors, _ = nnls(matrix, aim)
    rest = matrix @ factors - aim
    if np.linalg.norm(rest) <= CONTROL.infeasible:
        return None
    z = -rest[:-1] / rest[-1] * size
    return Limited(free + np.linalg.solve(R, z), factors > 0)
