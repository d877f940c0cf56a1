"""Branch: the path that leaves another one at a bifurcation, along the mode that becomes unstable there."""

from dataclasses import replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.system import System
from turgor.core.solvers.buckling.buckling_modes import tangent_at, tangent_rate
from turgor.core.solvers.buckling.settings import BUCKLING
from turgor.core.solvers.constraints.arc import Arc
from turgor.core.solvers.constraints.clock import Clock
from turgor.core.solvers.constraints.load_factor import ArcTarget
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.continuation.path_follower import follow
from turgor.core.solvers.continuation.path_points import begin, nothing
from turgor.core.solvers.continuation.path_run import Ending, Point, Run
from turgor.core.solvers.continuation.scalar_control.arc_length import Bounds, bounds, first_arc
from turgor.core.solvers.continuation.scalar_control.scalar_path import Goal, scalar_run
from turgor.core.solvers.continuation.step_control import StepControl
from turgor.core.solvers.continuation.tangent_response import load_response
from turgor.core.solvers.listeners import silent
from turgor.core.solvers.newton.newton import newton
from turgor.core.solvers.newton.newton_values import Start
from turgor.core.solvers.outcomes import Outcome
from turgor.core.solvers.path_outcomes import followed
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.restart import unknowns_of

Array = NDArray[np.float64]


def follow_branch(problem: Problem, procedure: StepOptions, limit: Bounds, side: int) -> Outcome:
    """Follow the path to its first bifurcation, and go on along the other one, to a side of the mode: 1 or −1."""
    ends = bounds(limit)

    def finished(before: Point, now: Point, run: Run) -> Ending | None:
        if not run.bifurcations:
            return ends(before, now, run)
        return Ending(run.bifurcations[0].state, lambda run: followed(run, "a bifurcation was met"))

    run = first_arc(problem, procedure, finished)
    if isinstance(run, Outcome):
        return run
    outcome = follow(run)
    if not run.bifurcations:
        return replace(outcome, message=f"{outcome.message} No bifurcation was met, where branch {side} would leave.")
    begun, load_factor = _branch_run(run, procedure, limit, side)
    outcome, where = follow(begun), f"load factor {load_factor:.4g}"
    return replace(outcome, message=f"{outcome.message} Took branch {side} at the bifurcation at {where}.")


def _branch_run(run: Run, procedure: StepOptions, limit: Bounds, side: int) -> tuple[Run, float]:
    """A run from the bifurcation of another one along the mode that becomes unstable, and its load factor there."""
    system, problem = run.task.system, run.task.problem
    unknowns, load_factor, along = _closer(run)
    here, mode = np.array([load_factor]), side * along
    length = min(procedure.first_step, procedure.max_step)
    size = BUCKLING.first_move / length / float(np.linalg.norm(system.displacement(mode), axis=1).max())
    target = ArcTarget(system, size, 0.0, unknowns, here, Arc.along(mode, 0.0, system.moving / size**2))
    stepping = StepControl(
        length=length,
        max_step=procedure.max_step,
        min_step=procedure.min_step,
        targets=(inf,),
    )
    constraint = replace(run.constraint, target=target, clock=Clock())
    other = scalar_run(problem, procedure, constraint, stepping, Goal(nothing, bounds(limit)))
    other.size = size
    begin(other, 0.0, unknowns, here)
    first = other.history[0]
    state = replace(first.state, unstable_modes=None)  # the count is that of the path that is left
    other.history[0] = replace(first, change=size * mode, slope=np.zeros(1), state=state)
    problem.states[-1] = state
    return other, load_factor


def _closer(run: Run) -> tuple[Array, float, Array]:
    """Unknowns (size,) and load factor where the tangent is singular, and the mode (size,) there.

    The first step along the branch is short, and the state that the path met is too far beyond for it. Newton's method
    for the stiffness of the mode goes closer: its rate with the load is a difference of tangents.
    """
    system, tangent = run.task.system, run.task.tangent
    state = run.bifurcations[0].state
    unknowns, load_factor = unknowns_of(system, state), state.load_factor
    constraint = load_control(system, history=run.constraint.history)
    tangent.use_double()
    mode = _unstable_mode(run, unknowns, load_factor)
    for _ in range(BUCKLING.closer):
        response = load_response(system, tangent, unknowns)
        here = unknowns, load_factor, constraint.history
        rate = _stiffness(system, tangent_rate(system, here, response), mode)
        change = -_stiffness(system, tangent_at(system, here), mode) / rate
        if abs(change) < BUCKLING.close * abs(load_factor):
            break
        start = Start(unknowns + change * response, None)
        result = newton(constraint, tangent, start, load_factor + change, run.task.settings, silent)
        if not result.converged or result.evaluation is None:
            break
        unknowns, load_factor = result.evaluation.unknowns, load_factor + change
        mode = _unstable_mode(run, unknowns, load_factor)
    return unknowns, load_factor, mode


def _stiffness(system: System, data: Array, mode: Array) -> float:
    """Work of a mode on itself through the tangent, or through its rate."""
    return float(mode @ system.pattern.product(data, mode))


def _unstable_mode(run: Run, unknowns: Array, load_factor: float) -> Array:
    """Vector (size,) with the eigenvalue of the tangent closest to zero, by inverse iteration; its motion is 1 long."""
    system, tangent = run.task.system, run.task.tangent
    at = system.evaluate(unknowns, load_factor, history=run.constraint.history)
    assert at is not None
    tangent.factor(at)
    free = system.moving & ~system.prescribed
    mode = np.where(free, np.random.default_rng(1).normal(size=system.size), 0.0)
    for _ in range(BUCKLING.inverse_iterations):
        mode = tangent.solve(np.where(free, mode, 0.0))
        mode[system.prescribed] = 0.0
        mode /= float(np.linalg.norm(mode[free]))
    shape = system.displacement(mode)
    farthest = shape[np.linalg.norm(shape, axis=1).argmax()]
    return np.asarray(mode * (1 if farthest.sum() >= 0 else -1))
