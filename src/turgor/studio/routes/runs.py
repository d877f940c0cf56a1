"""Runs: started, watched, paused and ended as processes of their own; their files, by their manifest alone."""

import zipfile
from pathlib import Path
from typing import Any

from anyio import to_thread
from starlette.background import BackgroundTask
from starlette.requests import Request
from starlette.responses import FileResponse, Response

from turgor.foundation.errors import TurgorError
from turgor.studio.answers import Studio, body_of, route, table_of, text_in
from turgor.studio.children.children import Child
from turgor.studio.children.run_folders import COARSE, check_name, file_of, folder_of, listed, status_of
from turgor.studio.children.tables import columns_of
from turgor.studio.guard import REPORT_POLICY
from turgor.studio.settings import STUDIO

#: Endings of the folders of runs: the fine one, and the coarse one before it.
FINE = "-results"

#: Pictures and tables that a browser shows; everything else is saved.
_SHOWN = {".png": "image/png", ".csv": "text/csv; charset=utf-8", ".log": "text/plain; charset=utf-8"}


def _query(request: Request, key: str) -> str:
    return request.query_params.get(key, "")


async def _list(studio: Studio, request: Request) -> Any:
    """All runs of the workspace, also those that have no folder yet, the latest first."""
    return await to_thread.run_sync(_all, studio)


def _all(studio: Studio) -> list[dict[str, Any]]:
    children = studio.children
    begun = [child.name for child in children.all() if child.kind in ("run", "coarse")]
    names = dict.fromkeys([*begun, *studio.workspace.runs()])
    states = [status_of(studio.workspace, children, name, curve=False) for name in names]
    return sorted(states, key=lambda each: -each["started"])


async def _status(studio: Studio, request: Request) -> Any:
    name = _query(request, "run")
    return await to_thread.run_sync(lambda: status_of(studio.workspace, studio.children, name))


async def _start(studio: Studio, request: Request) -> Any:
    """Start the coarse and the fine run of a job, one of them, or go on with one."""
    given = await table_of(request)
    job, way = text_in(given, "job"), text_in(given, "way")
    file = studio.workspace.job(job)
    stem = check_name(file.stem)
    fine = Child(name=f"{stem}{FINE}", kind="run", job=job, arguments=_arguments(job, f"{stem}{FINE}", "--force"))
    if way == "resume":
        name = text_in(given, "run") if "run" in given else fine.name
        return await _begin(studio, _resumed(studio, name, job))
    if way == "fine":
        return await _begin(studio, fine)
    if way != "coarse" and way != "both":
        raise TurgorError(f"'{way[:40]}' is no way to start; allowed are both, coarse, fine and resume.")
    changes = await studio.checking.worker.do("runs.checks.coarse_of", file)
    options = ["--force", *(f"--set={change}" for change in changes)]
    name = f"{stem}{COARSE}"
    coarse = Child(name=name, kind="coarse", job=job, arguments=_arguments(job, name, *options))
    if way == "both":
        running = studio.children.get(fine.name)
        if running is not None and running.alive:
            raise TurgorError(f"'{fine.name}' is being computed already; nothing is started twice.")
        later = {"name": fine.name, "kind": fine.kind, "job": job, "arguments": list(fine.arguments)}
        coarse = Child(name=name, kind="coarse", job=job, arguments=coarse.arguments, after=(later,))
    return await _begin(studio, coarse)


def _arguments(job: str, output: str, *options: str) -> tuple[str, ...]:
    return ("run", job, "--output", output, *options)


def _resumed(studio: Studio, name: str, job: str) -> Child:
    """A run that goes on: with the changes with which it was begun."""
    before = studio.children.get(name)
    if before is None:
        studio.workspace.run(name)
        return Child(name=name, kind="run", job=job, arguments=_arguments(job, name, "--resume"))
    arguments = tuple(each for each in before.arguments if each not in ("--force", "--resume"))
    return Child(name=name, kind=before.kind, job=before.job, arguments=(*arguments, "--resume"))


