"""Uncertainty of fitted parameters: standard errors, correlations, what tests leave open, spread between fits."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isfinite

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.fitting.result import Fit
from turgor.core.materials.library.fit_spread import SCATTER, FitSpread
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Uncertainty:
    """How well the points of a fit determine its parameters.

    Parameters
    ----------
    errors : (n,) array
        Standard errors, zero for a parameter that a constraint fixes, infinite for one that the points leave open.
    correlation : (n, n) array [-]
        Correlations; ±1 between parameters of which the points determine only a combination.
    covariance : (n, n) array
        Covariance in the directions that the points determine.
    open_directions : (n, k) array
        Changes of the parameters that change no stress, one per column.
    """

    errors: Array
    correlation: Array
    covariance: Array
    open_directions: Array

    def combination(self, names: Sequence[str], values: Sequence[float], moduli: int) -> str:
        """Describe the sum of two moduli that the points determine, where they leave both open.

        Parameters
        ----------
        names, values : sequence
            Names and values of all parameters.
        moduli : int
            How many of them are moduli; these come first.

        Returns
        -------
        str
            Such as ``"C10 + C01 = 14.5 ± 0.05 kPa"``; empty where there is no such pair.
        """
        parts = [k for k, error in enumerate(self.errors) if error == inf]
        if len(parts) != 2 or self.open_directions.shape[1] != 1 or max(parts) >= moduli:
            return ""
        i, j = parts
        along = self.open_directions[:, 0]
        weight = -along[i] / along[j]
        row = np.zeros(len(values))
        row[i], row[j] = 1.0, weight
        error = max(float(row @ self.covariance @ row), 0.0) ** 0.5
        factor = "" if abs(abs(weight) - 1) < ROUND_OFF.same else f"{abs(weight):.4g} "
        total = (values[i] + weight * values[j]) / 1e3
        return f"{names[i]} {'+' if weight > 0 else '-'} {factor}{names[j]} = {total:.5g} ± {error / 1e3:.2g} kPa"


def uncertainty_of(jacobian: Array, residual: Array, limits: Array) -> Uncertainty:
    """Derive the uncertainty of parameters from the Jacobian of a fit.

    Parameters
    ----------
    jacobian : (m, n) array
        Derivatives of the residual by the parameters.
    residual : (m,) array
        Weighted residual at every point.
    limits : (k, n) array
        Gradients of the active constraints, one per row.

    Examples
    --------
    Two equal columns leave the difference of their parameters open:

    >>> jacobian = np.column_stack([np.ones(3), np.ones(3), np.arange(3.0)])
    >>> three = uncertainty_of(jacobian, np.array([0.1, -0.2, 0.1]), np.empty((0, 3)))
    >>> three.errors.round(3), three.combination(["a", "b", "c"], [1e3, 2e3, 0.0], 3)
    (array([ inf,  inf, 0.173]), 'a + b = 3 ± 0.00022 kPa')
    """
    count = jacobian.shape[1]
    scale = np.linalg.norm(jacobian, axis=0)
    scale[scale == 0] = 1.0
    free = np.eye(count)
    if len(limits):
        rows = limits / scale
        _, size, directions = np.linalg.svd(rows / np.linalg.norm(rows, axis=1)[:, None])
        free = directions[int((size > ROUND_OFF.same).sum()) :].T
    if free.shape[1] == 0:
        none = np.zeros((count, 0))
        return Uncertainty(
            errors=np.zeros(count), correlation=np.eye(count), covariance=np.zeros((count, count)), open_directions=none
        )
    _, size, directions = np.linalg.svd(jacobian / scale @ free, full_matrices=True)
    size = np.append(size, np.zeros(free.shape[1] - len(size)))
    known = size > ROUND_OFF.same * size.max()
    variance = residual @ residual / max(len(residual) - int(known.sum()), 1)
    spread = free @ directions[known].T / size[known]
    covariance = spread @ spread.T * variance
    unnoticed = free @ directions[~known].T
    lost = np.linalg.norm(unnoticed, axis=1) > ROUND_OFF.same
    errors = np.where(lost, inf, np.sqrt(np.clip(np.diag(covariance), 0.0, None)))
    correlation = _correlation(np.where(np.outer(lost, lost), unnoticed @ unnoticed.T, covariance), lost)
    return Uncertainty(
        errors=errors / scale,
        correlation=correlation,
        covariance=covariance / np.outer(scale, scale),
        open_directions=unnoticed / scale[:, None],
    )


def _correlation(covariance: Array, lost: NDArray[np.bool_]) -> Array:
    """Correlations of a covariance; none between a parameter that is open and one that is not."""
    deviation = np.sqrt(np.clip(np.diag(covariance), 0.0, None))
    safe = np.where(deviation > 0, deviation, inf)
    correlation = np.where(np.not_equal.outer(lost, lost), 0.0, covariance / np.outer(safe, safe))
    np.fill_diagonal(correlation, 1.0)
    return np.asarray(correlation)


def scatter(fit: Fit) -> FitSpread | None:
    """Return the standard errors of a fit as a spread; None where the tests determine only combinations of constants.

    Parameters
    ----------
    fit : Fit
    """
    if fit.undetermined or not all(map(isfinite, fit.errors.values())):
        return None
    return FitSpread(
        of=SCATTER, deviations=dict(fit.errors),
        correlation=tuple(tuple(map(float, row)) for row in fit.correlation),
    )  # fmt: skip


def spread_between(fits: Sequence[Fit], of: str) -> FitSpread:
    """Return the spread of the constants between fits of one law to several specimens or batches.

    Parameters
    ----------
    fits : sequence of Fit
        Two or more of one law.
    of : str
        What they are, such as ``"batches"``.

    Returns
    -------
    FitSpread
        Standard deviations with n − 1, and the correlation.

    Raises
    ------
    TurgorError
        If there are fewer than two, or their laws differ.
    """
    laws = {fit.spec.name for fit in fits}
    if len(fits) < 2 or len(laws) > 1:
        raise TurgorError(
            f"a spread between {of} needs two fits or more of one law; given: {len(fits)} of {', '.join(sorted(laws))}."
        )
    table = np.array([list(fit.values.values()) for fit in fits])
    deviation = table.std(axis=0, ddof=1)
    safe = np.where(deviation > 0, deviation, np.inf)
    away = (table - table.mean(axis=0)) / safe
    correlation = np.clip(away.T @ away / (len(fits) - 1), -1.0, 1.0)
    np.fill_diagonal(correlation, 1.0)
    return FitSpread(
        of=f"{len(fits)} {of}", deviations=dict(zip(fits[0].values, map(float, deviation), strict=True)),
        correlation=tuple(tuple(row) for row in correlation.tolist()),
    )  # fmt: skip
