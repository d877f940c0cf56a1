"""A job with every value as a file: the base of all runs of a study, and its hash."""

import tomllib
from pathlib import Path

from turgor.foundation.store.atomic_files import whole
from turgor.job.job import Job
from turgor.job.output.identity import digest
from turgor.job.output.lock import lock_text
from turgor.studies.runs.jobs.job_numbers import JobNumber, numbers_of


def write_whole_job(job: Job, file: Path) -> dict[str, JobNumber]:
    """Write a job with every value, defaults and constants of library materials included, and return its numbers.

    Parameters
    ----------
    job : Job
    file : Path

    Returns
    -------
    dict of str to JobNumber
        By key.
    """
    text = lock_text(job, {})
    if not file.is_file() or file.read_text(encoding="utf-8") != text:
        file.parent.mkdir(parents=True, exist_ok=True)
        with whole(file) as part:  # tasks on several machines may write it at once
            part.write_text(text, encoding="utf-8")
    return numbers_of(tomllib.loads(text))


def digest_of(file: Path) -> str:
    """Return a hash of what a job computes and measures, from its file with every value.

    Parameters
    ----------
    file : Path
        Of `write_whole_job`.

    Returns
    -------
    str
    """
    return digest(tomllib.loads(file.read_text(encoding="utf-8")), ("name", "written_by", "engine"))
