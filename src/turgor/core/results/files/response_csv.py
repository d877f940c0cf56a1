"""Read responses from CSV files."""

from pathlib import Path

import numpy as np

from turgor.core.materials.experiments.file_text import csv_rows
from turgor.foundation.errors import TurgorError, near_file
from turgor.foundation.response import COLUMN_UNITS, Column, Response, split_header
from turgor.foundation.source import Source


def read_response(path: str | Path, source: Source | None = None) -> Response:
    """Read a table that `Response.to_csv` or a person wrote: CSV whose header holds names with units.

    Parameters
    ----------
    path : str or Path
        The file. ``pressure_kPa`` is the column ``pressure`` in kPa; a header without a known unit at its
        end, such as ``load_factor``, is a pure number.
    source : Source
        Where the numbers came from; the name of the file if it is not given.

    Returns
    -------
    Response
        Columns in SI units, in the order of the file.

    Raises
    ------
    TurgorError
        If the file is missing or empty, or a cell is no number: with its line and column.
    """
    path = Path(path)
    if not path.is_file():
        there = [each.name for each in path.parent.glob("*.csv")] if path.parent.is_dir() else []
        raise TurgorError(f"response file '{path}' does not exist{near_file(path, there)}")
    rows = csv_rows(path)
    if len(rows) < 2:
        raise TurgorError(f"response file '{path}' holds no rows; a header with units and numbers below it are needed.")
    headers = [header.strip() for header in rows[0][1]]
    table = np.array([_numbers(path, line, headers, row) for line, row in rows[1:]])
    columns = []
    for header, values in zip(headers, table.T, strict=True):
        name, unit = split_header(header)
        columns.append(Column(name, unit, values * COLUMN_UNITS[unit]))
    return Response(columns=tuple(columns), source=source or Source(text=path.name))


def _numbers(path: Path, line: int, headers: list[str], row: list[str]) -> list[float]:
    if len(row) != len(headers):
        raise TurgorError(f"{path}, line {line}: {len(row)} values, but the header names {len(headers)} columns.")
    numbers = []
    for header, text in zip(headers, row, strict=True):
        try:
            numbers.append(float(text))
        except ValueError:
            raise TurgorError(f"{path}, line {line}, column '{header}': '{text}' is not a number.") from None
    return numbers
