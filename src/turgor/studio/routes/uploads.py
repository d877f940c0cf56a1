"""Uploads: a file from the page is stored in the folder only after a process of its own could read it."""

import os
import re
import shutil
import time
import tomllib
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from anyio import to_thread
from starlette.requests import Request

from turgor.foundation.errors import TurgorError
from turgor.studio.answers import Studio, TooLarge, route
from turgor.studio.settings import STUDIO
from turgor.studio.workspace import PARTS

#: Endings of what the page may send: parts, tests of a material, and job files.
ALLOWED = (*PARTS, ".csv", ".toml")

#: Age after which an unfinished upload is one of a server that was killed [s]; reading takes minutes at most.
STALE = 3600.0

#: Longest name of a stored file without its ending: what every file system takes, with a number behind it.
LONGEST_STEM = 80


def stored_name(name: str) -> str:
    """Return the name under which a sent file is stored.

    Parameters
    ----------
    name : str
        As the browser states it.

    Raises
    ------
    TurgorError
        If it is a path, or its ending is none that is read.

    Examples
    --------
    >>> stored_name("my finger (2).STEP")
    'my-finger-2.step'
    """
    if not name or re.search(r"[/\\\x00-\x1f]", name) or name.startswith("."):
        raise TurgorError(f"{name[:120]!r} is no name of a file; allowed are names such as 'finger.step'.")
    stem, ending = os.path.splitext(name)
    if ending.lower() not in ALLOWED:
        raise TurgorError(f"'{name[:120]}' ends in '{ending[:20]}'; allowed are {', '.join(ALLOWED)}.")
    plain = "-".join(re.findall(r"\w+", stem, re.ASCII))[:LONGEST_STEM] or "part"
    return plain + ending.lower()


async def _upload(studio: Studio, request: Request) -> Any:
    """Store a file: its name and the unit of its numbers are in the address."""
    name = stored_name(request.query_params.get("name", ""))
    unit = request.query_params.get("unit") or None
    place = studio.workspace.own("uploads")
    _sweep(place)
    folder = Path(mkdtemp(dir=place))
    try:
        part = folder / name
        await _received(request, part)
        if part.suffix == ".toml":
            _check_job(part)
            facts: dict[str, Any] = {"kind": "job"}
        else:
            facts = await _looked(studio, part, unit)
        return {"name": await to_thread.run_sync(_moved, part, studio.workspace.folder), **facts}
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _sweep(place: Path) -> None:
    """Remove what a server has left that was killed during an upload."""
    for each in place.iterdir():
        if each.stat().st_mtime < time.time() - STALE:
            shutil.rmtree(each, ignore_errors=True)


async def _looked(studio: Studio, part: Path, unit: str | None) -> dict[str, Any]:
    try:
        facts: dict[str, Any] = await studio.slow.do("uploads.look", part, unit)
    except TurgorError as error:
        raise TurgorError(error.on_command_line.replace(f"{part.parent}{os.sep}", "")) from error
    return facts


async def _received(request: Request, part: Path) -> None:
    """Write the body into a file; nothing is read beyond the limit."""
    stated = request.headers.get("content-length", "0")
    count = int(stated) if stated.isdigit() else 0
    with part.open("xb") as file:
        if count <= STUDIO.upload_bytes:
            async for piece in request.stream():
                count = max(count, file.tell() + len(piece))
                if count > STUDIO.upload_bytes:
                    break
                file.write(piece)
        empty = file.tell() == 0
    if count > STUDIO.upload_bytes:
        most = f"more than {STUDIO.upload_bytes / 1e6:.0f} MB"
        raise TooLarge(f"'{part.name}' has {most}, which is the most that is read; put it into the folder.")
    if empty:
        raise TurgorError(f"'{part.name}' is empty.")


def _check_job(file: Path) -> None:
    """Refuse a file that is no TOML, or no job or study."""
    if file.stat().st_size > STUDIO.body_bytes:
        raise TooLarge(f"'{file.name}' has more than {STUDIO.body_bytes / 1e6:.0f} MB; a job file has some kilobytes.")
    try:
        content = tomllib.loads(file.read_bytes().decode("utf-8"))
    except (ValueError, RecursionError) as error:
        raise TurgorError(f"'{file.name}' is no TOML: {error}.") from error
    if not {"actuator", "mesh", "job"} & set(content):
        raise TurgorError(f"'{file.name}' is no job: it has no table [actuator].")


def _moved(part: Path, folder: Path) -> str:
    """Move a file into the folder, under a name that is free."""
    for number in range(1, 10_000):
        name = part.name if number == 1 else f"{part.stem}-{number}{part.suffix}"
        try:
            (folder / name).open("xb").close()
        except FileExistsError:
            continue
        os.replace(part, folder / name)
        return name
    raise TurgorError(f"the folder has too many files called '{part.name}'.")


UPLOADS = [route("/api/uploads", _upload, "POST")]
