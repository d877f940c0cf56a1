"""JobFunction: a job as a function of its numbers, the one adaptor that all studies of jobs use."""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

import tomlkit

from turgor.foundation.errors import TurgorError
from turgor.job.job import Job
from turgor.job.text.overrides import changed
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.factor import Value
from turgor.studies.runs.jobs.job_changes import job_changes
from turgor.studies.runs.jobs.job_numbers import JobNumber
from turgor.studies.runs.jobs.job_runs import solved_job
from turgor.studies.runs.jobs.job_slopes import SlopeRequest
from turgor.studies.runs.jobs.whole_job import digest_of, write_whole_job
from turgor.studies.runs.run import Place
from turgor.studies.runs.workspaces import solved_job_and_workspace

#: The job at the start with every value.
START = "start.toml"

#: Folder of the runs.
RUNS = "runs"

MeshError = Literal["none", "every", "nominal"]


@dataclass(frozen=True, slots=True, kw_only=True)
class JobFunction:
    """A job as a function of its numbers: numbers in, a run out, with derivatives if requested.

    Sweeps, optimization, calibration, uncertainty, sensitivity and surrogates take jobs through it.

    Parameters
    ----------
    file : Path
        A job file with every value.
    numbers : mapping of str to JobNumber
        Its numbers by key.
    """

    file: Path
    numbers: Mapping[str, JobNumber]

    @property
    def values(self) -> dict[str, Any]:
        """Arguments of `solved_job` besides the numbers."""
        return {"job": Place(self.file), "digest": digest_of(self.file)}

    @property
    def content(self) -> dict[str, Any]:
        """Content of the file."""
        return tomllib.loads(self.file.read_text(encoding="utf-8"))

    def computation(
        self,
        *,
        measures: Sequence[str] = (),
        mesh_error: MeshError = "none",
        slopes: SlopeRequest | None = None,
        as_design: bool = False,
        workspace: Mapping[str, Sequence[float]] = MappingProxyType({}),
    ) -> Computation:
        """Return the function from which runs are created.

        Parameters
        ----------
        measures : sequence of str
            By default those of the job.
        mesh_error : str
            Runs whose mesh error is estimated: ``"none"``, ``"every"``, or the ``"nominal"`` one.
        slopes : mapping, optional
            What is differentiated, as `SlopeRequest` says.
        as_design : bool
            Whether runs have the volume of the material and a picture as well.
        workspace : mapping of str to sequence of float [Pa]
            Pressures of each cavity, whose combinations are solved for the workspace as well; by default none.

        Returns
        -------
        Computation
        """
        values: dict[str, Any] = dict(self.values)
        if mesh_error == "every":  # else it is left out, so that the same runs serve searches with and without it
            values["mesh_error"] = True
        if measures:
            values["measures"] = list(measures)
        if slopes:
            values["slopes"] = dict(slopes)
        if as_design:
            values["as_design"] = True
        if workspace:
            values["workspace"] = {name: list(pressures) for name, pressures in workspace.items()}
        nominal: dict[str, Any] = {"mesh_error": True} if mesh_error == "nominal" else {}
        if nominal and slopes:
            nominal["slopes"] = None  # the search has ended
        function = solved_job_and_workspace if workspace else solved_job
        return Computation(function=function, values=values, nominal=nominal, gather="numbers")

    def write(self, values: Mapping[str, Value], file: Path, comment: str) -> None:
        """Write the job with other values by key, numbers in SI units; keys that are none of its own are left out."""
        known = {
            keys: value
            for keys, value in values.items()
            if isinstance(value, str) or keys.split(",")[0] in self.numbers
        }
        text = tomlkit.dumps(changed(self.content, {}, job_changes(self.content, known)))
        file.write_text("".join(f"# {line}\n" for line in comment.splitlines()) + f"\n{text}", encoding="utf-8")


def job_function(job: Job, folder: Path) -> JobFunction:
    """Write a job with every value into a folder, where runs of it are stored.

    Parameters
    ----------
    job : Job
    folder : Path
        Created if there is none; one that holds something else is refused.

    Returns
    -------
    JobFunction

    Raises
    ------
    TurgorError
        If the folder holds files of something else.
    """
    if folder.exists() and not folder.is_dir():
        raise TurgorError(f"the folder of results '{folder}' is a file; name another.")
    others = [each for each in folder.iterdir() if not each.name.startswith(START)] if folder.is_dir() else []
    if others and not (folder / START).is_file():  # parts of it are written by another call at this moment
        raise TurgorError(f"the folder of results '{folder}' holds files of something else; name another.")
    return JobFunction(file=folder / START, numbers=write_whole_job(job, folder / START))
