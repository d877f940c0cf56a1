"""Cavity control: paths along which the volumes or the amounts of gas of cavities are given."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.engine.system import System
from turgor.core.meshing.openings import torn_rims
from turgor.core.meshing.surface import outer_triangles, rim_edges
from turgor.core.model.drive import kinks
from turgor.core.model.model import Model
from turgor.core.solvers.constraints.cavities import CavityPressures, GasTarget, VolumeTarget
from turgor.core.solvers.constraints.clock import Clock
from turgor.core.solvers.constraints.constraint import Constraint, Target
from turgor.core.solvers.continuation.path_follower import follow
from turgor.core.solvers.continuation.path_points import begin
from turgor.core.solvers.continuation.path_run import Ending, Point, Run
from turgor.core.solvers.continuation.scalar_control.scalar_path import Goal, scalar_run
from turgor.core.solvers.continuation.scalar_control.settings import CAVITY_CONTROL
from turgor.core.solvers.continuation.step_control import StepControl
from turgor.core.solvers.outcomes import Outcome
from turgor.core.solvers.path_outcomes import reached
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.gas_mass import GasMass
from turgor.core.solvers.procedures.volume_control import VolumeControl
from turgor.core.solvers.restart import unknowns_of
from turgor.foundation.errors import TurgorError, unknown

Array = NDArray[np.float64]


def controlled_faces(model: Model, procedure: VolumeControl | GasMass) -> tuple[str, ...]:
    """Name the cavities whose pressure is unknown in a procedure.

    Raises
    ------
    TurgorError
        If a cavity is unknown, encloses no volume, or has a pressure of its own already.
    """
    field, names = procedure.requested_field, filled_cavities(model, procedure)
    for name in names:
        if any(load.face == name for load in model.pressures):
            raise TurgorError(
                f"{name} has a pressure load, and procedure.{field} seeks its pressure; leave the load out."
            )
        rim = rim_edges(model.mesh.face(name))
        if torn_rims(model.mesh, outer_triangles(model.mesh), rim):
            raise TurgorError(f"{name} encloses no volume that procedure.{field} could drive; close it (G02).")
    return names


def filled_cavities(model: Model, procedure: VolumeControl | GasMass) -> tuple[str, ...]:
    """Name the cavities that a procedure fills.

    Raises
    ------
    TurgorError
        If a cavity does not exist, or none is named where there are several.
    """
    requested, field, known = procedure.requested, procedure.requested_field, model.mesh.cavities
    if not isinstance(requested, Mapping):
        if len(known) != 1:
            if not known:
                raise TurgorError(
                    f"procedure.{field} fills a cavity, and the model has no cavity: no face encloses one."
                )
            names = ", ".join(known)
            given = "is one number" if field != "cavities" else "names none"
            raise TurgorError(f"procedure.{field} {given}, and the cavities are {names}; give one for each by name.")
        return tuple(known)
    for name in requested:
        if name not in known:
            raise unknown(f"cavity in procedure.{field}", name, known)
    return tuple(requested)


def follow_volume(problem: Problem, procedure: VolumeControl) -> Outcome:
    """Seek the pressures of cavities whose volumes are given."""
    system, (start, pressures, chambers) = problem.system, _now(problem)
    volumes, injected = chambers.volumes(start), of_each(procedure.volume, system.controlled)
    target = VolumeTarget(chambers, volumes, injected / system.length**3)
    before = (volumes - chambers.volumes(np.zeros(system.size))) * system.length**3
    driven = _amounts("injected_volume", system.controlled, before, before + injected)
    goal = Goal(driven, _at_the_end, kinks(system.model), limit_points=bool(injected.any()))
    return _follow(problem, procedure, target, goal, (start, pressures))


def follow_gas(problem: Problem, procedure: GasMass) -> Outcome:
    """Seek the pressures of cavities whose amounts of gas are given."""
    system, (start, pressures, chambers) = problem.system, _now(problem)
    volumes, ratios = chambers.volumes(start), of_each(procedure.mass_ratio, system.controlled)
    _check_room(system, volumes)
    target = gas_target(chambers, procedure, ratios, (volumes, pressures))
    driven = _amounts("gas_mass_ratio", system.controlled, np.ones(len(volumes)), ratios, target.seal)
    turns = {*kinks(system.model), *(() if target.sealed else (target.seal,))}
    return _follow(problem, procedure, target, Goal(driven, _at_the_end, tuple(sorted(turns))), (start, pressures))


def _now(problem: Problem) -> tuple[Array, Array, Chambers]:
    """Unknowns and scaled pressures at rest or where a former stage ended, and the cavities."""
    system, restart = problem.system, problem.restart
    chambers = Chambers(system, system.controlled)
    pressures = np.zeros(len(chambers)) if restart is None else restart.pressures(system)
    return unknowns_of(system, problem.start), pressures, chambers


def _follow(
    problem: Problem, procedure: VolumeControl | GasMass, target: Target, goal: Goal, now: tuple[Array, Array]
) -> Outcome:
    """Follow the path of a target for the pressures of cavities."""
    constraint = Constraint.of(CavityPressures(problem.system), target, Clock(procedure.duration), problem.history)
    stepping = StepControl.of(procedure, goal.kinks, problem.system.model.sheets_wrinkle)
    run = scalar_run(problem, procedure, constraint, stepping, goal)
    begin(run, 0.0, *now)
    return follow(run)


def _check_room(system: System, volumes: Array) -> None:
    """Refuse cavities without volume: they hold no gas at rest, so a ratio to it has no meaning."""
    least = CAVITY_CONTROL.no_volume * float(np.ptp(system.points, axis=0).prod())
    for name, volume in zip(system.controlled, volumes, strict=True):
        if volume <= least:
            raise TurgorError(f"{name} encloses no volume at rest, so it holds no gas; use VolumeControl.")


def of_each(values: float | Mapping[str, float], names: Sequence[str]) -> Array:
    """Return the requested value of each cavity (k,)."""
    return np.array([values[name] for name in names] if isinstance(values, Mapping) else [values], dtype=np.float64)


def gas_target(chambers: Chambers, procedure: GasMass, ratios: Array, now: tuple[Array, Array]) -> GasTarget:
    """The law of the gas in scaled units, from the scaled volumes and pressures of now."""
    system, (volumes, pressures) = chambers.system, now
    for name, volume in zip(system.controlled, volumes, strict=True):
        if volume <= 0:
            raise TurgorError(f"{name} encloses no volume at rest, so it holds no gas; use volume control.")
    first = procedure.pressure / system.stress_scale
    return GasTarget(
        chambers=chambers,
        volume=volumes,
        mass_ratio=ratios,
        ambient=procedure.ambient / system.stress_scale,
        outside=procedure.final_outside / system.stress_scale,
        exponent=procedure.exponent,
        pressure=np.full(len(volumes), first) if first else pressures,
        seal=procedure.seal if first else 0.0,
        sealed=not first,
    )


def _amounts(
    what: str, names: Sequence[str], first: Array, last: Array, begin: float = 0.0
) -> Callable[[float], dict[str, float]]:
    """What is prescribed at a parameter, by column; with several cavities also by cavity."""

    def driven(parameter: float) -> dict[str, float]:
        values = first + max(parameter - begin, 0.0) / (1 - begin) * (last - first)
        if len(names) == 1:
            return {what: float(values[0])}
        each = {f"{what}_{name}": float(value) for name, value in zip(names, values, strict=True)}
        return {what: float(values.sum()), **each} if what == "injected_volume" else each

    return driven


def _at_the_end(before: Point, now: Point, run: Run) -> Ending | None:
    """All was injected."""
    if now.parameter < 1.0:
        return None
    return Ending(now.state, lambda run: reached(run.states, run.steps, run.limits))
