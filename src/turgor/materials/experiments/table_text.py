"""Tables of testing machines as text: separator, decimal comma, header lines and numbers."""

import re
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.errors import TurgorError

_NUMBER = re.compile(r"[+-]?(\d+[.,]?\d*|[.,]\d+)([eE][+-]?\d+)?")
_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")
_UNIT = re.compile(r"[(\[][^)\]]*[)\]]")
_CLOCK = re.compile(r"\d+:\d\d(:\d\d)?([.,]\d+)?")
#: Texts of testing machines for a missing number.
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
        Cells of the numbers, decimal commas made points.
    first_line : int
        Line of the first row in the file, counted from 1.
    """

    file: str
    notes: tuple[str, ...]
    names: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    first_line: int

    def column(self, index: int) -> NDArray[np.float64]:
        """Return a column as numbers; the error for another cell states its line.

        Parameters
        ----------
        index : int
            Index of the column, from 0.
        """
        values = []
        for number, row in enumerate(self.rows):
            cell = row[index] if index < len(row) else ""
            try:
                value = float(cell)
            except ValueError:
                value = np.nan
            if not np.isfinite(value):
                name = self.names[index] if index < len(self.names) else f"number {index + 1}"
                raise TurgorError(
                    f"'{self.file}', line {self.first_line + number}: '{cell}' in column '{name}' is not a number; "
                    "correct or delete that line."
                )
            values.append(value)
        return np.array(values)

    def seconds(self, index: int) -> NDArray[np.float64] | None:
        """Return a column of times, as numbers or as a clock such as ``00:06:57.69``; None where one is neither.

        Parameters
        ----------
        index : int
            Index of the column, from 0.
        """
        values = []
        for row in self.rows:
            parts = row[index].replace(",", ".").split(":") if index < len(row) else [""]
            try:
                values.append(sum(float(part) * 60.0**power for power, part in enumerate(reversed(parts))))
            except ValueError:
                return None
            if len(parts) == 2:
                return None  # hours and minutes, or minutes and seconds
        times = np.array(values)
        return times if np.isfinite(times).all() else None


def read_table(path: str | Path) -> Table:
    """Read a table of numbers: semicolons, tabs, commas or spaces, header lines, decimal points or commas.

    Parameters
    ----------
    path : str or Path
        The file, in UTF-8 or Latin-1.
    """
    path = Path(path)
    try:
        data = path.read_bytes()
    except OSError as error:
        raise TurgorError(f"'{path}' cannot be read: {error.strerror}.") from error
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")  # older machines write µ and ² in Latin-1
    lines = text.splitlines()
    if not any(line.strip() for line in lines):
        raise TurgorError(f"'{path.name}' is empty; a test needs a header line and at least two rows of numbers.")
    separator = _separator(lines)
    cells = [_split(line, separator) for line in lines]
    start = _first_row(cells)
    if start is None:
        raise TurgorError(f"'{path.name}' holds no rows of numbers; a test needs at least two.")
    comma = separator != "," and any(_COMMA.fullmatch(cell) for row in cells[start : start + 50] for cell in row)
    rows = tuple(tuple(_plain(cell, comma) for cell in row) for row in cells[start:])
    while rows and not any(rows[-1]):
        rows = rows[:-1]
    above = [number for number in range(start) if lines[number].strip("#;,\t ")]
    names = _names(lines[above[-1]], separator, len(cells[start])) if above else ()
    if len(above) > 1 and all(_UNIT.fullmatch(name) for name in names if name):  # a line of its own for the units
        upper = _names(lines[above.pop(-2)], separator, len(cells[start]))
        names = tuple(f"{name} {unit}".strip() for name, unit in zip_longest(upper, names, fillvalue=""))
    notes = tuple(re.sub(r"[;,\t ]+$", "", lines[number]).lstrip("# ") for number in above[:-1])
    return Table(file=path.name, notes=notes, names=names, rows=rows, first_line=start + 1)


def _separator(lines: list[str]) -> str | None:
    """Return the separator that splits most of the lines with a leading number; None means blanks."""
    numeric = [line for line in lines if line.strip()[:1].isdigit() or line.strip()[:1] in "+-."][:200] or lines
    for sign in (";", "\t", ","):
        if sum(sign in line for line in numeric) > len(numeric) / 2:
            # "1,5 0,2" is two numbers with decimal commas, not three with commas between
            if sign == "," and all(_decimal_commas(line) for line in numeric):
                return None
            return sign
    return None


def _decimal_commas(line: str) -> bool:
    parts = line.split()
    return len(parts) > 1 and all(_NUMBER.fullmatch(part) for part in parts)


def _split(line: str, separator: str | None) -> list[str]:
    return [cell.strip().strip('"') for cell in (line.split() if separator is None else line.split(separator))]


def _first_row(cells: list[list[str]]) -> int | None:
    """Find the first line that holds nothing but numbers, two at least; names with numbers stand before it."""
    for number, row in enumerate(cells):
        looks = [bool(_NUMBER.fullmatch(cell) or _CLOCK.fullmatch(cell)) for cell in row]
        rest = [cell for cell, numeric in zip(row, looks, strict=True) if not numeric]
        words = sum(cell.lower() not in _MISSING for cell in rest)
        # a row may name its specimen, and may lack a value, which is refused later with its line
        if sum(looks) >= 2 and words <= 1 and sum(looks) > words:
            return number
    return None


def _names(line: str, separator: str | None, width: int) -> tuple[str, ...]:
    names = _split(line.lstrip("# "), separator)
    if len([name for name in names if name]) < min(width, 2) or separator is None:
        # the numbers are split by tabs and their names by blanks: a name ends with its unit in brackets
        found = re.findall(r"[^()\[\]]+[(\[][^)\]]*[)\]]", line.lstrip("# "))
        names = [name.strip(" \t,;") for name in found] or names
    return tuple(names)


def _plain(cell: str, comma: bool) -> str:
    return cell.replace(",", ".") if comma and _COMMA.fullmatch(cell) else cell
