"""Cavity control: paths along which procedures prescribe a value for cavities, such as a volume or an amount of gas."""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.model.drive import kinks
from turgor.core.solvers.constraints.cavities import CavityPressures
from turgor.core.solvers.constraints.clock import Clock
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.continuation.path_follower import follow
from turgor.core.solvers.continuation.path_points import begin, nothing
from turgor.core.solvers.continuation.path_run import Ending, Point, Run
from turgor.core.solvers.continuation.scalar_control.scalar_path import Goal, scalar_run
from turgor.core.solvers.continuation.step_control import StepControl
from turgor.core.solvers.outcomes import Outcome
from turgor.core.solvers.path_outcomes import reached
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.restart import unknowns_of

Array = NDArray[np.float64]


def follow_cavities(problem: Problem, procedure: StepOptions) -> Outcome:
    """Find the pressures of the cavities for which a procedure prescribes a value, or to which channels lead."""
    system, restart = problem.system, problem.restart
    chambers, start = Chambers(system, system.controlled), unknowns_of(system, problem.start)
    pressures = np.zeros(len(chambers)) if restart is None else restart.pressures(system)
    volumes, requested = chambers.volumes(unknowns_of(system, problem.first)), procedure.requested
    target, now = procedure.target(chambers, volumes, pressures), problem.load_factor
    constraint = Constraint.of(CavityPressures(system), target, Clock(procedure.duration, now), problem.history)
    goal = Goal(
        _driven(procedure, procedure.amounts(chambers, volumes), system.controlled) if procedure.drive else nothing,
        _at_the_end,
        tuple(sorted({*kinks(system.model), *procedure.turns})),
        limit_points=bool(any(requested.values()) if isinstance(requested, Mapping) else requested),
    )
    stepping = StepControl.of(procedure, goal.kinks, system.model.sheets_wrinkle)
    run = scalar_run(problem, procedure, constraint, stepping, goal)
    begin(run, now, start, pressures)
    return follow(run)


def _driven(
    procedure: StepOptions, amounts: Callable[[float], Array], names: tuple[str, ...]
) -> Callable[[float], dict[str, float]]:
    """Prescribed amounts at a parameter, by column; with several cavities also by cavity: amounts add up."""
    what = procedure.drive

    def driven(parameter: float) -> dict[str, float]:
        values = amounts(parameter)
        if len(names) == 1:
            return {what: float(values[0])}
        each = {f"{what}_{name}": float(value) for name, value in zip(names, values, strict=True)}
        return {what: float(values.sum()), **each} if procedure.drive_unit else each

    return driven


def _at_the_end(before: Point, now: Point, run: Run) -> Ending | None:
    """The whole amount was injected."""
    if now.parameter < 1.0:
        return None
    return Ending(now.state, reached)
