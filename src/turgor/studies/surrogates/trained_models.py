"""Trained models: what a surrogate asks of them, and of what trains them."""

from typing import Protocol, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Model(Protocol):
    """A trained model of several outputs; inputs are shares of their ranges, outputs in SI units."""

    def mean(self, at: Array) -> Array:
        """Return the outputs at points: (q, k) to (q, m)."""
        ...

    def spread(self, at: Array) -> tuple[Array, Array]:
        """Return outputs and their standard deviations, (q, m) each."""
        ...

    def slope(self, at: Array) -> Array:
        """Return the derivatives at one point, (m, k)."""
        ...

    def covariance(self, at: Array) -> Array:
        """Return the covariance among points, (m, q, q)."""
        ...


Fitted = TypeVar("Fitted", bound=Model)


class Trainer(Protocol[Fitted]):
    """What trains a model."""

    @property
    def parts(self) -> int:
        """Most parts of the rows that are held out one after the other."""
        ...

    def fit(self, inputs: Array, targets: Array, noise: Array) -> Fitted:
        """Fit to inputs, (n, k) as shares, and targets and noise, (n, m) [SI]."""
        ...

    def from_there(self, fitted: Fitted) -> Self:
        """Return the trainer that starts from a fit, for parts of the same points."""
        ...
