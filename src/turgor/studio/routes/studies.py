"""Studies: written as study files, started as processes of their own; their tables fill as runs end."""

import os
import tomllib
from pathlib import Path
from typing import Any

from anyio import to_thread
from starlette.requests import Request
from starlette.responses import FileResponse

from turgor.foundation.errors import TurgorError, unknown
from turgor.studio.answers import Studio, route, table_of, text_in
from turgor.studio.children.children import Child
from turgor.studio.children.run_folders import check_name
from turgor.studio.children.tables import columns_of
from turgor.studio.edits import with_values
from turgor.studio.settings import STUDIO
from turgor.studio.tasks.runs.studies import FOLDERS, RUNS

#: Files of a study that a page shows or saves.
_FILES = {".png": "image/png", ".csv": "text/csv; charset=utf-8", ".txt": "text/plain; charset=utf-8",
          ".toml": "text/plain; charset=utf-8", ".json": "application/json"}  # fmt: skip


async def _list(studio: Studio, request: Request) -> Any:
    """All study files with the kinds that they state."""
    names = [str(each["name"]) for each in studio.workspace.content()["jobs"] if each["kind"] == "study"]  # type: ignore[attr-defined]
    return [{"name": name, "kinds": _kinds(studio.workspace.job(name))} for name in names]


def _kinds(file: Path) -> list[str]:
    content = _content(file)
    return [kind for kind in FOLDERS if kind in content] or (["sweep"] if "factors" in content else [])


