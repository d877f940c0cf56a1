"""Optimization of a job: its runs, with the silicone that they take and a picture, and the files that are written."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from turgor.core.model.loads import Pressure
from turgor.core.results.measures.measures import MEASURES
from turgor.core.solvers.procedures.static import Static
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Column
from turgor.job.job import Job
from turgor.job.read import read_job
from turgor.studies.optimization.files.job_slopes import SOLID_VOLUME, asked_slopes, solid_volume_of, with_job_slopes
from turgor.studies.optimization.files.study_files import StudyFile, read_factors
from turgor.studies.optimization.files.workspaces import check_workspace, with_workspace
from turgor.studies.optimization.goals import Goal, Minimize, TipPath
from turgor.studies.optimization.manufacture import casting_rules
from turgor.studies.optimization.optimize import optimize
from turgor.studies.optimization.result import Optimization
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.factor import Value
from turgor.studies.runs.jobs.columns import unit_of_column
from turgor.studies.runs.jobs.job_file import JobFile, job_file
from turgor.studies.runs.jobs.job_numbers import any_number
from turgor.studies.runs.jobs.job_runs import forget_path, last_state_of, measured_job, solution_of_job
from turgor.studies.runs.run import Computed
from turgor.studies.runs.workspaces import REACHED
from turgor.views.pictures.picture import picture

#: Width of the pictures of designs in pixels.
PICTURE_WIDTH = 700


@dataclass(frozen=True, slots=True, kw_only=True)
class JobOptimization:
    """A job, and what is to be found.

    Parameters
    ----------
    base : JobFile
        The job with every value, in the folder of results.
    study : StudyFile
    mesh_error : bool
        Whether the mesh error of the best design is estimated, by one more run.
    """

    base: JobFile
    study: StudyFile
    mesh_error: bool = True

    @property
    def computation(self) -> Computation:
        """The job as a function of its numbers."""
        asked = {**self.base.values, "slopes": self._slopes}
        if self.study.workspace:
            asked["workspace"] = {name: list(values) for name, values in self.study.workspace.items()}
        nominal = {"mesh_error": True, "slopes": []} if self.mesh_error else {}
        return Computation(function=solved_design, values=asked, nominal=nominal, gather="numbers")

    @property
    def _slopes(self) -> list[list[Any]]:
        """What is differentiated: what the goals read, where the search takes slopes."""
        in_region = self.study.search.method in ("auto", "trust_region")
        fronts = sum(isinstance(each, Minimize) for each in self.study.goals) > 1
        if not self.study.search.slopes or not in_region or fronts:
            return []
        return asked_slopes(self.study.goals, {key.replace(" ", "") for key in self.study.factors})

    def search(self, evaluations: Evaluations) -> Optimization:
        """Search, with the rules of casting where the study file has any."""
        factors, start = read_factors(self.study, self.base)
        actuator: Any = read_job(self.base.file).actuator

        def make(values: Mapping[str, Value]) -> Any:
            return replace(actuator, **_dimensions(values))  # thousands of times, so that no file is read

        rules = () if self.study.casting is None else casting_rules(make, self.study.casting)
        if self.study.casting is not None:
            make(start)  # dimensions that are wrong from the start are a mistake, not a broken rule
        return optimize(
            self.computation, factors, [*self.study.goals, *rules], start=start, search=self.study.search,
            evaluations=evaluations,
        )  # fmt: skip


def job_optimization(study: StudyFile, job: Job, folder: Path, *, mesh_error: bool = True) -> JobOptimization:
    """Write the job with every value into a folder, where runs of it are kept.

    Parameters
    ----------
    study : StudyFile
    job : Job
        That of the study file, perhaps with changes.
    folder : Path
        Made if there is none; one that holds something else is refused.
    mesh_error : bool
        Whether the mesh error of the best design is estimated.

    Returns
    -------
    JobOptimization

    Raises
    ------
    TurgorError
        If the folder holds files of something else, or the job has no number of a factor.
    """
    measured = replace(job.output, measures=_measures(job, study))
    base = job_file(replace(job, procedure=_stopping(job, study.goals), output=measured), folder)
    for key in study.factors:
        for each in key.split(","):
            any_number(base.numbers, each.strip())
    check_workspace(study.workspace, study.goals, base.numbers, study.file)
    return JobOptimization(base=base, study=study, mesh_error=mesh_error)


def solved_design(
    job: str,
    digest: str,
    numbers: Mapping[str, Value],
    mesh_error: bool = False,
    slopes: Sequence[Sequence[Any]] = (),
    workspace: Mapping[str, Sequence[float]] = MappingProxyType({}),
) -> Computed:
    """Solve a job with other numbers; its response has the volume of rubber, and there is a picture of the last state.

    Parameters
    ----------
    job, digest, numbers, mesh_error
        As those of `turgor.studies.runs.jobs.job_runs.solved_job`.
    slopes : sequence of (str, str or None, float)
        Measures that are differentiated by the numbers, where that is exact: at a value of a column, or at the end.
    workspace : mapping of str to sequence of float [Pa]
        Pressures of each cavity, at all combinations of which the design is solved as well; by default none.

    Returns
    -------
    Computed
        With notes on what could not be differentiated.
    """
    asked, solution = solution_of_job(job, digest, numbers)
    response = measured_job(asked, solution, mesh_error=mesh_error)
    column = Column(SOLID_VOLUME, "mL", np.full(len(response), solid_volume_of(solution.model.mesh)))
    response = replace(response, columns=(*response.columns, column))
    notes: tuple[str, ...] = ()
    if slopes and solution.states:
        response, notes = with_job_slopes(asked, solution, response, numbers, slopes)
    if workspace:
        response = with_workspace(response, Path(job), numbers, workspace)
    drawn = picture(solution, width=PICTURE_WIDTH).png if solution.states else b""
    if solution.states:
        last = last_state_of(job, digest, numbers)
        last.parent.mkdir(parents=True, exist_ok=True)
        replace(solution, states=solution.states[-1:]).save(last)
    forget_path(job, digest, numbers)
    return Computed(response=response, picture=drawn, notes=notes)


def _measures(job: Job, study: StudyFile) -> tuple[str, ...]:
    """Return what the job measures, and what the goals read besides, after a check of their names."""
    asked = [each for goal in study.goals for each in _names(goal)]
    beside = {*study.factors, SOLID_VOLUME, *REACHED, "pressure", "load_factor", "time"}
    for name in asked:
        if name in MEASURES or name in beside or any(name.startswith(each) for each in job.output.markers):
            continue
        if not any(name.startswith(each) for each in MEASURES):  # parts of a measure, such as of each region
            raise unknown(f"measure in {study.file}:", name, [*MEASURES, *beside])
    places = [goal.at[0] for goal in study.goals if goal.at is not None]
    for name in places:
        if name not in MEASURES:
            try:
                unit_of_column(job, name)
            except TurgorError as error:
                raise TurgorError(f"{study.file}: at: {error}") from None
    more = [name for name in (*asked, *places) if name in MEASURES and name not in job.output.measures]
    return (*job.output.measures, *dict.fromkeys(more))


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
    full = [each.pressure for each in job.loads if isinstance(each, Pressure)]
    if not isinstance(job.procedure, Static) or len(full) != 1 or full[0] <= 0:
        return job.procedure
    at = [goal.at for goal in goals if goal.at is not None and goal.at[0] == "pressure"]
    asked = [float(value) for _, values in at for value in np.atleast_1d(values)]
    shares = {round(value / full[0], 9) for value in asked if 0 < value < full[0]}
    return replace(job.procedure, at=tuple(sorted({*job.procedure.at, *shares})))
