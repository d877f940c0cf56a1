"""Percentiles by weight: the value that a share of the volume or of the area stays below."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fields import CellFields

Array = NDArray[np.float64]

#: The largest values, one of so many, are enough to find the largest percentiles among; only they are sorted.
ONE_OF = 16

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
    flat, weight = values.ravel(), weights.ravel()
    total = float(weight.sum())
    target, largest = total * percent / 100, _largest(flat)
    below = total - float(weight[largest].sum())
    if below >= target:  # the percentile is not among them
        largest, below = np.arange(flat.size), 0.0
    order = largest[np.argsort(flat[largest])]
    share = below + np.cumsum(weight[order])
    return float(flat[order[min(int(np.searchsorted(share, target)), len(order) - 1)]])


def _largest(values: Array) -> NDArray[np.intp]:
    """Where the largest values stand, one of so many."""
    count = len(values) // ONE_OF + 1
    return np.argpartition(values, len(values) - count)[-count:]


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
