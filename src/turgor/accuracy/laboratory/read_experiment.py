"""Read tables of a laboratory: pressure against angle, displacement or force, as sensors and people write them."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.laboratory.headers import Header, column_name, read_header, split_header_unit
from turgor.core.materials.experiments.columns import role_of, split_unit
from turgor.core.materials.experiments.table_text import Table, read_table
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source

Array = NDArray[np.float64]

#: What sensors write for a missing number.
_MISSING = ("", "nan", "n/a", "na", "-", "--", "null", "none")


def read_experiment(
    path: str | Path,
    *,
    units: Mapping[str, str] | None = None,
    columns: Mapping[str, str] | Sequence[str] | None = None,
    source: Source | None = None,
) -> Response:
    r"""Read a table that was measured on an actuator.

    Parameters
    ----------
    path : str or Path
        A text file: semicolons, tabs, commas or blanks between the cells, decimal points or commas, units in the
        header or in a line below it.
    units : mapping of str to str, optional
        Unit of each column whose header has none, by the name of the column: ``{"pressure": "kPa"}``.
    columns : mapping of str to str, or sequence of str, optional
        New names by header, ``{"Bending Angle (°)": "bending_angle"}``; or all headers in order, for a file without.
    source : Source, optional
        Where the numbers came from; by default the name of the file.

    Returns
    -------
    Response
        Its columns in the order of the file. Columns of text are left out; a missing number is nan.

    Raises
    ------
    TurgorError
        If a unit is unknown or missing, or a cell is no number: with its line and column.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder) / "finger.csv"
    ...     _ = file.write_text("Pressure (psi);Bending Angle (°)\n0;0\n1,5;12,5\n3;31\n")
    ...     read_experiment(file)
    Response(3 rows: pressure 0 to 20.68 kPa, bending_angle 0 to 31 deg; from finger.csv)
    """
    table = _named(read_table(path), columns)
    return _response(table, _headers(table, units or {}, columns), source or Source(text=table.file))


def read_experiments(
    path: str | Path,
    by: str | Sequence[str],
    *,
    units: Mapping[str, str] | None = None,
    columns: Mapping[str, str] | Sequence[str] | None = None,
) -> dict[str, Response]:
    r"""Read a table that holds several runs, distinguished by one or more of its columns.

    Parameters
    ----------
    path
        See `read_experiment`.
    by : str or sequence of str
        Columns, as in the file or as in the response, whose values tell the runs apart; they may hold text.
    units, columns
        See `read_experiment`.

    Returns
    -------
    dict of str to Response
        By the values, such as ``"14.715, 1"``, in the order of the file.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder) / "finger.csv"
    ...     _ = file.write_text("run,pressure_kPa,angle_deg\nA,0,0\nA,10,3\nB,0,0\nB,10,4\n")
    ...     list(read_experiments(file, "run"))
    ['A', 'B']
    """
    table = _named(read_table(path), columns)
    places = [_place(table, each) for each in ([by] if isinstance(by, str) else by)]
    labels = [", ".join(row[place] if place < len(row) else "" for place in places) for row in table.rows]
    headers = {n: header for n, header in _headers(table, units or {}, columns).items() if n not in places}
    experiments = {}
    for label in dict.fromkeys(labels):
        part = table.keeping(each == label for each in labels)
        experiments[label] = _response(part, headers, Source(text=table.file, detail=label))
    return experiments


def specimen_column(path: str | Path) -> tuple[str, int]:
    r"""Return the column that tells the specimens of a table apart, and their number; an empty name and 0 for none.

    A counter of rows, which some recorders call sample, tells no specimens apart.

    Parameters
    ----------
    path : str or Path
        See `read_experiment`.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder) / "finger.csv"
    ...     _ = file.write_text("specimen,pressure_kPa,angle_deg\nA,0,0\nA,10,3\nB,0,0\nB,10,4\n")
    ...     specimen_column(file)
    ('specimen', 2)
    """
    table = read_table(path)
    for place, name in enumerate(table.names):
        words, unit = split_unit(name)
        if unit is None and role_of(words) in ("specimen", "batch"):
            values = [row[place] if place < len(row) else "" for row in table.rows]
            if 2 * len(set(values)) <= len(values):
                return name, len(set(values))
    return "", 0


def _named(table: Table, columns: Mapping[str, str] | Sequence[str] | None) -> Table:
    """Return the table with headers, those of the file or those that were given."""
    if columns is not None and not isinstance(columns, Mapping):
        if len(columns) != len(table.rows[0]):
            raise TurgorError(f"'{table.file}' has {len(table.rows[0])} columns, and {len(columns)} names were given.")
        return replace(table, names=tuple(columns))
    if not table.names:
        raise TurgorError(
            f"'{table.file}' has no header line.",
            python="Name its columns with their units in order, for example "
            "columns=('pressure_kPa', 'bending_angle_deg').",
            command="Write one with the names and units of its columns, for example pressure_kPa,bending_angle_deg.",
        )
    return table


def _headers(
    table: Table, units: Mapping[str, str], columns: Mapping[str, str] | Sequence[str] | None
) -> dict[int, Header]:
    """Header of each column of numbers, by its place."""
    renamed = {_place(table, old): new for old, new in columns.items()} if isinstance(columns, Mapping) else {}
    plain = {n: renamed.get(n) or column_name(split_header_unit(name)[0]) for n, name in enumerate(table.names)}
    for name in units:
        if name not in plain.values():
            raise TurgorError(f"'{table.file}': units: {unknown('column', name, plain.values())}")
    headers = {}
    for n, text in enumerate(table.names):
        if text and not _is_text(table, n):
            header = read_header(text, units.get(plain[n]), file=table.file)
            headers[n] = replace(header, name=plain[n])
    if not headers:
        raise TurgorError(f"'{table.file}' holds no column of numbers with a name.")
    return headers


def _response(table: Table, headers: Mapping[int, Header], source: Source) -> Response:
    columns = tuple(Column(each.name, each.unit, _numbers(table, n) * each.factor) for n, each in headers.items())
    return Response(columns=columns, source=source)


def _place(table: Table, name: str) -> int:
    """Place of a column, called as in the file or as in the response."""
    for n, text in enumerate(table.names):
        if name in (text, column_name(split_header_unit(text)[0])):
            return n
    raise TurgorError(f"'{table.file}': {unknown('column', name, filter(None, table.names))}")


def _is_text(table: Table, place: int) -> bool:
    """Whether most of the filled cells of a column are words."""
    filled = [row[place] for row in table.rows if place < len(row) and row[place].lower() not in _MISSING]
    return sum(_number(cell) is None for cell in filled) > len(filled) / 2


def _numbers(table: Table, place: int) -> Array:
    """Return the numbers of a column; a missing one is nan, and another text an error with its line."""
    values = []
    for line, row in zip(table.lines, table.rows, strict=True):
        cell = row[place] if place < len(row) else ""
        value = np.nan if cell.lower() in _MISSING else _number(cell)
        if value is None:
            raise TurgorError(
                f"'{table.file}', line {line}, column '{table.names[place]}': '{cell}' is not a number; correct or "
                "delete that line."
            )
        values.append(value)
    return np.array(values)


def _number(cell: str) -> float | None:
    """Return the number in a cell; None where it holds something else."""
    try:
        return float(cell)
    except ValueError:
        return None
