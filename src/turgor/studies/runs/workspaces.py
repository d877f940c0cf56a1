"""workspace_of: a model at all combinations of the pressures of several cavities, and the workspace that it reaches."""

import csv
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import isfinite
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from turgor.core.model.loads import pressures_among
from turgor.core.results.measures.shape.workspaces import COLUMNS, Workspace, workspace
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.foundation.store.atomic_files import whole
from turgor.job.job import Job
from turgor.job.read import read_job
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.executors.run_outcome import Ended
from turgor.studies.runs.factor import Value
from turgor.studies.runs.jobs.job_numbers import JobNumber, any_number
from turgor.studies.runs.jobs.job_runs import solved_job
from turgor.studies.runs.jobs.whole_job import digest_of, write_whole_job
from turgor.studies.runs.rounding import rounded
from turgor.studies.runs.run import Computed, Place, Run
from turgor.units import kPa, mm

Function = Callable[..., Response | Computed]

#: Columns of `WorkspaceRuns.to_response`.
REACHED = ("workspace_area", "workspace_volume")

#: Folder next to a job for the runs of its workspaces.
FOLDER = "workspaces"

#: The job with every value, next to its runs.
START = "start.toml"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WorkspaceRuns:
    """Runs at combinations of pressures, and the workspace around the places that they reach.

    Parameters
    ----------
    reached : Workspace
        All states of all paths count.
    pressures : tuple of mapping of str to float [Pa]
        Pressures of each run by cavity.
    ended : tuple of Ended
        How each run ended, in the same order.
    """

    reached: Workspace
    pressures: tuple[Mapping[str, float], ...]
    ended: tuple[Ended, ...]

    @property
    def problems(self) -> tuple[str, ...]:
        """Runs that failed, and those whose path ended early, in sentences."""
        sentences = []
        for each in self.ended:
            if each.result is None:
                sentences.append(f"The run with {each.run.name} failed: {each.problem}")
            elif each.result.response.message:
                sentences.append(f"The run with {each.run.name} ended early: {each.result.response.message}")
        return tuple(sentences)

    def to_response(self) -> Response:
        """Return area and volume as a response of one state, as a sweep or an optimization of designs reads them."""
        columns = (
            Column(REACHED[0], "mm2", np.array([self.reached.area])),
            Column(REACHED[1], "mL", np.array([self.reached.volume])),
        )
        source = Source(text="a workspace", detail=f"{len(self.ended)} runs")
        return Response(columns=columns, source=source, message=" ".join(self.problems))

    def write(self, file: str | Path) -> None:
        """Write a table with a line for each run: pressures [kPa], the last place of the tip [mm], and its problem."""
        with whole(Path(file)) as part, part.open("w", encoding="utf-8", newline="") as opened:
            table = csv.writer(opened)
            names = list(self.pressures[0])
            table.writerow([*(f"{name} (kPa)" for name in names), *(f"{name} (mm)" for name in COLUMNS), "problem"])
            for values, each in zip(self.pressures, self.ended, strict=True):
                response = None if each.result is None else each.result.response
                tip = ["" if response is None else f"{response[name][-1] / mm:.6g}" for name in COLUMNS]
                problem = each.problem if response is None else response.message
                table.writerow([*(f"{values[name] / kPa:.6g}" for name in names), *tip, problem])


def workspace_of(
    model: Job | Function,
    pressures: Mapping[str, Sequence[float]],
    *,
    values: Mapping[str, Value] | None = None,
    evaluations: Evaluations | None = None,
) -> WorkspaceRuns:
    """Compute a model at all combinations of the pressures of its cavities, and the workspace that its tip reaches.

    A path goes from rest to each combination with all pressures in proportion. A run that fails is reported, and the
    workspace is that of the others.

    Parameters
    ----------
    model : Job or callable
        A job from `turgor.jobs.read_job`; or a function of a module that takes a pressure [Pa] for each cavity by name,
        and returns a `Response` with ``tip_displacement_x``, ``tip_displacement_y`` and ``tip_displacement_z``.
    pressures : mapping of str to sequence of float [Pa]
        Pressures of each cavity, such as ``{"cavity_1": [0, 10 * kPa], "cavity_2": [0, 10 * kPa]}``. Cavities of a job
        that are not named have the pressure of the job. A combination at which nothing loads a job is not computed:
        every path begins at rest.
    values : mapping of str to float, int or str, optional
        Numbers of the job by key [SI], such as ``{"actuator.wall": 2e-3}``, or further arguments of the function.
    evaluations : Evaluations, optional
        Where runs are computed and saved, such as `turgor.studies.saved_in`; by default in this process, without files.

    Returns
    -------
    WorkspaceRuns

    Raises
    ------
    TurgorError
        If a cavity or a key is unknown, a cavity has no pressure, all runs fail, or the places lie on a line.

    Examples
    --------
    A beam with a cavity on either side bends with the difference of the pressures, and stretches with the sum:

    >>> from turgor.foundation.response import Column
    >>> from turgor.foundation.source import Source
    >>> def beam(left, right):
    ...     places = (left + right, left - right, 0.0)
    ...     columns = tuple(Column(name, "mm", [0, x * 1e-7]) for name, x in zip(COLUMNS, places, strict=True))
    ...     return Response(columns=columns, source=Source(text="a beam"))
    >>> workspace = workspace_of(beam, {"left": [0, 10 * kPa, 20 * kPa], "right": [0, 10 * kPa, 20 * kPa]})
    >>> len(workspace.ended), round(workspace.reached.area / mm**2, 6)
    (9, 8.0)
    """
    combinations = _combinations(model, pressures)
    computed = evaluations or Evaluations()
    if not isinstance(model, Job):
        more = dict(values or {})
        ended = computed.of(
            [Run(name=_name_of(each), function=model, values={**more, **each}) for each in combinations]
        )
        return _gathered(combinations, ended)
    with TemporaryDirectory() as folder:
        file = (computed.folder or Path(folder)) / START
        ended = computed.of(_job_runs(model, file, combinations, values or {}))
    return _gathered(combinations, ended)


