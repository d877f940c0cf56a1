"""Problem: what a procedure beyond load control needs to begin its path."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.engine.system import System
from turgor.engine.tangent import Tangent
from turgor.solvers.constraints.constraint import Constraint
from turgor.solvers.continuation.path_points import Point, Run, Task, point_at
from turgor.solvers.continuation.step_control import StepControl
from turgor.solvers.newton.newton import NewtonSettings
from turgor.solvers.outcomes import Outcome
from turgor.solvers.procedures.arc_length import ArcLength
from turgor.solvers.procedures.auto import Auto
from turgor.solvers.procedures.gas_mass import GasMass
from turgor.solvers.procedures.volume_control import VolumeControl
from turgor.solvers.restart import Carried
from turgor.solvers.solution import Iteration, LimitPoint, State, Step

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Problem:
    """The equations, how they are solved, what was asked, who listens, the lists to fill, where it begins."""

    system: System
    tangent: Tangent
    procedure: VolumeControl | GasMass | ArcLength | Auto
    progress: Callable[[Iteration, State | None], None] | None
    stop: Callable[[State], str | None] | None
    states: list[State]
    steps: list[Step]
    limits: list[LimitPoint]
    carried: Carried | None = None


def run_of(
    problem: Problem,
    control: Constraint,
    stepping: StepControl,
    driven: Callable[[float], dict[str, float]],
    finished: Callable[[Point, Point, Run], Outcome | None],
    turns: tuple[float, ...] = (),
) -> Run:
    """Make a run that fills the lists of a problem."""
    procedure = problem.procedure
    task = Task(
        system=problem.system,
        tangent=problem.tangent,
        settings=NewtonSettings(tolerance=procedure.tolerance, max_iterations=procedure.max_iterations),
        procedure=procedure,
        progress=problem.progress,
        stop=problem.stop,
        driven=driven,
        finished=finished,
        kinks=turns,
    )
    return Run(task, control, stepping, problem.states, problem.steps, problem.limits)


def begin(run: Run, parameter: float, unknowns: Array, scalars: Array) -> None:
    """Make a known equilibrium the first point of a run, and a state if there is none yet."""
    timed = run.control.clock.duration is not None
    if timed:
        run.control.clock.begin(run.task.system, parameter)
    at = run.control.sought.evaluate(unknowns, parameter, scalars)
    assert at is not None
    point = point_at(run, at, parameter, scalars, ahead=timed)
    run.history.append(point)
    if not run.states:
        run.states.append(point.state)
