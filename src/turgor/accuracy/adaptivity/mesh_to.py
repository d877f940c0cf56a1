"""mesh_to: solve, refine where the error comes from, and solve again, until a measure is as exact as requested."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.adaptivity.mesh_error import estimate_mesh_error, why_not
from turgor.accuracy.adaptivity.second_mesh import SecondMesh
from turgor.accuracy.adaptivity.settings import REFINEMENT
from turgor.core.engine.runtime import EngineOptions, use_threads
from turgor.core.engine.transfer import Transfer
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.refining.refinement import Refinement
from turgor.core.meshing.sizing.sizes import check_target
from turgor.core.model.model import Model
from turgor.core.results.error_text import with_error
from turgor.core.results.measures.measure import Measure
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.remeshing.indicator import error_indicator
from turgor.core.solvers.remeshing.refine import refined
from turgor.core.solvers.solution import Solution, SolveError
from turgor.core.solvers.solve import solve
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Round:
    """One mesh on the way to the target.

    Parameters
    ----------
    cells, unknowns : int
        Of the mesh.
    value, error : float [SI]
        The measure at the last state and its estimated mesh error.
    """

    cells: int
    unknowns: int
    value: float
    error: float

    @property
    def relative(self) -> float:
        """Error over value."""
        return self.error / abs(self.value) if self.value else inf


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Refined:
    """A path on a mesh that was refined for one measure.

    Parameters
    ----------
    solution : Solution
        The path on the last mesh; ``solution.model.mesh`` is that mesh.
    measure : Measure
        What is to be exact.
    target : float [-]
        Requested relative error.
    rounds : tuple of Round
        The meshes, the first one first.
    reached : bool
        Whether the estimate meets the target.
    finding : Finding
        What happened, where the error came from, and why it ended (N04).
    """

    solution: Solution
    measure: Measure
    target: float
    rounds: tuple[Round, ...]
    reached: bool
    finding: Finding

    __repr__ = brief


def mesh_to(
    model: Model,
    measure: Measure,
    target: float,
    *,
    procedure: Procedure | None = None,
    most_unknowns: int = REFINEMENT.unknowns,
    options: EngineOptions | None = None,
) -> Refined:
    """Solve a model and refine its mesh until the estimated error of a measure at the last state meets a target.

    Parameters
    ----------
    model : Model
        The question, on the mesh to begin with.
    measure : Measure
        What is to be exact.
    target : float [-]
        Largest relative error, such as 0.02.
    procedure : Procedure, optional
        How the path is followed; `Static` if it is not given.
    most_unknowns : int
        Refinement stops before the mesh has more.
    options : EngineOptions, optional

    Returns
    -------
    Refined
        The path on the last mesh, and the rounds of refinement. ``reached`` says whether the target is met.

    Raises
    ------
    TurgorError
        If the target is no share, or the mesh error cannot be estimated.
    SolveError
        If the first solve does not reach the whole load.

    Examples
    --------
    >>> import turgor as tg
    >>> from turgor.units import kPa, mm
    >>> mesh = tg.mesh(tg.FastPneuNet(chambers=2, length=20 * mm).build(), size=4 * mm)
    >>> rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    >>> model = tg.Model(mesh, {"body": rubber, "base": rubber}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 2 * kPa)])
    >>> found = tg.mesh_to(model, tg.cavity_volume, 0.01)
    >>> found.reached, found.rounds[-1].relative < 0.01
    (True, True)
    """
    solution = solve(model, procedure, options=options)
    return refine_to(solution, measure, target, most_unknowns=most_unknowns, options=options)


def refine_to(
    solution: Solution,
    measure: Measure,
    target: float,
    *,
    most_unknowns: int = REFINEMENT.unknowns,
    options: EngineOptions | None = None,
    notify: Callable[[str], None] | None = None,
) -> Refined:
    """Refine the mesh of a path until the estimated error of a measure meets a target; see `mesh_to`.

    ``notify(text)`` is called with what is being done.
    """
    check_target(target)
    if why_not(solution):
        raise TurgorError(f"the mesh cannot be refined to a target: {why_not(solution)}.")
    if not len(solution.model.mesh.cells):
        raise TurgorError("the mesh cannot be refined to a target: films have sides of one size; make that smaller.")
    rounds, say = [_round(solution, measure, options, False)], notify or (lambda _: None)
    where = _where(solution.model.mesh, error_indicator(solution.states[-1]))
    while rounds[-1].relative > target and len(rounds) <= REFINEMENT.rounds:
        refinement = _refined(solution, _growth(rounds[-1].relative / target), most_unknowns)
        if refinement is None:
            where = f"the next mesh would have more than {most_unknowns:,} unknowns; {where}"
            break
        shown = f"{100 * rounds[-1].relative:.2g} %, requested are {100 * target:.2g} %"
        unknowns = refinement.mesh.unknown_count
        say(f"mesh error of the {measure.name.replace('_', ' ')}: {shown}; refining to {unknowns} unknowns")
        solution = _solved_on(solution, refinement, options or EngineOptions())
        rounds.append(_round(solution, measure, options, True))
    return _ended(solution, measure, target, rounds, where)


def _round(solution: Solution, measure: Measure, options: EngineOptions | None, refined_before: bool) -> Round:
    estimate = estimate_mesh_error(solution, (measure,), options, refined_before)
    mesh = solution.model.mesh
    error = float(estimate.errors[measure.name][-1])
    if not np.isfinite(error):
        raise TurgorError(f"the mesh cannot be refined to a target: {estimate.finding and estimate.finding.message}")
    value = measure(solution.states[-1])
    return Round(cells=len(mesh.cells), unknowns=mesh.unknown_count, value=value, error=error)


def _growth(ratio: float) -> float:
    """Growth of the mesh that is likely to divide the error by a ratio: cells are added where it comes from."""
    return float(np.clip(ratio, REFINEMENT.least_growth, REFINEMENT.most_growth))


def _refined(solution: Solution, growth: float, most_unknowns: int) -> Refinement | None:
    """Refine where the error comes from, less where the mesh would get too large; None where nothing is allowed."""
    shares = error_indicator(solution.states[-1])
    for share in (1.0, 0.6, 0.3):
        refinement = refined(solution.model.mesh, shares, 1 + share * (growth - 1))
        if refinement.mesh.unknown_count <= most_unknowns:
            return refinement
    return None


def _solved_on(solution: Solution, refinement: Refinement, options: EngineOptions) -> Solution:
    """Follow the path on a refined mesh: each state from that on the coarser mesh, or the whole path again."""
    model = replace(solution.model, mesh=refinement.mesh)
    touching = any(touch.area > 0 for state in solution.states for touch in state.touches.values())
    remembers = any(state.memory is not None and state.memory.without_friction is not None for state in solution.states)
    if touching or remembers or any(state.stage for state in solution.states):
        return _solved_again(model, solution, options)
    second = SecondMesh(refinement, Transfer(solution.model.mesh, refinement), options)
    states = [second.at_rest(solution.states[0])]
    with use_threads(options.threads):
        for state in solution.states[1:]:
            state_there = second.solved_again(state, solution.procedure.parts(state.stage)[-1], exact=True)
            if state_there is None or (state_there.unstable_modes or 0) != (state.unstable_modes or 0):
                return _solved_again(model, solution, options)
            states.append(state_there)
    return replace(solution, model=states[-1].model, states=tuple(states))


def _solved_again(model: Model, solution: Solution, options: EngineOptions) -> Solution:
    solved = solve(model, solution.procedure, options=options, throw=False, progress=False)
    if len(solved.states) < 2:
        raise SolveError(solved)
    return solved


def _where(mesh: Mesh, shares: Array) -> str:
    """Say in which cells half of the error is."""
    by_cell = shares.sum(axis=1)
    order = np.argsort(-by_cell)
    count = int(np.searchsorted(np.cumsum(by_cell[order]), 0.5)) + 1
    middle = mesh.points[mesh.cells[order[:count]]].mean(axis=1)
    x, y, z = mesh.points[mesh.cells[order[0]]].mean(axis=0) / mm
    regions = {name: float(by_cell[cells].sum()) for name, cells in mesh.regions.items()}
    most = max(regions, key=lambda name: regions[name])
    low, high = middle.min(axis=0) / mm, middle.max(axis=0) / mm
    spread = ", ".join(f"{axis} {a:.3g} to {b:.3g}" for axis, a, b in zip("xyz", low, high, strict=True))
    return (
        f"half of the error came from {count} of {len(mesh.cells)} cells ({spread} mm), most of all from ({x:.3g}, "
        f"{y:.3g}, {z:.3g}) mm; {100 * regions[most]:.0f} % from the region {most}"
    )


def _ended(solution: Solution, measure: Measure, target: float, rounds: list[Round], where: str) -> Refined:
    first, last = rounds[0], rounds[-1]
    reached = last.relative <= target
    name = measure.name.replace("_", " ")
    message = (
        f"The mesh was refined for the {name} from {first.unknowns:,} to {last.unknowns:,} unknowns in "
        f"{len(rounds) - 1} rounds: {with_error(first.value, first.error, measure.unit)} became "
        f"{with_error(last.value, last.error, measure.unit)}, an error of {100 * last.relative:.2g} % where "
        f"{100 * target:.2g} % was requested; {where}."
    )
    if len(rounds) == 1 and reached:
        message = (
            f"The first mesh meets the target: {name} {with_error(last.value, last.error, measure.unit)}, an error of "
            f"{100 * last.relative:.2g} % where {100 * target:.2g} % was requested."
        )
    advice = "" if reached else "Allow more unknowns (most_unknowns), or begin with smaller cells in these places."
    return Refined(
        solution=solution,
        measure=measure,
        target=target,
        rounds=tuple(rounds),
        reached=reached,
        finding=Finding(
            code="N04", severity=Severity.NOTE if reached else Severity.WARNING, message=message, advice=advice
        ),
    )
