"""Identity of a job: what it computes, whatever its file is called, wherever it lies and however its path was typed."""

import json
import tomllib
from collections.abc import Collection, Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

from turgor.foundation.errors import TurgorError
from turgor.job.job import Job
from turgor.job.output.folder import LOCK
from turgor.job.output.lock import lock_text
from turgor.job.output.manifest import job_digest

#: Tables of a lock file that do not change the path.
IGNORED = frozenset({"name", "written_by", "engine", "output"})


def identity(content: Mapping[str, Any], ignored: Collection[str] = IGNORED) -> dict[str, Any]:
    """Return the values of a lock file by their keys with dots, without what does not change what is computed.

    Left out are the name, where numbers come from, and the path of a file whose content is stated by its hash.

    Parameters
    ----------
    content : mapping
        A lock file.
    ignored : collection of str
        Tables.

    Examples
    --------
    >>> identity({"name": "a", "materials": {"body": {"C10": "1 kPa", "source": {"text": "a.toml"}}}})
    {'materials.body.C10': '1 kPa'}
    """
    return _flat({key: value for key, value in content.items() if key not in ignored})


def _flat(table: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    flat: dict[str, Any] = {}
    skipped = {"source", *(("file",) if "sha256" in table else ())}
    for key, value in table.items():
        if key not in skipped:
            flat |= _flat(value, f"{before}{key}.") if isinstance(value, Mapping) else {f"{before}{key}": value}
    return flat


def digest(content: Mapping[str, Any], ignored: Collection[str] = IGNORED) -> str:
    """Return a hash of the identity of a lock file; parameters as those of `identity`."""
    return sha256(json.dumps(identity(content, ignored), sort_keys=True, default=str).encode()).hexdigest()[:16]


def digest_of(job: Job) -> str:
    """Return a hash of what a job computes."""
    return digest(tomllib.loads(lock_text(job, {})))


def read_lock(file: Path) -> dict[str, Any] | None:
    """Return the content of a lock file; None where it is missing or damaged."""
    try:
        content = tomllib.loads(file.read_text("utf-8"))
    except (OSError, ValueError):  # a TOML error and a wrong encoding are ValueErrors
        return None
    return content if "procedure" in content or "stages" in content else None


def check_same_job(job: Job, folder: Path) -> None:
    """Check that the run in a folder is that of a job.

    Parameters
    ----------
    job : Job
    folder : Path

    Raises
    ------
    TurgorError
        If it is of another one, with the first keys that differ.
    """
    before = read_lock(folder / LOCK)
    if before is None:
        known = job_digest(folder)
        if known and known != digest_of(job):
            raise TurgorError(
                f"the run in '{folder}' was one of another job; which keys differ is not known, because '{LOCK}' is "
                "damaged. Go on with the job as it was, or",
                python="begin again with force=True.",
                command="begin again with --force.",
            )
        return
    here, there = identity(tomllib.loads(lock_text(job, {}))), identity(before)
    other = [key for key in sorted(here | there) if here.get(key) != there.get(key)]
    if other:
        listed = "; ".join(
            f"{key} is {here.get(key, 'not given')} here, {there.get(key, 'not given')} there" for key in other[:3]
        )
        more = f"; and {len(other) - 3} more" if len(other) > 3 else ""
        raise TurgorError(
            f"the run in '{folder}' was one of another job: {listed}{more}. Go on with the job as it was, or",
            python="begin again with force=True.",
            command="begin again with --force.",
        )