def solved_job_and_workspace(
    job: str,
    digest: str,
    numbers: Mapping[str, Value],
    workspace: Mapping[str, Sequence[float]],
    mesh_error: bool = False,
    as_design: bool = False,
) -> Computed:
    """Solve a job with other numbers, and at combinations of pressures for its workspace.

    The runs of the workspace are stored next to the job, so that a search that was killed continues within a design.

    Parameters
    ----------
    job, digest, numbers
        As those of `solved_job`.
    workspace : mapping of str to sequence of float [Pa]
        Pressures of each cavity.
    mesh_error, as_design
        As those of `solved_job`.

    Returns
    -------
    Computed
        Its response has area and volume of the workspace, the same at each state; its message says which runs failed
        or ended early.
    """
    runs = Evaluations(folder=Path(job).parent / FOLDER, retry=True)  # a design that has ended is not called again
    reached = workspace_of(read_job(job), workspace, values=numbers, evaluations=runs).to_response()
    computed = solved_job(job, digest, numbers, mesh_error, as_design=as_design)
    response = computed.response
    columns = [Column(each.name, each.unit, np.full(len(response), each.values[0])) for each in reached.columns]
    message = " ".join(each for each in (response.message, reached.message) if each)
    return replace(computed, response=replace(response, columns=(*response.columns, *columns), message=message))


def _combinations(model: Job | Function, pressures: Mapping[str, Sequence[float]]) -> tuple[Mapping[str, float], ...]:
    """Return all combinations of pressures; of a job, those that load it."""
    for name, given in pressures.items():
        if not len(given) or not all(isfinite(value) for value in given):
            raise TurgorError(f"pressures of '{name}' are {list(given)}; give one pressure in Pa or more.")
    if not pressures:
        raise TurgorError("pressures is empty; name the cavities and their pressures.")
    combinations = tuple(
        {name: rounded(value) for name, value in zip(pressures, each, strict=True)}
        for each in product(*pressures.values())
    )
    if isinstance(model, Job):
        combinations = tuple(each for each in combinations if _is_loaded(model, each))
        if not combinations:
            raise TurgorError(f"nothing drives the job: all pressures of {', '.join(pressures)} are zero.")
    return combinations


def pressure_keys(numbers: Mapping[str, JobNumber]) -> dict[str, str]:
    """Return the keys of the pressures of a job by cavity.

    Parameters
    ----------
    numbers : mapping of str to JobNumber
        Of `write_whole_job`.

    Returns
    -------
    dict of str to str
    """
    keys = {key.split(".")[1]: key for key in numbers if key.startswith("loads.") and key.endswith(".pressure")}
    return keys | ({"cavity": "loads.pressure"} if "loads.pressure" in numbers else {})


def _job_runs(
    job: Job, file: Path, combinations: Sequence[Mapping[str, float]], values: Mapping[str, Value]
) -> list[Run]:
    """Runs of a job; its pressures are keys of the whole job."""
    numbers = write_whole_job(job, file)
    keys = pressure_keys(numbers)
    for name in combinations[0]:
        if name not in keys:
            raise unknown("cavity with a pressure", name, keys)
    for given, value in values.items():
        for key in given.split(",") if not isinstance(value, str) else ():
            any_number(numbers, key)
    same: dict[str, Any] = {"job": Place(file), "digest": digest_of(file), "measures": list(COLUMNS)}
    return [
        Run(
            name=_name_of(each), function=solved_job,
            values={**same, "numbers": {**values, **{keys[name]: value for name, value in each.items()}}},
        )
        for each in combinations
    ]  # fmt: skip


def _is_loaded(job: Job, pressures: Mapping[str, float]) -> bool:
    """Whether anything drives the job: the state of rest needs no run, and every path begins there."""
    pressed = pressures_among(job.loads)
    others = any(load.pressure for load in pressed if load.face not in pressures)
    return others or any(pressures.values()) or len(pressed) < len(job.loads)


def _gathered(combinations: tuple[Mapping[str, float], ...], ended: Sequence[Ended]) -> WorkspaceRuns:
    responses = [each.result.response for each in ended if each.result is not None]
    if not responses:
        raise TurgorError(f"all {len(ended)} runs failed; the first one: {ended[0].problem}")
    return WorkspaceRuns(reached=workspace(responses), pressures=combinations, ended=tuple(ended))


def _name_of(pressures: Mapping[str, float]) -> str:
    return ", ".join(f"{name} {value / kPa:g} kPa" for name, value in pressures.items())
