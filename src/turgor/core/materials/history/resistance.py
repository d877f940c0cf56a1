"""Resistance: what a network opposes to flow in one step, as a power of its Mises stress."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Resistance:
    """Equivalent log strain p by which points flow in a step: p = ((q − onset)/stress)^exponent − hardened.

    Parameters
    ----------
    stress : (...) array [Pa]
        Infinite where a point cannot flow.
    exponent : float
        1 or more.
    onset : float [Pa]
    hardened : (...) array
        Equivalent strain of steps before that counts.

    Examples
    --------
    >>> Resistance(np.full(2, 10.0), 2.0, 0.0, np.array([0.0, 0.25])).amount(np.array([5.0, 4.0]))[0]
    array([0.25, 0.  ])
    """

    stress: Array
    exponent: float
    onset: float
    hardened: Array

    def amount(self, q: Array) -> tuple[Array, Array]:
        """Equivalent strain p at Mises stresses q [Pa], and its slope ∂p/∂q; both 0 where nothing flows."""
        above = np.maximum(q - self.onset, 0.0) / self.stress
        with np.errstate(over="ignore", invalid="ignore"):
            p = above**self.exponent - self.hardened
            slope = np.where(p > 0, self.exponent * above ** (self.exponent - 1) / self.stress, 0.0)
        return np.where(np.isnan(q), np.nan, np.maximum(p, 0.0)), slope

    def bound(self, strain: Array) -> Array:
        """Mises stress [Pa] at which points flow by a strain in the step."""
        return np.asarray(self.onset + self.stress * (self.hardened + strain) ** (1.0 / self.exponent))

    def slope(self, strain: Array) -> Array:
        """Slope of `bound` by the strain [Pa]."""
        return np.asarray(self.stress / self.exponent * (self.hardened + strain) ** (1.0 / self.exponent - 1.0))

    def at(self, points: NDArray[np.bool_] | NDArray[np.int64]) -> "Resistance":
        """That of chosen points."""
        return Resistance(self.stress[points], self.exponent, self.onset, self.hardened[points])
