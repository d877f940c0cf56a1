"""Tables of testing machines as text: separator, decimal comma, header lines and numbers."""

import csv
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.experiments.columns import FACTORS, role_of
from turgor.core.materials.experiments.file_text import read_lines
from turgor.core.materials.experiments.settings import EXPERIMENTS
from turgor.foundation.errors import TurgorError

Cells: TypeAlias = tuple[str, ...]

_NUMBER = re.compile(r"[+-]?(\d+[.,]?\d*|[.,]\d+)([eE][+-]?\d+)?")
_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")
_POINT = re.compile(r"[+-]?\d*\.\d+([eE][+-]?\d+)?")
_BRACKETS = re.compile(r"[(\[][^)\]]*[)\]]")
_CLOCK = re.compile(r"\d+:\d\d(:\d\d)?([.,]\d+)?")
#: A number with a decimal comma and points between its thousands.
_THOUSANDS = re.compile(r"[+-]?\d{1,3}(\.\d{3})+,\d*")
_QUOTED = re.compile(r'"[^"]*"')

#: What testing machines write for a missing number.
_MISSING = frozenset({"", "nan", "n/a", "na", "-", "--", "inf", "-inf", "#n/a", "null"})


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """Text of a table.

    Parameters
    ----------
    file : str
        Name of the file, for messages.
    notes : tuple of str
        Lines before the column names.
    names : tuple of str
        Column names as written; empty where the file has none.
    rows : tuple of tuple of str
        Cells of the rows of numbers, with decimal points in place of commas.
    lines : tuple of int
        Line of each row in the file, counted from 1.
    """

    file: str
    notes: tuple[str, ...]
    names: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...]

    def column(self, index: int) -> NDArray[np.float64]:
        """Return a column as numbers; the error for a cell that is not a number states its line.

        Parameters
        ----------
        index : int
            Index of the column, from 0.
        """
        values = []
        for line, row in zip(self.lines, self.rows, strict=True):
            cell = _cell(row, index)
            value = float(cell) if _NUMBER.fullmatch(cell) and "," not in cell else np.nan
            if not np.isfinite(value):
                name = self.names[index] if index < len(self.names) else f"number {index + 1}"
                raise TurgorError(
                    f"'{self.file}', line {line}: '{cell}' in column '{name}' is not a number; "
                    "correct or delete that line."
                )
            values.append(value)
        return np.array(values)

    def seconds(self, index: int) -> NDArray[np.float64] | None:
        """Return a column of times, as numbers or as a clock such as ``00:06:57.69``; None where a cell is neither.

        Parameters
        ----------
        index : int
            Index of the column, from 0.
        """
        values = []
        for row in self.rows:
            parts = _cell(row, index).replace(",", ".").split(":")
            try:
                values.append(sum(float(part) * 60.0**power for power, part in enumerate(reversed(parts))))
            except ValueError:
                return None
            if len(parts) == 2:
                return None  # ambiguous: hours and minutes, or minutes and seconds
        times = np.array(values)
        return times if np.isfinite(times).all() else None

    def keeping(self, keep: Iterable[bool]) -> "Table":
        """Return the table with some of its rows.

        Parameters
        ----------
        keep : iterable of bool
            Whether each row stays.
        """
        numbers = [n for n, stays in enumerate(keep) if stays]
        return replace(self, rows=tuple(self.rows[n] for n in numbers), lines=tuple(self.lines[n] for n in numbers))

    def complete(self, indices: Iterable[int]) -> tuple["Table", str]:
        """Return the rows without a missing number, and a remark about the others.

        A number is missing if its cell is empty or holds what machines write for no value, such as ``nan``. For other
        text `column` raises an error.

        Parameters
        ----------
        indices : iterable of int
            Columns in which a number is needed.
        """
        columns = tuple(indices)
        full = [not any(_cell(row, index).lower() in _MISSING for index in columns) for row in self.rows]
        if all(full):
            return self, ""
        removed = [str(line) for line, stays in zip(self.lines, full, strict=True) if not stays]
        shown = ", ".join(removed if len(removed) <= 5 else [*removed[:4], "…", removed[-1]])
        where = f"line {shown}" if len(removed) == 1 else f"lines {shown}"
        return self.keeping(full), f"; {len(removed)} of {len(full)} rows left out that lack a number ({where})"


