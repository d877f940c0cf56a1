"""Studies as folders and tables: written, and read again."""

import csv
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

from turgor.foundation.errors import TurgorError
from turgor.foundation.response import COLUMN_UNITS, Column, Response
from turgor.foundation.source import Source
from turgor.foundation.store.atomic_files import whole
from turgor.studies.runs.executors.run_outcome import Ended
from turgor.studies.runs.factor import Factor
from turgor.studies.runs.files.designs_csv import read_designs
from turgor.studies.runs.files.run_files import run_with_key, save_run, saved_run
from turgor.studies.runs.run import Computed, Run
from turgor.studies.runs.study import FAILED, Row, Study

#: Files of a folder: the rows with the keys of their runs; the runs with their whole curves; and the table.
INDEX, RUNS, TABLE = "study.json", "runs", "study.csv"

_HEAD = re.compile(r"(.+?)(?: \((.+)\))?")


def write_study(
    study: Study, folder: str | Path, measures: Sequence[str] = (), at: tuple[str, float] | None = None
) -> Path:
    """Write a study into a folder: ``study.csv``, and all that `load_study` needs, with the whole curve of each row.

    Parameters
    ----------
    study : Study
    folder : str or Path
        Created if there is none; that of `saved_in` or the one above it named ``runs``, where runs are saved already.
    measures : sequence of str
        Of the table; all by default.
    at : (str, float), optional
        Column and value [SI] at which the table reads them; by default the last state.

    Returns
    -------
    Path
        The table.
    """
    folder = Path(folder)
    (folder / RUNS).mkdir(parents=True, exist_ok=True)
    rows = []
    for row in study.rows:
        run, computed = row.ended.run, row.ended.result
        if computed is not None and saved_run(run, folder / RUNS) is None:
            save_run(run, computed, folder / RUNS)
        rows.append({"values": dict(row.values), "name": run.name, "key": run.key, "problem": row.ended.problem})
    factors = [{item.name: getattr(each, item.name) for item in fields(each)} for each in study.factors]
    content = {"source": str(study.source), "factors": factors, "rows": rows}
    with whole(folder / INDEX) as part:
        part.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
    study.to_csv(folder / TABLE, measures, at)
    return folder / TABLE


def load_study(path: str | Path) -> Study:
    """Read a study that was written.

    Parameters
    ----------
    path : str or Path
        A folder of `write_study` or of ``turgor sweep``, whose rows have whole curves; or a table of `Study.to_csv`,
        whose rows have one state each.

    Returns
    -------
    Study

    Raises
    ------
    TurgorError
        If there is no study, or it is damaged.
    """
    path = Path(path)
    if path.is_file():
        return _from_table(path)
    file = path / INDEX
    if not file.is_file():
        raise TurgorError(f"'{path}' holds no {INDEX}, which says what its study was; a sweep writes it at its end.")
    try:
        content = json.loads(file.read_text(encoding="utf-8"))
        factors = tuple(Factor(**(each | {"levels": tuple(each["levels"])})) for each in content["factors"])
        rows = tuple(_row(each, path / RUNS) for each in content["rows"])
        return Study(factors=factors, rows=rows, source=Source(text=content["source"]))
    except (LookupError, TypeError, json.JSONDecodeError) as error:
        raise TurgorError(f"'{file}' is damaged: {error!r}.") from None


def not_computed() -> Response:
    """Raise an error in place of the function of a run that was read from a file."""
    raise TurgorError("this run was read from a file, which does not hold its function.")


def _row(each: Mapping[str, Any], folder: Path) -> Row:
    computed = None if each["problem"] else run_with_key(each["key"], folder)
    problem = each["problem"] or ("" if computed is not None else f"its files are not in '{folder}'.")
    run = Run(name=each["name"], function=not_computed, values=each["values"])
    return Row(values=each["values"], ended=Ended(run=run, result=computed, problem=problem, again=True))


def _from_table(path: Path) -> Study:
    with path.open(encoding="utf-8-sig", newline="") as file:
        heads, *lines = list(csv.reader(file)) or [[]]
    if "status" not in heads or heads[heads.index("status") :][:3] != ["status", "problem", "cpu_seconds"] or not lines:
        raise TurgorError(f"'{path}' is no table of a study: columns status, problem and cpu_seconds are missing.")
    place = heads.index("status")
    designs = read_designs(path, first=place)
    rows = []
    for values, line in zip(designs.values, lines, strict=True):
        status, problem, seconds, *cells = line[place:]
        run = Run(name=", ".join(f"{name} {value}" for name, value in values.items()), function=not_computed,
                  values=values)  # fmt: skip
        computed = None
        if status != FAILED:
            response = Response(
                columns=_columns(heads[place + 3 :], cells), source=Source(text=path.name), status=status,
                message=problem,
            )  # fmt: skip
            computed = Computed(response=response, seconds=float(seconds))
        rows.append(Row(values=values, ended=Ended(run=run, result=computed, problem=problem, again=True)))
    return Study(factors=designs.factors, rows=tuple(rows), source=Source(text=path.name))


def _columns(heads: Sequence[str], cells: Sequence[str]) -> tuple[Column, ...]:
    columns = []
    for head, cell in zip(heads, cells, strict=True):
        match = _HEAD.fullmatch(head)
        assert match is not None
        unit = match[2] or ""
        value = float(cell) * COLUMN_UNITS[unit] if cell else float("nan")
        columns.append(Column(match[1], unit, [value]))  # type: ignore[arg-type]
    return tuple(columns)
