"""Curves next to the viewer: the measured columns against the drive."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.drive import drive_of
from turgor.core.results.measures.headlines import headlines
from turgor.foundation.response import COLUMN_UNITS, Column, Response


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Measured:
    """Points of an experiment that are drawn next to a computed curve.

    Parameters
    ----------
    name : str
        Name of the experiment.
    x, y : str
        Columns of the response that they belong to.
    across, upward : (n,) array [SI]
        The points.
    """

    name: str
    x: str
    y: str
    across: NDArray[np.float64]
    upward: NDArray[np.float64]


def curves_of(response: Response, steps: Sequence[int], measured: Sequence[Measured] = ()) -> dict[str, Any] | None:
    """Put the columns of a response into the form that the viewer reads.

    Parameters
    ----------
    response : Response
        A row for each state.
    steps : sequence of int
        The states that the viewer shows.
    measured : sequence of Measured
        Experiments.

    Returns
    -------
    dict or None
        ``x`` and ``y`` columns with labels and values in their units, headlines first; None without measures.
    """
    drive = drive_of(response)
    varying = [column.name for column in response.quantities if column.name != drive and _varies(column)]
    first = [name for name in headlines(varying) if name in varying]
    chosen = [*first, *(name for name in varying if name not in first)]
    if not chosen or len(response) < 2:
        return None
    return {
        "x": _column(response, drive),
        "y": [_column(response, name) | {"measured": _points(response, drive, name, measured)} for name in chosen],
        "steps": list(steps),
    }


def _varies(column: Column) -> bool:
    known = column.values[np.isfinite(column.values)]
    return len(known) > 1 and bool(np.ptp(known) > 0)


def _column(response: Response, name: str) -> dict[str, Any]:
    column, errors = response.find(name), response.mesh_error(name)
    shown = None if errors is None else _numbers(errors / COLUMN_UNITS[column.unit])
    return {"name": name, "label": column.label, "values": _numbers(column.in_unit), "error": shown}


def _points(response: Response, x: str, y: str, measured: Sequence[Measured]) -> list[dict[str, Any]]:
    """The experiments that measured a column against the drive, in the units of the response."""
    across, upward = (COLUMN_UNITS[response.find(name).unit] for name in (x, y))
    return [
        {"name": each.name, "x": _numbers(each.across / across), "y": _numbers(each.upward / upward)}
        for each in measured
        if (each.x, each.y) == (x, y)
    ]


def _numbers(values: NDArray[np.float64]) -> list[float | None]:
    """Numbers with six digits; None where one is not known."""
    return [float(f"{value:.6g}") if np.isfinite(value) else None for value in values.tolist()]
