"""Inversion of a curve that rises from zero: samples until it turns, then the false position in all brackets."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Relative width of a bracket at which the search ends, and the most passes.
CLOSE, PASSES = 1e-13, 80


@dataclass(frozen=True, slots=True)
class Rise:
    """The rising part of a curve.

    Parameters
    ----------
    x, y : (n,) arrays
        Samples, the first at rest.
    turns : bool
        Whether the last sample is a maximum; else the curve was still rising where the samples ended.
    """

    x: Array
    y: Array
    turns: bool


def rising(curve: Callable[[Array], Array], x: Array, enough: float = np.inf) -> Rise:
    """Find the part of a curve from its first sample to its first maximum, which is refined.

    Samples behind a value that is no number do not count: a law may be undefined there.

    Parameters
    ----------
    curve : callable
        ``curve(x) -> y`` for arrays.
    x : (n,) array
        Rising samples.
    enough : float
        Samples behind the first that reaches this value do not count: it saves the search for the maximum.

    Returns
    -------
    Rise

    Examples
    --------
    >>> rise = rising(lambda x: np.sin(x), np.linspace(0, 6, 25))
    >>> bool(abs(rise.x[-1] - np.pi / 2) < 1e-7), rise.turns
    (True, True)
    """
    y = curve(x)
    known = int(np.argmin(np.isfinite(y))) if not np.isfinite(y).all() else len(x)
    x, y = x[:known], y[:known]
    falls = np.flatnonzero(np.diff(y) < 0)
    reached = int(np.argmax(y >= enough))
    if y[reached] >= enough and not (len(falls) and falls[0] < reached):
        return Rise(x[: reached + 1], y[: reached + 1], False)
    if not len(falls):
        return Rise(x, y, False)
    top = int(falls[0])
    at = extremum(curve, x[max(top - 1, 0)], x[min(top + 1, len(x) - 1)])
    keep = x < at
    return Rise(np.append(x[keep], at), np.append(y[keep], curve(np.array([at]))), True)


def extremum(curve: Callable[[Array], Array], low: float, high: float, passes: int = 12) -> float:
    """Find where a curve has its one maximum or minimum between two points, from the zero of its slope.

    Each pass samples the slope at nine points and keeps the two between which it changes sign.
    """
    reach = high - low
    for _ in range(passes):
        x = np.linspace(low, high, 9)
        step = max(1e-5 * reach, 1e-7)
        slope = curve(x + step) - curve(x - step)
        change = np.flatnonzero(slope[:-1] * slope[1:] <= 0)
        if not len(change):
            return float(x[np.argmin(np.abs(slope))])
        low, high = x[change[0]], x[change[0] + 1]
        share = float(slope[change[0]] / (slope[change[0]] - slope[change[0] + 1] or 1.0))
        if high - low < 1e-3 * reach:
            return float(low + share * (high - low))
    return float((low + high) / 2)


def inverted(curve: Callable[[Array], Array], rise: Rise, targets: Array) -> Array:
    """Find x with curve(x) = target on a rising part; the false position with halved ends (Illinois).

    Parameters
    ----------
    curve : callable
    rise : Rise
    targets : (m,) array
        Between the first and the last sample.

    Returns
    -------
    (m,) array

    Examples
    --------
    >>> x = np.linspace(0, 2, 5)
    >>> inverted(lambda x: x**2, Rise(x, x**2, False), np.array([0.0, 2.0])).round(9)
    array([0.        , 1.41421356])
    """
    above = np.clip(np.searchsorted(rise.y, targets), 1, len(rise.y) - 1)
    low, high = rise.x[above - 1], rise.x[above]
    below, over = rise.y[above - 1] - targets, rise.y[above] - targets
    side = np.zeros(len(targets))
    x = low
    for _ in range(PASSES):
        gap = np.where(over > below, over - below, 1.0)
        x = np.where(below == 0, low, np.where(over == 0, high, (low * over - high * below) / gap))
        y = curve(x) - targets
        short = y < 0
        over = np.where(short, np.where(side < 0, over / 2, over), y)
        below = np.where(short, y, np.where(side > 0, below / 2, below))
        low, high = np.where(short, x, low), np.where(short, high, x)
        side = np.where(short, -1.0, 1.0)
        if (np.abs(y) <= CLOSE * np.abs(rise.y[-1])).all() or (high - low <= CLOSE * np.abs(x)).all():
            break
    return np.asarray(x)
