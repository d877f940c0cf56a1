"""Slopes of what goals read: derivatives of a column at a value of a drive, or at the end of a path."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.response import Response
from turgor.studies.optimization.row_values import At, Measure, read
from turgor.studies.runs.slopes import slope_name
from turgor.studies.runs.study import Row, place_on

Array = NDArray[np.float64]


def slopes_of(row: Row, measure: Measure, at: At, factors: Sequence[str]) -> Array:
    """Return the derivatives of what is read from a row by each factor, (factors,) [SI]; NaN where unknown."""
    if not isinstance(measure, str) or row.response is None:
        return np.full(len(factors), np.nan)
    if measure in row.values:
        return np.array([float(name == measure) for name in factors])
    slopes = _column_slopes(row, measure, at, factors)
    if at is None or at[0] in row.values:
        return slopes
    moved = np.nan_to_num(_column_slopes(row, at[0], at, factors))  # a drive without slopes is the same for all designs
    return slopes - _rise(row.response, measure, at) * moved if moved.any() else slopes


def _column_slopes(row: Row, measure: str, at: At, factors: Sequence[str]) -> Array:
    names = [slope_name(measure, name) for name in factors]
    return np.array([read(row, name, at) if row.response and name in row.response else np.nan for name in names])


def _rise(response: Response, measure: str, at: tuple[str, float]) -> float:
    """Return by how much a measure changes along the path as the drive rises; it is read straight between rows."""
    drive, values = response.column(at[0]), response.column(measure)
    place = place_on(drive, at[1])
    if place is None or len(drive) < 2:
        return float("nan")
    first, share = place
    low, high = (first, first + 1) if share else (max(first - 1, 0), min(first + 1, len(drive) - 1))
    return float((values[high] - values[low]) / (drive[high] - drive[low]))
