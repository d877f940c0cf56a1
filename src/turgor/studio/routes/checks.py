"""Checks: what is wrong with a job, what would mend it, and what its solve would cost; and the page of a finding."""

import re
from functools import cache
from pathlib import Path
from typing import Any

from starlette.requests import Request

from turgor.foundation.errors import TurgorError
from turgor.studio.answers import Studio, route
from turgor.studio.history import version_of

#: Where the page of findings is: in the package, or in the repository next to it.
_PAGES = ("findings.md", "../../../docs/findings.md")


async def _check(studio: Studio, request: Request) -> Any:
    """Check a job; ``superseded`` where a newer check has replaced this one."""
    name = request.path_params["name"]
    file = studio.workspace.job(name)
    version = version_of(file.read_bytes().decode("utf-8", errors="replace"))
    answer = await studio.checking.do(name, "runs.checks.check", file, name)
    return {"superseded": True} if answer is None else {**answer, "version": version}


async def _estimate(studio: Studio, request: Request) -> Any:
    return await studio.slow.do("runs.estimates.estimate", studio.workspace.job(request.path_params["name"]))


async def _finding(studio: Studio, request: Request) -> Any:
    """Paragraphs of the documentation about a code."""
    code = request.path_params["code"]
    section = _sections().get(code)
    if section is None:
        raise TurgorError(f"there is no finding '{code[:20]}'.")
    return {"code": code, "paragraphs": section}


@cache
def _sections() -> dict[str, list[str]]:
    """Paragraphs of each section of the page of findings, by code."""
    home = Path(__file__).parents[1]
    text = next((file.read_text(encoding="utf-8") for each in _PAGES if (file := home / each).is_file()), "")
    sections = {}
    for part in re.split(r"^## ", text, flags=re.MULTILINE)[1:]:
        head, _, body = part.partition("\n")
        plain = re.sub(r"\[([^\]]+)\]\([^)]*\)", r"\1", body).replace("*", "").replace("`", "")
        sections[head.strip()] = [" ".join(each.split()) for each in plain.split("\n\n") if each.strip()]
    return sections


CHECKS = [
    route("/api/checks/{name}", _check),
    route("/api/estimates/{name}", _estimate),
    route("/api/findings/{code}", _finding),
]
