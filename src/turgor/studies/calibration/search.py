"""Search: bounded least squares with few runs; Broyden updates stand in for derivatives that cost runs."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares, lsq_linear

from turgor.studies.calibration.objective import Objective, known_columns
from turgor.studies.calibration.settings import CALIBRATION
from turgor.studies.runs.settings import RUNS

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchResult:
    """Where a search ended.

    Parameters
    ----------
    at : (n,) array
        Coordinates.
    residuals : (m,) array
    jacobian : (m, n) array
        At this point: by slopes of the responses, else by finite differences.
    converged : bool
        False where the runs were used up although a further step would gain something that rigs resolve.
    step : (n,) array
        The best step from here of the linear problem within the bounds.
    gain : float [-]
        Share by which it would lower the root of the mean square of the differences.
    """

    at: Array
    residuals: Array
    jacobian: Array
    converged: bool
    step: Array
    gain: float


class _SpentError(Exception):
    """All runs are used up."""


class _IdleError(Exception):
    """The last runs gained too little, or a further one would."""


def search(objective: Objective, start: Array, most: int) -> SearchResult:
    """Minimize half the sum of squares within the bounds.

    Each round begins with a Jacobian, by finite differences where the responses have no slopes. It goes on with one run
    an iteration and ends where these find no lower point: slopes are fresh at every point, Broyden updates stand in for
    differences. The last round confirms with its Jacobian that no step is left, which the standard errors need as well.

    Parameters
    ----------
    objective : Objective
    start : (n,) array
        Coordinates.
    most : int
        Runs at most; those of a last Jacobian may come on top.

    Returns
    -------
    SearchResult
    """
    at, residuals = start, objective.residuals(start)
    jacobian = objective.jacobian(at)
    while not no_step_left(objective, at, residuals, jacobian):
        to = _one_round(objective, at, jacobian, most)
        if to is None:
            return _ended(objective, at, residuals, jacobian, spent=True)
        if np.array_equal(to, at):
            break
        before, at, residuals = residuals, to, objective.residuals(to)
        jacobian = objective.jacobian(at)
        if _cost(before) - _cost(residuals) < _least_gain(objective, residuals):  # rough, as meshes that change are
            break
        if len(objective.evaluations.ended) >= most:
            return _ended(objective, at, residuals, jacobian, spent=True)
    return _ended(objective, at, residuals, jacobian)


def _ended(objective: Objective, at: Array, residuals: Array, jacobian: Array, spent: bool = False) -> SearchResult:
    """Return where a search ended. Runs that are used up matter only if more of them would show in the curve."""
    step = _linear_step(objective, at, residuals, jacobian)
    here, there = (float(np.sqrt(np.mean(each**2))) for each in (residuals, residuals + jacobian @ step))
    small = here - there < CALIBRATION.resolved or no_step_left(objective, at, residuals, jacobian)
    return SearchResult(
        at=at, residuals=residuals, jacobian=jacobian, converged=small or not spent, step=step,
        gain=1 - there / here if here else 0.0,
    )  # fmt: skip


def _one_round(objective: Objective, at: Array, jacobian: Array, most: int) -> Array | None:
    """Return the lowest point of one round with an updated Jacobian; None where the runs are used up."""
    low, high = objective.limits
    here = objective.residuals(at)
    best: dict[str, Any] = {"at": at, "cost": _cost(here), "idle": 0}

    def residuals(to: Array) -> Array:
        if len(objective.evaluations.ended) >= most:
            raise _SpentError
        there = objective.residuals(to)
        gain = best["cost"] - _cost(there)
        if gain > 0:
            best.update(at=to.copy(), cost=_cost(there))
        least = _least_gain(objective, here)
        best["idle"] += -CALIBRATION.idle_gains * least < gain < least
        if best["idle"] > RUNS.idle:
            raise _IdleError
        return there

    spent = False
    try:
        begun = at
        full = at + _linear_step(objective, at, objective.residuals(at), jacobian)
        if np.any((full <= low) | (full >= high)):  # the search within the bounds only comes close to them
            residuals(np.clip(full, low, high))
            begun = best["at"]
        follow = _Following(objective, at, jacobian)
        least_squares(
            residuals, np.clip(begun, low, high), jac=follow, bounds=(low, high),
            ftol=CALIBRATION.round_gain, xtol=CALIBRATION.smallest_step, gtol=None, max_nfev=8 + 2 * len(at),
        )  # fmt: skip
    except _IdleError:
        pass
    except _SpentError:
        spent = True
    return None if spent and best["at"] is at else np.asarray(best["at"])


class _Following:
    """A Jacobian that follows the search: exact where it costs no runs, updated by secants elsewhere (Broyden)."""

    def __init__(self, objective: Objective, at: Array, jacobian: Array) -> None:
        self.objective, self.at, self.jacobian = objective, at.copy(), jacobian.copy()

    def __call__(self, to: Array) -> Array:
        step = to - self.at
        if not np.any(step):
            return self.jacobian
        exact = self.objective.known_jacobian(to)
        known = known_columns(exact)
        here = self.objective.residuals(to)
        if known.all() and no_step_left(self.objective, to, here, exact):
            raise _IdleError
        mean = (exact[:, known] + self.jacobian[:, known]) / 2
        missed = here - self.objective.residuals(self.at) - mean @ step[known]
        missed -= self.jacobian[:, ~known] @ step[~known]
        length = float(step[~known] @ step[~known])
        if length > 0:
            self.jacobian[:, ~known] += np.outer(missed, step[~known]) / length
        self.jacobian[:, known] = exact[:, known]
        self.at = to.copy()
        return self.jacobian


def no_step_left(objective: Objective, at: Array, residuals: Array, jacobian: Array) -> bool:
    """Return whether the best step of the linear problem within the bounds gains too little.

    Parameters
    ----------
    objective : Objective
    at : (n,) array
        Coordinates.
    residuals : (m,) array
    jacobian : (m, n) array

    Returns
    -------
    bool
    """
    step = _linear_step(objective, at, residuals, jacobian)
    gain = _cost(residuals) - _cost(residuals + jacobian @ step)
    return bool(gain < _least_gain(objective, residuals) or np.abs(step).max() < CALIBRATION.smallest_step)


def _least_gain(objective: Objective, residuals: Array) -> float:
    """Gain that is not worth a step: small against the scatter of the differences, or their known spread."""
    freedom = max(len(residuals) - len(objective.parameters), 1)
    variance = 2 * _cost(residuals) / freedom
    return CALIBRATION.least_gain * max(variance, CALIBRATION.resolved**2 if objective.assumed else 1.0)


def _linear_step(objective: Objective, at: Array, residuals: Array, jacobian: Array) -> Array:
    """Best step of the linear problem within the bounds."""
    low, high = objective.limits
    here = np.clip(at, low, high)
    return np.asarray(lsq_linear(jacobian, -residuals, bounds=(low - here - 1e-12, high - here + 1e-12)).x)


def _cost(residuals: Array) -> float:
    return 0.5 * float(residuals @ residuals)
