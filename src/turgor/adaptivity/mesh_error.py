"""Mesh error: how far each measure of each state is from what finer cells would give.

A few states of the path are found again on a second mesh, in which the cells that carry most of the error are cut in
all directions. The difference of a measure between the two meshes, enlarged by what the second mesh leaves out, is the
estimate. Between these states it is interpolated along the path, relative to the change of the measure.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.adaptivity.indicator import error_indicator
from turgor.adaptivity.refine import refined
from turgor.adaptivity.second_mesh import SecondMesh
from turgor.engine.runtime import EngineOptions, use_threads
from turgor.engine.transfer import Transfer
from turgor.finding import Finding, Severity
from turgor.results.fields import MeshFacts, StateFields
from turgor.results.reading import Measure
from turgor.solvers.dynamic import Dynamic
from turgor.solvers.solution import Solution, State
from turgor.solvers.stages import OneProcedure, Stages

Array = NDArray[np.float64]

#: Where on the path states are found again, as shares of its length: the last one first.
PLACES = (1.0, 0.5, 0.2)

#: Time for the estimate over the time of the solve.
SHARE_OF_TIME = 0.5

#: Growth of the number of cells from the first mesh to the second: at least, and where all cells are cut.
LEAST_GROWTH, FULL_GROWTH = 1.6, 8.0

#: A factorization of n unknowns takes n to this power (`docs/theory`), and a state found again needs so many of them.
COST_EXPONENT, FACTORIZATIONS = 1.5, 2.5

#: Estimate over difference of the two meshes where all of the error was captured: halving cells leaves some of it.
REMAINDER = 1.3

#: Power of the captured share by which the difference is divided; set on the truth set (`docs/truth.md`).
CAPTURED_POWER = 0.5


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
        Numbers of the states that were found again.
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


@dataclass(frozen=True, slots=True, eq=False)
class FoundAgain:
    """States that were found again on a second mesh.

    Parameters
    ----------
    pairs : mapping of int to State
        By their number in the path.
    unknowns : int
        Of the second mesh.
    factor : float
        Estimated error over difference.
    seconds : float [s]
    """

    pairs: Mapping[int, State]
    unknowns: int
    factor: float
    seconds: float


def estimate_mesh_error(
    solution: Solution, measures: Sequence[Measure], options: EngineOptions | None = None
) -> MeshError:
    """Estimate the mesh error of measures at every state of a path.

    Parameters
    ----------
    solution : Solution
    measures : sequence of Measure
    options : EngineOptions, optional
        How the engine runs on the second mesh.

    Returns
    -------
    MeshError
        With nan and a finding (N03) where it cannot be estimated: motion and friction depend on all that was before.
    """
    reason = why_not(solution)
    found = None if reason else find_again(solution, options or EngineOptions())
    if found is None or not found.pairs:
        unknown = {each.name: np.full(len(solution.states), np.nan) for each in measures}
        return MeshError(errors=unknown, finding=_not_estimated(reason or "no state was found on the second mesh"))
    errors = {each.name: _along_path(solution, each, found) for each in measures}
    return MeshError(errors=errors, unknowns=found.unknowns, states=tuple(found.pairs), seconds=found.seconds)


@lru_cache(maxsize=1)
def find_again(solution: Solution, options: EngineOptions) -> FoundAgain | None:
    """Find a few states of a path again on a second mesh, within the time that is left for it.

    The last answer is kept, because a solution may be measured more than once.
    """
    began = perf_counter()
    chosen = _chosen(solution)
    if not chosen:
        return None
    mesh, budget = solution.model.mesh, SHARE_OF_TIME * _time_of(solution)
    shares = np.mean([error_indicator(solution.states[number]) for number in chosen[:2]], axis=0)
    refinement, captured = refined(mesh, shares, _growth(solution))
    second = SecondMesh(refinement, Transfer(mesh, refinement), options)
    pairs: dict[int, State] = {}
    with use_threads(options.threads):
        for count, number in enumerate(chosen):
            spent = perf_counter() - began
            if pairs and spent * (count + 1) / count > budget:
                break
            state = solution.states[number]
            found = second.found_again(state, procedure_of(solution, state))
            if found is not None:
                pairs[number] = found
    factor = REMAINDER / max(captured, 0.05) ** CAPTURED_POWER
    return FoundAgain(pairs, refinement.mesh.unknown_count, factor, perf_counter() - began)


def why_not(solution: Solution) -> str:
    """Say why states of a path cannot be found again on another mesh; empty where they can."""
    procedures = solution.procedure.stages if isinstance(solution.procedure, Stages) else ()
    moving = [solution.procedure, *(stage.procedure for stage in procedures)]
    if any(isinstance(each, Dynamic) for each in moving):
        return "the actuator moves, and every state depends on all before it"
    contact = solution.model.contact
    frictions = [obstacle.friction for obstacle in contact.obstacles]
    if contact.self_contact is not None:
        frictions.append(contact.self_contact.friction)
    if any(frictions):
        return "something rubs, and every state depends on all before it"
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


def procedure_of(solution: Solution, state: State) -> OneProcedure:
    """Return the procedure that found a state: in a sequence that of its stage."""
    if isinstance(solution.procedure, Stages):
        named = {stage.name: stage.procedure for stage in solution.procedure.stages}
        return named.get(state.stage, solution.procedure.stages[-1].procedure)
    return solution.procedure


def _time_of(solution: Solution) -> float:
    return solution.timing.total - solution.timing.compile


def _growth(solution: Solution) -> float:
    """Growth of the cells that leaves room for two states in the time of the estimate."""
    timing = solution.timing
    if not timing.factorizations or not timing.factorization:
        return FULL_GROWTH
    one = (timing.assembly + timing.factorization) / timing.factorizations
    affordable = 0.5 * SHARE_OF_TIME * _time_of(solution) / (FACTORIZATIONS * one)
    return float(np.clip(affordable ** (1 / COST_EXPONENT), LEAST_GROWTH, FULL_GROWTH))


def path_length(solution: Solution) -> Array:
    """How far along the path each state is, (n,) from 0 to 1: sums of the distances between displacements."""
    moved = [state.displacement for state in solution.states]
    steps = [float(np.linalg.norm(b - a)) for a, b in pairwise(moved)]
    total = np.concatenate([[0.0], np.cumsum(steps)])
    return np.asarray(total / total[-1] if total[-1] > 0 else np.linspace(0, 1, len(total)))


def _chosen(solution: Solution) -> list[int]:
    """Numbers of the states to be found again, in the order of interest."""
    place = path_length(solution)
    out: list[int] = []
    for share in PLACES:
        number = int(np.abs(place[1:] - share).argmin()) + 1
        if number not in out:
            out.append(number)
    return out


def _along_path(solution: Solution, measure: Measure, found: FoundAgain) -> Array:
    """Estimated error (n,) of a measure at every state."""
    facts = MeshFacts(solution.model.mesh)
    again = MeshFacts(next(iter(found.pairs.values())).model.mesh)
    numbers = sorted(found.pairs)
    values = np.array([measure(StateFields(state, facts)) for state in solution.states])
    known = np.array([measure(StateFields(found.pairs[number], again)) for number in numbers])
    difference = known - values[numbers]
    if measure.unwrap:
        values, difference = np.unwrap(values), np.arctan2(np.sin(difference), np.cos(difference))
    size = found.factor * np.abs(difference)
    place, change = path_length(solution), np.abs(values - values[0])
    if (change[numbers] > 1e-6 * max(float(np.abs(values).max()), 1e-300)).all():
        return np.asarray(np.interp(place, place[numbers], size / change[numbers]) * change)
    return np.asarray(np.interp(place, [0.0, *place[numbers]], [0.0, *size]))
