"""Training of networks: an ensemble from resampled points (scikit-learn)."""

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.studies.runs.optional_parts import needed
from turgor.studies.surrogates.gaussian_process import scaling
from turgor.studies.surrogates.network import Network

Array = NDArray[np.float64]

#: Units of the two hidden layers, and the penalty on squared weights.
HIDDEN, PENALTY = (32, 32), 1e-4


@dataclass(frozen=True, slots=True, kw_only=True)
class NetworkTrainer:
    """Fits an ensemble of networks, each to points drawn with replacement (bagging).

    Parameters
    ----------
    members : int
        Networks of the ensemble.
    iterations : int
        Most iterations of the search for weights (L-BFGS).
    parts : int
        Most parts of the rows that are held out one after the other: fewer than of a Gaussian process, because each
        takes training from the beginning.
    """

    members: int = 5
    iterations: int = 400
    parts: int = 5

    def fit(self, inputs: Array, targets: Array, noise: Array) -> Network:
        """Fit to inputs, (n, k) as shares, and targets and noise, (n, m) [SI]."""
        center, scale = scaling(targets)
        scaled = (targets - center) / scale
        members, left, seen = [], np.zeros_like(scaled), np.zeros(len(inputs))
        for number in range(self.members):
            drawn = np.random.default_rng(number).integers(0, len(inputs), len(inputs))
            member = self._member(2.0 * inputs[drawn] - 1.0, scaled[drawn], number)
            out = np.setdiff1d(np.arange(len(inputs)), drawn)
            left[out] += (_given(member, 2.0 * inputs[out] - 1.0) - scaled[out]) ** 2
            seen[out] += 1
            members.append(member)
        # points that a member has not drawn say what it does not explain; known mesh errors are told apart
        known = seen > 0
        variance = (left[known] / seen[known, None]).mean(axis=0) - ((noise / scale)[known] ** 2).mean(axis=0)
        layers = range(len(HIDDEN) + 1)
        return Network(
            weights=tuple(np.stack([each[0][n] for each in members]) for n in layers),
            biases=tuple(np.stack([each[1][n] for each in members])[:, None, :] for n in layers),
            scatter=np.sqrt(np.maximum(variance, 1e-8)),
            center=center,
            scale=scale,
        )

    def from_there(self, fitted: Network) -> "NetworkTrainer":
        """Return the same trainer: networks are trained anew."""
        return self

    def _member(self, inputs: Array, targets: Array, seed: int) -> tuple[list[Array], list[Array]]:
        networks: Any = needed("sklearn.neural_network", "training a surrogate")
        regressor = networks.MLPRegressor(
            hidden_layer_sizes=HIDDEN,
            activation="tanh",
            solver="lbfgs",
            alpha=PENALTY,
            max_iter=self.iterations,
            random_state=seed,
            tol=1e-7,
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # the search may end at its most iterations; held-out rows judge it
            regressor.fit(inputs, targets if targets.shape[1] > 1 else targets[:, 0])
        return regressor.coefs_, regressor.intercepts_


def _given(member: tuple[list[Array], list[Array]], inputs: Array) -> Array:
    values = inputs
    for number, (weight, bias) in enumerate(zip(*member, strict=True)):
        values = values @ weight + bias
        if number < len(member[0]) - 1:
            values = np.tanh(values)
    return values
