"""Values with their mesh errors, and functions for judges: values at a pressure, and whether values differ."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

import turgor as tg

Array = NDArray[np.float64]

#: What is appended to the name of a column to name the column of its mesh error.
MESH_ERROR = "_mesh_error"


@dataclass(frozen=True, slots=True, order=True)
class Value:
    """A number with its estimated mesh error, both in ``unit``; ``str`` gives ``"92.8 ± 0.9 deg"``.

    Parameters
    ----------
    number : float
    error : float
        Zero where no error was estimated.
    unit : str
    """

    number: float
    error: float = 0.0
    unit: str = ""

    def __str__(self) -> str:
        spread = f" ± {self.error:.2g}" if self.error else ""
        return f"{self.number:.4g}{spread} {self.unit}".strip()


def last(response: tg.Response, name: str) -> Value:
    """Value of a column in its last state.

    Parameters
    ----------
    response : Response
    name : str
        A column.

    Returns
    -------
    Value
    """
    column, error = _with_error(response, name)
    return Value(float(column.in_unit[-1]), float(error[-1]), column.unit)


def at(response: tg.Response, name: str, drive: str, where: float) -> Value:
    """Value of a column where another one first reaches a number.

    Parameters
    ----------
    response : Response
    name : str
        A column.
    drive : str
        Another one, such as ``"pressure"``.
    where : float [SI]
        The number that it reaches.

    Returns
    -------
    Value
        Not a number where it is never reached.

    Examples
    --------
    >>> import turgor as tg
    >>> Column = tg.experiments.Column
    >>> columns = (Column("pressure", "kPa", [0, 10e3]), Column("bending_angle", "deg", [0, 0.5]))
    >>> response = tg.Response(columns=columns, source=tg.laws.Source(text="a ruler"))
    >>> print(at(response, "bending_angle", "pressure", 5e3))
    14.32 deg
    """
    column, error = _with_error(response, name)
    way = response.column(drive)
    reached = np.flatnonzero(way >= where * (1 - 1e-9))
    if not len(reached):
        return Value(np.nan, np.nan, column.unit)
    k = int(reached[0])
    if k == 0:
        return Value(float(column.in_unit[0]), float(error[0]), column.unit)
    share = (where - way[k - 1]) / (way[k] - way[k - 1])
    number, spread = (float(each[k - 1] + share * (each[k] - each[k - 1])) for each in (column.in_unit, error))
    return Value(number, spread, column.unit)


def rises(values: Sequence[Value]) -> bool:
    """Whether each value is larger than the one before it, by more than their mesh errors together.

    Parameters
    ----------
    values : sequence of Value

    Returns
    -------
    bool

    Examples
    --------
    >>> rises([Value(1.0, 0.1), Value(2.0, 0.1)]), rises([Value(1.0, 0.6), Value(2.0, 0.6)])
    (True, False)
    """
    return all(b.number - a.number > a.error + b.error for a, b in pairwise(values))


def falls(values: Sequence[Value]) -> bool:
    """Whether each value is smaller than the one before it, by more than their mesh errors together.

    Parameters
    ----------
    values : sequence of Value

    Returns
    -------
    bool
    """
    return rises(tuple(values)[::-1])


def largest(values: Sequence[Value]) -> int:
    """Index of the largest value.

    Parameters
    ----------
    values : sequence of Value

    Returns
    -------
    int
    """
    return int(np.argmax([value.number for value in values]))


def listed(values: Sequence[Value]) -> str:
    """Values in one line, with the unit once: ``"68.6 ± 0.9, 124 ± 1 deg"``.

    Parameters
    ----------
    values : sequence of Value

    Returns
    -------
    str
    """
    return f"{', '.join(str(Value(value.number, value.error)) for value in values)} {values[0].unit}".strip()


def linearity(response: tg.Response, name: str, drive: str, until: float) -> float:
    """R² of a straight line through a column against its drive, sampled evenly up to a number.

    Parameters
    ----------
    response : Response
    name, drive : str
        Columns.
    until : float [SI]
        Largest drive.

    Returns
    -------
    float
    """
    drives = np.linspace(0, until, 41)
    values = np.interp(drives, response.column(drive), response.column(name))
    line = np.polyval(np.polyfit(drives, values, 1), drives)
    return float(1 - ((values - line) ** 2).sum() / ((values - values.mean()) ** 2).sum())


def _with_error(response: tg.Response, name: str) -> tuple[tg.experiments.Column, Array]:
    """Give a column, and its mesh error in its unit."""
    column = response.find(name)
    error = response.mesh_error(name)
    return column, np.zeros(len(column.values)) if error is None else tg.experiments.Column(
        name, column.unit, error
    ).in_unit
