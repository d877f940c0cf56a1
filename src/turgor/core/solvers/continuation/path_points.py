"""Path points: find the equilibria of a path, and make points of them."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.system import Evaluation, Stresses
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.continuation.path_run import Point, Run
from turgor.core.solvers.continuation.settings import STEP_CONTROL
from turgor.core.solvers.listeners import silent
from turgor.core.solvers.newton.border import rates
from turgor.core.solvers.newton.contact_newton import newton_with_contact
from turgor.core.solvers.newton.newton import newton
from turgor.core.solvers.newton.newton_values import NewtonResult, NewtonSettings, Report, Start
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.solution import State
from turgor.core.solvers.states import state_of

Array = NDArray[np.float64]


def settings_of(procedure: StepOptions) -> NewtonSettings:
    """Return how Newton's method iterates for a procedure."""
    return NewtonSettings(tolerance=procedure.tolerance, max_iterations=procedure.max_iterations)


def nothing(_: float) -> dict[str, float]:
    """Prescribe nothing but the load factor."""
    return {}


def solve_at(run: Run, parameter: float, start: Start, report: Report) -> NewtonResult:
    """Find the state at a parameter, with all that touches."""
    run.constraint = run.constraint.begun(parameter)
    settings = _for_short(run, parameter - run.history[-1].parameter)
    return newton_with_contact(run.constraint, run.task.tangent, start, parameter, settings, report)


def _for_short(run: Run, length: float) -> NewtonSettings:
    """The settings of Newton's method; in a step shorter than the first one, with a smaller tolerance.

    What the tolerance leaves does not shrink with the step. In a short one it is a large part of how far a soft body
    moves, and the next prediction continues it.
    """
    settings = run.task.settings
    smaller = settings.tolerance * length / run.task.procedure.first_step
    shrunk = min(settings.tolerance, max(STEP_CONTROL.smallest_tolerance, smaller))
    return replace(settings, tolerance=shrunk, enough=settings.tolerance)


def begin(run: Run, parameter: float, unknowns: Array, scalars: Array) -> None:
    """Make a known equilibrium the first point of a run, and a state if there is none yet."""
    timed = run.constraint.clock.duration is not None
    if timed:
        run.constraint = run.constraint.begun(parameter)
    at = run.constraint.evaluate(unknowns, parameter, scalars)
    assert at is not None
    point = point_at(run, at, parameter, scalars, ahead=timed)
    run.history.append(point)
    if not run.states:
        run.states.append(point.state)


def point_at(run: Run, at: Evaluation, parameter: float, scalars: Array, ahead: bool = False) -> Point:
    """Make a point of the path of an equilibrium: its rates, those ahead of it where it is a kink, and its state."""
    change_rates = rates(run.constraint, run.task.tangent, at, parameter, scalars, ahead)
    bare = plain_point(run, at, (parameter, scalars), None if change_rates is None else change_rates.modes)
    return bare if change_rates is None else replace(bare, change=change_rates.unknowns, slope=change_rates.scalars)


def plain_point(run: Run, at: Evaluation, place: tuple[float, Array], modes: int | None) -> Point:
    """Make a point without rates of an equilibrium at a parameter and scalars."""
    (parameter, scalars), system = place, run.task.system
    state = replace(
        state_of(system, at, modes),
        driven=run.task.driven(parameter),
        time=run.constraint.clock.time_of(parameter),
    )
    return Point(parameter, at.unknowns, scalars, system.stresses(at), None, None, state, at.history)


def between(points: Sequence[Point], parameter: float) -> Start:
    """The polynomial through points, at a parameter."""
    weights = lagrange_weights([point.parameter for point in points], parameter)
    pairs = list(zip(weights, points, strict=True))
    unknowns = unknowns_between(points, parameter)
    scalars = np.asarray(sum(w * p.scalars for w, p in pairs))
    return Start(unknowns, Stresses.combine([(w, p.stresses) for w, p in pairs]), scalars)


def unknowns_between(points: Sequence[Point], parameter: float) -> Array:
    """Unknowns (size,) of the polynomial through points, at a parameter."""
    weights = lagrange_weights([point.parameter for point in points], parameter)
    return np.asarray(sum(w * p.unknowns for w, p in zip(weights, points, strict=True)))


def lagrange_weights(parameters: Sequence[float], parameter: float) -> list[float]:
    """Weights of the points at ``parameters`` in their polynomial's value at ``parameter``.

    Examples
    --------
    >>> lagrange_weights([0.0, 1.0, 2.0], 3.0)
    [1.0, -3.0, 3.0]
    """
    weights = []
    for i, t_i in enumerate(parameters):
        weight = 1.0
        for j, t_j in enumerate(parameters):
            if i != j:
                weight *= (parameter - t_j) / (t_i - t_j)
        weights.append(weight)
    return weights


def fixed_load(run: Run, before: Point, after: Point, load_factor: float) -> State | None:
    """The state at a load factor between two points, found at this load."""
    system, tangent = run.task.system, run.task.tangent
    low, high = float(before.scalars[0]), float(after.scalars[0])
    share = (load_factor - low) / (high - low)
    near = between([before, after], before.parameter + share * (after.parameter - before.parameter))
    start = Start(near.unknowns, near.stresses)
    constraint = load_control(system, history=run.constraint.history)
    result = newton(constraint, tangent, start, load_factor, run.task.settings, silent)
    if not result.converged or result.evaluation is None:
        return None
    return state_of(system, result.evaluation, result.unstable_modes)
