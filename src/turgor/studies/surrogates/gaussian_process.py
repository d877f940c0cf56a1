"""Gaussian process: mean, standard deviation and slope from plain numbers, by NumPy alone."""

from dataclasses import dataclass
from math import sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GaussianProcess:
    """Gaussian processes of several outputs over the same inputs, each with its own kernel.

    The kernel is a²·c(r), with r² = Σ (uᵢ − vᵢ)²/ℓᵢ² and c = exp(−r²/2), or that of Matérn with ν = 5/2,
    c = (1 + √5 r + 5 r²/3) exp(−√5 r) (Rasmussen and Williams 2006, Gaussian Processes for Machine Learning, sec. 4.2).

    Parameters
    ----------
    inputs : (n, k) array
        Training inputs as shares of their ranges.
    amplitude : (m,) array
        a of each output, in units of its scale.
    lengths : (m, k) array
        ℓ of each output.
    smooth : (m,) array of bool
        Whether the kernel is the Gaussian one, of functions with all derivatives.
    scatter : (m,) array
        Standard deviation of what is not smooth, such as the scatter of meshes, in units of the scale.
    weights : (m, n) array
        (K + noise)⁻¹ y.
    root : (m, n, n) array
        L⁻¹, where L Lᵀ = K + noise.
    center, scale : (m,) array [SI]
        Outputs are center + scale times what the kernels give.
    """

    inputs: Array
    amplitude: Array
    lengths: Array
    smooth: NDArray[np.bool_]
    scatter: Array
    weights: Array
    root: Array
    center: Array
    scale: Array

    def mean(self, at: Array) -> Array:
        """Return the mean at shares of the ranges: (q, k) to (q, m) [SI]."""
        return np.asarray(self._mean(self._kernels(at)))

    def spread(self, at: Array) -> tuple[Array, Array]:
        """Return mean and standard deviation of what a run would give, (q, m) each [SI]."""
        kernels = self._kernels(at)
        explained = np.einsum("mnq,mnq->qm", *2 * (self.root @ kernels.transpose(0, 2, 1),))
        variance = np.maximum(self.amplitude**2 - explained, 0.0) + self.scatter**2
        return np.asarray(self._mean(kernels)), np.asarray(self.scale * np.sqrt(variance))

    def slope(self, at: Array) -> Array:
        """Return the derivatives of the mean at one point, (m, k) [SI per share]."""
        off = at - self.inputs
        scaled = off[None] / self.lengths[:, None, :]
        r = np.sqrt((scaled**2).sum(axis=2))
        # dk/du = -g(r) (u - v)/l²
        shape = np.where(self.smooth[:, None], np.exp(-(r**2) / 2), 5 / 3 * (1 + sqrt(5) * r) * np.exp(-sqrt(5) * r))
        weighted = self.weights * self.amplitude[:, None] ** 2 * shape
        slopes = -np.einsum("mn,mnk->mk", weighted, scaled) / self.lengths
        return np.asarray(self.scale[:, None] * slopes)

    def covariance(self, at: Array) -> Array:
        """Return the covariance of the mean among points, (m, q, q) [SI²]; scatter is not in it."""
        explained = self.root @ self._kernels(at).transpose(0, 2, 1)
        prior = kernel(at, at, self.amplitude, self.lengths, self.smooth)
        return np.asarray((prior - explained.transpose(0, 2, 1) @ explained) * self.scale[:, None, None] ** 2)

    def _kernels(self, at: Array) -> Array:
        return kernel(at, self.inputs, self.amplitude, self.lengths, self.smooth)

    def _mean(self, kernels: Array) -> Array:
        return np.asarray(self.center + self.scale * (kernels @ self.weights[:, :, None])[:, :, 0].T)


def kernel(first: Array, second: Array, amplitude: Array, lengths: Array, smooth: NDArray[np.bool_]) -> Array:
    """Return the kernels of all outputs between points, (m, q, n).

    Parameters
    ----------
    first : (q, k) array
    second : (n, k) array
    amplitude : (m,) array
    lengths : (m, k) array
    smooth : (m,) array of bool

    Returns
    -------
    (m, q, n) array
    """
    one = first[None] / lengths[:, None, :]
    two = second[None] / lengths[:, None, :]
    square = (one**2).sum(axis=2)[:, :, None] + (two**2).sum(axis=2)[:, None, :] - 2 * one @ two.transpose(0, 2, 1)
    square = np.maximum(square, 0.0)
    shape = np.empty_like(square)
    shape[smooth] = np.exp(-square[smooth] / 2)
    r = sqrt(5) * np.sqrt(square[~smooth])
    shape[~smooth] = (1 + r + r**2 / 3) * np.exp(-r)
    return np.asarray(amplitude[:, None, None] ** 2 * shape)


def conditioned(
    inputs: Array,
    targets: Array,
    noise: Array,
    *,
    amplitude: Array,
    lengths: Array,
    smooth: NDArray[np.bool_],
    scatter: Array,
) -> GaussianProcess:
    """Make the process of kernels that are known, conditioned on the training points.

    Parameters
    ----------
    inputs : (n, k) array
        As shares of their ranges.
    targets, noise : (n, m) array [SI]
        Values, and the standard deviation of each.
    amplitude, lengths, smooth, scatter
        Of the kernels, as of `GaussianProcess`.

    Returns
    -------
    GaussianProcess
    """
    center, scale = scaling(targets)
    scaled = ((targets - center) / scale).T
    variance = ((noise / scale).T) ** 2 + scatter[:, None] ** 2
    whole = kernel(inputs, inputs, amplitude, lengths, smooth)
    # the smallest addition with which it is positive definite in double precision
    floor = 1e-11 * amplitude[:, None] ** 2
    every = np.arange(len(inputs))
    whole[:, every, every] += variance + floor
    root = np.linalg.inv(np.linalg.cholesky(whole))
    root = np.tril(root)
    weights = (root.transpose(0, 2, 1) @ (root @ scaled[:, :, None]))[:, :, 0]
    return GaussianProcess(
        inputs=inputs, amplitude=amplitude, lengths=lengths, smooth=smooth, scatter=scatter, weights=weights, root=root,
        center=center, scale=scale,
    )  # fmt: skip


def scaling(targets: Array) -> tuple[Array, Array]:
    """Return mean and standard deviation of outputs, (m,) each; 1 where one does not vary."""
    scale = targets.std(axis=0)
    return targets.mean(axis=0), np.where(scale > 0, scale, 1.0)
