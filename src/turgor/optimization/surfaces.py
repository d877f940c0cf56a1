"""Surfaces: radial basis functions through what was computed, with which a search predicts before it computes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Surfaces:
    """Cubic radial basis functions with a linear part, one surface for each reading: s(u) = Σ wᵢ |u − uᵢ|³ + c·(1, u).

    They go through all points. Through n + 1 points in n dimensions they are linear, and each further point bends them.

    Parameters
    ----------
    points : (k, n) array
    weights : (k, m) array
    linear : (n + 1, m) array
    """

    points: Array
    weights: Array
    linear: Array

    def __call__(self, at: Array) -> Array:
        """Return the values at a point, (m,), or at several, (p, m)."""
        places = np.atleast_2d(at)
        apart = np.linalg.norm(places[:, None, :] - self.points[None, :, :], axis=2)
        found = apart**3 @ self.weights + self.linear[0] + places @ self.linear[1:]
        return found if np.ndim(at) == 2 else found[0]

    def gradient(self, at: Array) -> Array:
        """Return the derivatives at a point, (m, n)."""
        away = at - self.points
        apart = np.linalg.norm(away, axis=1)
        return (self.weights.T * (3 * apart)) @ away + self.linear[1:].T


def surfaces_through(points: Array, values: Array) -> Surfaces:
    """Return surfaces through points.

    Parameters
    ----------
    points : (k, n) array
    values : (k, m) array

    Returns
    -------
    Surfaces
        The least bent ones where there are fewer than n + 1 points.

    Examples
    --------
    >>> surface = surfaces_through(np.array([[0.0], [0.5], [1.0]]), np.array([[1.0], [2.0], [3.0]]))
    >>> surface(np.array([0.25])).round(12), surface.gradient(np.array([0.25])).round(12)
    (array([1.5]), array([[2.]]))
    """
    count, size = points.shape
    apart = np.linalg.norm(points[:, None, :] - points[None, :, :], axis=2) ** 3
    tail = np.column_stack([np.ones(count), points])
    matrix = np.block([[apart, tail], [tail.T, np.zeros((size + 1, size + 1))]])
    level = values.mean(axis=0)
    right = np.vstack([values - level, np.zeros((size + 1, values.shape[1]))])
    found = np.linalg.lstsq(matrix, right, rcond=1e-13)[0]
    linear = found[count:].copy()
    linear[0] += level
    return Surfaces(points, found[:count], linear)