def _content(file: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def _place(studio: Studio, name: str, kind: str) -> tuple[Path, Path]:
    """The study file, and the folder of its results."""
    file = studio.workspace.job(name)
    if kind not in FOLDERS:
        raise unknown("kind of study", kind[:40], FOLDERS)
    stem = str(_content(file).get("name", file.stem))
    return file, studio.workspace.folder / check_name(f"{stem}-{FOLDERS[kind]}")


async def _new(studio: Studio, request: Request) -> Any:
    """Write a study file from the values of a form, and start it."""
    given = await table_of(request)
    kind, values = text_in(given, "kind"), given.get("values")
    file = studio.workspace.new(text_in(given, "name"), ".toml")
    if kind not in FOLDERS or not isinstance(values, dict):
        raise TurgorError("a study needs a kind and a table of values.")
    file.write_text(with_values("", {"job": text_in(given, "job"), **values}), encoding="utf-8")
    try:
        planned = await studio.slow.do("runs.studies.check", file, kind)
    except TurgorError:
        file.unlink()
        raise
    return {"name": file.name, **planned, **await _begin(studio, file.name, kind)}


async def _numbers(studio: Studio, request: Request) -> Any:
    """What a study of a job may vary and read."""
    return await studio.slow.do("runs.studies.numbers", studio.workspace.job(request.path_params["job"]))


async def _reach(studio: Studio, request: Request) -> Any:
    """Compute the workspace of several cavities of a job."""
    given = await table_of(request)
    file, pressures = studio.workspace.job(text_in(given, "job")), given.get("pressures")
    if not isinstance(pressures, dict) or not pressures:
        raise TurgorError("a workspace needs pressures by cavity.")
    folder = check_name(f"{file.stem}-workspace")
    texts = [f"{name}={text}" for name, text in pressures.items()]
    child = Child(
        name=folder, kind="workspace", job=file.name, module="turgor.studio.tasks.runs.reach",
        arguments=(file.name, folder, _processes(), *texts),
    )  # fmt: skip
    await to_thread.run_sync(studio.children.start, child)
    return {"folder": folder}


async def _reached(studio: Studio, request: Request) -> Any:
    """What a workspace has reached so far."""
    file = studio.workspace.job(request.path_params["job"])
    name = check_name(f"{file.stem}-workspace")
    child = studio.children.get(name)
    folder = studio.workspace.folder / name
    if child is None and not folder.is_dir():
        return {"state": "none", "points": []}
    running = child is not None and child.alive
    log = studio.children.log(name)
    said = log.read_text(encoding="utf-8", errors="replace").strip() if log.exists() else ""
    state = "running" if running else "ended" if (folder / "workspace.csv").exists() else "failed"
    return {"state": state, "message": said[-1000:], **await studio.slow.do("runs.reach.reached", folder)}


def _processes() -> str:
    """Processes at once: one for each processor."""
    return str(max(1, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1))


async def _start(studio: Studio, request: Request) -> Any:
    """Start a study, or go on with it: what has ended is read, not computed again."""
    given = await table_of(request)
    return await _begin(studio, text_in(given, "study"), text_in(given, "kind"))


async def _begin(studio: Studio, name: str, kind: str) -> dict[str, Any]:
    file, folder = _place(studio, name, kind)
    arguments = (kind, file.name, "--output", folder.name, "--processes", _processes())
    child = Child(name=folder.name, kind=kind, job=file.name, arguments=arguments)
    await to_thread.run_sync(studio.children.start, child)
    return {"folder": folder.name}


async def _status(studio: Studio, request: Request) -> Any:
    """State of a study, its rows so far, its log and its files."""
    name, kind = request.query_params.get("study", ""), request.query_params.get("kind", "")
    file, folder = _place(studio, name, kind)
    child = studio.children.get(folder.name)
    running = child is not None and child.alive
    try:
        rows = await studio.slow.do("runs.studies.rows", file, folder, kind)
        planned = await studio.slow.do("runs.studies.check", file, kind)
    except TurgorError as error:
        rows, planned = [], {"planned": None, "rule": "", "problem": error.on_command_line}
    log = studio.children.log(folder.name)
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines() if log.exists() else []
    ended = any((folder / each).exists() for each in ("study.json", "optimization.csv", "calibration.json"))
    state = "running" if running else "ended" if ended else "paused" if rows else "none" if child is None else "failed"
    return {
        **planned,
        "folder": folder.name,
        "state": state,
        "rows": rows,
        "solving": len(list(folder.glob("paths/*"))),
        "log": lines[-STUDIO.lines :],
        "files": sorted(_files(folder)),
    }


def _files(folder: Path) -> list[str]:
    if not folder.is_dir():
        return []
    return [
        each.name for each in os.scandir(folder) if each.is_file(follow_symlinks=False) and _ending(each.name) in _FILES
    ]


def _ending(name: str) -> str:
    return os.path.splitext(name)[1]


async def _file(studio: Studio, request: Request) -> Any:
    """A file of a study that is listed."""
    _, folder = _place(studio, request.query_params.get("study", ""), request.query_params.get("kind", ""))
    name, known = request.query_params.get("file", ""), _files(folder)
    if name not in known:
        raise unknown("file of the study", name[:120], known)
    save = "inline" if request.query_params.get("show") else "attachment"
    return FileResponse(folder / name, media_type=_FILES[_ending(name)], filename=name, content_disposition_type=save)


async def _curve(studio: Studio, request: Request) -> Any:
    """The whole curve of a row."""
    _, folder = _place(studio, request.query_params.get("study", ""), request.query_params.get("kind", ""))
    key, known = request.query_params.get("row", ""), _keys(folder)
    if key not in known:
        raise unknown("row of the study", key[:40], known)
    return {"columns": columns_of(folder / RUNS / f"{key}.csv")}


def _keys(folder: Path) -> list[str]:
    return sorted(each.stem for each in (folder / RUNS).glob("*.json"))


async def _design(studio: Studio, request: Request) -> Any:
    """Write the design of a row as a job, and return its name; the same one where it was written before."""
    given = await table_of(request)
    _, folder = _place(studio, text_in(given, "study"), text_in(given, "kind"))
    key = text_in(given, "row")
    name = f"{folder.name}-{key[:8]}.toml"
    if name not in studio.workspace.jobs():
        await studio.slow.do("runs.studies.design", folder, key, studio.workspace.new(name, ".toml"))
    return {"name": name}


async def _end(studio: Studio, request: Request) -> Any:
    """Pause a study: runs that have ended are saved, and the others go on from their last states later."""
    given = await table_of(request)
    _, folder = _place(studio, text_in(given, "study"), text_in(given, "kind"))
    await to_thread.run_sync(studio.children.stop, folder.name)
    return {"folder": folder.name}


STUDIES = [
    route("/api/studies", _list),
    route("/api/studies", _new, "POST"),
    route("/api/studies/start", _start, "POST"),
    route("/api/studies/status", _status),
    route("/api/studies/file", _file),
    route("/api/studies/curve", _curve),
    route("/api/studies/design", _design, "POST"),
    route("/api/studies/end", _end, "POST"),
    route("/api/studies/numbers/{job}", _numbers),
    route("/api/studies/workspace", _reach, "POST"),
    route("/api/studies/workspace/{job}", _reached),
]
