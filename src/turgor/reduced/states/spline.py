"""Spline: training states as a smooth function of the inputs, from which Newton's method starts."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.store.codec import FOUR_DIGITS
from turgor.reduced.settings import START

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Spline:
    """Polyharmonic spline through values and slopes at some places.

    In scaled inputs x it is

        Σⱼ (wⱼ + vⱼ · ∂/∂xⱼ) |x − xⱼ|³ + a + B x

    With one input it is the cubic Hermite spline. Its starts are some times nearer to the answers than without slopes
    (an arm with nine inputs and 177 states: 2.2 % of the largest size in the median, not 12 %).

    Parameters
    ----------
    scales : (n,) array
        Factors of the inputs; those with a factor of zero do not count.
    centers : (k, m) array
        Scaled inputs of the places.
    weights : (k (1 + m), v) array
        w and v of each place.
    linear : (1 + m, v) array
        a and B.
    """

    scales: Array
    centers: Array
    weights: Array = field(metadata=FOUR_DIGITS)
    linear: Array

    @staticmethod
    def through(scales: Array, inputs: Array, values: Array, slopes: Array) -> "Spline":
        """Interpolate values (k, v) and their derivatives (k, v, n) by the inputs (k, n).

        Of places that are the same the last counts.
        """
        every = inputs * scales
        _, last = np.unique(every[::-1].round(9), axis=0, return_index=True)
        which, counts = len(every) - 1 - last, scales > 0
        x, y = every[which][:, counts], values[which]
        rates = slopes[which][:, :, counts].transpose(0, 2, 1) / scales[counts, None]
        k, m = x.shape
        size, rows = k * (1 + m), np.concatenate([y[:, None], rates], axis=1).reshape(k * (1 + m), -1)
        matrix = np.zeros((size + 1 + m, size + 1 + m))
        matrix[:size, :size] = _kernel(x).reshape(size, size) + START.smoothing * np.eye(size)
        one = np.zeros((k, 1 + m, 1 + m))
        one[:, 0, 0], one[:, 0, 1:], one[:, 1:, 1:] = 1.0, x, np.eye(m)
        matrix[:size, size:] = one.reshape(size, -1)
        matrix[size:, :size] = matrix[:size, size:].T
        right = np.vstack([rows, np.zeros((1 + m, y.shape[1]))])
        solved = np.linalg.solve(matrix, right)
        return Spline(scales, x, solved[:size], solved[size:])

    def at(self, inputs: Array) -> Array:
        """Value (v,) at inputs (n,)."""
        x = (inputs * self.scales)[self.scales > 0]
        away = self.centers - x
        distance = np.sqrt((away**2).sum(axis=1))
        features = np.column_stack([distance**3, 3.0 * distance[:, None] * away])
        return np.asarray(features.ravel() @ self.weights + self.linear[0] + x @ self.linear[1:])


def _kernel(x: Array) -> Array:
    """|x − x'|³ of places (k, m), its derivatives by x in rows, by x' in columns: (k, 1 + m, k, 1 + m)."""
    k, m = x.shape
    away = x[:, None] - x[None]
    distance = np.sqrt((away**2).sum(axis=2))
    way = away / np.sqrt(np.maximum(distance, 1e-300))[:, :, None]  # so that products are those over the distance
    out = np.empty((k, 1 + m, k, 1 + m))
    out[:, 0, :, 0] = distance**3
    out[:, 1:, :, 0] = np.einsum("abi,ab->aib", away, 3.0 * distance)
    out[:, 0, :, 1:] = -3.0 * distance[:, :, None] * away
    out[:, 1:, :, 1:] = -3.0 * np.einsum("abi,abj->aibj", way, way)
    out[:, 1:, :, 1:] -= 3.0 * np.einsum("ij,ab->aibj", np.eye(m), distance)
    return out
