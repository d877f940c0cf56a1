"""Runs of a job: the job solved with other numbers, measured, and differentiated if requested."""

import json
import tomllib
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from shutil import rmtree
from socket import gethostname

import numpy as np

from turgor.accuracy.measure import measure
from turgor.core.engine.runtime import EngineOptions
from turgor.core.solvers.solution import Solution, Status
from turgor.core.solvers.solve import resume, solve
from turgor.foundation.errors import NotHere, TurgorError
from turgor.foundation.response import Column, Response
from turgor.job.job import Job
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.studies.runs.factor import Value
from turgor.studies.runs.jobs.job_changes import job_changes
from turgor.studies.runs.jobs.job_slopes import SlopeRequest, with_requested_slopes
from turgor.studies.runs.jobs.solid_volume import SOLID_VOLUME, solid_volume_of
from turgor.studies.runs.run import Computed
from turgor.studies.runs.settings import RUNS
from turgor.views.pictures.picture import picture
from turgor.views.pictures.settings import FRAMING

#: Folder next to the job for paths that are being followed: each goes when its run has ended, the folder with the last.
PATHS = "paths"

#: Folder of the last states of runs, next to the job.
LAST_STATES = "last-states"


def solved_job(
    job: str,
    digest: str,
    numbers: Mapping[str, Value],
    mesh_error: bool = False,
    measures: Sequence[str] = (),
    slopes: SlopeRequest | None = None,
    as_design: bool = False,
) -> Computed:
    """Solve a job with other numbers and measure it, with one thread: the function of every study of a job.

    A run that is killed continues from its last accepted state when it is called again.

    Parameters
    ----------
    job : str
        A file of `write_whole_job`.
    digest : str
        `digest_of` the file, so that runs of another job are not taken for those of this one.
    numbers : mapping of str to float, int or str
        Values by key; numbers are in SI units, and several keys with commas between them have one value. The value of
        a material, such as ``"materials.body"``, is a record of the library: ``"ecoflex-00-30/yeoh-steck-2019"``; other
        texts are choices, such as the kind of the elements.
    mesh_error : bool
        Whether the mesh error is estimated, which takes up to half the time of the solve.
    measures : sequence of str
        What is measured; by default the measures of the job.
    slopes : mapping, optional
        Which measures are differentiated by the numbers where that is exact, as `SlopeRequest` says; by default none.
    as_design : bool
        Whether the response has the volume of the material, and a picture and the last state are stored as well.

    Returns
    -------
    Computed
        As far as the path goes; its message says why it ended early, its notes what could not be differentiated.

    Raises
    ------
    TurgorError
        If the job cannot be read, meshed or supported with these numbers.
    """
    changed, solution = solution_of_job(job, digest, numbers)
    response = measured_job(changed, solution, mesh_error=mesh_error, measures=measures)
    if as_design:
        volume = np.full(len(response), solid_volume_of(solution.model.mesh))
        response = replace(response, columns=(*response.columns, Column(SOLID_VOLUME, "mL", volume)))
    notes: tuple[str, ...] = ()
    if slopes and solution.states:
        response, notes = with_requested_slopes(changed, solution, response, numbers, slopes)
    drawn = b""
    if as_design and solution.states:
        drawn = picture(solution, width=FRAMING.design_width).png
        last = last_state_of(job, digest, numbers)
        last.parent.mkdir(parents=True, exist_ok=True)
        replace(solution, states=solution.states[-1:]).save(last)
    forget_path(job, digest, numbers)
    return Computed(response=response, picture=drawn, notes=notes)


def solution_of_job(job: str, digest: str, numbers: Mapping[str, Value]) -> tuple[Job, Solution]:
    """Solve a job with other numbers, with one thread, and return the path as far as it goes.

    The path is saved next to the job until `forget_path`, so that a run that is killed goes on from its last state.

    Parameters
    ----------
    job, digest, numbers
        As those of `solved_job`.

    Returns
    -------
    (Job, Solution)
        The job with these numbers.
    """
    if not Path(job).is_file():
        raise NotHere(
            f"the job of the study, '{job}', is not seen on the machine '{gethostname()}'; "
            "studies of jobs need a folder that all machines share."
        )
    content = tomllib.loads(Path(job).read_text(encoding="utf-8"))
    changed = read_job(job, job_changes(content, numbers))
    solution = _followed(changed, EngineOptions(threads=1), _path_of(job, digest, numbers))
    if solution.status is Status.INTERRUPTED:
        raise KeyboardInterrupt  # Ctrl-C ends the study; the run has not ended, and goes on when it is called again
    return changed, solution


def forget_path(job: str, digest: str, numbers: Mapping[str, Value]) -> None:
    """Remove the states that `solution_of_job` saved on its way, once the result is saved.

    Parameters
    ----------
    job, digest, numbers
        As those of `solved_job`.
    """
    folder = _path_of(job, digest, numbers)
    rmtree(folder, ignore_errors=True)
    with suppress(OSError):  # the paths of other runs are there
        folder.parent.rmdir()


def last_state_of(job: str, digest: str, numbers: Mapping[str, Value]) -> Path:
    """Return the file for the last state of a run, which pictures of several runs at one scale need.

    Parameters
    ----------
    job, digest, numbers
        As those of `solved_job`.

    Returns
    -------
    Path
    """
    return Path(job).parent / LAST_STATES / f"{path_name(digest, numbers)}.turgor"


def _path_of(job: str, digest: str, numbers: Mapping[str, Value]) -> Path:
    return Path(job).parent / PATHS / path_name(digest, numbers)


def measured_job(job: Job, solution: Solution, *, mesh_error: bool = False, measures: Sequence[str] = ()) -> Response:
    """Measure a solution of `solution_of_job`; the message says why the path ended early.

    Parameters
    ----------
    job : Job
    solution : Solution
    mesh_error, measures
        As those of `solved_job`.

    Returns
    -------
    Response
    """
    options = EngineOptions(threads=1)
    estimated = mesh_error and len(solution.states) > 1
    response = measure(solution, *(measures or job.output.chosen()), mesh_error=estimated, options=options)
    message = "" if solution.complete else f"{solution.message} {solution.advice}".strip()
    return replace(response, message=message)


def _followed(job: Job, options: EngineOptions, folder: Path) -> Solution:
    """Follow the path of a job, or go on with it where it was killed: every accepted state is in the folder at once."""
    if folder.exists():
        try:
            return resume(folder, options=options, throw=False)
        except TurgorError:  # killed as the folder was begun
            rmtree(folder)
    model, _ = prepare(job)
    _make(folder)
    return solve(model, job.procedure, options=options, folder=folder, throw=False, progress=False)


def _make(folder: Path) -> None:
    """Make the folder of a path, again if a run that ended has removed the empty one above it in between."""
    for _ in range(RUNS.attempts):
        with suppress(FileNotFoundError):
            folder.mkdir(parents=True, exist_ok=True)
            return


def path_name(digest: str, numbers: Mapping[str, Value]) -> str:
    """Return the name of the folder of a path that is being followed: a hash of the job and its values."""
    return sha256(json.dumps([digest, dict(numbers)], sort_keys=True).encode()).hexdigest()[:16]
