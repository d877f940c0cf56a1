"""Curves beside the viewer: the measured columns against the drive."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.response import COLUMN_UNITS, Column, Response
from turgor.results.drive import drive_of
from turgor.results.measures.headlines import headlines


def curves_of(response: Response, steps: Sequence[int]) -> dict[str, Any] | None:
    """Put the columns of a response into the form that the viewer reads.

    Parameters
    ----------
    response : Response
        A row for each state.
    steps : sequence of int
        The states that the viewer shows.

    Returns
    -------
    dict or None
        ``x`` and ``y`` columns with labels and values in their units, headlines first; None without measures.
    """
    drive = drive_of(response)
    measured = [column.name for column in response.quantities if column.name != drive and _varies(column)]
    first = [name for name in headlines(measured) if name in measured]
    chosen = [*first, *(name for name in measured if name not in first)]
    if not chosen or len(response) < 2:
        return None
    return {
        "x": _column(response, drive),
        "y": [_column(response, name) for name in chosen],
        "steps": list(steps),
    }


def _varies(column: Column) -> bool:
    known = column.values[np.isfinite(column.values)]
    return len(known) > 1 and bool(np.ptp(known) > 0)


def _column(response: Response, name: str) -> dict[str, Any]:
    column, errors = response.find(name), response.mesh_error(name)
    shown = None if errors is None else _numbers(errors / COLUMN_UNITS[column.unit])
    return {"name": name, "label": column.label, "values": _numbers(column.in_unit), "error": shown}


def _numbers(values: NDArray[np.float64]) -> list[float | None]:
    """Numbers with six digits; None where one is not known."""
    return [float(f"{value:.6g}") if np.isfinite(value) else None for value in values.tolist()]
