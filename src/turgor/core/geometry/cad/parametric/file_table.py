"""Tables of CAD files: a CSV file with a column for each dimension, and the file of each part."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from math import isclose, isfinite
from pathlib import Path

from turgor.core.geometry.cad.parametric.parameter import Parameter, Stated, arguments, shown_dimensions
from turgor.core.geometry.cad.parametric.running import ENDINGS
from turgor.core.materials.experiments.file_text import csv_rows
from turgor.foundation.errors import TurgorError, near_file
from turgor.units import UNITS

#: Name of the column of files.
FILE = "file"

#: Relative difference of two equal dimensions: a table and a job may state them in different units.
SAME = 1e-6

_HEADER = re.compile(r"\s*([^()]+?)\s*(?:\(([^()]*)\))?\s*")


@dataclass(frozen=True, slots=True, kw_only=True)
class FileTable:
    """A table of CAD files.

    Parameters
    ----------
    path : Path
    parameters : tuple of Parameter
        The dimensions.
    rows : tuple of (dict, Path)
        Dimensions and file of each part.
    """

    path: Path
    parameters: tuple[Parameter, ...]
    rows: tuple[tuple[Mapping[str, Stated], Path], ...]

    @property
    def digest(self) -> str:
        """A hash of the table and of all its files."""
        digest = sha256(self.path.read_bytes())
        for _, file in self.rows:
            digest.update(sha256(file.read_bytes()).digest())
        return digest.hexdigest()

    @property
    def first(self) -> dict[str, Stated]:
        """Dimensions of the first part, as a job states them."""
        units = {each.name: each.unit for each in self.parameters}
        return {name: f"{value} {units[name]}" if units[name] else value for name, value in self.rows[0][0].items()}

    def file(self, stated: Mapping[str, Stated]) -> Path:
        """Return the file of the part with some dimensions.

        Raises
        ------
        TurgorError
            If the table has no such part, with the nearest one.
        """
        given = arguments(self.parameters, stated, None, f"'{self.path.name}'")
        chosen = [file for dimensions, file in self.rows if all(_same(given[name], dimensions[name]) for name in given)]
        if len(chosen) == 1:
            return chosen[0]
        if chosen:
            raise TurgorError(f"'{self.path.name}' has {len(chosen)} parts with {shown_dimensions(stated)}.")
        nearest = min((dimensions for dimensions, _ in self.rows), key=lambda each: self._distance(given, each))
        units = {each.name: f" {each.unit}" if each.unit else "" for each in self.parameters}
        shown = {name: f"{value}{units[name]}" for name, value in nearest.items()}
        raise TurgorError(
            f"'{self.path.name}' has no part with {shown_dimensions(stated)}; the nearest has "
            f"{shown_dimensions(shown)}. "
            "A table has the parts that were drawn, and none between them; a script draws any."
        )

    def _distance(self, given: Mapping[str, Stated], other: Mapping[str, Stated]) -> float:
        """Distance of two parts: the sum of differences relative to the range in the table."""
        total = 0.0
        for name, value in given.items():
            column = [each[name] for each, _ in self.rows]
            if isinstance(value, str) or any(isinstance(each, str) for each in column):
                total += value != other[name]
            else:
                numbers = [float(each) for each in column]
                total += abs(float(value) - float(other[name])) / (max(numbers) - min(numbers) or 1.0)
        return total


def read_file_table(path: Path) -> FileTable:
    """Read a table of CAD files.

    Parameters
    ----------
    path : Path
        CSV with a header, such as ``wall (mm),folds,file``.

    Returns
    -------
    FileTable

    Raises
    ------
    TurgorError
        If a column, a number or a file is missing.
    """
    header, *rows = (row for _, row in csv_rows(path))
    if len(header) == 1 and ";" in header[0]:
        raise TurgorError(f"'{path.name}' has semicolons between its columns; commas are needed, and decimal points.")
    names = [_column(cell, path) for cell in header]
    twice = [name for name in dict(names) if sum(name == each for each, _ in names) > 1]
    if twice:
        raise TurgorError(f"'{path.name}' has several columns '{twice[0]}'; give each dimension one.")
    if FILE not in dict(names):
        listed = ", ".join(name for name, _ in names) or "none"
        raise TurgorError(f"'{path.name}' has no column '{FILE}' with the CAD file of each part; it has {listed}.")
    if not rows:
        raise TurgorError(f"'{path.name}' has no parts below its header.")
    read = [_row(row, names, path) for row in rows]
    texts = {name for name, _ in names if any(isinstance(dimensions.get(name), str) for dimensions, _ in read)}
    for row, (dimensions, _) in zip(rows, read, strict=True):  # 1 is a text, too, where another row has a letter
        dimensions |= {name: cell.strip() for (name, _), cell in zip(names, row, strict=True) if name in texts}
    parameters = tuple(
        Parameter(name=name, unit=unit, kind="text" if name in texts else "number")
        for name, unit in names
        if name != FILE
    )
    return FileTable(path=path, parameters=parameters, rows=tuple(read))


def _column(cell: str, path: Path) -> tuple[str, str]:
    """Name and unit of a column."""
    match = _HEADER.fullmatch(cell)
    if match is None:
        raise TurgorError(f"'{path.name}': the column '{cell}' has no name; write it as 'wall (mm)'.")
    name, unit = match[1], match[2] or ""
    if unit and unit not in UNITS["length"] and unit not in UNITS["angle"]:
        raise TurgorError(f"'{path.name}': the column '{cell}' is in {unit}; allowed are lengths and angles.")
    return name, unit


def _row(row: Sequence[str], names: Sequence[tuple[str, str]], path: Path) -> tuple[dict[str, Stated], Path]:
    if len(row) != len(names):
        raise TurgorError(f"'{path.name}': the row {','.join(row)!r} has {len(row)} cells, the header {len(names)}.")
    cells = {name: cell.strip() for (name, _), cell in zip(names, row, strict=True)}
    file = path.parent / cells.pop(FILE)
    if file.suffix.lower() not in ENDINGS:
        raise TurgorError(f"'{path.name}': '{file.name}' is no CAD file; allowed are {', '.join(ENDINGS)}.")
    if not file.is_file():
        there = sorted(each.name for each in file.parent.glob("*") if each.suffix.lower() in ENDINGS)
        raise TurgorError(f"'{path.name}': there is no file '{file}'{near_file(file, there)}")
    units = dict(names)
    return {name: _cell(name, cell, units[name], path) for name, cell in cells.items()}, file


def _cell(name: str, cell: str, unit: str, path: Path) -> Stated:
    try:
        number: Stated = float(cell) if isfinite(float(cell)) else cell
    except ValueError:
        number = cell
    if isinstance(number, str) and (unit or not cell):
        raise TurgorError(f"'{path.name}': {name} is '{cell}'; a number in {unit or 'a cell'} is needed.")
    return number


def _same(first: Stated, second: Stated) -> bool:
    if isinstance(first, str) or isinstance(second, str):
        return first == second
    return isclose(first, second, rel_tol=SAME)
