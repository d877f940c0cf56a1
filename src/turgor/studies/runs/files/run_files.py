"""Files of runs that a later call reads again: a table, a picture and notes; or why one failed."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from turgor.core.results.files.response_csv import read_response
from turgor.foundation.response import Response
from turgor.foundation.source import Source
from turgor.foundation.store.atomic_files import whole
from turgor.studies.runs.run import Computed, Run

#: Key of the notes of a run that failed.
PROBLEM = "problem"


def saved_run(run: Run, folder: Path) -> Computed | None:
    """Read the result of a run, if it has ended before.

    Parameters
    ----------
    run : Run
    folder : Path
        Where `save_run` wrote it.

    Returns
    -------
    Computed or None
    """
    return run_with_key(run.key, folder)


def run_with_key(key: str, folder: Path) -> Computed | None:
    """Read the result of the run with a key, if it has ended.

    Parameters
    ----------
    key : str
    folder : Path

    Returns
    -------
    Computed or None
    """
    notes, table, picture = _files(key, folder)
    content = _read_notes(notes)
    if PROBLEM in content or not content or not table.is_file():
        return None
    read = read_response(table)
    source, status = Source(text=content["source"]), content.get("status", "")
    response = Response(columns=read.columns, source=source, status=status, message=content["message"])
    return Computed(
        response=response,
        picture=picture.read_bytes() if picture.is_file() else b"",
        seconds=float(content["cpu_seconds"]),
        notes=tuple(content.get("notes", ())),
    )


def save_run(run: Run, computed: Computed, folder: Path) -> None:
    """Write the result of a run: its table, its picture, and at last its notes, without which it has not ended.

    Parameters
    ----------
    run : Run
    computed : Computed
    folder : Path
        Created if there is none.
    """
    folder.mkdir(parents=True, exist_ok=True)
    notes, table, picture = _files(run.key, folder)
    computed.response.to_csv(table)
    if computed.picture:
        with whole(picture) as part:
            part.write_bytes(computed.picture)
    content = {
        **_request(run),
        "source": str(computed.response.source),
        "status": computed.response.status,
        "message": computed.response.message,
        "cpu_seconds": round(computed.seconds, 3),
        **({"notes": list(computed.notes)} if computed.notes else {}),
    }
    _write(notes, content)


def save_problem(run: Run, problem: str, folder: Path) -> None:
    """Write why a run failed.

    Parameters
    ----------
    run : Run
    problem : str
    folder : Path
        Created if there is none.
    """
    folder.mkdir(parents=True, exist_ok=True)
    _write(_files(run.key, folder)[0], {**_request(run), PROBLEM: problem})


def saved_problem(run: Run, folder: Path) -> str:
    """Read why a run failed before.

    Parameters
    ----------
    run : Run
    folder : Path
        Where `save_problem` wrote it.

    Returns
    -------
    str
        Empty where it has not failed.
    """
    return str(_read_notes(_files(run.key, folder)[0]).get(PROBLEM, ""))


def forget(run: Run, folder: Path) -> None:
    """Remove the files of a run, its notes first, so that it is computed again.

    Parameters
    ----------
    run : Run
    folder : Path
    """
    for file in _files(run.key, folder):
        file.unlink(missing_ok=True)


def _request(run: Run) -> dict[str, Any]:
    return {
        "name": run.name,
        "function": f"{run.function.__module__}.{run.function.__qualname__}",
        "values": dict(run.values),
        **({} if run.design is None else {"design": run.written_design}),
    }


def _read_notes(notes: Path) -> dict[str, Any]:
    """Read notes; nothing where there are none, or another call removes them at this moment to try again."""
    try:
        return dict(json.loads(notes.read_text(encoding="utf-8")))
    except FileNotFoundError:
        return {}


def _write(notes: Path, content: Mapping[str, Any]) -> None:
    with whole(notes) as part:
        part.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def _files(key: str, folder: Path) -> tuple[Path, Path, Path]:
    return folder / f"{key}.json", folder / f"{key}.csv", folder / f"{key}.png"
