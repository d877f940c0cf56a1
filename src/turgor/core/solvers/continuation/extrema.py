"""Extrema: where a load on a path has a maximum or a minimum, from values and slopes at states."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
End = tuple[float, float, float]


def turning_points(before: End, after: End) -> list[float]:
    """Parameters between two states at which the cubic through their values and slopes turns, rising.

    Parameters
    ----------
    before, after : (float, float, float)
        Parameter, value and slope.

    Returns
    -------
    list of float
        None, one or two.

    Examples
    --------
    >>> turning_points((0.0, 0.0, 2.0), (3.0, -3.0, -4.0))  # 2 t − t²
    [1.0]
    """
    (p0, s0, d0), (p1, s1, d1) = before, after
    h = p1 - p0
    rise = (s1 - s0) / h
    # slope of the cubic over x = (p − p0) / h: a x² + b x + d0
    a, b = 3 * (d0 + d1 - 2 * rise), 2 * (3 * rise - 2 * d0 - d1)
    scale = max(abs(d0), abs(d1), abs(rise), 1e-300)
    if abs(a) < 1e-12 * scale:
        roots = [-d0 / b] if abs(b) > 1e-12 * scale else []
    else:
        inside = b * b - 4 * a * d0
        roots = [] if inside < 0 else [(-b + sign * np.sqrt(inside)) / (2 * a) for sign in (-1, 1)]
    return [float(p0 + h * x) for x in sorted(roots) if 0 < x < 1]


def extremum_ahead(loads: Sequence[float], sizes: Sequence[float]) -> float | None:
    """Load at which the cubic through the last four states has a maximum; None where it has none just ahead.

    With three states, or where the cubic has no maximum, a parabola through the last three takes its place. Near a
    limit point the distance to its load falls with the square of the distance to its size.

    Parameters
    ----------
    loads : sequence of float
        Rising.
    sizes : sequence of float
        How far the body has grown at each, such as its volume or the size of its displacement.

    Examples
    --------
    >>> extremum_ahead([0.75, 0.96, 0.99], [0.5, 0.8, 0.9])
    1.0
    >>> extremum_ahead([0.7, 0.8, 0.9], [0.5, 0.6, 0.7]) is None
    True
    """
    f, s = np.asarray(loads[-4:]), np.asarray(sizes[-4:])
    if len(f) < 3 or not (np.diff(s) > 0).all():
        return None
    return _top(f, s) or _top(f[-3:], s[-3:])


def _top(f: Array, s: Array) -> float | None:
    """Maximum just ahead of the polynomial through all points; None where it has none."""
    width = s[-1] - s[0]
    curve = np.polynomial.Polynomial.fit(s, f, len(f) - 1, domain=[s[0], s[-1]])
    turns = [float(x.real) for x in curve.deriv().roots() if abs(x.imag) < 1e-9 * width]
    tops = [x for x in turns if x > s[-2] and curve.deriv(2)(x) * width**2 < -1e-9 * abs(f[-1])]
    return round(max(float(curve(min(tops))), float(f[-1])), 12) if tops else None
