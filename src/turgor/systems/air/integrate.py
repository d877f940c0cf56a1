"""Integrate: equations of a network from one jump of its signals to the next."""

from collections.abc import Callable, Sequence
from math import ulp
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from turgor.foundation.errors import NotSolved
from turgor.systems.air.equations import Equations
from turgor.systems.air.settings import SOLVER

Array = NDArray[np.float64]


def integrate(
    equations: Equations,
    times: Array,
    tolerance: float = SOLVER.tolerance,
    method: str = "LSODA",
    event: "Callable[[float, Array], float] | None" = None,
) -> tuple[Array, int, float]:
    """Integrate from break to break; return unknowns (n, m) at times, the number of evaluations, and the end.

    Where there is an event, the end is where it rises through zero, if it does; later times have no unknowns.
    """
    y, begin, evaluations, until = equations.first, 0.0, 0, equations.around.until
    states = np.full((len(times), equations.size), np.nan)
    how = (tolerance, equations.scales * tolerance, method)
    for end in (*equations.breaks, until):
        inner = times[(times >= begin) & (times <= end)]
        solution = between(equations, np.unique([begin, *inner, end]), y, how, event)
        evaluations += solution.nfev
        if not solution.success:
            raise NotSolved(f"the network cannot be followed beyond {solution.t[-1]:.4g} s: {solution.message}")
        places = np.flatnonzero((times >= begin) & (times <= solution.t[-1]))
        states[places] = solution.y[:, np.searchsorted(solution.t, times[places])].T
        y, stop = solution.y[:, -1], end
        if solution.status == 1:
            y, stop = solution.y_events[0][0], float(solution.t_events[0][0])
        text = equations.outside(stop, y.tolist())
        if text:
            raise NotSolved(f"at {stop:.4g} s or before, {text}.")
        if solution.status == 1:
            return states, evaluations, stop
        begin = end
    return states, evaluations, until


def between(
    equations: Equations,
    times: Array,
    y: Array,
    how: tuple[float, Array, str],
    event: Callable[[float, Array], float] | None = None,
) -> Any:
    """Integrate a smooth stretch; the times at its ends belong to it, as seen from within.

    ``how`` is the relative error of a step, the absolute ones, and the method.
    """
    begin, end = times[0], times[-1]
    inside = max(1e-12 * (end - begin), 4 * ulp(end))

    def within(time: float) -> float:
        return min(max(time, begin + inside), end - inside)

    def rates(time: float, unknowns: Array) -> Sequence[float]:
        return equations.rates(within(time), unknowns)

    def jacobian(time: float, unknowns: Array) -> Array:
        return equations.jacobian(within(time), unknowns)

    tolerance, errors, method = how
    if event is not None:
        event.terminal, event.direction = True, 1.0  # type: ignore[attr-defined]
    more = {"rtol": tolerance, "atol": errors, "events": event, "jac": jacobian}
    return solve_ivp(rates, (begin, end), y, method, times, **more)
