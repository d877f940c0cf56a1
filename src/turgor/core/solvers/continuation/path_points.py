"""Path points: the equilibria of a path, and the data of a run along it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.cells.internal_variables import History
from turgor.core.engine.system import Evaluation, Stresses, System
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.continuation.step_control import StepControl
from turgor.core.solvers.continuation.thresholds import SMALLEST_TOLERANCE
from turgor.core.solvers.listeners import silent
from turgor.core.solvers.newton.border import rates
from turgor.core.solvers.newton.contact_newton import newton_with_contact
from turgor.core.solvers.newton.newton import NewtonResult, NewtonSettings, Report, Start, newton
from turgor.core.solvers.outcomes import Outcome
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.solution import LimitPoint, State, Step
from turgor.core.solvers.states import state_of
from turgor.core.solvers.step_reasons import Reason

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Point:
    """An equilibrium on the path, with the rates of the path there.

    Parameters
    ----------
    parameter : float
    unknowns : (size,) array
    scalars : (k,) array
        Empty under load control.
    stresses : Stresses
    change : (size,) array or None
        Of the unknowns with the parameter, None where the tangent was singular or the rates were not looked for. Under
        load control it is by the last factors of Newton's method.
    slope : (k,) array or None
        Of the scalars.
    state : State
    history : History or None
        What the rubber brought into the step to it.
    """

    parameter: float
    unknowns: Array
    scalars: Array
    stresses: Stresses
    change: Array | None
    slope: Array | None
    state: State
    history: History | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Bifurcation:
    """Where the path meets another one: the load factor, a state just beyond, and how many modes become unstable."""

    load_factor: float
    state: State
    modes: int


@dataclass(frozen=True, slots=True, eq=False)
class Judgment:
    """Whether a step is accepted, and why.

    Parameters
    ----------
    point : Point or None
        The new point of the path; None where the step is rejected.
    reason : Reason or None
        Why it is rejected, or how it was found.
    passed : tuple of Bifurcation
        Bifurcations that an accepted step passes.
    """

    point: Point | None
    reason: Reason | None = None
    passed: tuple[Bifurcation, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Ending:
    """The last state of a path, and what to say about the run once it is among the states."""

    state: State
    outcome: Callable[["Run"], Outcome]


class Strategy(Protocol):
    """What differs between load control and a path whose scalars are sought."""

    def next_parameter(self, run: "Run") -> float:
        """The parameter to try next."""

    def predict(self, run: "Run", parameter: float) -> Start:
        """Where Newton's method starts."""

    def judge(self, run: "Run", result: NewtonResult, parameter: float) -> Judgment:
        """Whether a result is the next point of the path."""

    def rescue(self, run: "Run") -> Outcome | None:
        """What to do when a step cannot be cut any more: how the run ends, or None where another state was found."""

    def accepted(self, run: "Run", now: Point) -> None:
        """Adapt the step control beyond an accepted step."""

    def turn(self, run: "Run", now: Point) -> None:
        """Start without history at a kink, beyond which former states predict nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """What does not change along a path.

    Parameters
    ----------
    problem : Problem
    procedure : StepOptions
        Its steps, tolerance and numbers of iterations count.
    strategy : Strategy
    settings : NewtonSettings
    driven : callable
        ``driven(parameter) -> dict``: what is prescribed besides the load factor, by the names of columns.
    finished : callable
        ``finished(before, now, run) -> Ending or None`` for every accepted step.
    kinks : tuple of float
        Parameters beyond which the path goes another way.
    limit_points : bool
        Whether maxima and minima of the scalars are looked for.
    """

    problem: Problem
    procedure: StepOptions
    strategy: Strategy
    settings: NewtonSettings
    driven: Callable[[float], dict[str, float]]
    finished: Callable[[Point, Point, "Run"], Ending | None]
    kinks: tuple[float, ...] = ()
    limit_points: bool = True

    @property
    def system(self) -> System:
        """The equations of equilibrium."""
        return self.problem.system

    @property
    def tangent(self) -> Tangent:
        """Their tangent."""
        return self.problem.tangent


@dataclass(slots=True, eq=False)
class Run:
    """How far a path has come.

    Parameters
    ----------
    task : Task
    constraint : Constraint
        Of the next step.
    stepping : StepControl
    history : list of Point
        The last points, from which the next one is predicted.
    bifurcations : list of Bifurcation
    size : float
        Displacement that counts as much as a load factor of 1, where the load factor is sought; 0 elsewhere.
    """

    task: Task
    constraint: Constraint
    stepping: StepControl
    history: list[Point] = field(default_factory=list)
    bifurcations: list[Bifurcation] = field(default_factory=list)
    size: float = 0.0

    @property
    def states(self) -> list[State]:
        """The path so far."""
        return self.task.problem.states

    @property
    def steps(self) -> list[Step]:
        """Attempted steps."""
        return self.task.problem.steps

    @property
    def limits(self) -> list[LimitPoint]:
        """Limit points so far."""
        return self.task.problem.limits


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
    shrunk = min(settings.tolerance, max(SMALLEST_TOLERANCE, smaller))
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
    found = rates(run.constraint, run.task.tangent, at, parameter, scalars, ahead)
    bare = plain_point(run, at, (parameter, scalars), None if found is None else found.modes)
    return bare if found is None else replace(bare, change=found.unknowns, slope=found.scalars)


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
