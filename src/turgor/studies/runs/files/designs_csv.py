"""Tables of designs as CSV: a column for each factor with its unit, and a line for each design."""

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from turgor.core.materials.experiments.file_text import csv_rows
from turgor.foundation.errors import TurgorError, unknown
from turgor.studies.runs.designs import Designs
from turgor.studies.runs.factor import Factor, Value
from turgor.studies.runs.jobs.job_numbers import JobNumber
from turgor.studies.runs.rounding import rounded
from turgor.studies.runs.settings import RUNS
from turgor.units import UNITS, unit_value

_HEAD = re.compile(r"\s*([^()\[\]]+?)\s*(?:[(\[](.+)[)\]])?\s*")


def read_designs(file: str | Path, numbers: Mapping[str, JobNumber] | None = None, first: int | None = None) -> Designs:
    """Read a table of designs.

    Parameters
    ----------
    file : str or Path
        CSV with headers such as ``wall (mm)``, or keys of a job, ``actuator.wall (mm)``. Columns of text are choices.
    numbers : mapping of str to JobNumber, optional
        Numbers of a job, which its columns are checked against.
    first : int, optional
        Number of columns that are read; all by default.

    Returns
    -------
    Designs

    Raises
    ------
    TurgorError
        If the table is empty, a unit is unknown or missing, or a cell is no number.
    """
    path = Path(file)
    if not path.is_file():
        raise TurgorError(f"there is no table of designs '{path}'.")
    lines = csv_rows(path)
    if len(lines) < 2:
        raise TurgorError(f"'{path}' has no designs; a line with headers and a line for each design are needed.")
    for number, row in lines[1:]:
        if len(row) != len(lines[0][1]):
            raise TurgorError(f"'{path}', line {number}: {len(row)} cells; the first line has {len(lines[0][1])}.")
    heads = [_head(text, path) for text in lines[0][1][:first]]
    columns = [
        _column(head, [(n, row[k].strip()) for n, row in lines[1:]], path, numbers) for k, head in enumerate(heads)
    ]
    factors = tuple(factor for factor, _ in columns)
    values = tuple(
        {each.name: cells[k] for each, (_, cells) in zip(factors, columns, strict=True)} for k in range(len(lines) - 1)
    )
    return Designs(factors=factors, values=values, rule=f"table {path.name}")


def _head(text: str, path: Path) -> tuple[str, str]:
    match = _HEAD.fullmatch(text)
    if match is None:
        raise TurgorError(f"'{path}': '{text}' is no name with a unit, such as wall (mm).")
    return match[1].replace("+", ","), match[2] or ""  # a comma would need quotes in CSV


def _column(
    head: tuple[str, str], cells: Sequence[tuple[int, str]], path: Path, numbers: Mapping[str, JobNumber] | None
) -> tuple[Factor, list[Value]]:
    """Return the factor of a column, and its values in SI."""
    name, unit = head
    number = None if numbers is None else numbers.get(name.split(",")[0])
    _check_unit(name, unit, number, path)
    if number is None and not unit and not all(_is_number(cell) for _, cell in cells):
        return Factor(name=name, levels=tuple(dict.fromkeys(cell for _, cell in cells))), [cell for _, cell in cells]
    plain = [_number(cell, line, name, path) for line, cell in cells]
    whole = number.whole if number is not None else not unit and all(each == int(each) for each in plain)
    values: list[Value] = [int(x) if whole and x == int(x) else rounded(x * unit_value(unit)) for x in plain]
    levels = tuple(dict.fromkeys(sorted(values)))
    if len(levels) > RUNS.most_levels:  # those of a sample
        low, high = float(levels[0]), float(levels[-1])
        return Factor(name=name, low=low, high=high, unit=unit, whole=whole), values
    return Factor(name=name, levels=levels, unit=unit, whole=whole), values


def _check_unit(name: str, unit: str, number: JobNumber | None, path: Path) -> None:
    if number is not None and number.unit:
        if unit not in UNITS[number.dimension]:
            known = ", ".join(UNITS[number.dimension])
            raise TurgorError(f"'{path}': '{name}' needs a unit in brackets: {known}.")
    elif unit and (number is not None or not any(unit in units for units in UNITS.values())):
        raise unknown(f"unit of '{name}' in '{path}'", unit, [each for units in UNITS.values() for each in units])


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _number(cell: str, line: int, name: str, path: Path) -> float:
    if not _is_number(cell):
        raise TurgorError(f"'{path}', line {line}: {name}: '{cell}' is not a number.")
    if not math.isfinite(float(cell)):
        raise TurgorError(f"'{path}', line {line}: {name}: '{cell}' is not finite.")
    return float(cell)
