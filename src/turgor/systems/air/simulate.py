"""simulate: follow a network through time."""

from math import inf

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.foundation.errors import TurgorError
from turgor.systems.air.coupling import follow_coupled, in_motion
from turgor.systems.air.equations import Equations
from turgor.systems.air.history import History
from turgor.systems.air.integrate import integrate
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
    Chambers of a `MovingActuator` are stepped together with the gas: every step ends at a volume that both agree on.

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
    if in_motion(network):
        return follow_coupled(network, stored, until, (tolerance, method))
    equations = Equations(network, until)
    states, evaluations, _ = integrate(equations, stored, tolerance, method)
    return History(equations=equations, time=stored, unknowns=states, evaluations=evaluations)
