"""Slopes: derivatives of measures by numbers, as further columns of a response."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response


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
    >>> from turgor.foundation.source import Source
    >>> area = Response(columns=(Column("area", "mm2", [4.0]),), source=Source(text="a square"))
    >>> with_slopes(area, {"area": {"side": 4.0}})["area_slope_side"]
    array([4.])
    """
    columns = list(response.columns)
    for measure, by in slopes.items():
        for factor, given in by.items():
            values = np.full(len(response), np.nan)
            table = np.asarray(given, dtype=np.float64)
            if table.shape not in ((), (len(response),)):
                raise TurgorError(
                    f"slopes of '{measure}' by '{factor}' have the shape {table.shape}; give one number, or "
                    f"{len(response)}, one for each state."
                )
            values[-1 if table.ndim == 0 else slice(None)] = table
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