def read_table(path: str | Path) -> Table:
    """Read a table of numbers: semicolons, tabs, commas or spaces, header lines, decimal points or commas.

    Parameters
    ----------
    path : str or Path
        The file, in UTF-8, UTF-16 or Latin-1.
    """
    path = Path(path)
    lines = read_lines(path)
    separator = _separator(lines)
    cells = [_split(line, separator) for line in lines]
    start = _first_row(cells)
    if start is None:
        raise TurgorError(f"'{path.name}' holds no rows of numbers; a test needs at least two.")
    above = [number for number in range(start) if lines[number].strip("#;,\t ")]
    names, used = _header([lines[number] for number in above], separator, len(cells[start]))
    notes = tuple(lines[number].rstrip(";,\t ").lstrip("# ") for number in above[: len(above) - used])
    counted = [
        (number + 1, cells[number])
        for number in range(start, len(lines))
        if any(cells[number]) and not lines[number].lstrip().startswith("#")
    ]
    where = tuple(line for line, _ in counted)
    rows = tuple(_checked_rows([row for _, row in counted], where, names, path.name))
    return _with_decimal_points(Table(file=path.name, notes=notes, names=names, rows=rows, lines=where))


def _cell(row: Sequence[str], index: int) -> str:
    return row[index] if index < len(row) else ""


def _separator(lines: list[str]) -> str | None:
    """Return the separator that splits most of the lines that begin with a number; None means blanks."""
    bare = [_QUOTED.sub("0", line).strip() for line in lines]  # a comma between quotes splits nothing
    numeric = [line for line in bare if line[:1].isdigit() or line[:1] in ("+", "-", ".", "−")][:200] or bare
    for sign in (";", "\t", ","):
        if sum(sign in line for line in numeric) > len(numeric) / 2:
            # "1,5 0,2" is two numbers with decimal commas, not three with commas between
            if sign == "," and all(_decimal_commas(line) for line in numeric):
                return None
            return sign
    return None


def _decimal_commas(line: str) -> bool:
    """Whether a line is several numbers between blanks."""
    parts = line.split()
    return len(parts) > 1 and all(_NUMBER.fullmatch(part) for part in parts)


def _split(line: str, separator: str | None) -> list[str]:
    if separator is None:
        cells = line.split()
    elif '"' in line:
        try:
            cells = next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
        except csv.Error:  # a cell of more than 131,072 letters
            cells = line.split(separator)
    else:
        cells = line.split(separator)
    return [cell.strip().strip('"').strip().replace("−", "-") for cell in cells]


def _first_row(cells: list[list[str]]) -> int | None:
    """Find the first row of numbers: at least two numbers, and the names of batch and specimen.

    Lines above the table also have a number or two, such as dimensions: a row of several words counts only where most
    rows have their words in the same columns.
    """
    kinds = [tuple(_kind(cell) for cell in row) for row in cells]
    usual = Counter(kind for kind in kinds if kind.count("1") >= 2).most_common(1)
    for number, kind in enumerate(kinds):
        numbers, words = kind.count("1"), kind.count("w")
        if numbers >= 2 and ((words <= 1 and numbers > words) or kind == usual[0][0]):
            return number
    return None


def _kind(cell: str) -> str:
    """Return 1 for a number or a time, w for a word, and a blank where a value is missing."""
    if _NUMBER.fullmatch(cell) or _CLOCK.fullmatch(cell):
        return "1"
    return " " if cell.lower() in _MISSING else "w"


