"""Surfaces: radial basis functions through computed points, by which a search predicts readings."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.studies.optimization.settings import TRUST_REGION

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Surfaces:
    """Cubic radial basis functions with a polynomial part, one surface for each reading.

    They are ``s(u) = Σ wᵢ |u − uᵢ|³ + p(u)`` and go through all points. Through n + 1 points in n
    dimensions they are linear. With more points the polynomial has squares as well, and with more yet products, so that
    they are exact for a quadratic function.

    Parameters
    ----------
    points : (k, n) array
    weights : (k, m) array
    polynomial : (t, m) array
        Coefficients of 1, the coordinates, their squares, and their products in pairs.
    """

    points: Array
    weights: Array
    polynomial: Array

    def __call__(self, at: Array) -> Array:
        """Return the values at a point, (m,), or at several, (p, m)."""
        places = np.atleast_2d(at)
        apart = np.linalg.norm(places[:, None, :] - self.points[None, :, :], axis=2)
        terms = _terms(places)[:, : len(self.polynomial)]
        values = apart**3 @ self.weights + terms @ self.polynomial
        return values if np.ndim(at) == 2 else values[0]

    def gradient(self, at: Array) -> Array:
        """Return the derivatives at a point, (m, n)."""
        away = at - self.points
        apart = np.linalg.norm(away, axis=1)
        terms = _slopes_of_terms(at)[: len(self.polynomial)]
        return (self.weights.T * (3 * apart)) @ away + self.polynomial.T @ terms


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
    every = _terms(points)
    sizes = (1 + size, 1 + 2 * size, every.shape[1])
    used = max(each for each in sizes if each == sizes[0] or count >= each + TRUST_REGION.spare)
    tail = every[:, :used]
    matrix = np.block([[apart, tail], [tail.T, np.zeros((used, used))]])
    level = values.mean(axis=0)
    right = np.vstack([values - level, np.zeros((used, values.shape[1]))])
    solved = np.linalg.lstsq(matrix, right, rcond=1e-13)[0]
    polynomial = solved[count:].copy()
    polynomial[0] += level
    return Surfaces(points, solved[:count], polynomial)


def _terms(places: Array) -> Array:
    """Return 1, the coordinates, their squares and their products, (p, t)."""
    first, second = np.triu_indices(places.shape[1], 1)
    products = places[:, first] * places[:, second]
    return np.column_stack([np.ones(len(places)), places, places**2, products])


def _slopes_of_terms(at: Array) -> Array:
    """Return the derivatives of `_terms` at a point, (t, n)."""
    size = len(at)
    first, second = np.triu_indices(size, 1)
    unit = np.eye(size)
    products = unit[first] * at[second][:, None] + unit[second] * at[first][:, None]
    return np.vstack([np.zeros((1, size)), unit, 2 * np.diag(at), products])
