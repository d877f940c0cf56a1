"""Slopes: derivatives of measures by factors, as further columns of a response, where a function knows them."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.errors import TurgorError
from turgor.optimization.reading import At, Measure, read
from turgor.response import Column, Response
from turgor.study.study import Row, place_on

Array = NDArray[np.float64]


def with_slopes(response: Response, slopes: Mapping[str, Mapping[str, ArrayLike]]) -> Response:
    """Add derivatives of measures by factors to a response, for a search that uses them.

    Parameters
    ----------
    response : Response
    slopes : mapping of str to mapping of str to float or (n,) array [SI]
        Derivatives by measure and factor, such as ``{"bending_angle": gradient.by("bending_angle")}``: one for each
        state, NaN where it is not known, or one number for the last state. Where a goal reads at a value of a drive
        that depends on the factors, that of the drive is needed as well.

    Returns
    -------
    Response

    Raises
    ------
    TurgorError
        If there are neither one number nor as many as states.

    Examples
    --------
    >>> from turgor.source import Source
    >>> area = Response(columns=(Column("area", "mm2", [4.0]),), source=Source(text="a square"))
    >>> with_slopes(area, {"area": {"side": 4.0}})["area_slope_side"]
    array([4.])
    """
    columns = list(response.columns)
    for measure, by in slopes.items():
        for factor, given in by.items():
            values = np.full(len(response), np.nan)
            found = np.asarray(given, dtype=np.float64)
            if found.shape not in ((), (len(response),)):
                raise TurgorError(
                    f"slopes of '{measure}' by '{factor}' have the shape {found.shape}; give one number, or "
                    f"{len(response)}, one for each state."
                )
            values[-1 if found.ndim == 0 else slice(None)] = found
            columns.append(Column(slope_name(measure, factor), "", values))
    return replace(response, columns=tuple(columns))


def slope_name(measure: str, factor: str) -> str:
    """Return the name of the column with the derivative of a measure by a factor.

    Examples
    --------
    >>> slope_name("bending_angle", "actuator.wall")
    'bending_angle_slope_actuator_wall'
    """
    return f"{measure}_slope_{''.join(letter if letter.isalnum() else '_' for letter in factor)}"


def slopes_of(row: Row, measure: Measure, at: At, factors: Sequence[str]) -> Array:
    """Return the derivatives of what is read from a row by each factor, (factors,) [SI]; NaN where unknown."""
    if not isinstance(measure, str) or row.response is None:
        return np.full(len(factors), np.nan)
    if measure in row.values:
        return np.array([float(name == measure) for name in factors])
    found = _column_slopes(row, measure, at, factors)
    if at is None or at[0] in row.values:
        return found
    moved = np.nan_to_num(_column_slopes(row, at[0], at, factors))  # a drive without slopes is the same for all designs
    return found - _rise(row.response, measure, at) * moved if moved.any() else found


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
