"""Path run: the points of a path, what each step passes on to the next one, and the data of a run along it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.cells.internal_variables import History
from turgor.core.engine.system import Stresses, System
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.continuation.step_control import StepControl
from turgor.core.solvers.newton.newton_values import NewtonResult, NewtonSettings, Start
from turgor.core.solvers.outcomes import Outcome
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.solution import LimitPoint, State, Step
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
    memory : StepMemory or None
        What the next steps know; None where that does not change.
    """

    point: Point | None
    reason: Reason | None = None
    passed: tuple[Bifurcation, ...] = ()
    memory: "StepMemory | None" = None


@dataclass(frozen=True, slots=True)
class StepMemory:
    """Memory of load control from step to step, besides the points of the path.

    Parameters
    ----------
    lost_stability : bool
        Whether an attempt since the last state had unstable modes.
    rate : float
        Motion of the nodes with the load factor at the last state; infinite where it is not known.
    failed_guides : int
        Attempts that started from the guide and found no state.
    guided_until : float or None
        Load factor from which on the run goes without its guide; None as long as it has one.
    """

    lost_stability: bool = False
    rate: float = inf
    failed_guides: int = 0
    guided_until: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Rescue:
    """Rescue where no step can be shorter: another point of the path, or the end of the run.

    Parameters
    ----------
    reached : (Point, NewtonResult) or None
    ending : Outcome or None
        None where a point was reached.
    memory : StepMemory
    """

    reached: tuple[Point, NewtonResult] | None
    ending: Outcome | None
    memory: StepMemory


@dataclass(frozen=True, slots=True, eq=False)
class Turn:
    """Continuation of a run beyond a kink: its points, its constraint, its step control and its memory."""

    history: tuple[Point, ...]
    constraint: Constraint
    stepping: StepControl
    memory: StepMemory


@dataclass(frozen=True, slots=True, eq=False)
class Ending:
    """The last state of a path, and the outcome of the run that ends with it."""

    state: State
    outcome: Callable[["Run"], Outcome]


class Strategy(Protocol):
    """Differences between load control and a path whose scalars are unknown. They do not change along the path."""

    def next_parameter(self, run: "Run") -> float:
        """The parameter to try next."""

    def predict(self, run: "Run", parameter: float) -> Start:
        """Start of Newton's method."""

    def judge(self, run: "Run", result: NewtonResult, parameter: float) -> Judgment:
        """Whether a result is the next point of the path."""

    def rescue(self, run: "Run") -> Rescue:
        """Return the rescue where a step cannot be cut any more."""

    def accepted(self, run: "Run", now: Point) -> StepControl:
        """The step control beyond an accepted step."""

    def turn(self, run: "Run", now: Point) -> Turn:
        """Start without history at a kink, beyond which former states do not predict the path."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """Constants of a path.

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
    """State of a run along a path.

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
        Displacement that counts as much as a load factor of 1, where the load factor is unknown; 0 elsewhere.
    memory : StepMemory
        What the last step passes on.
    """

    task: Task
    constraint: Constraint
    stepping: StepControl
    history: list[Point] = field(default_factory=list)
    bifurcations: list[Bifurcation] = field(default_factory=list)
    size: float = 0.0
    memory: StepMemory = field(default_factory=StepMemory)

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
