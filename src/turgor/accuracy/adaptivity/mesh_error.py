"""Mesh error: how far each measure of each state is from what finer cells would give.

A few states of the path are solved again on a second mesh, in which the cells with most of the error are cut in all
directions. The estimate is the difference of a measure between the two meshes, scaled up by the error that the second
mesh still has, which the indicator measures there. Between these states it is interpolated along the path, relative to
the change of the measure.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.adaptivity.paired_states import PairedStates
from turgor.accuracy.adaptivity.second_mesh import SecondMesh
from turgor.accuracy.adaptivity.settings import MESH_ERROR
from turgor.core.engine.runtime import EngineOptions, use_threads
from turgor.core.engine.transfer import transfer_to
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.refining.refinement import Refinement
from turgor.core.meshing.refining.split_films import FilmRefinement, refine_films
from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.results.measures.measure import Measure
from turgor.core.solvers.remeshing.indicator import error_indicator, squared_errors
from turgor.core.solvers.remeshing.refine import ALL_CUT, refined
from turgor.core.solvers.solution import Solution, State
from turgor.foundation.display import brief
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Response

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MeshError:
    """Estimated mesh error of measures along a path.

    Parameters
    ----------
    errors : mapping of str to (n,) array [SI]
        Estimated size of the error of each measure at each state, not negative; nan where nothing is known.
    unknowns : int
        Unknowns of the second mesh.
    states : tuple of int
        Numbers of the states whose equilibrium was solved again.
    seconds : float [s]
        What it took.
    finding : Finding or None
        Why there is no estimate, where there is none.
    """

    errors: Mapping[str, Array]
    unknowns: int = 0
    states: tuple[int, ...] = ()
    seconds: float = 0.0
    finding: Finding | None = None

    __repr__ = brief


def estimate_mesh_error(
    solution: Solution,
    measures: Sequence[Measure],
    options: EngineOptions | None = None,
    refined_before: bool = False,
    linear: bool = False,
    known: Response | None = None,
) -> MeshError:
    """Estimate the mesh error of measures at every state of a path.

    Parameters
    ----------
    solution : Solution
    measures : sequence of Measure
    options : EngineOptions, optional
        How the engine runs on the second mesh.
    refined_before : bool
        Whether the mesh was refined where the error comes from; the second mesh is finer then.
    linear : bool
        Whether one linear solve on the second mesh is enough, of all measures at the last state. What it gives is the
        residual on that mesh, weighted with the adjoint of each measure there, since both follow from one tangent.
    known : Response, optional
        Measures of the path that need not be read again.

    Returns
    -------
    MeshError
        With nan and a finding (N03) where it cannot be estimated: motion and friction depend on all that was before.
    """
    reason = why_not(solution)
    paired = None if reason else find_again(solution, options or EngineOptions(), refined_before, linear)
    if paired is None or not paired.pairs:
        unknown = {each.name: np.full(len(solution.states), np.nan) for each in measures}
        return MeshError(errors=unknown, finding=_not_estimated(reason or "no state was found on the second mesh"))
    values = _read(solution.states, measures, known)
    again = _read_again(solution, paired, measures, values)
    errors = {
        each.name: _along_path(path_length(solution), each, (values[:, k], again[:, k]), paired)
        for k, each in enumerate(measures)
    }
    return MeshError(errors=errors, unknowns=paired.unknowns, states=tuple(paired.pairs), seconds=paired.seconds)


@lru_cache(maxsize=1)
def find_again(
    solution: Solution, options: EngineOptions, refined_before: bool = False, linear: bool = False
) -> PairedStates | None:
    """Solve for a few states of a path on a second mesh; on a coarser one where this fails because sheets wrinkle.

    Only the last one, by a linear solve, if ``linear``. The last result is cached, because a solution may be measured
    more than once.
    """
    began = perf_counter()
    count, growth = plan(solution, refined_before)
    chosen = _chosen(solution, 1 if linear else count)
    if not chosen:
        return None
    if not len(solution.model.mesh.cells):
        every = _chosen(solution, len(MESH_ERROR.places))
        finer = refine_films(solution.model.mesh)
        paired = _on_second_mesh(solution, every, finer, options, linear, enough=1)
        return replace(paired, seconds=perf_counter() - began)
    shares = np.mean([error_indicator(solution.states[number]) for number in chosen[:2]], axis=0)
    paired = _on_second_mesh(solution, chosen, refined(solution.model.mesh, shares, growth), options, linear)
    if not paired.pairs:
        least = _least_growth(solution)
        failed = chosen if growth <= least else []  # on the same mesh they would fail again
        others = [number for number in _chosen(solution, len(MESH_ERROR.places)) if number not in failed]
        coarser = refined(solution.model.mesh, shares, least)
        paired = _on_second_mesh(solution, others, coarser, options, linear, enough=1)
    return replace(paired, seconds=perf_counter() - began)


def _on_second_mesh(
    solution: Solution,
    chosen: list[int],
    refinement: Refinement | FilmRefinement,
    options: EngineOptions,
    linear: bool,
    enough: int = len(MESH_ERROR.places),
) -> PairedStates:
    """Solve for chosen states, until enough converge, on a refined mesh."""
    transfer = transfer_to(solution.model.mesh, refinement)
    mesh = SecondMesh(refinement, transfer, options)
    pairs: dict[int, State] = {}
    moved: dict[int, float] = {}
    with use_threads(options.threads):
        for number in chosen:
            if len(pairs) == enough:
                break
            state = solution.states[number]
            state_there = mesh.solved_again(state, solution.procedure.parts(state.stage)[-1], linear=linear)
            if state_there is not None:
                before = transfer.nodal(state.displacement)
                pairs[number] = state_there
                share = 1.0 if len(state.model.mesh.cells) else MESH_ERROR.folds
                change, size = (float(np.linalg.norm(u)) for u in (state_there.displacement - before, before))
                moved[number] = share * change / size if size else 0.0  # at rest there is no share
    remaining = _remaining(solution.states[next(iter(pairs))], next(iter(pairs.values()))) if pairs else 0.0
    return PairedStates(pairs, moved, refinement.mesh.unknown_count, remaining, 0.0)


def _remaining(state: State, state_there: State) -> float:
    """Squared error in energy of a state on the second mesh over that on the first one."""
    if not len(state.model.mesh.cells):
        return MESH_ERROR.remaining_of_films
    whole = float(squared_errors(state).sum())
    return float(squared_errors(state_there).sum()) / whole if whole > 0 else 0.0


def why_not(solution: Solution) -> str:
    """Say why states of a path cannot be solved for on another mesh; empty where they can."""
    reason = next((each.depends_on_path for each in solution.procedure.parts() if each.depends_on_path), "")
    if reason:
        return reason
    contact = solution.model.contact
    frictions = [obstacle.friction for obstacle in contact.obstacles]
    if contact.self_contact is not None:
        frictions.append(contact.self_contact.friction)
    if any(frictions):
        return "there is friction, and every state depends on all before it"
    if any(load.channel is not None for load in solution.model.loads):
        return "liquid flows through a channel, and every state depends on all before it"
    if solution.model.bonds:
        return f"the bond '{solution.model.bonds[0].name}' is damaged, and every state depends on all before it"
    path_dependent = next((load.path_dependent for load in solution.model.loads if load.path_dependent), "")
    if path_dependent:
        return f"{path_dependent}, and with it every state, depends on all states before it"
    if solution.model.mesh.cells.shape[1] == 20:
        return "cells of 20 nodes cannot be cut"
    return "" if len(solution.states) > 1 else "there is no state but the one at rest"


def _not_estimated(reason: str) -> Finding:
    return Finding(
        code="N03",
        severity=Severity.NOTE,
        message=f"The mesh error was not estimated: {reason}.",
        advice="Compare two meshes yourself: `turgor convergence` does.",
    )


def plan(solution: Solution, refined_before: bool) -> tuple[int, float]:
    """How many states are solved again, and by how much the number of cells grows, for half the work of the solve.

    Work is counted in factorizations, so that the estimate does not depend on how busy the machine is.
    """
    touching = any(touch.area > 0 for touch in solution.states[-1].touches.values())
    needed = MESH_ERROR.state_work_touching if touching else MESH_ERROR.state_work
    affordable = max(solution.timing.factorizations, 1) / needed
    count = 1
    root = 1 / MESH_ERROR.cost_exponent
    while count < len(MESH_ERROR.places) and (affordable / (count + 1)) ** root > MESH_ERROR.growth:
        count += 1
    least = MESH_ERROR.growth if refined_before else _least_growth(solution)
    return count, float(np.clip((affordable / count) ** root, least, ALL_CUT))


def _least_growth(solution: Solution) -> float:
    """Growth of the number of cells from the first mesh to the second at least."""
    tetrahedra = solution.model.mesh.cell_type is TETRAHEDRON
    return MESH_ERROR.least_growth if tetrahedra else MESH_ERROR.least_growth_hexahedra


def path_length(solution: Solution) -> Array:
    """How far along the path each state is, (n,) from 0 to 1: sums of the distances between displacements."""
    moved = [state.displacement for state in solution.states]
    steps = [float(np.linalg.norm(b - a)) for a, b in pairwise(moved)]
    total = np.concatenate([[0.0], np.cumsum(steps)])
    return np.asarray(total / total[-1] if total[-1] > 0 else np.linspace(0, 1, len(total)))


def _chosen(solution: Solution, count: int) -> list[int]:
    """Numbers of the states to solve again, the most interesting ones first."""
    place = path_length(solution)
    out: list[int] = []
    for share in MESH_ERROR.places[:count]:
        number = int(np.abs(place[1:] - share).argmin()) + 1
        if number not in out:
            out.append(number)
    return out


def _read(states: Sequence[State], measures: Sequence[Measure], known: Response | None = None) -> Array:
    """Measures (n, m) of states on one mesh; the fields of a state are shared by its measures, then dropped."""
    facts, out = MeshFacts(states[0].model.mesh), np.empty((len(states), len(measures)))
    new = [k for k, each in enumerate(measures) if known is None or each.name not in known]
    alone = [k for k in new if measures[k].along is None]
    for number, state in enumerate(states):
        at = StateFields(state, facts)
        out[number, alone] = [measures[k](at) for k in alone]
    for k, each in enumerate(measures):
        if known is not None and each.name in known:
            out[:, k] = known.column(each.name)
        elif each.along is not None:
            out[:, k] = each.read([StateFields(state, facts) for state in states])
    return out


def _read_again(solution: Solution, paired: PairedStates, measures: Sequence[Measure], values: Array) -> Array:
    """Measures (k, m) of the states that were solved again, in their order.

    A sum along the path is made over these states alone on both meshes; the difference is added to its value.
    """
    numbers = sorted(paired.pairs)
    again = [paired.pairs[number] for number in numbers]
    sums = [k for k, each in enumerate(measures) if each.along is not None]
    out = np.empty((len(numbers), len(measures)))
    alone = [k for k in range(len(measures)) if k not in sums]
    out[:, alone] = _read(again, [measures[k] for k in alone])
    if sums:
        rest = _at_rest(again[0])
        few = [solution.states[0], *(solution.states[number] for number in numbers)]
        first, second = (_read(path, [measures[k] for k in sums])[1:] for path in (few, [rest, *again]))
        out[:, sums] = values[np.ix_(numbers, sums)] + second - first
    return out


def _at_rest(state: State) -> State:
    """The undeformed state on the mesh of a state."""
    return replace(
        state,
        load_factor=0.0,
        displacement=np.zeros_like(state.displacement),
        mean_stress=np.zeros_like(state.mean_stress),
        nodal_force=np.zeros_like(state.nodal_force),
        touches={},
        pressures=dict.fromkeys(state.pressures, 0.0),
        memory=None,
        points={},
    )


def _along_path(place: Array, measure: Measure, read: tuple[Array, Array], paired: PairedStates) -> Array:
    """Estimated error (n,) of a measure, read at all states and at those that were solved again, by their places."""
    (values, known), numbers = read, sorted(paired.pairs)
    difference = known - values[numbers]
    if measure.unwrap:
        values, difference = np.unwrap(values), np.arctan2(np.sin(difference), np.cos(difference))
    change = np.abs(values - (values[0] if np.isfinite(values[0]) else 0.0))  # what is straight at rest has no radius
    size = np.abs(difference)
    least = np.array([paired.moved[number] for number in numbers]) * change[numbers]
    # two meshes may agree by accident, but for measures that are prescribed
    scaled = np.hypot(paired.factor(measure.local) * size, least)
    size = np.where(size > MESH_ERROR.negligible * change[numbers], scaled, size)
    if (change[numbers] > MESH_ERROR.negligible * max(float(np.nanmax(np.abs(values))), 1e-300)).all():
        return np.asarray(np.interp(place, place[numbers], size / change[numbers]) * change)
    return np.asarray(np.interp(place, [0.0, *place[numbers]], [0.0, *size]))
