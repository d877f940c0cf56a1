"""Equilibria of rods along a path of load factors."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.solvers.constraints.arc import Arc
from turgor.core.solvers.constraints.elimination import eliminated
from turgor.core.solvers.newton.iteration import CONVERGED, iterate
from turgor.fast_models.rod.model import RodModel
from turgor.fast_models.rod.newton import (
    Converged,
    Iterate,
    NotConverged,
    converged,
    equilibrium,
    factored,
    moved,
)
from turgor.fast_models.rod.settings import ALONG_ARC, PATH
from turgor.fast_models.rod.solution import RodError, RodSolution
from turgor.fast_models.rod.stability import is_stable
from turgor.fast_models.rod.state import RodState
from turgor.fast_models.rod.system import RodSystem
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def static(model: RodModel, at: int | Iterable[float] = 1) -> RodSolution:
    """Find the equilibria of rods under growing loads.

    Newton's method takes the whole way to the next load factor in one step where it can, and shorter ones where not.

    Parameters
    ----------
    model : RodModel
    at : int or sequence of floats
        How many even steps of the load factor from 0 to 1 to keep, or which load factors; rest is kept before them.

    Returns
    -------
    RodSolution

    Raises
    ------
    RodError
        If there is no equilibrium further on; its `solution` holds the path so far.
    TurgorError
        If `at` is not rising from above 0.

    Examples
    --------
    >>> from turgor.fast_models.rod.loads import PlateForce
    >>> from turgor.fast_models.rod.model import Rod
    >>> from turgor.fast_models.rod.sections.section import RodSection
    >>> rod = Rod(section=RodSection.from_moduli(EA=1e4, GA=1e4, EI=1.0, GJ=1.0), length=1.0)
    >>> roll = RodModel(rods=[rod], loads=[PlateForce(moment=(0, 2 * np.pi, 0))])
    >>> print(abs(static(roll).tip[-1]).max() < 1e-12)  # the tip is back at the base
    True
    """
    factors = _factors(at)
    system = RodSystem(model)
    states, count = [system.start()], 0
    here, step = states[0], factors[0]
    for factor in factors:
        while here.load_factor < factor:
            last = here.load_factor + step >= factor - 1e-12
            target = factor if last else here.load_factor + step
            try:
                result = equilibrium(system, replace(here, load_factor=target))
            except NotConverged as failed:
                step = failed.share * min(step, target - here.load_factor)
                if step < PATH.shortest:
                    raise _stuck(system, states, here, count) from None
                continue
            step = max(step, PATH.growth * (target - here.load_factor))
            here, count = result.state, count + result.iterations
        states.append(here)
    return solution_of(system, states, f"All {len(factors)} load factors were reached.", count)


def arc_length(
    model: RodModel,
    *,
    step: float = 0.05,
    until: float = 1.0,
    most_steps: int = 400,
    stop: Callable[[RodState], bool] | None = None,
) -> RodSolution:
    """Follow equilibria of rods along their path, also where the loads must fall (Riks's method).

    Parameters
    ----------
    model : RodModel
        Its loads must grow in proportion to the load factor.
    step : float
        First length of a step: root mean square of motions over the length and rotations [rad], with the load factor.
    until : float
        Load factor at which the path ends.
    most_steps : int
    stop : callable, optional
        ``stop(state)`` ends the path where it is true.

    Returns
    -------
    RodSolution

    Raises
    ------
    RodError
        If a step fails, or the load factor is not reached; its `solution` holds the path so far.
    """
    if not 0 < step < np.inf:
        raise TurgorError(f"step of the arc is {step:g}; it must be more than 0.")
    system = RodSystem(model)
    states, count, longest = [system.start()], 0, 4 * step
    along: _Direction | None = None
    while len(states) <= most_steps:
        here = states[-1]
        try:
            direction = _direction(system, here, along)
            result = _arc_step(system, here, direction, step)
        except NotConverged:
            step /= 2
            if step < PATH.shortest:
                raise _stuck(system, states, here, count) from None
            continue
        if result.state.load_factor >= until:
            result = equilibrium(system, replace(result.state, load_factor=until))
            return solution_of(system, [*states, result.state], f"The path reached the load factor {until:g}.", count)
        states.append(result.state)
        count, along = count + result.iterations, direction
        if stop is not None and stop(result.state):
            return solution_of(system, states, "The path was stopped.", count)
        step = min(longest, step * (PATH.target_iterations / result.iterations) ** 0.5)
    message = f"{most_steps} steps were taken, and the load factor is {states[-1].load_factor:.4g}; allow more steps."
    raise RodError(message, solution_of(system, states, message, count, "not_reached"))


def solution_of(
    system: RodSystem, states: list[RodState], message: str, iterations: int, status: str = "converged"
) -> RodSolution:
    """Make the solution of the states of a path."""
    stable = tuple(is_stable(system, state) for state in states)
    lost = [state.load_factor for state, good in zip(states, stable, strict=True) if good is False]
    if lost:
        message += f" From the load factor {lost[0]:.4g} on, a state is unstable: a small push takes it elsewhere."
    return RodSolution(
        model=system.model, states=tuple(states), status=status, message=message, iterations=iterations, stable=stable
    )


def _factors(at: int | Iterable[float]) -> list[float]:
    if isinstance(at, int):
        if at < 1:
            raise TurgorError(f"at is {at}; at least 1 step is needed.")
        return list(np.linspace(0, 1, at + 1)[1:])
    factors = [float(each) for each in at]
    if not factors or not all(a < b for a, b in zip([0.0, *factors[:-1]], factors, strict=True)):
        raise TurgorError(f"at is {at}; load factors must rise from above 0.")
    return factors


def _stuck(system: RodSystem, states: list[RodState], here: RodState, count: int) -> RodError:
    """Say that there is no equilibrium further on."""
    path = states if states[-1] is here else [*states, here]
    message = (
        f"No equilibrium was found beyond the load factor {here.load_factor:.4g}: the rods may snap there, or an "
        "element may turn too far. Follow the path by arc_length, or take more elements."
    )
    return RodError(message, solution_of(system, path, message, count, "not_converged"))


@dataclass(frozen=True, slots=True, eq=False)
class _Direction:
    """A unit tangent of the path: twists (n, 6), and the arc that measures lengths along it."""

    twists: Array
    arc: Arc


def _direction(system: RodSystem, here: RodState, before: _Direction | None) -> _Direction:
    """The unit tangent of the path at a state, onward from the one before."""
    twists = _rate(system, here)
    weights = _weights(system, twists)
    onward = before is None or before.arc.length(twists.ravel(), 1.0) >= 0
    sign = 1.0 if onward else -1.0
    arc = Arc.along(sign * twists.ravel(), sign, weights)
    return _Direction(arc.rise * twists, arc)


def _rate(system: RodSystem, here: RodState) -> Array:
    """Return how the nodes move by the load factor."""
    at = system.evaluate(here)
    change = PATH.rate_step if here.load_factor <= 0 else -PATH.rate_step
    other = system.evaluate(replace(here, load_factor=here.load_factor + change))
    (twists,) = factored(system, at).solve(-(other.residual - at.residual) / change)
    return twists


def _arc_step(system: RodSystem, here: RodState, direction: _Direction, step: float) -> Converged:
    """Go a step along the tangent and correct it at right angles."""
    at = system.evaluate(here)
    state = replace(here, load_factor=here.load_factor + step * direction.arc.rise)
    start = Iterate(*moved(system, state, at, step * direction.twists))
    return converged(iterate(_AlongArc(system, direction.arc), start, ALONG_ARC.iterations))


@dataclass(frozen=True, slots=True, eq=False)
class _AlongArc:
    """The case of Newton's method for rods on an arc: the load factor is unknown, the length is prescribed."""

    system: RodSystem
    arc: Arc

    def update(self, at: Iterate) -> tuple[Array, float]:
        """Twists (n, 6) of the nodes, and the change of the load factor."""
        state, evaluation = at.state, at.evaluation
        change = -PATH.rate_step if state.load_factor > 0 else PATH.rate_step
        other = self.system.evaluate(replace(state, load_factor=state.load_factor + change))
        by_load = (other.residual - evaluation.residual) / change
        to_zero, by_factor = factored(self.system, evaluation).solve(-evaluation.residual, -by_load)
        conditions = self.arc.conditions(np.zeros(to_zero.size), 0.0, 0.0)
        twists, more = eliminated(to_zero.ravel(), by_factor.reshape(1, -1), conditions, conditions.errors)
        return twists.reshape(-1, 6), float(more[0])

    def advanced(self, at: Iterate, update: tuple[Array, float]) -> Iterate:
        """The state moved by an update, at the new load factor."""
        twists, more = update
        state = replace(at.state, load_factor=at.state.load_factor + more)
        size = np.sqrt(_weights(self.system, twists) @ twists.ravel() ** 2) + abs(more)
        return Iterate(*moved(self.system, state, at.evaluation, twists), size=float(size))

    def ended(self, at: Iterate, iteration: int) -> str | None:
        """Converged once the update is small."""
        return CONVERGED if at.size < ALONG_ARC.small_update else None


def _weights(system: RodSystem, twists: Array) -> Array:
    """Weights (6n,) of squared motions: a mean over the nodes, of shifts over the length and rotations."""
    return np.tile(np.repeat([1 / system.size**2, 1.0], 3), len(twists)) / len(twists)
