"""Studies: the rows that a study has so far, from its folder; and a row as a job of its own."""

import json
import tomllib
from collections.abc import Mapping
from math import isfinite
from pathlib import Path
from typing import Any

from turgor.foundation.errors import TurgorError, unknown

#: Folder of the runs of a study, and the job with every value.
RUNS, START = "runs", "start.toml"

#: Tables of a study file with runs of their own, and the ends of the folders that their commands write.
FOLDERS: Mapping[str, str] = {"sweep": "study", "optimize": "optimization", "calibrate": "calibration"}


def check(file: Path, kind: str) -> dict[str, Any]:
    """Read a study file; return how many designs it has, at most.

    Parameters
    ----------
    file : Path
    kind : str
        One of `FOLDERS`.
    """
    from turgor.studies.study_file.study_file import read_study_file

    study = read_study_file(file, kind=kind)
    if study.sweep is not None:
        return {"planned": len(study.sweep.designs), "rule": study.sweep.designs.rule}
    if study.optimize is not None:
        return {"planned": study.optimize.search.most_solves, "rule": "at most"}
    return {"planned": None if study.calibrate is None else study.calibrate.most_solves, "rule": "at most"}


def numbers(file: Path) -> dict[str, Any]:
    """Return the numbers of a job that a study may vary, with every default, and what the job measures.

    Parameters
    ----------
    file : Path
        A job file.
    """
    from turgor.core.model.loads import pressures_among
    from turgor.core.results.measures.measures import MEASURES
    from turgor.job.output.lock import lock_text
    from turgor.job.read import read_job
    from turgor.studies.runs.jobs.job_numbers import numbers_of

    job = read_job(file)
    known = numbers_of(tomllib.loads(lock_text(job, {})))
    return {
        "numbers": [
            {"key": each.key, "value": float(f"{each.value / each.factor:.6g}"), "unit": each.unit, "whole": each.whole}
            for each in known.values()
        ],
        "measures": list(dict.fromkeys([*job.output.measures, *MEASURES])),
        "cavities": [load.face for load in pressures_among(job.loads)],
    }


def rows(file: Path, folder: Path, kind: str) -> list[dict[str, Any]]:
    """Return a row for each run that has ended: its numbers, measures with mesh errors, and what went wrong.

    Parameters
    ----------
    file : Path
        The study file.
    folder : Path
        Of its results.
    kind : str
    """
    from turgor.studies.runs.jobs.job_numbers import numbers_of
    from turgor.studies.study_file.study_file import read_study_file

    if not (folder / START).is_file():
        return []
    numbers = numbers_of(_start(folder))
    at: tuple[str, float] | None = None
    measures: tuple[str, ...] = ()
    if kind == "sweep":
        plan = read_study_file(file, kind=kind).sweep
        at, measures = (None, ()) if plan is None else (plan.at, tuple(plan.measures))
    notes = sorted((folder / RUNS).glob("*.json"), key=lambda each: each.stat().st_mtime_ns)
    return [_row(each, numbers, at, measures) for each in notes if _notes(each)]


def _row(notes: Path, numbers: Mapping[str, Any], at: Any, measures: tuple[str, ...]) -> dict[str, Any]:
    from turgor.foundation.response import COLUMN_UNITS, MESH_ERROR
    from turgor.studies.runs.files.run_files import run_with_key
    from turgor.studies.runs.study import read_at

    content = _notes(notes)
    computed = run_with_key(notes.stem, notes.parent)
    values = []
    response = None if computed is None else computed.response
    for column in () if response is None else response.columns:
        chosen = not measures or column.name in measures
        if column.name.endswith(MESH_ERROR) or not chosen or column.name == (at or ("load_factor",))[0]:
            continue
        scale, error = COLUMN_UNITS[column.unit], read_at(response, column.name + MESH_ERROR, at)
        value = read_at(response, column.name, at)
        values.append({
            "name": column.name, "unit": column.unit, "value": value / scale if isfinite(value) else None,
            "error": error / scale if isfinite(error) else None,
        })  # fmt: skip
    return {
        "key": notes.stem,
        "factors": [_factor(keys, value, numbers) for keys, value in _numbers(content).items()],
        "measures": values,
        "status": "" if response is None else response.status,
        "problem": content.get("problem") or ("" if response is None else response.message),
        "seconds": content.get("cpu_seconds"),
    }


def _factor(keys: str, value: Any, numbers: Mapping[str, Any]) -> dict[str, Any]:
    number = numbers.get(keys.split(",")[0])
    if number is None or isinstance(value, str):
        return {"name": keys, "unit": "", "value": value}
    return {"name": keys, "unit": number.unit, "value": float(f"{value / number.factor:.6g}")}


def design(folder: Path, key: str, file: Path) -> None:
    """Write the design of a row as a job of its own.

    Parameters
    ----------
    folder : Path
        Of the study.
    key : str
        Of the row.
    file : Path
        The job to write.
    """
    from turgor.studies.runs.jobs.job_function import JobFunction
    from turgor.studies.runs.jobs.job_numbers import numbers_of

    notes = {each.stem: each for each in (folder / RUNS).glob("*.json")}
    if key not in notes:
        raise unknown("row of the study", key[:40], notes)
    content = _notes(notes[key])
    if not content:
        raise TurgorError("this row is being written; try again.")
    base = JobFunction(file=folder / START, numbers=numbers_of(_start(folder)))
    base.write(_numbers(content), file, f"Design of the study '{folder.name}': {content.get('name', key)}")


def _numbers(content: Mapping[str, Any]) -> dict[str, Any]:
    return dict(content.get("values", {}).get("numbers", {}))


def _start(folder: Path) -> dict[str, Any]:
    return tomllib.loads((folder / START).read_text(encoding="utf-8"))


def _notes(file: Path) -> dict[str, Any]:
    try:
        return dict(json.loads(file.read_text(encoding="utf-8")))
    except (OSError, ValueError):
        return {}
