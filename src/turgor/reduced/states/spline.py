"""Spline: training states as a smooth function of the inputs, from which Newton's method starts."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Spline:
    """Polyharmonic spline Σ wⱼ |x − xⱼ|³ + a + B x; with one input it is the natural cubic spline.

    Parameters
    ----------
    centers : (k, n) array
    weights : (k, v) array
    linear : (1 + n, v) array
        a and B.
    """

    centers: Array
    weights: Array
    linear: Array

    @staticmethod
    def through(points: Array, values: Array) -> "Spline":
        """Interpolate values (k, v) at points (k, n); of points that are the same the last counts."""
        _, last = np.unique(points[::-1].round(9), axis=0, return_index=True)
        x, y = points[::-1][last], values[::-1][last]
        k, n = x.shape
        one = np.column_stack([np.ones(k), x])
        matrix = np.zeros((k + n + 1, k + n + 1))
        matrix[:k, :k] = np.linalg.norm(x[:, None] - x[None], axis=2) ** 3
        matrix[:k, k:], matrix[k:, :k] = one, one.T
        right = np.vstack([y, np.zeros((n + 1, y.shape[1]))])
        solved = np.linalg.lstsq(matrix, right, rcond=1e-13)[0]
        return Spline(x, solved[:k], solved[k:])

    def at(self, x: Array) -> Array:
        """Value (v,) at a point (n,)."""
        away = np.sqrt(((self.centers - x) ** 2).sum(axis=1)) ** 3
        return np.asarray(away @ self.weights + self.linear[0] + x @ self.linear[1:])
