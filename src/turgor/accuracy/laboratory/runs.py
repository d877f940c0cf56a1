"""Runs of an experiment: loading and unloading distinguished, and repeated runs averaged with their spread."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.laboratory.headers import DIMENSIONS, spelled_column
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import COLUMN_UNITS, Column, Response
from turgor.foundation.source import Source
from turgor.units import UNITS

Array = NDArray[np.float64]

#: End of the name of the column that holds the spread of repeated runs: their standard deviation.
SPREAD = "_spread"

#: A drive that goes back by less than this share of its range wavers; by more, it has turned.
TURN = 0.05


def loading(response: Response, x: str | None = None) -> Response:
    """Return the rows of a response in which the drive rises.

    Parameters
    ----------
    response : Response
        One or more cycles.
    x : str, optional
        What drives; by default the first column.

    Returns
    -------
    Response

    Raises
    ------
    TurgorError
        If the drive never rises.

    Examples
    --------
    >>> pressure, angle = Column("pressure", "kPa", [0, 10e3, 20e3, 10e3, 0]), Column("bending_angle", "deg", range(5))
    >>> cycle = Response(columns=(pressure, angle), source=Source(text="a test"))
    >>> print(loading(cycle)["pressure_kPa"], unloading(cycle)["pressure_kPa"])
    [ 0. 10. 20.] [20. 10.  0.]
    """
    return _directed(response, x, rising=True)


def unloading(response: Response, x: str | None = None) -> Response:
    """Return the rows of a response in which the drive falls; see `loading`."""
    return _directed(response, x, rising=False)


def within_ranges(response: Response, ranges: Sequence[str]) -> Response:
    """Return the rows of a response whose values lie in ranges of columns.

    Parameters
    ----------
    response : Response
    ranges : sequence of str
        Each a column and its range, such as ``"pressure=5..30 kPa"``; the first number may have another unit.

    Returns
    -------
    Response

    Raises
    ------
    TurgorError
        If a range cannot be read, names no column, or leaves fewer than two rows.

    Examples
    --------
    >>> pressure, angle = Column("pressure", "kPa", [0, 10e3, 20e3, 30e3]), Column("bending_angle", "deg", range(4))
    >>> test = Response(columns=(pressure, angle), source=Source(text="a test"))
    >>> print(within_ranges(test, ["pressure = 5..20 kPa"])["pressure_kPa"])
    [10. 20.]
    """
    for text in ranges:
        name, equals, span = (part.strip() for part in text.partition("="))
        first, dots, last = (part.strip() for part in span.partition(".."))
        if not (equals and dots and name):
            raise TurgorError(f"the range '{text}' cannot be read; write NAME=FROM..TO, such as 'pressure=0..30 kPa'.")
        name = spelled_column(name, response.names)
        if name not in response:
            raise unknown(f"column of {response.source}", name, response.names)
        column = response.find(name)
        high, unit = _number(last, column, "")
        low, _ = _number(first, column, unit)
        rows = np.flatnonzero((column.values >= low) & (column.values <= high))
        if len(rows) < 2:
            raise TurgorError(
                f"the range '{text}' leaves {len(rows)} of {len(response)} rows of {response.source}, whose '{name}' "
                f"is {column.span}; two are needed."
            )
        response = _rows(response, rows.tolist())
    return response


def _number(text: str, column: Column, unit: str) -> tuple[float, str]:
    """Number of a range in SI units, and its unit: that which is stated, the one of the other end, or none."""
    number, _, stated = text.partition(" ")
    unit = stated.strip() or unit
    try:
        value = float(number)
    except ValueError:
        raise TurgorError(f"'{text}' in the range of '{column.name}' is no number with a unit.") from None
    units = {each: COLUMN_UNITS[each] for each in column.units}
    units |= next((dict(UNITS[kind]) for kind in DIMENSIONS if column.unit in UNITS[kind]), {})
    if unit not in units:
        known = ", ".join(filter(None, units)) or "none"
        raise TurgorError(f"'{text}' in the range of '{column.name}' has the unit '{unit}'; allowed: {known}.")
    return value * units[unit], unit


def branches(values: Array, turn: float = TURN) -> list[tuple[int, int]]:
    """Find where a drive rises and falls.

    Parameters
    ----------
    values : (n,) array
        The drive, with noise.
    turn : float [-]
        Share of the range by which it goes back where it turns.

    Returns
    -------
    list of (int, int)
        First and last row of each branch; neighbors share the row at which the drive turns.

    Examples
    --------
    >>> branches(np.array([0.0, 1, 0.99, 2, 3, 2, 1, 2]))
    [(0, 4), (4, 6), (6, 7)]
    """
    least = turn * float(np.nanmax(values) - np.nanmin(values))
    ends, extreme, direction = [0], 0, 0
    for n, value in enumerate(values):
        ahead = (value - values[extreme]) * (direction or 1)
        if direction == 0 and abs(value - values[extreme]) > least:
            direction, extreme = (1 if value > values[extreme] else -1), n
        elif direction and ahead >= 0:
            extreme = n
        elif direction and -ahead > least:
            ends.append(extreme)
            direction, extreme = -direction, n
    ends.append(len(values) - 1)
    return [(first, last) for first, last in pairwise(ends) if last > first]


def average_runs(runs: Sequence[Response], x: str | None = None, *, rows: int = 101) -> Response:
    """Average repeated runs at equal values of the drive.

    Parameters
    ----------
    runs : sequence of Response
        Two or more, each with a drive that rises (or falls) throughout; see `loading`.
    x : str, optional
        What drives; by default the first column of the first run.
    rows : int
        Number of values of the drive, evenly spaced over the range that all runs share.

    Returns
    -------
    Response
        The drive, and for every column that all runs have its mean and, as ``NAME_spread``, the standard deviation of
        the runs (with n − 1).

    Raises
    ------
    TurgorError
        If there are fewer than two runs, a drive turns, or the runs share no range.

    Examples
    --------
    >>> runs = [Response(columns=(Column("pressure", "kPa", [0, 1e3]), Column("force", "N", [0, top])),
    ...                  source=Source(text="a test")) for top in (1.0, 3.0)]
    >>> mean = average_runs(runs, rows=3)
    >>> print(mean["force"], mean["force_spread"].round(3))
    [0. 1. 2.] [0.    0.707 1.414]
    """
    if len(runs) < 2:
        raise TurgorError(f"average_runs needs two runs or more, not {len(runs)}.")
    x = x or runs[0].names[0]
    ranges = np.array([(np.nanmin(run.column(x)), np.nanmax(run.column(x))) for run in runs])
    low, high = ranges[:, 0].max(), ranges[:, 1].min()
    if not low < high:
        raise TurgorError(
            f"the runs share no range of '{x}': the highest begins at {low:g}, the lowest ends at {high:g}."
        )
    at = np.linspace(low, high, rows)
    columns = [Column(x, runs[0].find(x).unit, at)]
    for name in (each for each in runs[0].names if each != x and all(each in run for run in runs)):
        unit = runs[0].find(name).unit
        table = np.array([interpolated(run, x, name, at) for run in runs])
        columns.append(Column(name, unit, table.mean(axis=0)))
        columns.append(Column(name + SPREAD, unit, table.std(axis=0, ddof=1)))
    source = Source(text=f"mean of {len(runs)} runs", detail="; ".join(dict.fromkeys(str(run.source) for run in runs)))
    return Response(columns=tuple(columns), source=source)


def interpolated(response: Response, x: str, y: str, at: Array) -> Array:
    """Interpolate a column at values of the drive; nan beyond its range.

    Parameters
    ----------
    response : Response
        With a drive that does not turn.
    x, y : str
        Columns.
    at : (n,) array [SI]
        Values of the drive.

    Returns
    -------
    (n,) array [SI]

    Raises
    ------
    TurgorError
        If the drive turns.
    """
    drive, values = response.column(x), response.column(y)
    known = np.isfinite(drive) & np.isfinite(values)
    drive, values = drive[known], values[known]
    if len(drive) < 2:
        raise TurgorError(f"'{response.source}' has {len(drive)} rows with '{x}' and '{y}'; two are needed.")
    if len(branches(drive)) > 1:
        raise TurgorError(
            f"'{x}' of {response.source} goes up and down; take loading(...) or unloading(...) of it first."
        )
    places, which, counts = np.unique(drive, return_inverse=True, return_counts=True)
    means = np.bincount(which, weights=values) / counts  # equal readings of the drive: their mean
    return np.interp(at, places, means, left=np.nan, right=np.nan)


def _directed(response: Response, x: str | None, *, rising: bool) -> Response:
    drive = response.column(x or response.names[0])
    rows: list[int] = []
    for first, last in branches(drive):
        if (drive[last] > drive[first]) == rising:
            rows += range(first + (1 if rows and rows[-1] == first else 0), last + 1)
    if not rows:
        way = "rises" if rising else "falls"
        raise TurgorError(f"'{x or response.names[0]}' of {response.source} never {way}.")
    return _rows(response, rows)


def _rows(response: Response, rows: list[int]) -> Response:
    return replace(
        response,
        columns=tuple(replace(column, values=column.values[rows]) for column in response.columns),
        stages=tuple(response.stages[n] for n in rows) if response.stages else (),
    )
