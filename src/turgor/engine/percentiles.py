"""Percentiles by weight: the value that a share of the volume or of the area stays below."""

import numpy as np
from numpy.typing import NDArray

from turgor.engine.fields import CellFields

Array = NDArray[np.float64]

#: The largest stress and stretch of reports and pictures: this share of the volume stays below, in percent.
PERCENTILE = 99


def weighted_percentile(values: Array, weights: Array, percent: float = PERCENTILE) -> float:
    """Return the value that a share of the weight stays below.

    Parameters
    ----------
    values, weights : arrays of one shape
        Values, and the volume or area that each stands for.
    percent : float
        The share, in percent.

    Examples
    --------
    >>> weighted_percentile(np.array([3.0, 1.0, 2.0]), np.array([0.005, 0.5, 0.5]))
    2.0
    """
    order = np.argsort(values, axis=None)
    share = np.cumsum(weights.ravel()[order])
    return float(values.ravel()[order[np.searchsorted(share, share[-1] * percent / 100)]])


def volume_percentile(cells: CellFields, values: Array, chosen: NDArray[np.int64] | slice = slice(None)) -> float:
    """Return the value of a field that 99 % of the volume of some cells stay below.

    Parameters
    ----------
    cells : CellFields
        Whose reference volumes count.
    values : (c, q) array
        The field at the quadrature points.
    chosen : (k,) int array or slice
        Which cells; all by default.
    """
    return weighted_percentile(values[chosen], cells.weight[chosen])
