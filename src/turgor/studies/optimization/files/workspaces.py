"""Workspaces as goals of a job: pressures of the cavities in a study file, and what each design reaches with them."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Column, Response
from turgor.job.read import read_job
from turgor.studies.optimization.files.numbers import numbers_in
from turgor.studies.optimization.goals import Goal, TipPath
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.factor import Value
from turgor.studies.runs.jobs.job_numbers import JobNumber
from turgor.studies.runs.workspaces import REACHED, pressure_keys, workspace_of

Pressures = Mapping[str, Sequence[float]]

#: Folder beside the job where the runs of workspaces are kept.
FOLDER = "workspaces"


def read_workspace(table: Mapping[str, Any], where: str) -> dict[str, tuple[float, ...]]:
    """Read the pressures of each cavity.

    Parameters
    ----------
    table : mapping
        ``[workspace]`` of a study file, such as ``{"cavity_1": "0, 10, 20 kPa"}``.
    where : str
        Beginning of messages.

    Returns
    -------
    dict of str to tuple of float [Pa]
        Empty where there is no table.

    Raises
    ------
    TurgorError
        If a value is no list of pressures.

    Examples
    --------
    >>> read_workspace({"cavity_1": "0, 10 kPa"}, "study.toml: [workspace]")
    {'cavity_1': (0.0, 10000.0)}
    """
    example = "0, 10, 20 kPa"
    return {name: tuple(numbers_in(given, f"{where}.{name}", "pressure", example)) for name, given in table.items()}


def check_workspace(pressures: Pressures, goals: Sequence[Goal], numbers: Mapping[str, JobNumber], file: Path) -> None:
    """Raise an error if goals and pressures do not belong together, or the job has no such cavity.

    Parameters
    ----------
    pressures : mapping of str to sequence of float [Pa]
    goals : sequence of Goal
    numbers : mapping of str to JobNumber
        Of the job.
    file : Path
        The study file, for messages.
    """
    asked = [each.measure for each in goals if not isinstance(each, TipPath) and each.measure in REACHED]
    if asked and not pressures:
        raise TurgorError(
            f"{file}: a goal reads '{asked[0]}', which needs the pressures of the cavities: [workspace] with "
            'cavity_1 = "0, 10, 20 kPa".'
        )
    if pressures and not asked:
        raise TurgorError(f"{file}: [workspace]: no goal reads {' or '.join(REACHED)}; leave it out, or add a goal.")
    known = pressure_keys(numbers)
    for name in pressures:
        if name not in known:
            raise unknown(f"cavity in {file}: [workspace]:", name, known)


def with_workspace(response: Response, job: Path, numbers: Mapping[str, Value], pressures: Pressures) -> Response:
    """Add area and volume of the workspace of a design to its response, the same at each state.

    The runs are kept beside the job, so that a search that was killed goes on within a design.

    Parameters
    ----------
    response : Response
    job : Path
        A file of `turgor.studies.runs.jobs.job_runs.write_whole_job`.
    numbers : mapping of str to float, int or str
        Numbers of the job by key [SI].
    pressures : mapping of str to sequence of float [Pa]
        Of each cavity.

    Returns
    -------
    Response
        Its message tells which runs failed or ended early.
    """
    runs = Evaluations(folder=job.parent / FOLDER, retry=True)  # asked for where the design has not ended, or again
    found = workspace_of(read_job(job), pressures, values=numbers, evaluations=runs).to_response()
    columns = [Column(each.name, each.unit, np.full(len(response), each.values[0])) for each in found.columns]
    message = " ".join(each for each in (response.message, found.message) if each)
    return replace(response, columns=(*response.columns, *columns), message=message)
