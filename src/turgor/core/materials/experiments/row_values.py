"""Values of rows besides stretch and stress: the axis that a stress acts along, and the time."""

import re

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.experiments.columns import Column
from turgor.core.materials.experiments.material_test import Array
from turgor.core.materials.experiments.table_text import Table
from turgor.foundation.errors import TurgorError


def along_second(table: Table, column: Column) -> NDArray[np.bool_]:
    """Return whether the stress of each row acts along the second axis, by words such as ``2``, ``sigma_22`` or ``y``.

    Parameters
    ----------
    table : Table
    column : Column
        That of the words.
    """
    second = []
    for line, row in zip(table.lines, table.rows, strict=True):
        word = row[column.index].strip().lower() if column.index < len(row) else ""
        match = re.fullmatch(r".*?(1|2|x|y|first|second)", word)
        if match is None:
            raise TurgorError(
                f"'{table.file}', line {line}: '{word}' in column '{column.name}' is no axis; write 1 or 2."
            )
        second.append(match[1] in ("2", "y", "second"))
    return np.array(second)


def time_of(table: Table, column: Column | None) -> tuple[Array | None, str]:
    """Return the time since the first row, and a remark about its column; None where there is no usable time.

    Parameters
    ----------
    table : Table
    column : Column or None
    """
    if column is None:
        return None, ""
    time = table.seconds(column.index)
    if time is None:
        return None, f"; '{column.name}' left out, because it does not hold times only"
    time = time * column.factor
    back = np.flatnonzero(np.diff(time) < 0)
    if len(back):
        return None, f"; '{column.name}' left out, because it runs backwards at line {table.lines[int(back[0]) + 1]}"
    return time - time[0], f"; time from '{column.name}'"
