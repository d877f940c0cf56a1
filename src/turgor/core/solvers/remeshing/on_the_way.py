"""On the way: cut cells where they degrade on a path, and go on with the finer ones."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from turgor.core.engine.runtime import EngineOptions
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.core.model.model import Model
from turgor.core.solvers.checkpoints.checkpoint_data import PathSoFar
from turgor.core.solvers.checks.distortion import node_volume_ratios
from turgor.core.solvers.listeners import Listeners
from turgor.core.solvers.procedures.procedure import Procedure, refuse_remeshing
from turgor.core.solvers.remeshing.remesh import Remeshed, finer_cells, moved_to, transferred
from turgor.core.solvers.remeshing.settings import REMESHING
from turgor.core.solvers.restart import Restart
from turgor.core.solvers.solution import Solution, State, Status, Step, Timing
from turgor.core.solvers.stage_sequence import Follow
from turgor.core.solvers.step_reasons import Cause, Reason
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity


def degraded_volume(state: State) -> float:
    """Return the share of the volume at rest that is in cells whose volume ratio falls to next to nothing at a node.

    Parameters
    ----------
    state : State
    """
    ratios = node_volume_ratios(state)
    bad = ratios.min(axis=1) < REMESHING.least_ratio * ratios.mean(axis=1)
    volumes = cell_volumes(state.model.mesh)
    return float(volumes[bad].sum() / volumes.sum())


@dataclass(slots=True, eq=False)
class Watch:
    """Ends a path on one mesh where its cells degrade.

    Parameters
    ----------
    stop : callable or None
        That of the caller.
    by_caller : bool
        Whether the caller ended it. A path that is read from its record calls neither.
    """

    stop: Callable[[State], str | None] | None
    by_caller: bool = False

    def __call__(self, state: State) -> str | None:
        """Return why the path ends at a state: a reason of the caller, or cells that degrade."""
        reason = None if self.stop is None else self.stop(state)
        self.by_caller = reason is not None
        if reason is None and state.load_factor < 1 and degraded_volume(state) > REMESHING.degraded_volume:
            return "cells degrade"
        return reason


def follow_remeshing(
    follow: Follow,
    options: EngineOptions,
    model: Model,
    procedure: Procedure,
    listeners: Listeners,
    restart: Restart | None,
) -> tuple[Solution, Restart]:
    """Follow a procedure; where cells degrade or no step succeeds, cut them and go on.

    The solution has all states on the last mesh. Those of the meshes before are carried over, without any change.

    Parameters
    ----------
    follow : callable
        Follows a path on one mesh.
    options : EngineOptions
    model : Model
    procedure : Procedure
    listeners : Listeners
    restart : Restart or None

    Returns
    -------
    (Solution, Restart)
    """
    refuse_remeshing(model)
    notes: list[Finding] = []
    timings: list[Timing] = []
    for number in range(REMESHING.most + 1):
        last = number == REMESHING.most
        watch = Watch(listeners.stop)
        listening = listeners if last else replace(listeners, stop=watch)
        solution, end = follow(model, procedure, listening, restart)
        timings.append(solution.timing)
        if last or not _needs_cells(solution, watch):
            break
        try:
            new, path = _on_finer_cells(solution, procedure, options)
        except TurgorError as error:
            notes.append(_given_up(solution.states[-1], error))
            if solution.status is Status.STOPPED:  # go on with the cells that there are
                path = PathSoFar(states=solution.states, steps=solution.steps, limits=solution.limit_points)
                solution, end = follow(model, procedure, listeners, replace(end, path=path))
                timings.append(solution.timing)
            break
        notes.append(_finding(solution.model, new))
        model, restart = new.state.model, replace(new.restart, path=path)
    whole = replace(solution, findings=(*notes, *solution.findings), timing=Timing.together(timings))
    return whole, end


def _needs_cells(solution: Solution, watch: Watch) -> bool:
    """Whether a path on one mesh ended because its cells degrade."""
    if solution.status is Status.STOPPED:
        return not watch.by_caller
    if solution.status not in (Status.STEP_TOO_SMALL, Status.LIMIT_POINT) or len(solution.states) < 2:
        return False
    causes = {step.cause for step in solution.steps[-REMESHING.last_steps :]}
    turned = bool(causes & {Cause.INVERTED_CELL, Cause.INVERTED_START})
    return turned or degraded_volume(solution.states[-1]) > 0


def _on_finer_cells(solution: Solution, procedure: Procedure, options: EngineOptions) -> tuple[Remeshed, PathSoFar]:
    """Remesh at the last stable state, or one of those before it; return it with the path up to it on its mesh."""
    stable = [k for k, state in enumerate(solution.states) if not state.unstable_modes]
    transfer = finer_cells(solution.states[stable[-1]])
    for place in dict.fromkeys([*(stable[-1 - back] for back in REMESHING.earlier if back < len(stable)), 0]):
        new = moved_to(transfer, solution.states[place], procedure, options)
        if new is not None:
            return new, _path_until(solution, place, new)
    raise TurgorError("no equilibrium was found on the finer cells.")


def _path_until(solution: Solution, place: int, new: Remeshed) -> PathSoFar:
    """The path on the finer cells up to the state of a number, with what was done there as a step."""
    model, factor = new.state.model, new.state.load_factor
    states = [transferred(state, new.transfer, model) for state in solution.states[:place]]
    cells = f"{len(solution.model.mesh.cells)} to {len(model.mesh.cells)}"
    step = Step(
        load_factor=factor,
        increment=0.0,
        iterations=new.iterations,
        residual=new.residual,
        accepted=True,
        seconds=0.0,
        why=Reason(Cause.REMESHED, 100 * new.error.displacement, cells),
    )
    limits = tuple(limit for limit in solution.limit_points if limit.state < place)
    return PathSoFar(states=(*states, new.state), steps=(*solution.steps, step), limits=limits)


def _finding(before: Model, new: Remeshed) -> Finding:
    error, factor = new.error, new.state.load_factor
    pressure = f", unknown pressures by {100 * error.pressure:.2g} %" if error.pressure else ""
    moved = (
        " Displacements were carried over without error; the equilibrium on the new cells differs by "
        f"{100 * error.displacement:.2g} % of them, its energy by {100 * error.energy:.2g} %{pressure}."
    )
    return Finding(
        code="N07",
        severity=Severity.NOTE,
        message=f"New cells at load factor {factor:.4g}: {len(before.mesh.cells)} became "
        f"{len(new.state.model.mesh.cells)}.{moved if factor else ' The path began again with them.'}",
        advice="States before have the error of the cells before. Where it matters, mesh finer from the start.",
    )


def _given_up(state: State, error: TurgorError) -> Finding:
    return Finding(
        code="N07",
        severity=Severity.WARNING,
        message=f"Cells degrade at load factor {state.load_factor:.4g}, and no new ones were made: {error}",
        advice="Mesh the body finer from the start where it degrades, or take smaller steps.",
    )
