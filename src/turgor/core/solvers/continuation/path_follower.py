"""Path follower: the one loop that steps along a path, whatever constraint drives it.

A strategy has the differences between load control and a path with scalar unknowns: how far the next step goes, where
Newton's method starts, whether a result is the next point of the path, and what to do when no step succeeds.
"""

from collections.abc import Callable
from dataclasses import replace
from time import perf_counter
from typing import Any

from turgor.core.solvers.checkpoints.loop import Loop
from turgor.core.solvers.continuation.limit_points import insert_limit_points
from turgor.core.solvers.continuation.path_points import solve_at
from turgor.core.solvers.continuation.path_run import Judgment, Point, Run
from turgor.core.solvers.continuation.scalar_control.arc_scaling import next_conditions
from turgor.core.solvers.continuation.settings import PREDICTOR
from turgor.core.solvers.continuation.step_control import in_vain
from turgor.core.solvers.newton.newton_values import NewtonResult
from turgor.core.solvers.outcomes import Outcome, interrupted, stopped_by, too_many_steps
from turgor.core.solvers.solution import Step


def follow(run: Run, other: Any = None) -> Outcome:
    """Step along the path from the last point of the history until it is finished.

    Parameters
    ----------
    run : Run
    other : dataclass, optional
        What else the steps change.

    Returns
    -------
    Outcome
    """
    return step_loop(
        Loop(run.task.problem, [run, other]),
        lambda: _advance(run),
        lambda: len(run.steps) >= run.task.procedure.max_steps,
        lambda: too_many_steps(run.task.system.model, run.states[-1], run.task.procedure),
    )


def step_loop(
    loop: Loop,
    attempt: Callable[[], Outcome | None],
    spent: Callable[[], bool],
    out_of_steps: Callable[[], Outcome],
) -> Outcome:
    """Attempt steps until one of them ends the run, the allowed number is spent, or the user presses Ctrl-C.

    Every accepted step is saved where the problem has a record. A loop that was ended from outside continues there.
    """
    problem = loop.problem

    def steps(keep: Callable[[], None]) -> Outcome:
        try:
            while not spent():
                outcome = attempt()
                if outcome is not None:
                    return outcome
                if problem.steps and problem.steps[-1].accepted:
                    keep()
            return out_of_steps()
        except KeyboardInterrupt:
            return interrupted(problem.system.model, problem.states[-1])

    return loop.follow(steps)


def _advance(run: Run) -> Outcome | None:
    """Attempt one step; return how the run ends, if it does."""
    task, last, began = run.task, run.history[-1], perf_counter()
    parameter = task.strategy.next_parameter(run)
    shorter = run.stepping.failed(parameter - last.parameter)
    run.constraint = run.constraint.begun(parameter)
    start = task.strategy.predict(run, parameter)
    load = run.constraint.scalar_unknowns.load_factor(parameter, start.scalars)
    result = solve_at(run, parameter, start, task.problem.listeners.reporter(len(run.steps) + 1, load))
    judgment = task.strategy.judge(run, result, parameter)
    noted(run, result, (parameter, perf_counter() - began), judgment)
    run.memory = judgment.memory or run.memory
    if judgment.point is None:
        if shorter is None or in_vain(run.steps):
            return _rescued(run)
        run.stepping = shorter
        return None
    run.bifurcations += judgment.passed
    return accept(run, judgment.point, result)


def _rescued(run: Run) -> Outcome | None:
    """Go on where no step succeeds; return how the run ends, if it does."""
    rescue = run.task.strategy.rescue(run)
    run.memory = rescue.memory
    return rescue.ending if rescue.reached is None else accept(run, *rescue.reached)


def noted(run: Run, result: NewtonResult, when: tuple[float, float], judgment: Judgment) -> None:
    """Note an attempted step to a parameter, with the seconds that it took."""
    parameter, seconds = when
    run.steps.append(
        Step(
            load_factor=run.constraint.scalar_unknowns.load_factor(parameter, result.scalars),
            increment=parameter - run.history[-1].parameter,
            iterations=result.iterations,
            residual=result.residual,
            accepted=judgment.point is not None,
            seconds=seconds,
            why=judgment.reason,
        )
    )
    run.task.problem.listeners.rejected(len(run.steps), run.steps[-1])


def accept(run: Run, now: Point, result: NewtonResult) -> Outcome | None:
    """Make a point the last state of the path; return how the run ends, if it does."""
    task, last = run.task, run.history[-1]
    run.history.append(now)
    del run.history[: -PREDICTOR.history]
    before, ending = insert_limit_points(run, last, now)
    ending = ending or task.finished(before, now, run)
    state = now.state if ending is None else ending.state
    run.states.append(state)
    run.constraint = replace(run.constraint, memory=state.memory)
    reason = task.problem.listeners.accepted(len(run.steps), state, result)
    if reason is not None:
        return stopped_by(task.system.model, state, reason)
    if ending is not None:
        return ending.outcome(run)
    touches = result.evaluation is not None and result.evaluation.contacts.touch
    run.stepping = run.stepping.accepted(now.parameter - last.parameter, result.hardest or result.iterations, touches)
    run.stepping = task.strategy.accepted(run, now)
    next_conditions(run, last, now)
    if now.parameter in task.kinks:
        _turn(run, now)
    return None


def _turn(run: Run, now: Point) -> None:
    """Go on beyond a kink."""
    turn = run.task.strategy.turn(run, now)
    run.history[:] = turn.history
    run.constraint, run.stepping, run.memory = turn.constraint, turn.stepping, turn.memory
