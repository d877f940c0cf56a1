"""Gradients of jobs: derivatives of measures by the numbers of a job file."""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from turgor.engine.runtime import EngineOptions
from turgor.errors import TurgorError
from turgor.gradients.gradient import gradient
from turgor.gradients.result import Gradient
from turgor.gradients.variation import Variation
from turgor.job.job import Job
from turgor.job.meshes import new_mesh_of
from turgor.job.prepare import model_of, prepare
from turgor.job.read import read_job
from turgor.meshing.mesh import Mesh
from turgor.model.model import Model
from turgor.response import COLUMN_UNITS
from turgor.results.measures.reading import Measure
from turgor.setups.added import with_setup
from turgor.solvers.procedures.stages import OneProcedure, Stages
from turgor.solvers.solution import Solution
from turgor.solvers.solve import solve
from turgor.solvers.stage_sequence import questions
from turgor.study.job_runs import write_whole_job
from turgor.study.jobs.job_changes import changes_of
from turgor.study.jobs.job_numbers import JobNumber, find_number

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
    anew with the same settings, and must be the same cells; tetrahedra are carried along with the CAD shape.

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
    with TemporaryDirectory() as folder:
        file = Path(folder) / "job.toml"
        numbers = write_whole_job(job, file)
        values = {key: _value(numbers, key) for key in keys}
        if solution is None:
            solution = solve(prepare(job)[0], job.procedure, options=options)
        stage = _stage(job, solution, state)
        asked = _Asked(file, job, values, solution.states[0].model.mesh, stage)
        units = {key: unit for key in keys if (unit := numbers[key.split(",")[0]].unit) in COLUMN_UNITS}
        driven = any(single.split(".")[0] in _PATH for key in keys for single in key.split(","))
        variation = Variation(asked.model, values, units, procedure=asked.procedure if driven else None)
        chosen = measures or [each for each in job.output.chosen() if each.along is None]
        return gradient(solution, chosen, variation, state=state, options=options)


@dataclass(frozen=True, slots=True)
class _Asked:
    """A job with other numbers: its model on the same or a moved mesh, and its procedure.

    Parameters
    ----------
    file : Path
        The job with all its numbers.
    job : Job
    values : mapping of str to float
        What its numbers are.
    mesh : Mesh
        On which it was solved.
    stage : int
        Number of the stage; -1 where there is one procedure.
    """

    file: Path
    job: Job
    values: Mapping[str, float]
    mesh: Mesh
    stage: int

    def model(self, values: Mapping[str, float]) -> Model:
        """The model that a state belongs to."""
        changed = self._changed(values)
        job, made = self._job(changed), self.mesh
        if any(key.split(".")[0] == _SHAPE for keys in changed or values for key in keys.split(",")):
            made = new_mesh_of(replace(job, mesh=self.job.mesh_settings), job.geometry())
        model = with_setup(model_of(job, made), job.setup)
        return questions(model, job.procedure)[self.stage] if isinstance(job.procedure, Stages) else model

    def procedure(self, values: Mapping[str, float]) -> OneProcedure:
        """The procedure that found a state."""
        procedure = self._job(self._changed(values)).procedure
        return procedure.stages[self.stage].procedure if isinstance(procedure, Stages) else procedure

    def _changed(self, values: Mapping[str, float]) -> dict[str, float]:
        return {key: value for key, value in values.items() if value != self.values[key]}

    def _job(self, changed: Mapping[str, float]) -> Job:
        content = tomllib.loads(self.file.read_text(encoding="utf-8"))
        return read_job(self.file, changes_of(content, changed, exact=True), like=self.job)


def _value(numbers: Mapping[str, JobNumber], keys: str) -> float:
    """The number that one key or several have.

    Raises
    ------
    TurgorError
        If there is none, it is a setting of the computation, or several keys have different ones.
    """
    found = [find_number(numbers, key) for key in keys.split(",")]
    for each in found:
        if each.key.split(".")[0] in _SETTINGS:
            raise TurgorError(f"'{each.key}' is a setting of the computation; a gradient is taken by what is built.")
    values = [each.value for each in found]
    if len(set(values)) > 1:
        raise TurgorError(f"'{keys}' has the numbers {' and '.join(f'{each:g}' for each in values)}; one is needed.")
    return values[0]


def _stage(job: Job, solution: Solution, state: int) -> int:
    """Number of the stage of a state; -1 where there are no stages."""
    if not isinstance(job.procedure, Stages):
        return -1
    names = [stage.name for stage in job.procedure.stages]
    name = solution.states[state].stage if -len(solution.states) <= state < len(solution.states) else ""
    return names.index(name) if name in names else 0
