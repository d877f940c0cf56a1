"""Gradients of jobs: derivatives of measures by the numbers of a job file."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from turgor.accuracy.gradients.gradient import gradient_with
from turgor.accuracy.gradients.result import Gradient
from turgor.accuracy.gradients.systems import Systems
from turgor.accuracy.gradients.variation import Variation
from turgor.core.engine.runtime import EngineOptions
from turgor.core.model.model import Model
from turgor.core.results.measures.measure import Measure
from turgor.core.setups.with_setup import with_direction, with_setup
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.solution import Solution
from turgor.core.solvers.solve import solve
from turgor.core.solvers.stage_sequence import questions
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import COLUMN_UNITS
from turgor.job.job import Job
from turgor.job.meshes import new_mesh_of
from turgor.job.prepare import model_of, prepare
from turgor.job.read import read_job
from turgor.studies.runs.jobs.job_changes import changes_of
from turgor.studies.runs.jobs.job_numbers import JobNumber, find_number
from turgor.studies.runs.jobs.whole_job import write_whole_job

#: Sections whose numbers are settings of a computation, not quantities of the actuator.
_SETTINGS = ("mesh", "output", "engine")

#: The section whose numbers change the shape, and with it the mesh; and those that change the procedure.
_SHAPE, _PATH = "actuator", ("procedure", "stages")


def gradient_of_job(
    job: Job,
    keys: Sequence[str],
    measures: Sequence[Measure | str] = (),
    *,
    solution: Solution | None = None,
    state: int = -1,
    options: EngineOptions | None = None,
) -> Gradient:
    """Differentiate measures by the numbers of a job: dimensions of the actuator, materials, loads, fibers.

    The shape moves with the nodes of its mesh: the actuator is built a little larger and smaller. Hexahedra are swept
    again with the same settings, and must be the same elements; tetrahedra move with the CAD shape.

    Parameters
    ----------
    job : Job
    keys : sequence of str
        Numbers by dotted key, such as ``"actuator.wall"`` or ``"materials.body.C10"``; several keys with commas between
        them are one number.
    measures : sequence of Measure or str
        What is differentiated; by default what the job measures of single states.
    solution : Solution, optional
        The path of the job, where it was solved already; it is solved here by default.
    state : int
        Number of the state; the last one by default.
    options : EngineOptions, optional

    Returns
    -------
    Gradient

    Raises
    ------
    TurgorError
        If the job has no such number, or as `turgor.gradient` does.
    SolveError
        If the job is solved here and does not reach the full load.
    """
    if not keys:
        raise TurgorError("a gradient needs a number of the job; name one or more, such as 'materials.body.C10'.")
    solution = solution or solve(prepare(job)[0], job.procedure, options=options, progress=False)
    with nearby_jobs(job, solution) as nearby:
        chosen = measures or [each for each in job.output.chosen() if each.along is None]
        return nearby.gradient(keys, chosen, state, options)


@contextmanager
def nearby_jobs(job: Job, solution: Solution) -> Iterator["NearbyJobs"]:
    """Give a job at nearby values of its numbers, with which several states are differentiated.

    Parameters
    ----------
    job : Job
    solution : Solution
        The path of the job.

    Yields
    ------
    NearbyJobs
    """
    with TemporaryDirectory() as folder:
        file = Path(folder) / "job.toml"
        yield NearbyJobs(file, job, write_whole_job(job, file), solution)


@dataclass(frozen=True, slots=True, eq=False)
class NearbyJobs:
    """A job at nearby values of its numbers: its models on the same or a moved mesh, and its procedures.

    Parameters
    ----------
    file : Path
        The job with all its numbers.
    job : Job
    numbers : mapping of str to JobNumber
        By key.
    solution : Solution
        Of the job.
    """

    file: Path
    job: Job
    numbers: Mapping[str, JobNumber]
    solution: Solution
    _models: dict[tuple[tuple[tuple[str, float], ...], int], Model] = field(default_factory=dict)
    _systems: Systems = field(default_factory=Systems)

    def gradient(
        self, keys: Sequence[str], measures: Sequence[Measure | str], state: int, options: EngineOptions | None = None
    ) -> Gradient:
        """Differentiate measures at a state by some of the numbers.

        Parameters
        ----------
        keys : sequence of str
        measures : sequence of Measure or str
        state : int
        options : EngineOptions, optional

        Returns
        -------
        Gradient
        """
        stage = _stage(self.job, self.solution, state)
        driven = any(is_of_path(key) for key in keys)
        values = {key: _value(self.numbers, key) for key in keys}
        units = {key: self.numbers[key.split(",")[0]].unit for key in keys}
        variation = Variation(
            lambda values: self._model(values, stage),
            values,
            {key: unit for key, unit in units.items() if unit in COLUMN_UNITS},
            procedure=(lambda values: self._procedure(values, stage)) if driven else None,
        )
        return gradient_with(self._systems, self.solution, measures, variation, state, options)

    def _model(self, values: Mapping[str, float], stage: int) -> Model:
        """The model that a state belongs to; nearby ones are built once for all states of a stage.

        That of the job itself is built each time, because what it is meshed of says how tetrahedra move.
        """
        changed = self._changed(values)
        known = tuple(sorted(changed.items())), stage
        if not changed or known not in self._models:
            self._models[known] = self._new_model(changed, changed or values, stage)
        return self._models[known]

    def _new_model(self, changed: Mapping[str, float], shaped: Mapping[str, float], stage: int) -> Model:
        job, mesh = self._job(changed), self.solution.states[0].model.mesh
        if any(key.split(".")[0] == _SHAPE for keys in shaped for key in keys.split(",")):
            mesh = new_mesh_of(replace(job, mesh=self.job.mesh_settings), job.geometry())
        model = with_setup(model_of(job, mesh), with_direction(job.setup, self.solution.model))
        return questions(model, job.procedure)[stage]

    def _procedure(self, values: Mapping[str, float], stage: int) -> Procedure:
        """The procedure that computed a state."""
        return self._job(self._changed(values)).procedure.parts()[stage]

    def _changed(self, values: Mapping[str, float]) -> dict[str, float]:
        return {key: value for key, value in values.items() if value != _value(self.numbers, key)}

    def _job(self, changed: Mapping[str, float]) -> Job:
        content = tomllib.loads(self.file.read_text(encoding="utf-8"))
        return read_job(self.file, changes_of(content, changed, exact=True), like=self.job)


def is_of_path(keys: str) -> bool:
    """Return whether a number is one of the procedure.

    Examples
    --------
    >>> is_of_path("procedure.volume"), is_of_path("materials.body.C10,materials.base.C10")
    (True, False)
    """
    return any(key.split(".")[0] in _PATH for key in keys.split(","))


def _value(numbers: Mapping[str, JobNumber], keys: str) -> float:
    """The number that one key or several have.

    Raises
    ------
    TurgorError
        If there is none, it is a setting of the computation, or several keys have different ones.
    """
    matches = [find_number(numbers, key) for key in keys.split(",")]
    for each in matches:
        if each.key.split(".")[0] in _SETTINGS:
            raise TurgorError(f"'{each.key}' is a setting of the computation; a gradient is taken by what is built.")
    values = [each.value for each in matches]
    if len(set(values)) > 1:
        raise TurgorError(f"'{keys}' has the numbers {' and '.join(f'{each:g}' for each in values)}; one is needed.")
    return values[0]


def _stage(job: Job, solution: Solution, state: int) -> int:
    """Number of the stage of a state, from 0; that of the last one where there is no such state."""
    name = solution.states[state].stage if -len(solution.states) <= state < len(solution.states) else ""
    return len(job.procedure.parts(name)) - 1
