"""Estimate: the error of an answer, from the errors that are known at full solves and from the sampling there."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from turgor.reduced.settings import ESTIMATE

Array = NDArray[np.float64]


def _nothing() -> Array:
    return np.zeros(0)


@dataclass(frozen=True, kw_only=True, eq=False)
class KnownErrors:
    """Full solves at which the error of a reduced model is known: training states and held-out ones.

    Between them the logarithm of the error over a yardstick is a Gaussian process of the inputs (kriging, Drohmann and
    Carlberg 2015, doi 10.1137/140969841); its standard deviation is added. The yardstick is a mean of the size of the
    answer and of the indicator of the sampling. The indicator has the inverse tangent of the answer in it, so that it
    is large where the body is soft, and there whatever the modes miss makes a large error, too.

    Parameters
    ----------
    places : (k, 1 + n) array
        Inputs as shares of their ranges, the share of the fixed loads first.
    errors : (k,) array [-]
        Largest error of the displacement of a node, over the largest displacement of all training states.
    sizes : (k,) array [-]
        Size of the answers, over the largest in training.
    indicators : (k,) array [-]
        How far they move with other sampled points; see `ReducedState`.

    Examples
    --------
    >>> known = KnownErrors(places=np.array([[0.0], [1.0]]), errors=np.array([1e-3, 1e-2]), sizes=np.ones(2),
    ...                     indicators=np.full(2, 1e-4))
    >>> bool(1e-3 < known.at(np.array([0.5]), 1.0, 1e-4) < 1e-2)
    True
    """

    places: Array = field(default_factory=lambda: np.zeros((0, 1)))
    errors: Array = field(default_factory=_nothing)
    sizes: Array = field(default_factory=_nothing)
    indicators: Array = field(default_factory=_nothing)

    def at(self, place: Array, size: float, indicator: float) -> float:
        """Estimate the error at a place (1 + n,) of an answer of a size; its indicator where nothing is known."""
        if not len(self.errors):
            return indicator
        mean, spread, inverse, weights = self._process
        near = self._likeness(place[None])[0]
        left = float(1.0 - near @ inverse @ near)
        value = mean + float(near @ weights) + ESTIMATE.deviations * spread * max(left, 0.0) ** 0.5
        return float(np.exp(value) * _yardstick(size, indicator))

    @cached_property
    def _process(self) -> tuple[float, float, Array, Array]:
        """Mean and deviation of the logarithms, and the inverse of their correlation, alone and times them."""
        logs = np.log(np.maximum(self.errors, ESTIMATE.smallest) / _yardstick(self.sizes, self.indicators))
        mean, spread = float(logs.mean()), max(float(logs.std()), ESTIMATE.spread)
        likeness = self._likeness(self.places) + ESTIMATE.noise**2 * np.eye(len(logs))
        inverse: Array = np.linalg.inv(likeness).astype(np.float64)
        return mean, spread, inverse, np.asarray(inverse @ (logs - mean))

    def _likeness(self, places: Array) -> Array:
        """Correlation (j, k) of places (j, 1 + n) with the known ones."""
        away = np.sqrt(((places[:, None] - self.places[None]) ** 2).sum(axis=2))
        return np.asarray(np.exp(-away / (ESTIMATE.length * max(self.places.shape[1] - 1, 1) ** 0.5)))


def _yardstick(size: "Array | float", indicator: "Array | float") -> "Array":
    """Geometric mean of a size over the largest, not zero at rest, and of an indicator."""
    lifted = (size + ESTIMATE.rest) / (1.0 + ESTIMATE.rest)
    return np.asarray(lifted ** (1 - ESTIMATE.sampling) * np.maximum(indicator, ESTIMATE.smallest) ** ESTIMATE.sampling)
