"""Following: step along the path of a control, find the limit points on it, and end where it was asked to."""

from collections.abc import Callable
from time import perf_counter

import numpy as np

from turgor.solvers.continuation.arc_scaling import go_onward
from turgor.solvers.continuation.continuity import Verdict, judged
from turgor.solvers.continuation.limit_points import insert_limit_points
from turgor.solvers.continuation.path_points import Point, Run, between, point_at, solve_at
from turgor.solvers.continuation.predictor import HISTORY
from turgor.solvers.newton.newton import NewtonResult, Start
from turgor.solvers.outcomes import Outcome, interrupted, stopped_by, stuck, too_many_steps
from turgor.solvers.path_outcomes import lost_path
from turgor.solvers.solution import Iteration, Step


def follow(run: Run) -> Outcome:
    """Step along the path from the last point of the history until it is finished."""
    try:
        while True:
            if len(run.steps) >= run.task.procedure.max_steps:
                return too_many_steps(run.task.system.model, run.states[-1], run.task.procedure)
            outcome = _advance(run)
            if outcome is not None:
                return outcome
    except KeyboardInterrupt:
        return interrupted(run.task.system.model, run.states[-1])


def _advance(run: Run) -> Outcome | None:
    """Attempt one step; return how the run ends, if it does."""
    last, began = run.history[-1], perf_counter()
    parameter = run.stepping.next_load(last.parameter)
    run.control.clock.begin(run.task.system, parameter)
    result = solve_at(run, parameter, _start(run, parameter), _reporter(run, parameter))
    increment = parameter - last.parameter
    now, verdict = None, Verdict(result.reason)
    if result.converged and result.evaluation is not None:
        now = point_at(run, result.evaluation, parameter, result.scalars)
        verdict = judged(run, last, now)
    run.steps.append(
        Step(
            load_factor=run.control.sought.load_factor(parameter, result.scalars),
            increment=increment,
            iterations=result.iterations,
            residual=result.residual,
            accepted=now is not None and verdict.reason is None,
            seconds=perf_counter() - began,
            why=verdict.reason,
        )
    )
    if now is None or verdict.reason is not None:
        shorter = run.stepping.failed(increment)
        if shorter is None:
            return _stuck(run)
        run.stepping = shorter
        return None
    assert result.evaluation is not None
    run.task.system.contact.accept(result.evaluation.contacts)  # after the state has been read
    run.bifurcations += verdict.passed
    return _accept(run, last, now, result)


def _stuck(run: Run) -> Outcome:
    """No step is short enough: on a path whose load factor is sought this is no limit point."""
    if run.size:
        return lost_path(run)
    return stuck(run.task.system.model, run.states, run.steps, False)


def _accept(run: Run, last: Point, now: Point, result: NewtonResult) -> Outcome | None:
    task = run.task
    run.history.append(now)
    del run.history[:-HISTORY]
    before, ending = insert_limit_points(run, last, now)
    ending = ending or task.finished(before, now, run)
    if ending is not None:
        return ending
    run.states.append(now.state)
    task.system.materials.memory = now.state.memory
    if task.progress is not None:
        task.progress(_iteration(run, now.state.load_factor, (result.iterations, result.residual, 0.0, 1.0)), now.state)
    reason = task.stop(now.state) if task.stop is not None else None
    if reason is not None:
        return stopped_by(task.system.model, now.state, reason)
    run.stepping = run.stepping.accepted(now.parameter - last.parameter, result.hardest or result.iterations)
    go_onward(run, last, now)
    if now.parameter in task.kinks:
        _turn(run, now)
    return None


def _turn(run: Run, now: Point) -> None:
    """Beyond a kink the path goes another way: its past predicts nothing, and its rates are those ahead."""
    if run.control.clock.duration is not None:
        run.control.clock.begin(run.task.system, now.parameter)
    at = run.control.sought.evaluate(now.unknowns, now.parameter, now.scalars)
    assert at is not None
    run.history[:] = [point_at(run, at, now.parameter, now.scalars, ahead=True)]
    run.stepping = run.stepping.turned(run.task.procedure.first_step)


def _start(run: Run, parameter: float) -> Start:
    """Extrapolate with the order that a lower one does not improve, judged by the conditions and the residual."""
    best, smallest = between(run.history[-1:], parameter), np.inf
    for count in range(len(run.history), 0, -1):
        trial = between(run.history[-count:], parameter)
        at = run.control.sought.evaluate(trial.unknowns, parameter, trial.scalars)
        size = np.inf if at is None else float(np.linalg.norm(at.residual[~run.task.system.held]))
        if np.isfinite(smallest) and size >= smallest:
            break
        if size < smallest and (count > 1 or not np.isfinite(smallest)):
            best, smallest = trial, size
    return best


def _reporter(run: Run, parameter: float) -> Callable[[int, float, float, float], None]:
    def report(iteration: int, residual: float, correction: float, length: float) -> None:
        if run.task.progress is not None:
            factor = run.states[-1].load_factor
            run.task.progress(_iteration(run, factor, (iteration, residual, correction, length), 1), None)

    return report


def _iteration(run: Run, load: float, how: tuple[int, float, float, float], ahead: int = 0) -> Iteration:
    iteration, residual, correction, length = how
    return Iteration(
        step=len(run.steps) + ahead,
        iteration=iteration,
        load_factor=load,
        residual=residual,
        correction=correction,
        step_length=length,
    )
