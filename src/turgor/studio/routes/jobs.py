"""Jobs: files of the workspace that the page reads and edits; the file on disk is the state."""

from typing import Any

from anyio import to_thread
from starlette.requests import Request

from turgor.foundation.errors import TurgorError
from turgor.studio.answers import Studio, route, table_of, text_in
from turgor.studio.edits import with_values
from turgor.studio.history import History


def history_of(studio: Studio, name: str) -> History:
    """Return a job file with its edits."""
    file = studio.workspace.job(name)
    return History(file, studio.workspace.own("history") / file.name)


async def _workspace(studio: Studio, request: Request) -> Any:
    return await to_thread.run_sync(studio.workspace.content)


async def _read(studio: Studio, request: Request) -> Any:
    return history_of(studio, request.path_params["name"]).state()


async def _edit(studio: Studio, request: Request) -> Any:
    """Replace the text, or set values by their dotted keys; null removes a key."""
    history, given = history_of(studio, request.path_params["name"]), await table_of(request)
    version = text_in(given, "version")
    values = given.get("values")
    if values is None:
        text = text_in(given, "text")
    elif isinstance(values, dict):
        text = with_values(history.text, values)
    else:
        raise TurgorError("the request has no table 'values'.")
    history.write(text, version)
    return history.state()


async def _step(studio: Studio, request: Request) -> Any:
    history, given = history_of(studio, request.path_params["name"]), await table_of(request)
    way = request.path_params["way"]
    if way not in ("undo", "redo"):
        raise TurgorError(f"'{way[:40]}' is no way to step; allowed are undo and redo.")
    history.step(way, text_in(given, "version"))
    return history.state()


async def _new(studio: Studio, request: Request) -> Any:
    """Write the job of a family or of a part under a new name."""
    given = await table_of(request)
    file = studio.workspace.new(text_in(given, "name"), ".toml")
    if "part" in given:
        part = studio.workspace.file(text_in(given, "part"))
        text = await studio.slow.do("starting.job_of_part", part, given.get("unit"))
    else:
        text = await studio.worker.do("starting.job_of_family", text_in(given, "family"))
    file.write_text(text, encoding="utf-8")
    return history_of(studio, file.name).state()


JOBS = [
    route("/api/workspace", _workspace),
    route("/api/jobs", _new, "POST"),
    route("/api/jobs/{name}", _read),
    route("/api/jobs/{name}", _edit, "PATCH"),
    route("/api/jobs/{name}/{way}", _step, "POST"),
]
