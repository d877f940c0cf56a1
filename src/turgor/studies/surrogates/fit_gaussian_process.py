"""Training of Gaussian processes: the kernel of each output by its marginal likelihood (scikit-learn)."""

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.studies.runs.optional_parts import needed
from turgor.studies.surrogates.gaussian_process import GaussianProcess, conditioned, scaling
from turgor.studies.surrogates.settings import SURROGATE

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GaussianProcessTrainer:
    """Fits Gaussian processes; with kernels of a fit before, only their numbers are adapted.

    Parameters
    ----------
    before : GaussianProcess or None
        Fit to more points, from which the search starts.
    parts : int
        Most parts of the rows that are held out one after the other.
    """

    before: GaussianProcess | None = None
    parts: int = 10

    def fit(self, inputs: Array, targets: Array, noise: Array) -> GaussianProcess:
        """Fit to inputs, (n, k) as shares, and targets and noise, (n, m) [SI]."""
        center, scale = scaling(targets)
        scaled, deviation = (targets - center) / scale, noise / scale
        some = np.arange(len(inputs))
        if len(inputs) > SURROGATE.kernel_points:
            some = np.random.default_rng(0).choice(some, SURROGATE.kernel_points, replace=False)
        kernels = [
            _best(self._candidates(n, inputs[some], scaled[some, n], deviation[some, n]))
            for n in range(targets.shape[1])
        ]
        return conditioned(
            inputs,
            targets,
            noise,
            amplitude=np.array([each.amplitude for each in kernels]),
            lengths=np.array([each.lengths for each in kernels]),
            smooth=np.array([each.smooth for each in kernels]),
            scatter=np.array([each.scatter for each in kernels]),
        )

    def from_there(self, fitted: GaussianProcess) -> "GaussianProcessTrainer":
        """Return the trainer that starts from a fit."""
        return GaussianProcessTrainer(before=fitted)

    def _candidates(self, n: int, inputs: Array, targets: Array, noise: Array) -> "list[_Kernel]":
        if self.before is not None:
            before = self.before
            start = _Kernel(
                smooth=bool(before.smooth[n]), amplitude=float(before.amplitude[n]), lengths=before.lengths[n],
                scatter=float(before.scatter[n]), likelihood=0.0,
            )  # fmt: skip
            return [_searched(start, inputs, targets, noise, starts=1)]
        starts = [
            _Kernel(smooth=smooth, amplitude=1.0, lengths=np.ones(inputs.shape[1]), scatter=1e-2, likelihood=0.0)
            for smooth in (False, True)
        ]
        return [_searched(start, inputs, targets, noise, starts=SURROGATE.kernel_starts) for start in starts]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Kernel:
    smooth: bool
    amplitude: float
    lengths: Array
    scatter: float
    likelihood: float


def _best(kernels: list[_Kernel]) -> _Kernel:
    return max(kernels, key=lambda each: each.likelihood)


def _searched(start: _Kernel, inputs: Array, targets: Array, noise: Array, *, starts: int) -> _Kernel:
    process: Any = needed("sklearn.gaussian_process", "training a surrogate")
    kernels: Any = needed("sklearn.gaussian_process.kernels", "training a surrogate")
    lengths = np.clip(start.lengths, *SURROGATE.lengths)
    shape = (
        kernels.RBF(lengths, SURROGATE.lengths) if start.smooth else kernels.Matern(lengths, SURROGATE.lengths, nu=2.5)
    )
    low, high = SURROGATE.amplitude
    scattered = kernels.ConstantKernel(np.clip(start.amplitude, low, high) ** 2, (low**2, high**2)) * shape
    scattered += kernels.WhiteKernel(np.clip(start.scatter**2, *SURROGATE.scatter), SURROGATE.scatter)
    regressor = process.GaussianProcessRegressor(
        scattered, alpha=noise**2 + 1e-10, n_restarts_optimizer=starts - 1, random_state=0
    )
    with warnings.catch_warnings():
        # a length at its bound means an input without influence, which is no problem
        warnings.simplefilter("ignore")
        regressor.fit(inputs, targets)
    kernel = regressor.kernel_
    return _Kernel(
        smooth=start.smooth,
        amplitude=float(np.sqrt(kernel.k1.k1.constant_value)),
        lengths=np.atleast_1d(np.asarray(kernel.k1.k2.length_scale, dtype=np.float64)),
        scatter=float(np.sqrt(kernel.k2.noise_level)),
        likelihood=float(regressor.log_marginal_likelihood_value_),
    )
