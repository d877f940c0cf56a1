"""Arcs: paths whose load factor is sought, from where they begin to the bounds at which they end."""

from collections.abc import Callable, Sequence
from math import inf

import numpy as np

from turgor.engine.fields import cell_fields
from turgor.engine.system import System
from turgor.errors import TurgorError
from turgor.model.loads import RAMP
from turgor.model.model import Model
from turgor.solvers.controls import ArcTarget, Control, LoadFactor, displacement_of
from turgor.solvers.following import follow
from turgor.solvers.newton import NewtonSettings, Start, newton
from turgor.solvers.outcome import Outcome, stuck
from turgor.solvers.path_outcomes import followed, reached
from turgor.solvers.path_procedures import ArcLength
from turgor.solvers.points import Point, Run, fixed_load, silent, state_of
from turgor.solvers.problem import Array, Problem, begin, run_of
from turgor.solvers.solution import Step
from turgor.solvers.stepping import StepControl


def check_proportional(model: Model, what: str) -> None:
    """Refuse what a sought load factor cannot drive."""
    histories = [getattr(load, "history", RAMP) for load in model.loads]
    if any(history != RAMP for history in histories):
        raise TurgorError(f"{what} needs loads that grow in proportion to the load factor; leave out their histories.")


def check_still(system: System, what: str) -> None:
    """Refuse supports that move with a load factor that is sought."""
    if (system.prescribed(1.0) != system.prescribed(0.0)).any():
        raise TurgorError(f"{what} needs supports that stay in place; a Displacement moves with the load factor.")


def follow_arc(problem: Problem, procedure: ArcLength) -> Outcome:
    """Take the first step by the load, which sets the scale of the displacement, then go on by the arc."""
    system, tangent = problem.system, problem.tangent
    check_proportional(system.model, "ArcLength")
    check_still(system, "ArcLength")
    rest = system.evaluate(np.zeros(system.size), 0.0)
    assert rest is not None
    problem.states.append(state_of(system, rest, None, {}, {}))
    settings = NewtonSettings(tolerance=procedure.tolerance, max_iterations=procedure.max_iterations)
    load = procedure.first_step
    while True:
        first = newton(system, tangent, Start(rest.unknowns, system.stresses(rest)), load, settings, silent)
        problem.steps.append(_first_step(load, first.iterations, first.residual, first.converged, first.reason))
        if first.converged:
            break
        load *= 0.35
        if load < procedure.min_step:
            return stuck(system.model, problem.states, problem.steps, bool(first.unstable_modes))
    assert first.evaluation is not None
    return follow(arc_run(problem, first.evaluation.unknowns, load, procedure.max_stretch))


def arc_run(problem: Problem, unknowns: Array, load: float, max_stretch: float) -> Run:
    """A run by the arc length from a state on, in the direction in which it lies from the undeformed one."""
    system, procedure = problem.system, problem.procedure
    size = float(np.linalg.norm(unknowns[: 3 * system.node_count])) / load
    length, here = load * 2**0.5, np.array([load])
    along = displacement_of(system, unknowns) / (length * size**2)
    target = ArcTarget(system, size, length, unknowns, here, along, load / length)
    longest = procedure.max_step if isinstance(procedure, ArcLength) else 2 * procedure.max_step
    stepping = StepControl(length=length, max_step=longest, min_step=procedure.min_step, targets=(inf,))
    run = run_of(problem, Control(LoadFactor(system), target), stepping, nothing, bounds(max_stretch))
    begin(run, length, unknowns, here)
    if len(run.states) == 1:
        run.states.append(run.history[-1].state)
    return run


def _first_step(load: float, iterations: int, residual: float, accepted: bool, reason: str) -> Step:
    return Step(
        load_factor=load,
        increment=load,
        iterations=iterations,
        residual=residual,
        accepted=accepted,
        seconds=0.0,
        reason=reason,
    )


def bounds(
    max_stretch: float, enough: Callable[[Point, Run], bool] | None = None
) -> Callable[[Point, Point, Run], Outcome | None]:
    """End where the load factor reaches 1 or 0, the stretch or displacement its bound, or the cavities theirs."""

    def finished(before: Point, now: Point, run: Run) -> Outcome | None:
        procedure = run.task.procedure
        if isinstance(procedure, ArcLength):
            _insert_requested(run, before, now, procedure.at)
        low, high = float(before.scalars[0]), float(now.scalars[0])
        if low < 1.0 <= high:
            full = fixed_load(run, before, now, 1.0)
            if full is not None:
                run.states.append(full)
                return reached(run.states, run.steps, run.limits)
        grown = enough is not None and enough(now, run)
        why = "the cavities have grown as far as asked" if grown else _bound(run, now, max_stretch)
        if why is None:
            return None
        run.states.append(now.state)
        return followed(run.states, run.steps, run.limits, why)

    return finished


def _bound(run: Run, now: Point, max_stretch: float) -> str | None:
    state, procedure = now.state, run.task.procedure
    if now.scalars[0] <= 0:
        return "the load is back at zero"
    stretch = float(cell_fields(state.model, state.displacement, state.mean_stress).stretch.max())
    if stretch >= max_stretch:
        return f"the largest stretch has reached {stretch:.3g}"
    if isinstance(procedure, ArcLength) and procedure.max_displacement is not None:
        moved = float(np.linalg.norm(state.displacement, axis=1).max())
        if moved >= procedure.max_displacement:
            return f"the largest displacement has reached {moved * 1e3:.4g} mm"
    return None


def _insert_requested(run: Run, before: Point, now: Point, requested: Sequence[float]) -> None:
    """Make states at the load factors that were asked for, in the order in which the path crosses them."""
    low, high = float(before.scalars[0]), float(now.scalars[0])
    between = [factor for factor in requested if min(low, high) < factor < max(low, high)]
    for factor in sorted(between, reverse=high < low):
        state = fixed_load(run, before, now, factor)
        if state is not None:
            run.states.append(state)


def nothing(_: float) -> dict[str, float]:
    """Prescribe nothing but the load factor."""
    return {}
