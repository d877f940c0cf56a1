"""Files of a path: times and wanted outputs, a row for each time."""

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.files.response_csv import read_response
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Response
from turgor.systems.control.forces import ContactForce
from turgor.systems.control.outputs import Angle, Output, Tip

Array = NDArray[np.float64]

#: Column of the times.
TIME = "time"

#: Columns of outputs, and the unit of each in SI.
COLUMNS = {"tip_x": "m", "tip_y": "m", "tip_z": "m", "bending_angle": "rad"}

#: Column of the contact force, or the beginning of its name before that of the obstacle.
FORCE = "force"


@dataclass(frozen=True, slots=True, eq=False)
class WantedPath:
    """A path that a file states.

    Parameters
    ----------
    output : Output
        What follows it, by the names of the columns.
    rows : (k, m) array [SI]
    times : (k,) array [s] or None
    """

    output: Output
    rows: Array
    times: Array | None


def read_path(file: str | Path, further: Collection[str] = ()) -> WantedPath:
    """Read a path from CSV: ``time_s``, and ``tip_x_mm``, ``tip_y_mm``, ``tip_z_mm``, or one other column.

    That is ``bending_angle_deg``, ``force_N`` (on the only obstacle) or, on an obstacle of a name, ``force_plate_N``.
    Columns of the tip that are missing do not count. The time is needed for limits of rates only.

    Parameters
    ----------
    file : str or Path
    further : collection of str
        Names of columns that the file may have too and that do not count, such as inputs along a history.

    Returns
    -------
    WantedPath

    Raises
    ------
    TurgorError
        If a column is unknown, has no unit or one of something else, or none is there that could be followed.
    """
    read = read_response(file)
    table = Response(columns=tuple(each for each in read.columns if each.name not in further), source=read.source)
    for column in table.columns:
        forced = column.name == FORCE or column.name.startswith(f"{FORCE}_")
        if not forced and column.name not in (TIME, *COLUMNS):
            raise unknown(f"column of '{file}'", column.name, (TIME, *COLUMNS, FORCE))
        needed = "s" if column.name == TIME else "N" if forced else COLUMNS[column.name]
        if column.si_unit != needed:
            example = {"s": "s", "m": "mm", "rad": "deg", "N": "N"}[needed]
            given = f"is in {column.unit}" if column.unit else "has no unit"
            raise TurgorError(f"'{file}': the column '{column.name}' {given}; write {column.name}_{example}.")
    axes = "".join(axis for axis in "xyz" if f"tip_{axis}" in table.names)
    others = [name for name in table.names if name != TIME and not name.startswith("tip_")]
    if len(others) + bool(axes) != 1:
        raise TurgorError(
            f"'{file}' has the columns {', '.join(table.names)}; needed are some of tip_x, tip_y and tip_z, or "
            "bending_angle or a force alone, and time."
        )
    rows = np.column_stack([table[name] for name in others or [f"tip_{axis}" for axis in axes]])
    output = _output(axes, others)
    return WantedPath(output, rows, table[TIME] if TIME in table.names else None)


def _output(axes: str, others: list[str]) -> Output:
    """What follows the columns."""
    if axes:
        return Tip(axes)
    name = others[0].removeprefix(FORCE)
    return Angle() if name == others[0] else ContactForce(name[1:] or None)
