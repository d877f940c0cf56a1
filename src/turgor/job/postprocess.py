"""Postprocess: measure and report a run from its folder, finished or not, without a solve."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from turgor.core.results.fields.path_fields import PathFields
from turgor.core.results.files.response_csv import read_response
from turgor.core.results.measures.measures import Reader, find_measure, measure
from turgor.core.solvers.checks.materials import rubber_findings
from turgor.core.solvers.load import load
from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import by_weight
from turgor.foundation.response import MESH_ERROR, Response
from turgor.job.job import Job
from turgor.job.output.folder import LOCK, RESPONSE
from turgor.job.output.identity import read_lock
from turgor.job.output.outcome import RunOutcome
from turgor.job.output.versions import versions
from turgor.job.output.write import write_results
from turgor.job.read import read_job


def measure_folder(folder: str | Path, names: tuple[str, ...] = ()) -> Response:
    """Measure the states of a run in a folder of results.

    Parameters
    ----------
    folder : str or Path
        Of `run_job` or `turgor run`, or of `solve`.
    names : tuple of str
        Names of measures; those of the job if none is given.

    Returns
    -------
    Response
        Without mesh errors.

    Raises
    ------
    TurgorError
        If the folder holds no path, or a name is unknown.
    """
    folder = Path(folder)
    solution: Solution = load(folder)
    if not names and (folder / LOCK).exists():
        return measure(solution, *_job(folder).output.chosen())
    return measure(solution, *(find_measure(name) for name in names))


def report_folder(folder: str | Path, notify: Callable[[str], None]) -> RunOutcome:
    """Write all files of a run again from the states in its folder.

    Fields for ParaView that are complete and younger than the path are left as they are, and so are pictures that show
    it. Mesh errors are not estimated, because that would solve again; those that the run has written stay.

    Parameters
    ----------
    folder : str or Path
        Of `run_job` or `turgor run`.
    notify : callable
        ``notify(text)``, called with each activity.

    Returns
    -------
    RunOutcome

    Raises
    ------
    TurgorError
        If the folder holds no path or no lock file.
    """
    outcome, fields = outcome_of_folder(folder)
    return replace(outcome, files=write_results(outcome, notify, fields))


def outcome_of_folder(folder: str | Path) -> tuple[RunOutcome, PathFields]:
    """Return the outcome of a run from its folder, measured again, without files, and the fields of its path.

    Parameters
    ----------
    folder : str or Path
        Of `run_job` or `turgor run`.

    Raises
    ------
    TurgorError
        If the folder holds no path or no lock file.
    """
    folder = Path(folder)
    solution: Solution = load(folder)
    job = _job(folder)
    fields = PathFields(solution)
    response = Reader(job.output.chosen()).response(solution, fields)
    response = _with_known_errors(response, folder / RESPONSE)
    outcome = RunOutcome(
        job=job,
        solution=solution,
        response=response,
        findings=by_weight((*rubber_findings(solution.model, solution.states), *solution.findings)),
        written_by=versions() | {"linear_solver": solution.timing.linear_solver},
        notices=(),
        folder=folder,
    )
    return outcome, fields


def _with_known_errors(response: Response, file: Path) -> Response:
    """Add the mesh errors that a response of the same states in a file has."""
    if not file.exists():
        return response
    before = read_response(file)
    known = {column.name: column for column in before.columns if column.name.endswith(MESH_ERROR)}
    if len(before) != len(response) or not known:
        return response
    columns = []
    for column in response.columns:
        columns.append(column)
        error = known.get(column.name + MESH_ERROR)
        if error is not None and np.allclose(before.column(column.name), column.values, rtol=1e-9, equal_nan=True):
            columns.append(error)
    return replace(response, columns=tuple(columns))


def _job(folder: Path) -> Job:
    file = folder / LOCK
    if not file.exists():
        raise TurgorError(f"'{folder}' holds no {LOCK}, which says what its run was.")
    if read_lock(file) is None:
        raise TurgorError(
            f"'{file}' is damaged.",
            python="run_job(job, output, resume=True) writes it again.",
            command=f"turgor run JOB --output {folder} --resume writes it again.",
        )
    return read_job(file)