def _header(above: Sequence[str], separator: str | None, width: int) -> tuple[tuple[str, ...], int]:
    """Column names from the lines above the numbers, and how many lines they take: units may have their own line."""
    if not above:
        return (), 0
    last = _split(above[-1].lstrip("# "), separator)
    if len(above) < 2 or not _are_units(last):
        return _names(above[-1], separator, width), 1
    upper = _names(above[-2], separator, width)
    units = [unit if not unit or _BRACKETS.fullmatch(unit) else f"({unit})" for unit in last]
    return tuple(f"{name} {unit}".strip() for name, unit in zip_longest(upper, units, fillvalue="")), 2


def _are_units(names: Sequence[str]) -> bool:
    """Whether a header line holds units only: all in brackets, or all but at most one known."""
    stated = [name for name in names if name]
    if stated and all(_BRACKETS.fullmatch(name) for name in stated):
        return True
    known = sum(any(name.strip("()[] ") in units for units in FACTORS.values()) for name in stated)
    return known >= 1 and known >= len(stated) - 1 and all(len(name) <= 8 for name in stated)


def _names(line: str, separator: str | None, width: int) -> tuple[str, ...]:
    names = _split(line.lstrip("# "), separator)
    few = len([name for name in names if name]) < min(width, 2) or separator is None
    if few and len(line) < EXPERIMENTS.longest_header:
        # the numbers are split by tabs and their names by blanks: a name ends with its unit in brackets
        with_units = re.findall(r"[^()\[\]]+[(\[][^)\]]*[)\]]", line.lstrip("# "))
        names = [name.strip(" \t,;") for name in with_units] or names
    return tuple(names)


def _checked_rows(
    rows: Sequence[Sequence[str]], lines: Sequence[int], names: Sequence[str], file: str
) -> Iterator[Cells]:
    """Rows without empty cells beyond the columns; a cell too many or too few is an error, because columns shift."""
    usual = Counter(len(row) for row in rows).most_common(1)[0][0]
    width = max((n + 1 for n, name in enumerate(names) if name), default=usual)
    for row, line in zip(rows, lines, strict=True):
        end = next((n for n in range(len(row), width, -1) if row[n - 1]), min(len(row), width))
        words = [cell for cell in row if cell.lower() not in _MISSING]
        if len(words) > 1 and not any(map(_NUMBER.fullmatch, words)):
            raise TurgorError(
                f"'{file}', line {line}: a second table begins there ('{words[0]}'). Put each specimen into a file of "
                "its own, or all rows below one header, with a column 'specimen'."
            )
        if end != width:
            against = f"the header names {width} columns" if names else f"other lines have {width}"
            cells = "1 cell" if end == 1 else f"{end} cells"
            raise TurgorError(
                f"'{file}', line {line} has {cells}, but {against}: its numbers may stand in wrong columns; correct or "
                "delete that line."
            )
        yield tuple(row[:end])


def _with_decimal_points(table: Table) -> Table:
    """Return the table with decimal points instead of commas; an error if its numbers have both."""
    if _first_match(table, _THOUSANDS) is not None:
        table = replace(
            table,
            rows=tuple(tuple(c.replace(".", "") if _THOUSANDS.fullmatch(c) else c for c in row) for row in table.rows),
        )
    comma = _first_match(table, _COMMA)
    if comma is None:
        return table
    point = _first_match(table, _POINT)
    if point is not None:
        raise TurgorError(
            f"'{table.file}': '{comma[0]}' in line {comma[1]} has a decimal comma, '{point[0]}' in line {point[1]} "
            "a decimal point; write all numbers in one way, without separators of thousands."
        )
    rows = tuple(
        tuple(cell.replace(",", ".") if _COMMA.fullmatch(cell) else cell for cell in row) for row in table.rows
    )
    return replace(table, rows=rows)


def _first_match(table: Table, pattern: re.Pattern[str]) -> tuple[str, int] | None:
    """First cell that matches a pattern, and its line; names of specimens, such as 1.2, do not count."""
    labels = {n for n, name in enumerate(table.names) if role_of(name) == "specimen"}
    for row, line in zip(table.rows, table.lines, strict=True):
        for index, cell in enumerate(row):
            if pattern.fullmatch(cell) and index not in labels:
                return cell, line
    return None
