"""Tables: the CSV file of a response for the page, read without the engine, so that the server stays small."""

import csv
from pathlib import Path
from typing import Any

from turgor.foundation.errors import TurgorError

#: Units at the end of headers; a test compares them with those of `turgor.foundation.response`.
UNITS = frozenset(
    ["m", "mm", "um", "1/m", "rad", "deg", "Pa", "kPa", "MPa", "m2", "mm2", "m3", "L", "mL", "N", "mN", "Nm", "J", "mJ"]
    + ["N/m", "kg", "g", "s", "ms", "m3/s", "L/min", "mL/min", "K"]
)

#: End of the name of a column with the mesh error of another one.
MESH_ERROR = "_mesh_error"

#: Rows of a table that the page reads.
MOST_ROWS = 20_000


def name_and_unit(header: str) -> tuple[str, str]:
    """Split a header into name and unit: ``pressure_kPa``, or ``pressure (kPa)`` as laboratories and studies write it.

    Examples
    --------
    >>> name_and_unit("pressure_kPa"), name_and_unit("wall (mm)"), name_and_unit("load_factor")
    (('pressure', 'kPa'), ('wall', 'mm'), ('load_factor', ''))
    """
    text = header.strip()
    for opening, closing in ("()", "[]"):
        if text.endswith(closing) and opening in text:
            name, _, unit = text[:-1].rpartition(opening)
            return name.strip(), unit.strip()
    name, _, unit = text.rpartition("_")
    return (name, unit) if name and unit in UNITS else (text, "")


def columns_of(file: Path) -> list[dict[str, Any]]:
    """Return the columns of a table with names, units, values and mesh errors; none where there is no table yet.

    Raises
    ------
    TurgorError
        If it is no table.
    """
    try:
        with file.open(encoding="utf-8-sig", newline="") as stream:
            sample = stream.read(4096)
            stream.seek(0)
            delimiter = ";" if sample.count(";") > sample.count(",") else ","
            rows = [row for row, _ in zip(csv.reader(stream, delimiter=delimiter), range(MOST_ROWS), strict=False)]
    except FileNotFoundError:
        return []
    except (OSError, ValueError, csv.Error) as error:
        raise TurgorError(f"'{file.name}' is no table: {error}.") from error
    if not rows:
        return []
    columns: dict[str, dict[str, Any]] = {}
    errors: dict[str, list[float | None]] = {}
    for number, header in enumerate(rows[0]):
        name, unit = name_and_unit(header)
        values = [_number(row[number]) if number < len(row) else None for row in rows[1:]]
        if name.endswith(MESH_ERROR):
            errors[name.removesuffix(MESH_ERROR)] = values
        else:
            columns[name] = {"name": name, "unit": unit, "values": values, "error": None}
    for name, values in errors.items():
        if name in columns:
            columns[name]["error"] = values
    return list(columns.values())


def rows_of(file: Path) -> list[dict[str, str]]:
    """Return the lines of a table by its headers, as texts; none where there is no table."""
    try:
        with file.open(encoding="utf-8-sig", newline="") as stream:
            return [dict(row) for row, _ in zip(csv.DictReader(stream), range(MOST_ROWS), strict=False)]
    except (OSError, ValueError, csv.Error):
        return []


def _number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if abs(value) < float("inf") else None
