"""Polynomial: a number of an actuator by its inputs, with the error at points that it was not fitted to."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.display import Shown
from turgor.systems.robots.backbone import Array

#: Degrees that are tried, and the rows that each coefficient needs at least.
DEGREES, ROWS = range(10), 1.5

#: A higher degree is taken where it divides the error by this at least.
WORTH = 0.8


@dataclass(frozen=True, slots=True, eq=False)
class Polynomial(Shown):
    """A sum of products of powers of scaled inputs t = 2 (s − low) / (high − low) − 1.

    Parameters
    ----------
    exponents : (k, n) int array
    coefficients : (k,) array [SI]
    low, high : (n,) arrays [SI]
        Range of the inputs.
    error : float [SI]
        Largest error at the points that it was not fitted to.

    Examples
    --------
    >>> line = Polynomial(np.array([[0], [1]]), np.array([2.0, 3.0]), np.zeros(1), np.full(1, 10.0), error=0.0)
    >>> print(line.at([[0.0], [5.0], [10.0]]))
    [-1.  2.  5.]
    """

    exponents: NDArray[np.int64]
    coefficients: Array
    low: Array
    high: Array
    error: float

    def __repr__(self) -> str:
        return f"Polynomial(degree {self.degree}, {len(self.coefficients)} terms, largest error {self.error:.3g})"

    @property
    def degree(self) -> int:
        """Largest sum of exponents."""
        return int(self.exponents.sum(axis=1).max())

    def at(self, inputs: Sequence[float] | Array) -> Array:
        """Values (k,) at inputs (k, n) [SI]."""
        scaled = 2 * (np.atleast_2d(inputs) - self.low) / (self.high - self.low) - 1
        return _products(scaled, self.exponents) @ self.coefficients


def fitted(fit: tuple[Array, Array], test: tuple[Array, Array], box: tuple[Array, Array]) -> Polynomial:
    """Fit polynomials of rising degree by least squares, and take the one with the smallest error at other points.

    Parameters
    ----------
    fit, test : ((k, n), (k,)) arrays [SI]
        Inputs and values to fit, and others.
    box : (low, high)
        Range of the inputs.

    Returns
    -------
    Polynomial
    """
    low, high = box
    best: Polynomial | None = None
    for degree in DEGREES:
        exponents = _exponents(len(low), degree)
        if best is not None and len(exponents) * ROWS > len(fit[1]):
            break
        matrix = _products(2 * (fit[0] - low) / (high - low) - 1, exponents)
        coefficients = np.asarray(np.linalg.lstsq(matrix, fit[1], rcond=None)[0], dtype=np.float64)
        made = Polynomial(exponents, coefficients, low, high, 0.0)
        made = Polynomial(exponents, coefficients, low, high, float(np.abs(made.at(test[0]) - test[1]).max()))
        if best is None or made.error < WORTH * best.error:
            best = made
    assert best is not None
    return best


def _exponents(count: int, degree: int) -> NDArray[np.int64]:
    """All exponents (k, count) whose sum is at most the degree."""
    rows = [
        np.bincount(np.array(chosen, dtype=np.int64), minlength=count)
        for total in range(degree + 1)
        for chosen in combinations_with_replacement(range(count), total)
    ]
    return np.array(rows, dtype=np.int64).reshape(-1, count)


def _products(scaled: Array, exponents: NDArray[np.int64]) -> Array:
    return np.prod(scaled[:, None, :] ** exponents, axis=2)
