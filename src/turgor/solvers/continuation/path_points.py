"""Points: equilibria on a path, how they are found, and what a run along the path knows."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from turgor.engine.system import Evaluation, Stresses, System
from turgor.engine.tangent import Tangent
from turgor.solvers.constraints.cavities import acting_pressures
from turgor.solvers.constraints.constraint import Constraint
from turgor.solvers.constraints.loads import load_control
from turgor.solvers.continuation.predictor import lagrange_weights
from turgor.solvers.continuation.step_control import StepControl
from turgor.solvers.newton.border import rates
from turgor.solvers.newton.contact_newton import newton_with_contact, touches
from turgor.solvers.newton.newton import NewtonResult, NewtonSettings, Start, newton
from turgor.solvers.outcomes import Outcome
from turgor.solvers.procedures.arc_length import ArcLength
from turgor.solvers.procedures.auto import Auto
from turgor.solvers.procedures.gas_mass import GasMass
from turgor.solvers.procedures.volume_control import VolumeControl
from turgor.solvers.solution import Iteration, LimitPoint, State, Step

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Point:
    """An equilibrium on the path, and how it goes on from there.

    Parameters
    ----------
    parameter : float
    unknowns : (size,) array
    scalars : (k,) array
    stresses : Stresses
    change : (size,) array or None
        Of the unknowns with the parameter, None where the tangent was singular.
    slope : (k,) array or None
        Of the scalars.
    state : State
    """

    parameter: float
    unknowns: Array
    scalars: Array
    stresses: Stresses
    change: Array | None
    slope: Array | None
    state: State


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """What does not change along a path.

    Parameters
    ----------
    system : System
    tangent : Tangent
    settings : NewtonSettings
    procedure : VolumeControl, GasMass, ArcLength or Auto
    progress : callable or None
    stop : callable or None
    driven : callable
        ``driven(parameter) -> dict``: what is prescribed besides the load factor, by the names of columns.
    finished : callable
        ``finished(before, now, run) -> Outcome or None`` after every accepted step.
    kinks : tuple of float
        Parameters beyond which the path goes another way.
    """

    system: System
    tangent: Tangent
    settings: NewtonSettings
    procedure: VolumeControl | GasMass | ArcLength | Auto
    progress: Callable[[Iteration, State | None], None] | None
    stop: Callable[[State], str | None] | None
    driven: Callable[[float], dict[str, float]]
    finished: Callable[[Point, Point, "Run"], Outcome | None]
    kinks: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Bifurcation:
    """Where the path meets another one: the load factor, a state just beyond, and how many modes become unstable."""

    load_factor: float
    state: State
    modes: int


@dataclass(slots=True, eq=False)
class Run:
    """What was found so far; the caller owns the lists.

    ``size`` is the displacement that counts as much as a load factor of 1, where the load factor is sought.
    """

    task: Task
    control: Constraint
    stepping: StepControl
    states: list[State]
    steps: list[Step]
    limits: list[LimitPoint] = field(default_factory=list)
    history: list[Point] = field(default_factory=list)
    bifurcations: list[Bifurcation] = field(default_factory=list)
    size: float = 0.0


def solve_at(
    run: Run, parameter: float, start: Start, report: Callable[[int, float, float, float], None]
) -> NewtonResult:
    """Find the state at a parameter, with all that touches."""
    run.control.clock.begin(run.task.system, parameter)
    return newton_with_contact(run.control, run.task.tangent, start, parameter, run.task.settings, report)


def point_at(run: Run, at: Evaluation, parameter: float, scalars: Array, ahead: bool = False) -> Point:
    """Make a point of the path of an equilibrium: its rates, those ahead of it where it is a kink, and its state."""
    system = run.task.system
    found = rates(run.control, run.task.tangent, at, parameter, scalars, ahead)
    sought = {} if at.sought is None else dict(acting_pressures(system, scalars))
    state = state_of(system, at, None if found is None else found.modes, sought, run.task.driven(parameter))
    state = replace(state, time=run.control.clock.time_of(parameter))
    change, slope = (None, None) if found is None else (found.unknowns, found.scalars)
    return Point(parameter, at.unknowns, scalars, system.stresses(at), change, slope, state)


def state_of(
    system: System, at: Evaluation, modes: int | None, pressures: dict[str, float], driven: dict[str, float]
) -> State:
    """The state of an equilibrium in physical units."""
    displacement, mean_stress = system.physical(at.unknowns)
    return State(
        model=system.model,
        load_factor=at.load_factor,
        displacement=displacement,
        mean_stress=mean_stress,
        nodal_force=system.split(at.residual)[0] * system.stress * system.length**2,
        unstable_modes=modes,
        pressures=pressures,
        driven=driven,
        touches=touches(system, at),
        memory=system.remembered(at),
    )


def between(points: Sequence[Point], parameter: float) -> Start:
    """The polynomial through points, at a parameter."""
    weights = lagrange_weights([point.parameter for point in points], parameter)
    pairs = list(zip(weights, points, strict=True))
    unknowns = np.asarray(sum(w * p.unknowns for w, p in pairs))
    scalars = np.asarray(sum(w * p.scalars for w, p in pairs))
    return Start(unknowns, Stresses.combine([(w, p.stresses) for w, p in pairs]), scalars)


def fixed_load(run: Run, before: Point, after: Point, load_factor: float) -> State | None:
    """The state at a load factor between two points, found at this load."""
    system, tangent = run.task.system, run.task.tangent
    low, high = float(before.scalars[0]), float(after.scalars[0])
    share = (load_factor - low) / (high - low)
    near = between([before, after], before.parameter + share * (after.parameter - before.parameter))
    result = newton(
        load_control(system), tangent, Start(near.unknowns, near.stresses), load_factor, run.task.settings, silent
    )
    if not result.converged or result.evaluation is None:
        return None
    return state_of(system, result.evaluation, result.unstable_modes, {}, {})


def silent(iteration: int, residual: float, correction: float, length: float) -> None:
    """Report nothing."""
