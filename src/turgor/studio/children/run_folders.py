"""Run folders: how a run goes or has gone, from the files on disk, whoever has started it."""

import re
from itertools import pairwise
from pathlib import Path, PurePosixPath
from typing import Any

from turgor.foundation.errors import TurgorError, unknown
from turgor.studio.children.children import Child, Children, waiting
from turgor.studio.children.tables import columns_of
from turgor.studio.settings import STUDIO
from turgor.studio.workspace import RESULTS_MARK, Workspace, read_json

#: Files of a run that the server reads by name.
RESPONSE, LOG, LOCK, IN_USE = "response.csv", "run.log", "job.lock.toml", ".in-use"

#: End of the folder of a coarse run, whose numbers the page marks.
COARSE = "-draft"

#: States of a run that has ended by itself.
ENDED = ("ended", "early")

_FINDING = re.compile(r"([A-Z]\d\d) (error|warning|note): (.+)")
_COMPLETE = "solved to the end: "
_COUNT = re.compile(r"\d+ steps accepted, ")
_STEP = re.compile(r"load factor ([\d.eE+-]+)")


def folder_of(workspace: Workspace, children: Children, name: str) -> Path:
    """Return the folder of a run that is listed, or that the studio has started."""
    if children.get(name) is not None:
        return workspace.folder / name
    return workspace.run(name)


def status_of(workspace: Workspace, children: Children, name: str, *, curve: bool = True) -> dict[str, Any]:
    """Return the state of a run, and what the page shows of it.

    Parameters
    ----------
    workspace : Workspace
    children : Children
    name : str
    curve : bool
        Whether the response, the log and the files are returned as well.
    """
    folder, child = folder_of(workspace, children, name), children.get(name)
    lines = _lines(folder, child, children)
    state = _state(folder, child)
    short = {
        "name": name,
        "job": "" if child is None else child.job,
        "coarse": name.endswith(COARSE),
        "state": state,
        "message": _ending(folder).removeprefix(_COMPLETE) if state in ENDED else _message(state, lines, child),
        "progress": _progress(state, lines),
        "started": _started(folder, child),
        "states": len(list((folder / "path").glob("state-*.turgor"))),
        "waiting": [] if child is None else list(waiting(child)),
    }
    if not curve:
        return short
    return short | {
        "columns": columns_of(folder / RESPONSE),
        "log": lines[-STUDIO.lines :],
        "findings": _findings(_text(folder / LOG) if state in ENDED else lines),
        "files": sorted(listed(folder)),
    }


def _state(folder: Path, child: Child | None) -> str:
    """State of a run: running, ended, early (before the full load), paused, failed or elsewhere."""
    if child is not None and child.alive:
        return "running"
    path = folder / "path"
    if child is None and (folder / IN_USE).exists():
        return "elsewhere"
    if (path / "solution.turgor").exists():
        ending = _ending(folder)
        return "early" if ending and not ending.startswith(_COMPLETE) else "ended"
    if any(path.glob("state-*.turgor")):
        return "paused" if child is None or child.code in (None, -2, -9, 130) else "failed"
    return "failed"


def _message(state: str, lines: list[str], child: Child | None) -> str:
    if state == "failed":
        said = [line for line in lines if line.strip() and not line.startswith("[")]
        if child is not None and child.code in (-2, -9, 130):
            return "It was stopped before its first state."
        return said[-1] if said else "It ended before its first state."
    talking = [re.sub(r"^\[ *[\d:]+\] ", "", line) for line in lines if line.startswith("[")]
    return talking[-1] if talking and state == "running" else ""


def _ending(folder: Path) -> str:
    """How the solve of a run has ended, as its log says: the line before the number of steps."""
    lines = _text(folder / LOG)
    return next((line for line, after in pairwise(lines) if _COUNT.match(after)), "")


def _progress(state: str, lines: list[str]) -> float:
    """Share of the load at the last step."""
    steps = [match[1] for line in lines if (match := _STEP.search(line))]
    return 1.0 if state == "ended" else float(steps[-1]) if steps else 0.0


def _started(folder: Path, child: Child | None) -> float:
    if child is not None:
        return child.started
    try:
        return (folder / LOCK).stat().st_mtime
    except OSError:
        return 0.0


def _lines(folder: Path, child: Child | None, children: Children) -> list[str]:
    """What the process has printed; of a run that others have started, its log."""
    return _text(folder / LOG if child is None else children.log(child.name))


def _text(file: Path) -> list[str]:
    try:
        return file.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return []


def _findings(lines: list[str]) -> list[dict[str, str]]:
    """Findings in a log: the code, the severity and the sentences."""
    known = {match[0]: match for line in lines if (match := _FINDING.search(line))}
    return [{"code": each[1], "severity": each[2], "message": each[3], "advice": ""} for each in known.values()]


def listed(folder: Path) -> frozenset[str]:
    """Return the names of the files in a folder of results that turgor wrote and that are there."""
    names = read_json(folder / RESULTS_MARK).get("files")
    if not isinstance(names, list):
        return frozenset()
    return frozenset(str(name) for name in names if _inside(folder, str(name)))


def _inside(folder: Path, name: str) -> bool:
    """Whether a name stays in a folder, also behind links: a manifest is a file that others may have changed."""
    path = PurePosixPath(name)
    if path.is_absolute() or ".." in path.parts or "\\" in name:
        return False
    file = folder / name
    return file.is_file() and file.resolve().is_relative_to(folder.resolve())


def file_of(folder: Path, name: str) -> Path:
    """Return a file of a folder of results that its manifest lists.

    Raises
    ------
    TurgorError
        If it lists none of this name: nothing else is sent.
    """
    names = listed(folder)
    if name not in names:
        raise unknown("file of the run", name[:120], names)
    return folder / name


def check_name(name: str) -> str:
    """Return a name of a folder of results, or say what is wrong with it."""
    plain = re.fullmatch(r"[\w][\w. -]{0,118}", name)
    if not plain:
        raise TurgorError(f"'{name[:120]}' is no name of a folder; use letters, digits and signs as in 'my-finger'.")
    return name
