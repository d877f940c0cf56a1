"""Optimization of a job: the search with its function, and the procedure and measures that the goals need."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from turgor.core.model.loads import pressures_among
from turgor.core.results.measures.measures import MEASURES
from turgor.foundation.errors import TurgorError, unknown
from turgor.job.job import Job
from turgor.job.read import read_job
from turgor.studies.optimization.goals import Goal, Minimize, TipPath
from turgor.studies.optimization.manufacture import Casting, casting_rules
from turgor.studies.optimization.optimize import optimize
from turgor.studies.optimization.result import Optimization
from turgor.studies.optimization.search import Search
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.factor import Factor, Value
from turgor.studies.runs.jobs.columns import unit_of_column
from turgor.studies.runs.jobs.job_function import JobFunction, job_function
from turgor.studies.runs.jobs.job_numbers import JobNumber
from turgor.studies.runs.jobs.solid_volume import SOLID_VOLUME
from turgor.studies.runs.workspaces import REACHED, pressure_keys


@dataclass(frozen=True, slots=True, kw_only=True)
class OptimizationPlan:
    """Goals, factors and settings of an optimization of a job.

    Parameters
    ----------
    factors : tuple of Factor
        Numbers of the job by key, with their ranges.
    start : mapping of str to number [SI]
        Where the search begins.
    goals : tuple of Goal
    workspace : mapping of str to tuple of float [Pa]
        Pressures of each cavity; empty if no goal reads the workspace.
    casting : Casting or None
        Rules of casting, if the part is to be cast.
    search : Search
    """

    factors: tuple[Factor, ...]
    start: Mapping[str, Value]
    goals: tuple[Goal, ...]
    workspace: Mapping[str, tuple[float, ...]] = field(default_factory=lambda: MappingProxyType({}))
    casting: Casting | None = None
    search: Search = field(default_factory=Search)


@dataclass(frozen=True, slots=True, kw_only=True)
class JobOptimization:
    """A job in the folder of results, and the plan of the search.

    Parameters
    ----------
    base : JobFunction
    plan : OptimizationPlan
    mesh_error : bool
        Whether the mesh error of the best design is estimated, by one more run.
    """

    base: JobFunction
    plan: OptimizationPlan
    mesh_error: bool = True

    @property
    def computation(self) -> Computation:
        """The job as a function of its numbers."""
        readings = self._differentiated
        return self.base.computation(
            mesh_error="nominal" if self.mesh_error else "none", slopes={"readings": readings} if readings else None,
            as_design=True, workspace=self.plan.workspace,
        )  # fmt: skip

    @property
    def _differentiated(self) -> list[list[Any]]:
        """The readings of the goals, if the search takes slopes."""
        in_region = self.plan.search.method in ("auto", "trust_region")
        fronts = sum(isinstance(each, Minimize) for each in self.plan.goals) > 1
        if not self.plan.search.slopes or not in_region or fronts:
            return []
        return readings_of(self.plan.goals, {each.name for each in self.plan.factors})

    def search(self, evaluations: Evaluations) -> Optimization:
        """Search, with the rules of casting if the plan has any."""
        plan = self.plan
        actuator: Any = read_job(self.base.file).actuator

        def make(values: Mapping[str, Value]) -> Any:
            return replace(actuator, **_dimensions(values))  # thousands of times, so that no file is read

        rules = () if plan.casting is None else casting_rules(make, plan.casting)
        if plan.casting is not None:
            make(plan.start)  # dimensions that are wrong at the start are a mistake, not a broken rule
        return optimize(
            self.computation, plan.factors, [*plan.goals, *rules], start=plan.start, search=plan.search,
            evaluations=evaluations,
        )  # fmt: skip


def job_optimization(plan: OptimizationPlan, job: Job, folder: Path, *, mesh_error: bool = True) -> JobOptimization:
    """Write the job with every value into a folder, where its runs are stored.

    Parameters
    ----------
    plan : OptimizationPlan
    job : Job
    folder : Path
        Created if there is none; one that holds something else is refused.
    mesh_error : bool
        Whether the mesh error of the best design is estimated.

    Returns
    -------
    JobOptimization

    Raises
    ------
    TurgorError
        If the folder holds files of something else, or a goal reads what the job does not have.
    """
    measured = replace(job.output, measures=_measures(job, plan))
    base = job_function(replace(job, procedure=_stopping(job, plan.goals), output=measured), folder)
    _check_workspace(plan, base.numbers)
    return JobOptimization(base=base, plan=plan, mesh_error=mesh_error)


def readings_of(goals: Sequence[Goal], factors: Collection[str]) -> list[list[Any]]:
    """Return what goals read: measures, each with the column and its value at which it is read.

    Parameters
    ----------
    goals : sequence of Goal
    factors : collection of str
        Names of the factors, which need no derivatives if goals read them.

    Returns
    -------
    list of [str, str or None, float]
        Empty if a goal has no derivative: a function, a workspace, or a path compared at shares of its length.
    """
    readings: list[list[Any]] = []
    for goal in goals:
        if isinstance(goal, TipPath):
            if goal.at is None:
                return []
            readings += [[each, goal.at[0], float(value)] for value in goal.at[1] for each in goal.measures]
        elif not isinstance(goal.measure, str) or goal.measure in REACHED:
            return []
        elif goal.measure not in factors:
            readings.append([goal.measure, *(goal.at or (None, 0.0))])
    return readings


def _measures(job: Job, plan: OptimizationPlan) -> tuple[str, ...]:
    """Return what the job measures, and what the goals read besides, after a check of their names."""
    names = [each for goal in plan.goals for each in _names(goal)]
    others = {*(each.name for each in plan.factors), SOLID_VOLUME, *REACHED, "pressure", "load_factor", "time"}
    for name in names:
        if name in MEASURES or name in others or any(name.startswith(each) for each in job.output.markers):
            continue
        if not any(name.startswith(each) for each in MEASURES):  # parts of a measure, such as of each region
            raise unknown("measure of a goal", name, [*MEASURES, *others])
    places = [goal.at[0] for goal in plan.goals if goal.at is not None]
    for name in places:
        if name not in MEASURES:
            try:
                unit_of_column(job, name)
            except TurgorError as error:
                raise TurgorError(f"at of a goal: {error}") from None
    more = [name for name in (*names, *places) if name in MEASURES and name not in job.output.measures]
    return (*job.output.measures, *dict.fromkeys(more))


def _check_workspace(plan: OptimizationPlan, numbers: Mapping[str, JobNumber]) -> None:
    """Raise an error if goals and pressures do not belong together, or the job has no such cavity."""
    reading = [each.measure for each in plan.goals if not isinstance(each, TipPath) and each.measure in REACHED]
    if reading and not plan.workspace:
        raise TurgorError(
            f"a goal reads '{reading[0]}', which needs the pressures of the cavities: [optimize.workspace] with "
            'cavity_1 = "0, 10, 20 kPa".'
        )
    if plan.workspace and not reading:
        raise TurgorError(f"no goal reads {' or '.join(REACHED)}; leave out the workspace, or add a goal.")
    known = pressure_keys(numbers)
    for name in plan.workspace:
        if name not in known:
            raise unknown("cavity of the workspace", name, known)


def _dimensions(values: Mapping[str, Value]) -> dict[str, Value]:
    """Return the fields of the actuator that keys of a job such as ``"actuator.wall"`` change."""
    single = {key: value for keys, value in values.items() for key in keys.split(",")}
    return {key.removeprefix(_ACTUATOR): value for key, value in single.items() if key.startswith(_ACTUATOR)}


#: Beginning of the keys of dimensions.
_ACTUATOR = "actuator."


def _names(goal: Goal) -> tuple[str, ...]:
    if isinstance(goal, TipPath):
        return goal.measures
    return (goal.measure,) if isinstance(goal.measure, str) else ()


def _stopping(job: Job, goals: Sequence[Goal]) -> Any:
    """Return the procedure with a state at each pressure at which goals read: between states is interpolated."""
    full = [each.pressure for each in pressures_among(job.loads)]
    procedure: Any = job.procedure
    if not procedure.load_control or len(full) != 1 or full[0] <= 0:
        return procedure
    at = [goal.at for goal in goals if goal.at is not None and goal.at[0] == "pressure"]
    stops = [float(value) for _, values in at for value in np.atleast_1d(values)]
    shares = {round(value / full[0], 9) for value in stops if 0 < value < full[0]}
    return replace(procedure, at=tuple(sorted({*procedure.at, *shares})))
