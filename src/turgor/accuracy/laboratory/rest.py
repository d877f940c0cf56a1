"""Rest: what a measurement shows before and after its drive has acted, which is offset and drift."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.laboratory.settings import LABORATORY
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Rest:
    """Values at the lowest drive, at the beginning and at the end of a record.

    Parameters
    ----------
    drive : float [SI]
        The lowest drive, as measured at the beginning.
    start : float [SI]
        Median of the value there, at the beginning.
    end : float [SI]
        The same at the end; nan where the drive does not come back.
    """

    drive: float
    start: float
    end: float

    @property
    def drift(self) -> float:
        """What the value has changed by in between [SI]; nan where the drive does not come back."""
        return self.end - self.start


def rest_of(response: Response, x: str, y: str) -> Rest | None:
    """Return what a measurement shows at rest; None where it does not begin there.

    Parameters
    ----------
    response : Response
        In the order of time.
    x, y : str
        What drives, and what is measured.

    Returns
    -------
    Rest or None

    Examples
    --------
    >>> from turgor.foundation.response import Column
    >>> from turgor.foundation.source import Source
    >>> columns = Column("pressure", "kPa", [0, 20e3, 0]), Column("bending_angle", "deg", [0.1, 0.9, 0.2])
    >>> round(rest_of(Response(columns=columns, source=Source(text="a test")), "pressure", "bending_angle").drift, 3)
    0.1
    """
    drive, value = response.column(x), response.column(y)
    known = np.isfinite(drive) & np.isfinite(value)
    drive, value = drive[known], value[known]
    reach = float(np.ptp(drive)) if len(drive) else 0.0
    if reach == 0:
        return None
    low = drive <= drive.min() + LABORATORY.rest * reach
    if not low[0]:
        return None
    away = np.flatnonzero(~low)
    first = slice(0, int(away[0]))
    back = low[-1]
    end = float(np.median(value[int(away[-1]) + 1 :])) if back else np.nan
    return Rest(drive=float(np.median(drive[first])), start=float(np.median(value[first])), end=end)


def remove_drift(response: Response, y: str, x: str) -> Response:
    """Return a measurement without its drift: what has not come back at the end is taken away in proportion to time.

    Parameters
    ----------
    response : Response
        In the order of time; without a column ``time``, rows count.
    y, x : str
        What drifts, and what drives.

    Returns
    -------
    Response

    Raises
    ------
    TurgorError
        If the record does not begin and end at the lowest drive.

    Examples
    --------
    >>> from turgor.foundation.response import Column
    >>> from turgor.foundation.source import Source
    >>> columns = Column("pressure", "kPa", [0, 20e3, 0]), Column("bending_angle", "deg", [0.1, 0.9, 0.2])
    >>> test = Response(columns=columns, source=Source(text="a test"))
    >>> remove_drift(test, "bending_angle", "pressure")["bending_angle"]
    array([0.1 , 0.85, 0.1 ])
    """
    rest = rest_of(response, x, y)
    if rest is None or not np.isfinite(rest.drift):
        raise TurgorError(
            f"the drift of '{y}' in {response.source} is not known: the record does not begin and end at its lowest "
            f"'{x}'."
        )
    clock = response.column("time") if "time" in response else np.arange(len(response), dtype=float)
    share = (clock - clock[0]) / (clock[-1] - clock[0])
    return less(response, y, rest.drift * share)


def less(response: Response, y: str, amount: float | Array) -> Response:
    """Return a response with an amount subtracted from a column [SI]."""
    columns = tuple(
        replace(column, values=column.values - amount) if column.name == y else column for column in response.columns
    )
    return replace(response, columns=columns)
