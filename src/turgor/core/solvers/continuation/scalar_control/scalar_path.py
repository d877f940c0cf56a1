"""Paths with scalar unknowns: how they go from step to step, and how they begin."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.continuation.continuity import judged
from turgor.core.solvers.continuation.path_points import point_at, settings_of
from turgor.core.solvers.continuation.path_run import Ending, Judgment, Point, Rescue, Run, Task, Turn
from turgor.core.solvers.continuation.predictor import BY_PATH, predicted
from turgor.core.solvers.continuation.step_control import StepControl
from turgor.core.solvers.newton.newton_values import NewtonResult, Start
from turgor.core.solvers.outcomes import stuck
from turgor.core.solvers.path_outcomes import lost_path
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.step_options import StepOptions


@dataclass(frozen=True, slots=True)
class ScalarStrategy:
    """Strategy of a path whose pressures or load factor are unknown."""

    def next_parameter(self, run: Run) -> float:
        """The parameter that the step control gives."""
        return run.stepping.next_load(run.history[-1].parameter)

    def predict(self, run: Run, parameter: float) -> Start:
        """Extrapolate, compared by the unbalanced force."""
        return predicted(run.constraint, run.task.tangent, run.history, parameter, BY_PATH)

    def judge(self, run: Run, result: NewtonResult, parameter: float) -> Judgment:
        """Reject a step to another path."""
        if not result.converged or result.evaluation is None:
            return Judgment(None, result.reason)
        now = point_at(run, result.evaluation, parameter, result.scalars)
        verdict = judged(run, run.history[-1], now)
        return Judgment(now if verdict.reason is None else None, verdict.reason, verdict.passed)

    def rescue(self, run: Run) -> Rescue:
        """Say that no step is short enough; with an unknown load factor this is no limit point."""
        ending = lost_path(run) if run.size else stuck(run.task.system.model, run.states, run.steps, False)
        return Rescue(None, ending, run.memory)

    def accepted(self, run: Run, now: Point) -> StepControl:
        """The same step control."""
        return run.stepping

    def turn(self, run: Run, now: Point) -> Turn:
        """Start without history, with the rates beyond the kink."""
        constraint = run.constraint
        if constraint.clock.duration is not None:
            constraint = constraint.begun(now.parameter)
        at = constraint.evaluate(now.unknowns, now.parameter, now.scalars)
        assert at is not None
        first = point_at(replace(run, constraint=constraint), at, now.parameter, now.scalars, ahead=True)
        return Turn((first,), constraint, run.stepping.turned(run.task.procedure.first_step), run.memory)


@dataclass(frozen=True, slots=True)
class Goal:
    """Prescribed values of a path and its end.

    Parameters
    ----------
    driven : callable
        What is prescribed by its parameter, by the names of columns.
    finished : callable
        Where it ends.
    kinks : tuple of float
        Parameters beyond which it goes another way.
    limit_points : bool
        Whether maxima and minima of the scalars are limit points; not where all volumes stay, and pressures turn
        because other loads do.
    """

    driven: Callable[[float], dict[str, float]]
    finished: Callable[[Point, Point, Run], Ending | None]
    kinks: tuple[float, ...] = ()
    limit_points: bool = True


def scalar_run(
    problem: Problem, procedure: StepOptions, constraint: Constraint, stepping: StepControl, goal: Goal
) -> Run:
    """Make a run along a constraint that fills the lists of a problem."""
    task = Task(
        problem=problem,
        procedure=procedure,
        strategy=ScalarStrategy(),
        settings=settings_of(procedure),
        driven=goal.driven,
        finished=goal.finished,
        kinks=goal.kinks,
        limit_points=goal.limit_points,
    )
    return Run(task, constraint, stepping)
