"""Estimate: standard errors, intervals and correlation of the parameters, and undetermined combinations."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm, t

from turgor.studies.calibration.objective import Objective
from turgor.studies.calibration.parameter import Parameter
from turgor.studies.calibration.search import SearchResult
from turgor.studies.calibration.settings import CALIBRATION
from turgor.studies.runs.settings import LEVEL

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Estimate:
    """How well parameters are determined, linearized at the solution.

    Parameters
    ----------
    errors : (n,) array [SI]
        Standard errors; nan for a parameter at its bound.
    intervals : (n, 2) array [SI]
        95 % intervals, within the bounds; nan for a parameter at its bound.
    correlation : (n, n) array
        Of the errors; in the logarithm of a parameter whose bounds are positive.
    scatter : float [-]
        Root of the sum of squares over the degrees of freedom: 1 where differences are as large as the spread.
    at_bound : tuple of str
        Parameters that ended at a bound.
    undetermined : tuple of str
        A sentence for each combination that the curves do not determine.
    notes : tuple of str
        What the numbers assume.
    """

    errors: Array
    intervals: Array
    correlation: Array
    scatter: float
    at_bound: tuple[str, ...]
    undetermined: tuple[str, ...]
    notes: tuple[str, ...]


def estimate(objective: Objective, end: SearchResult) -> Estimate:
    """Estimate how well the parameters are determined at the end of a search.

    The covariance is (JᵀJ)⁻¹ with the Jacobian of the weighted differences, in the coordinates of the search. It is
    multiplied by the square of the scatter where the spread of the measurement is not known, or where the differences
    are larger than the spread.

    Parameters
    ----------
    objective : Objective
    end : SearchResult

    Returns
    -------
    Estimate
    """
    parameters, count = objective.parameters, len(objective.parameters)
    free = ~_at_bound(objective, end)
    freedom = max(len(end.residuals) - int(free.sum()), 1)
    scatter = float(np.sqrt(end.residuals @ end.residuals / freedom))
    factor = scatter if objective.assumed else max(scatter, 1.0)
    deviation, correlation = np.full(count, np.nan), np.full((count, count), np.nan)
    if free.any():
        deviation[free], correlation[np.ix_(free, free)] = _errors(end.jacobian[:, free], factor)
    scaled = objective.assumed or scatter > 1.0
    quantile = float(t.ppf((1 + LEVEL) / 2, freedom) if scaled else norm.ppf((1 + LEVEL) / 2))
    values = np.array([each.value(x) for each, x in zip(parameters, end.at, strict=True)])
    slopes = np.array([each.slope(value) for each, value in zip(parameters, values, strict=True)])
    intervals = np.array([
        [each.value(x - quantile * s), each.value(x + quantile * s)] if np.isfinite(s) else list(each.bounds)
        for each, x, s in zip(parameters, end.at, deviation, strict=True)
    ])  # fmt: skip
    intervals[~free] = np.nan
    rows = objective.rows
    return Estimate(
        errors=deviation * np.abs(slopes),
        intervals=intervals,
        correlation=correlation,
        scatter=scatter,
        at_bound=tuple(each.name for each, inside in zip(parameters, free, strict=True) if not inside),
        undetermined=_undetermined(
            [each for each, inside in zip(parameters, free, strict=True) if inside],
            end.jacobian[:rows, free],
            factor,
        ),
        notes=_notes(objective, end.residuals, scatter),
    )


def _at_bound(objective: Objective, end: SearchResult) -> NDArray[np.bool_]:
    low, high = objective.limits
    near = CALIBRATION.smallest_step * np.array([each.width for each in objective.parameters])
    return (end.at - low < near) | (high - end.at < near)


def _errors(jacobian: Array, factor: float) -> tuple[Array, Array]:
    """Standard errors and correlation of the coordinates; infinite where a parameter changes nothing."""
    _, sizes, directions = np.linalg.svd(jacobian, full_matrices=False)
    sizes = np.maximum(sizes, 1e-12 * max(float(sizes[0]), 1e-300))
    half = directions.T / sizes
    covariance = half @ half.T
    deviation = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(deviation, deviation)
    return factor * deviation, correlation


def _undetermined(parameters: Sequence[Parameter], jacobian: Array, factor: float) -> tuple[str, ...]:
    if not parameters:
        return ()
    _, sizes, directions = np.linalg.svd(jacobian, full_matrices=True)
    sizes = np.append(sizes, np.zeros(len(parameters) - len(sizes)))
    limits = np.array([
        CALIBRATION.undetermined * (min(1.0, each.width) if each.logarithmic else 1.0) for each in parameters
    ])  # fmt: skip
    sentences = []
    for size, direction in zip(sizes, directions, strict=True):
        allowed = float(np.min(limits / np.maximum(np.abs(direction), 1e-9)))
        if size <= CALIBRATION.least_effect * sizes[0] or factor / size > allowed:
            sentences.append(_sentence(parameters, direction))
    return tuple(sentences)


def _sentence(parameters: Sequence[Parameter], direction: Array) -> str:
    share = np.abs(direction) / np.abs(direction).max()
    part = [(each, float(x)) for each, x, s in zip(parameters, direction, share, strict=True) if s >= CALIBRATION.named]
    names = [each.name for each, _ in part]
    known = [each.name for each, _ in part if each.prior is not None]
    if len(part) == 1:
        text = f"{names[0]} is not determined: the curves hardly depend on it."
    else:
        listed = f"{', '.join(names[:-1])} and {names[-1]} are not determined separately"
        (first, a), (second, b) = part[0], part[-1]
        if len(part) == 2 and first.logarithmic and second.logarithmic:
            power = -a / b
            raised = "" if abs(abs(power) - 1) < 0.005 else f"^{abs(power):.2f}"
            kind, sign = ("product", "·") if power > 0 else ("ratio", "/")
            text = f"{listed}: the curves tell only the {kind} {first.name} {sign} {second.name}{raised}."
        else:
            moves = ", ".join(f"{each.name} {_change(each, x / np.abs(direction).max())}" for each, x in part)
            text = f"{listed}: the curves stay almost as they are when they change together ({moves})."
    if known:
        return f"{text} The result rests on the prior of {' and '.join(known)}."
    return f"{text} Fix one, give it a prior, or add an experiment in which they act differently."


def _change(parameter: Parameter, coordinate: float) -> str:
    """A change of a parameter, scaled so that the largest one is 10 %."""
    if parameter.logarithmic:
        return f"{10 * coordinate:+.2g} %"
    low, high = parameter.bounds
    amount = 0.1 * coordinate * (high - low)
    return f"{'+' if amount > 0 else ''}{parameter.shown(amount, 2)}"


def _notes(objective: Objective, residuals: Array, scatter: float) -> tuple[str, ...]:
    notes = []
    if objective.assumed:
        notes.append(
            "The spread of the measurement is not given: standard errors are those that the remaining differences give."
        )
    elif scatter > 1.5:
        notes.append(
            f"The differences are {scatter:.2g} times as large as the spread of the measurement: something else is "
            "wrong, too. The standard errors are multiplied by it."
        )
    first = 0
    for each in objective.data:
        rows = residuals[first : first + len(each.value)][np.argsort(each.drive, kind="stable")]
        first += len(each.value)
        if len(rows) >= 8 and rows.std() > 0:
            alike = float(np.sum(rows[1:] * rows[:-1]) / np.sum(rows**2))
            if alike > CALIBRATION.correlated:
                notes.append(
                    f"Neighboring differences of {each.trial.name} are alike (correlation {alike:.2f}): the curve is "
                    "missed in shape, not by noise, and the standard errors are too small."
                )
    return tuple(notes)