async def _begin(studio: Studio, child: Child) -> Any:
    begun = await to_thread.run_sync(studio.children.start, child)
    return {"name": begun.name, "waiting": [each["name"] for each in begun.after]}


async def _end(studio: Studio, request: Request) -> Any:
    """Pause a run, which writes what it has, or stop it within a second."""
    given = await table_of(request)
    name, way = text_in(given, "run"), request.path_params["way"]
    ways = {"pause": studio.children.interrupt, "stop": studio.children.stop}
    if way not in ways:
        raise TurgorError(f"'{way[:40]}' is no way to end a run; allowed are pause and stop.")
    await to_thread.run_sync(ways[way], name)
    return {"name": name}


async def _scene(studio: Studio, request: Request) -> Any:
    """What the viewer draws of a run; nothing where it has no state yet."""
    folder = folder_of(studio.workspace, studio.children, _query(request, "run"))
    text = await studio.worker.do("runs.scenes.scene", folder, _query(request, "part") != "live")
    return Response(text, media_type="application/json") if text else Response(status_code=204)


async def _file(studio: Studio, request: Request) -> Any:
    """A file that the manifest of a run lists; a report opens, other files are saved."""
    folder = folder_of(studio.workspace, studio.children, _query(request, "run"))
    file = file_of(folder, _query(request, "file"))
    if file.suffix == ".html":
        return FileResponse(file, media_type="text/html", headers={"content-security-policy": REPORT_POLICY})
    kind = _SHOWN.get(file.suffix, "application/octet-stream")
    save = "inline" if _query(request, "show") else "attachment"
    return FileResponse(file, media_type=kind, filename=f"{folder.name}-{file.name}", content_disposition_type=save)


async def _fields(studio: Studio, request: Request) -> Any:
    """The fields of all states in one archive."""
    folder = folder_of(studio.workspace, studio.children, _query(request, "run"))
    names = sorted(name for name in listed(folder) if name.startswith("vtu/"))
    if not names:
        raise TurgorError("this run has no fields yet; make them first.")
    archive = studio.workspace.own("exports") / f"{folder.name}-vtu.zip"
    await to_thread.run_sync(_pack, archive, folder, names)
    return FileResponse(archive, filename=archive.name, background=BackgroundTask(archive.unlink, missing_ok=True))


def _pack(archive: Path, folder: Path, names: list[str]) -> None:
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as packed:
        for name in names:
            packed.write(folder / name, name)


async def _make(studio: Studio, request: Request) -> Any:
    """Write a file of a run that is not there yet."""
    given = await table_of(request)
    name, state = text_in(given, "run"), given.get("state")
    child = studio.children.get(name)
    if child is not None and child.alive:
        raise TurgorError("the run still writes into its folder; wait until it has ended, or pause it.")
    folder = folder_of(studio.workspace, studio.children, name)
    number = state if isinstance(state, int) else 10**6
    return {"file": await studio.slow.do("runs.making.make", folder, text_in(given, "kind"), number)}


async def _experiment(studio: Studio, request: Request) -> Any:
    """Columns of a table of the workspace, such as an experiment next to curves."""
    return {"columns": columns_of(studio.workspace.file(_query(request, "table")))}


async def _dropped(studio: Studio, request: Request) -> Any:
    """Save a table that was dropped on the page."""
    file = studio.workspace.new(_query(request, "name"), ".csv")
    body = await body_of(request, STUDIO.body_bytes)
    try:
        file.write_text(body.decode("utf-8-sig"), encoding="utf-8")
    except UnicodeDecodeError as error:
        raise TurgorError("this is no text; a CSV file in UTF-8 is needed.") from error
    return {"name": file.name}


RUNS = [
    route("/api/runs", _list),
    route("/api/runs", _start, "POST"),
    route("/api/runs/status", _status),
    route("/api/runs/scene", _scene),
    route("/api/runs/file", _file),
    route("/api/runs/fields", _fields),
    route("/api/runs/make", _make, "POST"),
    route("/api/runs/experiment", _experiment),
    route("/api/runs/experiment", _dropped, "POST"),
    route("/api/runs/{way}", _end, "POST"),
]
