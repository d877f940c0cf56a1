"""Network: an ensemble of small neural networks from plain numbers, by NumPy alone."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Network:
    """An ensemble of networks with layers of tanh and a linear output; their spread is the uncertainty.

    Parameters
    ----------
    weights : tuple of (e, in, out) array
        Of each layer, for all e members.
    biases : tuple of (e, 1, out) array
    scatter : (m,) array
        Standard deviation of what no member explains, in units of the scale.
    center, scale : (m,) array [SI]
        Outputs are center + scale times what the members give.
    """

    weights: tuple[Array, ...]
    biases: tuple[Array, ...]
    scatter: Array
    center: Array
    scale: Array

    def mean(self, at: Array) -> Array:
        """Return the mean of the members at shares of the ranges: (q, k) to (q, m) [SI]."""
        return np.asarray(self.center + self.scale * self._members(at).mean(axis=0))

    def spread(self, at: Array) -> tuple[Array, Array]:
        """Return mean and standard deviation, (q, m) each [SI]."""
        members = self._members(at)
        deviation = np.sqrt(members.var(axis=0, ddof=1) + self.scatter**2)
        return np.asarray(self.center + self.scale * members.mean(axis=0)), np.asarray(self.scale * deviation)

    def slope(self, at: Array) -> Array:
        """Return the derivatives of the mean at one point, (m, k) [SI per share]."""
        values, slopes = _centered(at[None])[None], None
        for number, (weight, bias) in enumerate(zip(self.weights, self.biases, strict=True)):
            values = values @ weight + bias
            slopes = 2.0 * weight if slopes is None else slopes @ weight
            if number < len(self.weights) - 1:
                values = np.tanh(values)
                slopes = slopes * (1 - values**2)
        assert slopes is not None
        return np.asarray(self.scale[:, None] * slopes.mean(axis=0).T)

    def covariance(self, at: Array) -> Array:
        """Return the covariance of the members among points, (m, q, q) [SI²]; scatter is not in it."""
        members = self._members(at)
        off = (members - members.mean(axis=0)).transpose(2, 0, 1)
        return np.asarray(off.transpose(0, 2, 1) @ off / (len(members) - 1) * self.scale[:, None, None] ** 2)

    def _members(self, at: Array) -> Array:
        """Outputs of every member, (e, q, m)."""
        values = _centered(at)[None]
        for number, (weight, bias) in enumerate(zip(self.weights, self.biases, strict=True)):
            values = values @ weight + bias
            if number < len(self.weights) - 1:
                values = np.tanh(values)
        return np.asarray(values)


def _centered(at: Array) -> Array:
    """Inputs from -1 to 1."""
    return np.asarray(2.0 * at - 1.0)
