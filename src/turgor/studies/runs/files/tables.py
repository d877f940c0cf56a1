"""Tables of studies: columns with units in their headers, as CSV, Parquet and data frames."""

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path

from turgor.foundation.store.atomic_files import whole
from turgor.studies.runs.optional_parts import needed
from turgor.studies.runs.settings import RUNS

#: A column of a table: numbers or texts; NaN is an empty cell of a file.
Cells = Sequence[float | int | str]


def write_csv(columns: Mapping[str, Cells], path: str | Path) -> None:
    """Write a table as CSV, which appears whole or not at all.

    Parameters
    ----------
    columns : mapping of str to sequence
        Cells by header.
    path : str or Path
    """
    with whole(Path(path)) as part, part.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow(columns)
        table.writerows([_cell(each) for each in row] for row in zip(*columns.values(), strict=True))


def write_parquet(columns: Mapping[str, Cells], path: str | Path) -> None:
    """Write a table as Parquet, which appears whole or not at all.

    Parameters
    ----------
    columns : mapping of str to sequence
        Cells by header.
    path : str or Path

    Raises
    ------
    TurgorError
        If pyarrow is not installed.
    """
    pyarrow, parquet = needed("pyarrow", "to_parquet"), needed("pyarrow.parquet", "to_parquet")
    with whole(Path(path)) as part:
        parquet.write_table(pyarrow.table({name: list(cells) for name, cells in columns.items()}), part)


def header(name: str, unit: str) -> str:
    """Return the header of a column.

    Examples
    --------
    >>> header("actuator.wall", "mm"), header("chambers", "")
    ('actuator.wall (mm)', 'chambers')
    """
    return f"{name} ({unit})" if unit else name


def _cell(value: float | int | str) -> str:
    if isinstance(value, float):
        return "" if value != value else f"{value:.{RUNS.digits + 1}g}"
    return str(value)
