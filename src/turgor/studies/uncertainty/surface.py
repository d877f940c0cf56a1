"""Response surface: linear or quadratic in the inputs, each in units of its standard deviation from its mean.

y(z) = y0 + Σ aᵢ zᵢ + Σ bᵢ zᵢ² + Σ cᵢⱼ zᵢ zⱼ, with independent normal zᵢ: mean y0 + Σ bᵢ, variance
Σ (aᵢ² + 2 bᵢ²) + Σ cᵢⱼ². The linear surface has neither b nor c. Central differences at z = ±1, or at ±√3 for the
quadratic one: these are the Gauss–Hermite points, so that mean and variance of one input are those of a quadrature of
fifth order.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Draws from a quadratic surface, so that its 95 % range is right to 1 % of its width.
DRAWS = 20_000

Point = tuple[float, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Surface:
    """Coefficients of one column at all rows.

    Parameters
    ----------
    middle : (m,) array
        Value at the mean of all inputs.
    first, second : (n, m) array
        Coefficients a and b of each input.
    mixed : mapping of (int, int) to (m,) array
        Coefficients c.
    """

    middle: Array
    first: Array
    second: Array
    mixed: Mapping[tuple[int, int], Array]

    def at(self, z: Array) -> Array:
        """Return the values at points (k, n), (k, m)."""
        values = self.middle + z @ self.first + z**2 @ self.second
        for (i, j), c in self.mixed.items():
            values = values + np.outer(z[:, i] * z[:, j], c)
        return np.asarray(values)

    @property
    def parts(self) -> Array:
        """Variance that each input brings alone, (n, m)."""
        return np.asarray(self.first**2 + 2 * self.second**2)

    @property
    def together(self) -> Array:
        """Variance of the mixed terms, (m,)."""
        return np.asarray(sum((c**2 for c in self.mixed.values()), np.zeros_like(self.middle)))


def design(count: int, *, quadratic: bool, interactions: bool) -> list[Point]:
    """Return the points of a surface: the middle, two for each input, and one for each pair.

    Parameters
    ----------
    count : int
        Number of inputs.
    quadratic, interactions : bool

    Returns
    -------
    list of tuple of float

    Examples
    --------
    >>> len(design(3, quadratic=True, interactions=True))
    10
    """
    reach = sqrt(3.0) if quadratic else 1.0
    points = [_point(count, {})]
    for i in range(count):
        points += [_point(count, {i: reach}), _point(count, {i: -reach})]
    if interactions:
        points += [_point(count, {i: 1.0, j: 1.0}) for i, j in combinations(range(count), 2)]
    return points


def check_points(count: int, *, quadratic: bool) -> list[Point]:
    """Return the held-out points: all inputs off at once, in the same and in alternating directions.

    Parameters
    ----------
    count : int
    quadratic : bool

    Returns
    -------
    list of tuple of float
    """
    same = tuple([0.8] * count)
    other = tuple(-0.8 if k % 2 == 0 else 0.8 for k in range(count))
    return [same, other] if quadratic else [same]


def fit_surface(
    value_at: Callable[[Point], Array | None], count: int, *, quadratic: bool, interactions: bool
) -> Surface:
    """Compute the coefficients from the values at the points of the design.

    Parameters
    ----------
    value_at : callable
        Values at a point; None where the run failed. The middle one must not have failed. Where one side of an input
        failed, the other side gives its slope.
    count : int
    quadratic, interactions : bool

    Returns
    -------
    Surface
        nan for an input of which both sides failed.
    """
    reach = sqrt(3.0) if quadratic else 1.0
    middle = value_at(_point(count, {}))
    assert middle is not None
    first, second = np.full((count, len(middle)), np.nan), np.zeros((count, len(middle)))
    for i in range(count):
        above, below = value_at(_point(count, {i: reach})), value_at(_point(count, {i: -reach}))
        if above is not None and below is not None:
            first[i] = (above - below) / (2 * reach)
            if quadratic:
                second[i] = (above + below - 2 * middle) / (2 * reach**2)
        elif above is not None or below is not None:
            first[i] = (above - middle) / reach if above is not None else (middle - below) / reach  # type: ignore[operator]
    mixed = {}
    for i, j in combinations(range(count), 2) if interactions else ():
        corner = value_at(_point(count, {i: 1.0, j: 1.0}))
        if corner is not None:
            mixed[i, j] = corner - middle - first[i] - first[j] - second[i] - second[j]
    return Surface(middle=middle, first=first, second=second, mixed=mixed)


def range_of(surface: Surface, others: Sequence[Array]) -> tuple[Array, Array]:
    """Return the 2.5 and 97.5 percentiles of a surface with other independent parts.

    Parameters
    ----------
    surface : Surface
    others : sequence of (k, m) array
        Further parts, with equally likely rows.

    Returns
    -------
    low, high : (m,) array
    """
    draw = np.random.default_rng(1)
    values = surface.at(draw.standard_normal((DRAWS, len(surface.first))))
    for table in others:
        values = values + table[draw.integers(len(table), size=DRAWS)]
    low, high = np.percentile(values, [2.5, 97.5], axis=0)
    return low, high


def _point(count: int, moved: Mapping[int, float]) -> Point:
    return tuple(moved.get(k, 0.0) for k in range(count))
