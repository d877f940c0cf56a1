"""Held-out error: each row of a study predicted by models that have not seen it, and intervals calibrated by that."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.response import Column
from turgor.studies.runs.settings import HALF_WIDTH, LEVEL
from turgor.studies.surrogates.fit_gaussian_process import GaussianProcessTrainer
from turgor.studies.surrogates.gaussian_process import GaussianProcess
from turgor.studies.surrogates.settings import SURROGATE

Array = NDArray[np.float64]
Whole = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HeldOut:
    """How a measure is predicted in rows that were held out.

    Parameters
    ----------
    name, unit : str
        Measure.
    computed, predicted : (n,) array [SI]
    deviation : (n,) array [SI]
        Calibrated standard deviation of computed − predicted, with that of the mesh.
    coverage : (float, float)
        Share of rows within the intervals of 68 and 95 %. Those of a part are calibrated by the other parts.
    factor : float
        By which the standard deviations of the model are multiplied.
    """

    name: str
    unit: str
    computed: Array
    predicted: Array
    deviation: Array
    coverage: tuple[float, float]
    factor: float

    @property
    def rms(self) -> float:
        """Root of the mean square of the error [SI]."""
        return float(np.sqrt(np.mean((self.computed - self.predicted) ** 2)))

    @property
    def worst(self) -> float:
        """Largest error [SI]."""
        return float(np.max(np.abs(self.computed - self.predicted)))

    @property
    def range(self) -> float:
        """Largest less smallest computed value [SI]."""
        return float(np.ptp(self.computed))

    @property
    def share(self) -> float:
        """Root mean square error over the range."""
        return self.rms / self.range if self.range else 0.0

    @property
    def r_squared(self) -> float:
        """Share of the variance that predictions explain, R²; below zero where the mean would predict better."""
        spread = float(np.sum((self.computed - self.computed.mean()) ** 2))
        return 1.0 - float(np.sum((self.computed - self.predicted) ** 2)) / spread if spread else 1.0

    @property
    def sentence(self) -> str:
        """Return error and coverage in a sentence."""
        rms, worst = (self._shown(value) for value in (self.rms, self.worst))
        near, wide = (f"{100 * each:.0f} %" for each in self.coverage)
        words = Column(self.name, self.unit, np.zeros(1)).words
        return (
            f"{words}: {rms} RMS in held-out rows ({100 * self.share:.2g} % of the range), {worst} at worst, "
            f"R² {self.r_squared:.4f}; its 68 and 95 % intervals hold {near} and {wide} of {len(self.computed)}."
        )

    def _shown(self, value: float) -> str:
        shown = Column(self.name, self.unit, np.array([value])).in_unit[0]
        return f"{shown:.3g} {self.unit}".rstrip()


def parts_of(row: Whole, most: int) -> Whole:
    """Divide points into parts, rows of a study as wholes; (n,) numbers of parts.

    Parameters
    ----------
    row : (n,) array
        Row of each point.
    most : int
        Most parts.

    Returns
    -------
    (n,) array

    Examples
    --------
    >>> parts = parts_of(np.array([0, 0, 1, 2, 3, 4]), most=10)
    >>> bool(parts[0] == parts[1]), len(set(parts.tolist()))
    (True, 5)
    """
    rows, where = np.unique(row, return_inverse=True)
    shuffled = np.random.default_rng(0).permutation(len(rows)) % min(most, len(rows))
    return np.asarray(shuffled[where])


def held_out(
    trainer: GaussianProcessTrainer,
    fitted: GaussianProcess,
    inputs: Array,
    outputs: Sequence[Column],
    noise: Array,
    row: Whole,
) -> tuple[HeldOut, ...]:
    """Predict each part of the rows from the others, and calibrate the standard deviations.

    Parameters
    ----------
    trainer : GaussianProcessTrainer
    fitted : GaussianProcess
        Fit to all rows, from which those to the parts start.
    inputs : (n, k) array
        As shares of their ranges.
    outputs : sequence of Column
        (n,) values each.
    noise : (n, m) array [SI]
    row : (n,) array
        Row of each point.

    Returns
    -------
    tuple of HeldOut
        One for each output.
    """
    targets = np.stack([each.values for each in outputs], axis=1)
    parts = parts_of(row, trainer.parts)
    again = trainer.from_there(fitted)
    predicted, deviation = np.empty_like(targets), np.empty_like(targets)
    for part in np.unique(parts):
        out = parts == part
        model = again.fit(inputs[~out], targets[~out], noise[~out])
        predicted[out], deviation[out] = model.spread(inputs[out])
    spread = np.maximum(np.hypot(deviation, noise), 1e-12 * np.ptp(targets, axis=0) + 1e-300)
    off = np.abs(targets - predicted) / spread
    return tuple(
        HeldOut(
            name=each.name, unit=each.unit, computed=targets[:, n], predicted=predicted[:, n],
            deviation=spread[:, n] * factor_of(off[:, n]), coverage=_coverage(off[:, n], parts),
            factor=factor_of(off[:, n]),
        )
        for n, each in enumerate(outputs)
    )  # fmt: skip


def factor_of(off: Array) -> float:
    """Return the factor of standard deviations that suits errors, given as multiples of them.

    It is the larger of what makes the mean square one, which is right for normal errors, and what makes 95 % of them
    lie in their interval, because errors of few rows have wider tails.

    Parameters
    ----------
    off : (n,) array

    Returns
    -------
    float
    """
    wide = float(np.quantile(off, LEVEL)) / HALF_WIDTH
    return float(np.clip(max(np.sqrt(np.mean(off**2)), wide), *SURROGATE.factors))


def _coverage(off: Array, parts: Whole) -> tuple[float, float]:
    """Shares of errors in the intervals, those of each part calibrated by the other parts."""
    scaled = np.empty_like(off)
    for part in np.unique(parts):
        out = parts == part
        scaled[out] = off[out] / factor_of(off[~out])
    near, wide = (float(np.mean(scaled <= half)) for half in (1.0, HALF_WIDTH))
    return near, wide
