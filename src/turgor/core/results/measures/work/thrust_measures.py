"""Thrust: the mean force over a cycle with which a moving actuator pushes what holds it."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from turgor.core.model.history import History, share_at
from turgor.core.model.model import Model
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.measure import Measure
from turgor.core.results.measures.standard_measures import support_force
from turgor.core.results.measures.work.settings import CYCLES
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def period_of(history: History) -> float | None:
    """Return the shortest shift by which a history repeats itself up to its end, at most a half; None without one.

    Parameters
    ----------
    history : sequence of (float, float), or str

    Returns
    -------
    float or None

    Examples
    --------
    >>> period_of("sin(8*pi*s)"), period_of("sin(pi*s)"), period_of(((0, 1), (1, 1)))
    (0.25, None, None)
    """
    count = CYCLES.samples
    shares = np.array([share_at(history, s) for s in np.linspace(0.0, 1.0, count + 1)])
    width = float(np.ptp(shares))
    if not width:
        return None
    errors = np.array([np.abs(shares[k:] - shares[: count + 1 - k]).max() for k in range(count // 2 + 2)]) / width
    for k in range(2, count // 2 + 1):
        if errors[k] > CYCLES.near or errors[k] > min(errors[k - 1], errors[k + 1]):
            continue
        if errors[k] <= CYCLES.same:
            return k / count
        shift = _refined(history, ((k - 1) / count, (k + 1) / count), width)
        if shift is not None:
            return shift
    return None


def _refined(history: History, bounds: tuple[float, float], width: float) -> float | None:
    """The shift within bounds that repeats a history best; None where it does not repeat it."""
    begins = np.linspace(0.0, 1.0 - bounds[1], CYCLES.fine_samples)

    def error(shift: float) -> float:
        return max(abs(share_at(history, s + shift) - share_at(history, s)) for s in begins) / width

    best = minimize_scalar(error, bounds=bounds, method="bounded", options={"xatol": CYCLES.shift})
    return float(best.x) if best.fun <= CYCLES.same_refined else None


def cycle_of(model: Model) -> float:
    """Return the cycle of the loads of a model, as a share of its path.

    Parameters
    ----------
    model : Model

    Raises
    ------
    TurgorError
        If no load repeats within the path, or the cycles of two loads do not fit into each other.
    """
    periods = [period for load in model.loads if (period := period_of(load.history)) is not None]
    if not periods:
        raise TurgorError(
            "it is a mean over a cycle, and no load has a history that repeats; state one of two cycles or more, such "
            'as history_over_time = "sin(2*pi*t/0.5)**2".'
        )
    longest = max(periods)
    for period in periods:
        if abs(longest / period - round(longest / period)) > CYCLES.fit:
            raise TurgorError(
                f"it is a mean over a cycle, and loads have cycles of {longest:.4g} and {period:.4g} of the path; the "
                "longest must be a multiple of the others."
            )
    return longest


def thrusts(path: Sequence[StateFields], axis: int) -> Array:
    """Mean force along an axis over the cycle up to each state, (n,) [N]; nan in the first cycle, and in coarse ones.

    Parameters
    ----------
    path : sequence of StateFields
        Of a motion.
    axis : int
    """
    cycle = cycle_of(path[-1].model)
    if any(at.state.velocity is None for at in path[1:]):
        raise TurgorError("it is the force of a motion; follow it with the procedure dynamic.")
    factors = np.array([at.state.load_factor for at in path])
    force = -np.array([support_force(at)[axis] for at in path])
    sums = np.concatenate([[0.0], np.cumsum((force[1:] + force[:-1]) / 2 * np.diff(factors))])
    begins = factors - cycle
    steps = np.arange(len(factors)) - np.searchsorted(factors, begins + CYCLES.shift, side="right") + 1
    known = (begins >= -CYCLES.shift) & (steps >= CYCLES.least_steps)
    return np.where(~known, np.nan, (sums - np.interp(begins, factors, sums)) / cycle)


def _of_path(at: StateFields) -> float:
    raise TurgorError("it is a mean along a path.")


def _along(axis: str) -> Measure:
    """Make the measure of the thrust along an axis."""
    number = "xyz".index(axis)
    return Measure(
        name=f"thrust_{axis}", unit="mN", function=_of_path, along=lambda path: thrusts(path, number), moving=True,
        definition=f"force along {axis} with which a moving actuator pushes its supports, mean over the last cycle of "
        f"its loads by the trapezoidal rule, whole actuator; none for a cycle of less than {CYCLES.least_steps} steps",
    )  # fmt: skip


thrust_x, thrust_y, thrust_z = map(_along, "xyz")
