"""Loops: loading and unloading of a measurement against those of a computation."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.laboratory.runs import branches
from turgor.accuracy.laboratory.settings import LABORATORY

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Loop:
    """Differences of loading and unloading.

    Parameters
    ----------
    loading, unloading : float [SI]
        Roots of the mean squares of the differences of the rows in which the drive rises, and falls.
    width : float [SI]
        Mean of what the measured value is larger by in unloading, at equal drive.
    """

    loading: float
    unloading: float
    width: float


def rising_rows(drive: Array) -> NDArray[np.bool_]:
    """Return whether the drive rises at each row; a row at which it turns belongs to the branch before.

    Examples
    --------
    >>> rising_rows(np.array([0.0, 1.0, 2.0, 1.0, 0.0])).tolist()
    [True, True, True, False, False]
    """
    rising = np.ones(len(drive), dtype=bool)
    for first, last in branches(drive):
        rising[first + (first > 0) : last + 1] = drive[last] > drive[first]
    return rising


def loop_of(drive: Array, measured: Array, away: Array) -> Loop | None:
    """Return the loop of measured rows; None where the drive does not turn.

    Parameters
    ----------
    drive, measured : (n,) array [SI]
        In the order of time.
    away : (n,) array [SI]
        Computed minus measured.

    Examples
    --------
    >>> drive = np.array([0.0, 1.0, 2.0, 1.0, 0.0])
    >>> loop = loop_of(drive, np.array([0.0, 1.0, 2.0, 1.5, 0.5]), np.array([0.0, 0.0, 0.0, -0.5, -0.5]))
    >>> loop.loading, loop.unloading, round(loop.width, 3)
    (0.0, 0.5, 0.5)
    """
    rising = rising_rows(drive)
    if rising.sum() < 2 or (~rising).sum() < 2:
        return None
    low, high = (
        max(drive[rising].min(), drive[~rising].min()), min(drive[rising].max(), drive[~rising].max()),
    )  # fmt: skip
    at = np.linspace(low, high, LABORATORY.loop_points)
    up, down = (_mean_curve(drive[rows], measured[rows], at) for rows in (rising, ~rising))
    loading, unloading = (float(np.sqrt(np.mean(away[rows] ** 2))) for rows in (rising, ~rising))
    return Loop(loading=loading, unloading=unloading, width=float(np.mean(down - up)))


def computed_at(drive: Array, values: Array, at: Array) -> tuple[Array, bool]:
    """Return a computed value at each measured drive, from the branch in the same direction where both have one.

    Parameters
    ----------
    drive, values : (n,) array [SI]
        The computed path.
    at : (m,) array [SI]
        The measured drive, in the order of time.

    Returns
    -------
    values : (m,) array [SI]
        nan beyond the computed range.
    unloaded : bool
        Whether the computation has a branch of unloading that was used.
    """
    parts = branches(drive)
    first = parts[0] if parts else (0, len(drive) - 1)
    result = _between(drive, values, first, at)
    if len(parts) < 2 or not _comes_back(drive, parts):
        return result, False
    falls = ~rising_rows(at)
    result[falls] = _between(drive, values, parts[1], at[falls])
    return result, bool(falls.any())


def _comes_back(drive: Array, parts: list[tuple[int, int]]) -> bool:
    """Whether the second branch of a drive ends where the first began."""
    (begin, top), (_, end) = parts[:2]
    reach = abs(drive[top] - drive[begin])
    return bool(abs(drive[end] - drive[begin]) <= LABORATORY.closed * reach)


def _between(drive: Array, values: Array, part: tuple[int, int], at: Array) -> Array:
    rows = slice(part[0], part[1] + 1)
    known = np.isfinite(drive[rows]) & np.isfinite(values[rows])
    places, which, counts = np.unique(drive[rows][known], return_inverse=True, return_counts=True)
    means = np.bincount(which, weights=values[rows][known]) / counts
    return np.interp(at, places, means, left=np.nan, right=np.nan)


def _mean_curve(drive: Array, values: Array, at: Array) -> Array:
    order = np.argsort(drive, kind="stable")
    return np.interp(at, drive[order], values[order])
