"""simulate: follow a network through time."""

from collections.abc import Callable, Sequence
from math import inf, ulp
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

from turgor.foundation.errors import NotSolved, TurgorError
from turgor.systems.air.equations import Equations
from turgor.systems.air.history import History
from turgor.systems.air.network import Network
from turgor.systems.air.settings import SOLVER

Array = NDArray[np.float64]


def simulate(
    network: Network,
    until: float,
    *,
    times: ArrayLike | None = None,
    tolerance: float = SOLVER.tolerance,
    method: str = "LSODA",
) -> History:
    """Follow a network from the start to an end.

    Between the times at which a signal or a valve jumps, SciPy integrates with steps of variable order and length.

    Parameters
    ----------
    network : Network
    until : float [s]
        End.
    times : (n,) array [s], optional
        When states are stored, from 0 to the end; 501 of equal distance by default.
    tolerance : float [-]
        Relative error of a step.
    method : str
        ``"LSODA"``, ``"BDF"`` or ``"Radau"``.

    Returns
    -------
    History

    Raises
    ------
    TurgorError
        If a time, the tolerance or the method is out of range.
    NotSolved
        If a chamber leaves its table, or a step becomes too short.

    Examples
    --------
    >>> from turgor.systems.air.nodes import Chamber, Supply
    >>> from turgor.systems.air.parts.connection import Connection
    >>> from turgor.systems.air.parts.passages import Restriction
    >>> tank = Network(
    ...     nodes={"supply": Supply(400e3), "tank": Chamber(18e-6)},
    ...     parts={"valve": Connection("supply", "tank", Restriction(conductance=1e-9))},
    ... )
    >>> run = simulate(tank, 0.2)
    >>> print(run.pressure("tank")[[0, 250, 500]].round(-2))
    [     0. 262500. 397300.]
    """
    if not 0 < until < inf:
        raise TurgorError(f"until is {until:g} s; a positive time is needed.")
    if not 1e-13 <= tolerance <= 1e-2:
        raise TurgorError(f"tolerance is {tolerance:g}; allowed is 1e-13 to 0.01.")
    if method not in ("LSODA", "BDF", "Radau"):
        raise TurgorError(f"method is '{method}'; allowed is LSODA, BDF or Radau.")
    stored = np.linspace(0.0, until, SOLVER.samples + 1) if times is None else np.array(times, dtype=np.float64)
    if stored.ndim != 1 or not len(stored) or (np.diff(stored) <= 0).any():
        raise TurgorError("times must rise, and there must be one at least.")
    if stored[0] < 0 or stored[-1] > until:
        raise TurgorError(f"times reach from {stored[0]:g} to {stored[-1]:g} s; allowed is 0 to the end, {until:g} s.")
    equations = Equations(network, until)
    states, evaluations, _ = integrate(equations, stored, tolerance, method)
    return History(equations=equations, time=stored, unknowns=states, evaluations=evaluations)


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
        solution = _between(equations, np.unique([begin, *inner, end]), y, how, event)
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


def _between(
    equations: Equations,
    times: Array,
    y: Array,
    how: tuple[float, Array, str],
    event: Callable[[float, Array], float] | None,
) -> Any:
    """Integrate a smooth stretch; the times at its ends belong to it, as seen from within."""
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
