"""Arc length: follow paths whose load factor is unknown, from their start to their bounds."""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.engine.cells.internal_variables import Memory
from turgor.core.engine.fields import cell_fields
from turgor.core.engine.system import System
from turgor.core.model.history import is_straight, share_at
from turgor.core.model.model import Model
from turgor.core.solvers.constraints.arc import Arc
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.constraints.load_factor import ArcTarget, LoadFactor, displacement_of
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.continuation.path_follower import follow
from turgor.core.solvers.continuation.path_points import begin, fixed_load, nothing, settings_of
from turgor.core.solvers.continuation.path_run import Ending, Point, Run
from turgor.core.solvers.continuation.scalar_control.path_reversal import reverses
from turgor.core.solvers.continuation.scalar_control.scalar_path import Goal, scalar_run
from turgor.core.solvers.continuation.settings import STEP_CONTROL
from turgor.core.solvers.continuation.step_control import StepControl
from turgor.core.solvers.continuation.tangent_response import exceeds_tangent, load_response, rate_at
from turgor.core.solvers.listeners import silent
from turgor.core.solvers.newton.newton import newton
from turgor.core.solvers.newton.newton_values import Start
from turgor.core.solvers.outcomes import Outcome, stuck
from turgor.core.solvers.path_outcomes import followed, reached, turned_back
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.restart import unknowns_of
from turgor.core.solvers.solution import Step
from turgor.core.solvers.states import state_of
from turgor.core.solvers.step_reasons import Cause, Reason
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

Finished = Callable[[Point, Point, Run], Ending | None]


def check_proportional(model: Model, what: str) -> None:
    """Refuse loads that a load factor cannot scale."""
    if not all(is_straight(load.history) for load in model.loads):
        raise TurgorError(f"{what} needs loads that grow in proportion to the load factor; leave out their histories.")


def check_still(system: System, what: str) -> None:
    """Refuse supports that move with a load factor that is unknown."""
    if (system.prescribed_values(1.0) != system.prescribed_values(0.0)).any():
        raise TurgorError(f"{what} needs supports that stay in place; a Displacement moves with the load factor.")


def _check_driven(model: Model) -> None:
    """Refuse an arc along which no load changes, or an obstacle moves."""
    for obstacle in model.contact.obstacles:
        if obstacle.moves(0.0, 1.0):
            raise TurgorError(f"ArcLength needs obstacles that stay in place, and '{obstacle.name}' moves.")
    if all(share_at(load.history, 0.0) == share_at(load.history, 1.0) for load in model.loads):
        raise TurgorError("ArcLength follows loads that change, and here none does; state one.")


def follow_arc(problem: Problem, procedure: StepOptions, limit: "Bounds") -> Outcome:
    """Take the first step under load control, which scales the displacement, then prescribe the arc length."""
    return _followed(first_arc(problem, procedure, bounds(limit)))


def first_arc(problem: Problem, procedure: StepOptions, ends: Finished) -> Run | Outcome:
    """A run by the arc length from rest on, or why its first step failed."""
    check_proportional(problem.system.model, "ArcLength")
    check_still(problem.system, "ArcLength")
    _check_driven(problem.system.model)
    rest = problem.system.evaluate(start_of(problem), 0.0, history=problem.history)
    assert rest is not None
    problem.states.append(state_of(problem.system, rest, None))
    return _run_from_rest(problem, procedure, (procedure.first_step, procedure.max_step), ends)


def _followed(begun: Run | Outcome) -> Outcome:
    return begun if isinstance(begun, Outcome) else follow(begun)


def from_rest(problem: Problem, procedure: StepOptions, lengths: tuple[float, float], ends: Finished) -> Outcome:
    """Take a first step by the load, at most as long as requested, and go on by arcs up to a longest one."""
    return _followed(_run_from_rest(problem, procedure, lengths, ends))


def _run_from_rest(
    problem: Problem, procedure: StepOptions, lengths: tuple[float, float], ends: Finished
) -> Run | Outcome:
    system, tangent, settings, (load, longest) = problem.system, problem.tangent, settings_of(procedure), lengths
    problem = slowly(problem, problem.memory)
    rest = start_of(problem)
    at_rest = system.evaluate(rest, 0.0, history=problem.history)
    assert at_rest is not None
    stresses, (rate, modes) = system.stresses(at_rest), rate_at(system, tangent, at_rest)
    while True:
        constraint = load_control(system, history=problem.history)
        first = newton(constraint, tangent, Start(rest, stresses), load, settings, silent)
        reason = first.reason
        if first.evaluation is not None and first.converged:
            faster, unstable = rate_at(system, tangent, first.evaluation)
            leaps = exceeds_tangent(system, first.evaluation.unknowns - rest, load, (rate, faster))
            reason = Reason(Cause.BRANCH_JUMP) if leaps else None
            reason = Reason(Cause.UNSTABLE) if (unstable or 0) > (modes or 0) else reason
        problem.steps.append(_first_step(load, first.iterations, first.residual, reason))
        problem.listeners.rejected(len(problem.steps), problem.steps[-1])
        if first.converged and reason is None:
            break
        load *= STEP_CONTROL.step_cut
        if load < procedure.min_step:
            return stuck(system.model, problem.states, problem.steps, bool(first.unstable_modes))
    assert first.evaluation is not None
    return arc_run(problem, procedure, (first.evaluation.unknowns, load), (load * 2**0.5, longest), ends)


