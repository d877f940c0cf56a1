"""Code: what is wrong with a file, by its lines."""

import re
import tomllib
from pathlib import Path
from typing import Any

from turgor.foundation.errors import TurgorError

#: A problem of a job as `turgor check` prints it: file, line and sentence.
_PROBLEM = re.compile(r"(?P<file>.+?):(?P<line>\d+): (?P<sentence>.+)", re.DOTALL)

#: Where TOML cannot be read.
_PLACE = re.compile(r"at line (\d+)")


def problems_of(file: Path) -> list[dict[str, Any]]:
    """Return the problems of a job or study file, each with its line from 1; 0 where a problem is of the whole file."""
    try:
        content = tomllib.loads(file.read_text(encoding="utf-8", errors="replace"))
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        place = _PLACE.search(str(error))
        return [{"line": int(place[1]) if place else 0, "sentence": f"This is no TOML: {error}."}]
    try:
        _read(file, content)
    except TurgorError as error:
        texts = getattr(error, "problems", None) or [error.on_command_line]
        return [_problem(text, file) for text in texts]
    return []


def _read(file: Path, content: dict[str, Any]) -> None:
    """Read a job, or what calls itself a study; other files have no problems that turgor knows."""
    from turgor.job.read import read_job
    from turgor.studies.study_file.study_file import read_study_file

    if "job" in content:
        read_study_file(file)
    elif "actuator" in content or "mesh" in content:
        read_job(file)


def _problem(text: str, file: Path) -> dict[str, Any]:
    match = _PROBLEM.fullmatch(text)
    if match is None:
        return {"line": 0, "sentence": text.replace(str(file), file.name)}
    return {"line": int(match["line"]), "sentence": match["sentence"].replace(str(file), file.name)}
