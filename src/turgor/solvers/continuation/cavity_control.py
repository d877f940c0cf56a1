"""Paths: what each procedure controls, and where its path begins and ends."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.engine.chambers import Chambers
from turgor.engine.system import System
from turgor.errors import TurgorError, unknown
from turgor.meshing.openings import torn_rims
from turgor.meshing.surface import outer_triangles, rim_edges
from turgor.model.drive import kinks
from turgor.model.model import Model
from turgor.solvers.constraints.cavities import CavityPressures, GasTarget, VolumeTarget
from turgor.solvers.constraints.clock import Clock
from turgor.solvers.constraints.constraint import Constraint, Target
from turgor.solvers.continuation.arc_length import check_proportional, check_still, follow_arc
from turgor.solvers.continuation.branch_switch import History, Watch, go_past, load_control, lost
from turgor.solvers.continuation.path_follower import follow
from turgor.solvers.continuation.path_points import Point, Run
from turgor.solvers.continuation.problem import Problem as Problem
from turgor.solvers.continuation.problem import begin, run_of
from turgor.solvers.continuation.step_control import StepControl
from turgor.solvers.outcomes import Outcome
from turgor.solvers.path_outcomes import reached
from turgor.solvers.procedures.arc_length import ArcLength
from turgor.solvers.procedures.auto import Auto
from turgor.solvers.procedures.gas_mass import GasMass
from turgor.solvers.procedures.stages import Sealed
from turgor.solvers.procedures.static import Static
from turgor.solvers.procedures.volume_control import VolumeControl
from turgor.solvers.restart import unknowns_of
from turgor.solvers.solution import Procedure, State

Array = NDArray[np.float64]

#: A cavity with less than this share of the box around the body has no volume.
NO_VOLUME = 1e-9

ByLoad = Callable[[Static, Callable[[State], str | None]], Outcome]


def controlled_faces(model: Model, procedure: Procedure) -> tuple[str, ...]:
    """Name the cavities whose pressure a procedure seeks.

    Raises
    ------
    TurgorError
        If a cavity is unknown, encloses no volume, or has a pressure of its own already.
    """
    if not isinstance(procedure, VolumeControl | GasMass):
        return ()
    field, names = _field(procedure), asked_cavities(model, procedure)
    for name in names:
        if any(load.face == name for load in model.pressures):
            raise TurgorError(
                f"{name} has a pressure load, and procedure.{field} seeks its pressure; leave the load out."
            )
        rim = rim_edges(model.mesh.face(name))
        if torn_rims(model.mesh, outer_triangles(model.mesh), rim):
            raise TurgorError(f"{name} encloses no volume that procedure.{field} could drive; close it (G02).")
    return names


def asked_cavities(model: Model, procedure: VolumeControl | GasMass) -> tuple[str, ...]:
    """Name the cavities that a procedure fills.

    Raises
    ------
    TurgorError
        If a cavity is unknown, or it is not said which one.
    """
    asked = procedure.volume if isinstance(procedure, VolumeControl) else procedure.mass_ratio
    field, known = _field(procedure), model.mesh.cavities
    if not isinstance(asked, Mapping):
        if len(known) != 1:
            names = ", ".join(known) or "none"
            told = "is one number" if field != "cavities" else "names none"
            raise TurgorError(f"procedure.{field} {told}, and the cavities are {names}; give one for each by name.")
        return tuple(known)
    for name in asked:
        if name not in known:
            raise unknown(f"cavity in procedure.{field}", name, known)
    return tuple(asked)


def _field(procedure: VolumeControl | GasMass) -> str:
    """What the user calls the amounts."""
    if isinstance(procedure, Sealed):
        return "cavities"
    return "volume" if isinstance(procedure, VolumeControl) else "mass_ratio"


def follow_path(problem: Problem, by_load: ByLoad, history: History) -> Outcome:
    """Follow the path of any procedure but load control from the undeformed state.

    Parameters
    ----------
    problem : Problem
    by_load : callable
        ``by_load(static, stop) -> Outcome`` follows the path by the load, and fills the lists of the problem.
    history : sequence
        Load factors, unknowns and stresses of the last states that it found.
    """
    procedure = problem.procedure
    if isinstance(procedure, ArcLength):
        return follow_arc(problem, procedure)
    if isinstance(procedure, Auto):
        check_proportional(problem.system.model, "procedure auto")
        check_still(problem.system, "procedure auto")
        watch = Watch.at_rest(problem, history)
        outcome = by_load(load_control(procedure), watch)
        return go_past(problem, watch) if lost(outcome, watch) else outcome
    return _follow_cavities(problem, procedure)


def _follow_cavities(problem: Problem, procedure: VolumeControl | GasMass) -> Outcome:
    """Seek the pressures of cavities, from the undeformed state or from where a former stage ended."""
    system, carried = problem.system, problem.carried
    chambers = Chambers(system, system.controlled)
    start = unknowns_of(system, None if carried is None else carried.state)
    pressures = np.zeros(len(chambers)) if carried is None else carried.pressures(system)
    volumes = chambers.volumes(start)
    target: Target
    if isinstance(procedure, VolumeControl):
        injected = _each(procedure.volume, system.controlled)
        target = VolumeTarget(chambers, volumes, injected / system.length**3)
        before = (volumes - chambers.volumes(np.zeros(system.size))) * system.length**3
        driven = _amounts("injected_volume", system.controlled, before, before + injected)
    else:
        _check_room(system, volumes)
        ratios = _each(procedure.mass_ratio, system.controlled)
        target = _gas(chambers, procedure, ratios, (volumes, pressures))
        driven = _amounts("gas_mass_ratio", system.controlled, np.ones(len(volumes)), ratios, target.seal)
    seal = (target.seal,) if isinstance(target, GasTarget) and not target.sealed else ()
    turns = tuple(sorted({*kinks(system.model), *seal}))
    control = Constraint(CavityPressures(system), target, Clock(procedure.duration))
    run = run_of(problem, control, StepControl.of(procedure, turns), driven, _at_the_end, turns)
    begin(run, 0.0, start, pressures)
    return follow(run)


def _check_room(system: System, volumes: Array) -> None:
    """Refuse to put gas into what has no volume, where a ratio to the gas at rest says nothing."""
    least = NO_VOLUME * float(np.ptp(system.points, axis=0).prod())
    for name, volume in zip(system.controlled, volumes, strict=True):
        if volume <= least:
            raise TurgorError(f"{name} encloses no volume at rest, so it holds no gas; use VolumeControl.")


def _each(asked: float | Mapping[str, float], names: Sequence[str]) -> Array:
    return np.array([asked[name] for name in names] if isinstance(asked, Mapping) else [asked], dtype=np.float64)


def _gas(chambers: Chambers, procedure: GasMass, ratios: Array, now: tuple[Array, Array]) -> GasTarget:
    """The law of the gas in scaled units, from the scaled volumes and pressures of now."""
    system, (volumes, pressures) = chambers.system, now
    for name, volume in zip(system.controlled, volumes, strict=True):
        if volume <= 0:
            raise TurgorError(f"{name} encloses no volume at rest, so it holds no gas; use volume control.")
    first = procedure.pressure / system.stress
    return GasTarget(
        chambers=chambers,
        volume=volumes,
        mass_ratio=ratios,
        ambient=procedure.ambient / system.stress,
        outside=procedure.final_outside / system.stress,
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


def _at_the_end(before: Point, now: Point, run: Run) -> Outcome | None:
    """All was injected."""
    if now.parameter < 1.0:
        return None
    run.states.append(now.state)
    return reached(run.states, run.steps, run.limits)
