"""Values with their mesh error, as text."""

from math import floor, isfinite, log10

import numpy as np

from turgor.foundation.response import COLUMN_UNITS, Column, Response

#: Errors smaller than this, in the unit that is shown, count as zero, and so do their values.
NOT_SHOWN = 1e-6


def is_zero(column: Column) -> bool:
    """Return whether a column is zero throughout, to the digits that are shown."""
    return bool((np.abs(column.in_unit) < NOT_SHOWN).all())


def with_error(value: float, error: float, unit: str) -> str:
    """Write a value with its mesh error, both in ``unit``, with as many digits as the error allows to tell apart.

    Parameters
    ----------
    value, error : float [SI]
        The error may be nan, where it is not known.
    unit : str
        One of `COLUMN_UNITS`.

    Examples
    --------
    >>> with_error(1.6196, 0.0157, "deg"), with_error(0.01234, float("nan"), "mm")
    ('92.8 ± 0.9 deg', '12.34 mm')
    """
    scale = COLUMN_UNITS[unit]
    if not isfinite(error) or error <= 0 or error / scale < NOT_SHOWN:
        return f"{value / scale:.4g} {unit}".rstrip()
    decimals = _decimals(error / scale)
    return f"{value / scale:.{decimals}f} ± {error / scale:.{decimals}f} {unit}".rstrip()


def _decimals(error: float) -> int:
    """Decimals that show one digit of an error, two where the first is a one."""
    place = floor(log10(error))
    leading = error / 10.0**place
    return int(np.clip(-place + (1 if leading < 1.95 else 0), 0, 9))


def last_with_error(response: Response, column: Column) -> str:
    """Write the last value of a column with its mesh error, where one was estimated.

    Parameters
    ----------
    response : Response
    column : Column
        One of its columns.
    """
    errors = response.mesh_error(column.name)
    error = float("nan") if errors is None else float(errors[-1])
    return with_error(float(column.values[-1]), error, column.unit)
