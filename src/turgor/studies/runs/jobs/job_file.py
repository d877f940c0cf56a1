"""JobFile: a job with every value as a file, whose values can be changed."""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tomlkit

from turgor.foundation.errors import TurgorError
from turgor.job.job import Job
from turgor.job.text.overrides import changed
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.factor import Value
from turgor.studies.runs.jobs.job_changes import job_changes
from turgor.studies.runs.jobs.job_numbers import JobNumber, find_number
from turgor.studies.runs.jobs.job_runs import digest_of, solved_job, write_whole_job
from turgor.studies.runs.run import Place

#: The job at the start with every value.
START = "start.toml"

#: Folder of the runs.
RUNS = "runs"


@dataclass(frozen=True, slots=True, kw_only=True)
class JobFile:
    """A job whose numbers can be changed.

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

    def computation(self, *, mesh_error: bool, measures: Sequence[str] = ()) -> Computation:
        """Return the job as a function of its values; the measures are those of the job by default."""
        values = self.values | {"mesh_error": mesh_error} | ({"measures": list(measures)} if measures else {})
        return Computation(function=solved_job, values=values, gather="numbers")

    def write(self, values: Mapping[str, Value], file: Path, comment: str) -> None:
        """Write the job with other values by key, numbers in SI units; keys that are none of its own are left out."""
        known = {
            keys: value
            for keys, value in values.items()
            if isinstance(value, str) or keys.split(",")[0] in self.numbers
        }
        text = tomlkit.dumps(changed(self.content, {}, job_changes(self.content, known)))
        file.write_text("".join(f"# {line}\n" for line in comment.splitlines()) + f"\n{text}", encoding="utf-8")


def job_file(job: Job, folder: Path) -> JobFile:
    """Write a job with every value into a folder, where runs of it are kept.

    Parameters
    ----------
    job : Job
    folder : Path
        Made if there is none; one that holds something else is refused.

    Returns
    -------
    JobFile

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
    return JobFile(file=folder / START, numbers=write_whole_job(job, folder / START))


def keys_of(text: str, job: JobFile, option: str) -> str:
    """Return keys with commas between them, after a check that one value fits all.

    Parameters
    ----------
    text : str
    job : JobFile
    option : str
        Beginning of messages.

    Returns
    -------
    str

    Raises
    ------
    TurgorError
        If one is unknown, or they measure different things.
    """
    keys = [each.strip() for each in text.split(",")]
    units = {find_number(job.numbers, key).dimension for key in keys}
    if len(units) > 1:
        raise TurgorError(f"{option} is '{text}': {' and '.join(sorted(units))} cannot have one value.")
    return ",".join(keys)