def arc_run(
    problem: Problem, procedure: StepOptions, at: tuple[Array, float], steps: tuple[float, float], ends: Finished
) -> Run:
    """A run by the arc length from a stable state on, to where the load rises, with a first and a longest step."""
    system, (unknowns, load) = problem.system, at
    size, here = displacement_scale(problem, unknowns, load), np.array([load])
    target = ArcTarget(system, size, 0.0, unknowns, here, _direction(problem, unknowns, load, size))
    length, longest = steps
    stepping = StepControl(length=min(length, longest), max_step=longest, min_step=procedure.min_step, targets=(inf,))
    constraint = Constraint.of(LoadFactor(system), target, history=problem.history)
    run = scalar_run(problem, procedure, constraint, stepping, Goal(nothing, ends))
    run.size = size
    begin(run, 0.0, unknowns, here)
    if len(run.states) == 1:
        run.states.append(run.history[-1].state)
    return run


def displacement_scale(problem: Problem, unknowns: Array, load: float) -> float:
    """Displacement that counts as much as a load factor of 1: that of the state over its load."""
    return float(np.linalg.norm(displacement_of(problem.system, unknowns - start_of(problem)))) / load


def slowly(problem: Problem, memory: Memory | None) -> Problem:
    """The problem with its memory at an infinitely slow step."""
    return replace(problem, history=problem.system.history(memory, inf))


def start_of(problem: Problem) -> Array:
    """Unknowns (size,) at load factor 0."""
    return unknowns_of(problem.system, problem.start)


def _direction(problem: Problem, unknowns: Array, load: float, size: float) -> Arc:
    """Direction in which the load rises; from rest to here where the tangent is singular."""
    system = problem.system
    at = system.evaluate(unknowns, load, history=problem.history)
    assert at is not None
    response = (unknowns - start_of(problem)) / load
    with suppress(SingularTangentError):
        problem.tangent.factor(at)
        response = load_response(system, problem.tangent, unknowns)
    return Arc.along(response, 1.0, system.moving / size**2)


def _first_step(load: float, iterations: int, residual: float, reason: Reason | None) -> Step:
    return Step(
        load_factor=load,
        increment=load,
        iterations=iterations,
        residual=residual,
        accepted=reason is None,
        seconds=0.0,
        why=reason,
    )


@dataclass(frozen=True, slots=True)
class Bounds:
    """Where a path ends whatever its load.

    Parameters
    ----------
    max_stretch : float [-]
    max_displacement : float or None [m]
    at : tuple of float [-]
        Load factors at which states are made on the way.
    past : float [-]
        Volume of cavities that drive the path over that at its first limit point.
    """

    max_stretch: float
    max_displacement: float | None = None
    at: tuple[float, ...] = ()
    past: float = inf


def bounds(limit: Bounds, enough: Callable[[Point, Run], bool] | None = None) -> Finished:
    """End where the load factor reaches 1 or 0, the stretch or displacement its bound, or the cavities theirs."""

    def finished(before: Point, now: Point, run: Run) -> Ending | None:
        _insert_requested(run, before, now, limit.at)
        low, high = float(before.scalars[0]), float(now.scalars[0])
        if low < 1.0 <= high:
            full = fixed_load(run, before, now, 1.0)
            if full is not None:
                run.bifurcations[:] = [each for each in run.bifurcations if each.load_factor <= 1]
                return Ending(full, lambda run: reached(run, run.bifurcations))
        if reverses(run, now):
            return Ending(now.state, turned_back)
        grown = enough is not None and enough(now, run)
        why = "the cavities have grown as far as requested" if grown else _bound(now, limit)
        return None if why is None else Ending(now.state, lambda run: followed(run, why))

    return finished


def _bound(now: Point, limit: Bounds) -> str | None:
    state = now.state
    if now.scalars[0] <= 0:
        begun = any(share_at(load.history, 0.0) for load in state.model.loads)
        return "the loads are back at what they were at first" if begun else "the load is back at zero"
    fields = cell_fields(state.model, state.displacement, state.mean_stress, None, state.load_factor)
    stretch = float(fields.stretch.max(initial=1.0))
    if stretch >= limit.max_stretch:
        return f"the largest stretch has reached {stretch:.3g}"
    if limit.max_displacement is not None:
        moved = float(np.linalg.norm(state.displacement, axis=1).max())
        if moved >= limit.max_displacement:
            return f"the largest displacement has reached {moved * 1e3:.4g} mm"
    return None


def _insert_requested(run: Run, before: Point, now: Point, requested: Sequence[float]) -> None:
    """Make states at the requested load factors, in the order in which the path crosses them."""
    low, high = float(before.scalars[0]), float(now.scalars[0])
    between = [factor for factor in requested if min(low, high) < factor < max(low, high)]
    for factor in sorted(between, reverse=high < low):
        state = fixed_load(run, before, now, factor)
        if state is not None:
            run.states.append(state)
