"""Richardson's extrapolation from three meshes: observed order, extrapolated value, error estimate."""

from dataclasses import dataclass
from math import isfinite, log

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from turgor.core.results.convergence.settings import EXTRAPOLATION
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Extrapolation:
    """Extrapolation of a sequence of values on finer and finer meshes.

    Parameters
    ----------
    value : float
        Extrapolated value where the sequence converges, else the one of the finest mesh.
    error : float
        Estimated error of the finest mesh, not negative: 1.25 times the distance to the extrapolated value (the grid
        convergence index), or the spread of the last three values where there is none.
    order : float or None
        Observed order of convergence; None where the sequence has none.
    trust : str
        ``"converging"``, ``"equal"``, ``"fast"`` (faster than the cells can, order limited), ``"slow"``,
        ``"diverging"`` or ``"not monotone"``.
    """

    value: float
    error: float
    order: float | None
    trust: str

    @property
    def reliable(self) -> bool:
        """Whether the extrapolated value rests on an observed order."""
        return self.trust in ("converging", "equal", "fast")


def extrapolate(sizes: ArrayLike, values: ArrayLike) -> Extrapolation:
    """Extrapolate values on three or more meshes to the size zero, by the last three of them.

    The value is taken as f + C h^p: three meshes give the limit f, the factor C and the order p, whatever the ratios of
    their sizes (Richardson's extrapolation).

    Parameters
    ----------
    sizes : (n,) array [m]
        Sizes of the cells from coarse to fine.
    values : (n,) array
        What was computed with them.

    Returns
    -------
    Extrapolation

    Raises
    ------
    TurgorError
        If there are fewer than three sizes or they do not get smaller.

    Examples
    --------
    >>> h = np.array([4.0, 2.0, 1.0])
    >>> limit = extrapolate(h, 10 + 0.5 * h**2)
    >>> round(limit.value, 9), round(limit.order, 9), limit.error
    (10.0, 2.0, 0.625)
    >>> extrapolate(h, [1.0, 3.0, 2.0]).trust
    'not monotone'
    """
    h, f = np.asarray(sizes, dtype=np.float64), np.asarray(values, dtype=np.float64)
    if h.ndim != 1 or h.shape != f.shape or len(h) < 3:
        raise TurgorError(f"{len(h)} meshes and {len(f)} values are given; at least three of each are needed.")
    if not (np.isfinite(h).all() and np.isfinite(f).all() and (h > 0).all() and (np.diff(h) < 0).all()):
        raise TurgorError(
            f"mesh sizes are {h.tolist()} and values {f.tolist()}; sizes must be positive and get smaller, and every "
            "value finite."
        )
    h, f = h[-3:], f[-3:]
    first, last = f[1] - f[0], f[2] - f[1]
    finest, spread = float(f[2]), float(np.ptp(f))
    if max(abs(first), abs(last)) <= EXTRAPOLATION.equal * np.abs(f).max():
        return Extrapolation(value=finest, error=spread, order=None, trust="equal")
    if first * last < 0:
        return Extrapolation(value=finest, error=spread, order=None, trust="not monotone")
    order = _order(h, abs(first), abs(last))
    if order < EXTRAPOLATION.least_order:
        trust = "slow" if order > 0 else "diverging"
        return Extrapolation(value=finest, error=spread, order=order if order > 0 else None, trust=trust)
    used = min(order, EXTRAPOLATION.most_order)
    value = float(finest + last / ((h[1] / h[2]) ** used - 1))
    if order <= EXTRAPOLATION.most_order:
        return Extrapolation(
            value=value, error=EXTRAPOLATION.safety * abs(value - finest), order=order, trust="converging"
        )
    # the last two values may agree by chance: what the first two say, with the highest order, is an error too
    expected = first * h[2] ** used / (h[0] ** used - h[1] ** used)
    error = EXTRAPOLATION.safety * max(abs(value - finest), abs(expected))
    shown = order if isfinite(order) else None
    return Extrapolation(value=value, error=float(error), order=shown, trust="fast")


def _order(h: Array, first: float, last: float) -> float:
    """The p for which |f2 - f1| : |f3 - f2| is (h1^p - h2^p) : (h2^p - h3^p); negative where differences grow."""
    if last <= EXTRAPOLATION.equal * first:
        return np.inf
    if first <= EXTRAPOLATION.equal * last:
        return -np.inf
    a, b = log(h[0] / h[1]), log(h[1] / h[2])

    def off(p: float) -> float:
        # log of the ratio of the differences, written so that p = 0 is its limit log(a / b)
        rising = p * b + log(np.expm1(p * a) / np.expm1(p * b)) if p else log(a / b)
        return float(rising) - log(first / last)

    low, high = -20 / (a + b), 40 / (a + b)
    if off(low) > 0:
        return -np.inf
    if off(high) < 0:
        return np.inf
    return float(brentq(off, low, high, xtol=1e-12))
