"""Jets: numbers with their first and second derivatives, so that an energy that is written once has both."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Jet:
    """Values with their derivatives by n variables.

    Parameters
    ----------
    value : (...) array
    first : (..., n) array
    second : (..., n, n) array

    Examples
    --------
    >>> x = Jet(np.array([2.0]), np.array([[1.0]]), np.zeros((1, 1, 1)))
    >>> y = x * x / (x + x)
    >>> y.value.tolist(), y.first.tolist(), y.second.round(12).tolist()
    ([1.0], [[0.5]], [[[0.0]]])
    """

    value: Array
    first: Array
    second: Array

    def __add__(self, other: "Jet") -> "Jet":
        return Jet(self.value + other.value, self.first + other.first, self.second + other.second)

    def __sub__(self, other: "Jet") -> "Jet":
        return self + other.times(-1.0)

    def __mul__(self, other: "Jet") -> "Jet":
        a, b = self, other
        cross = a.first[..., :, None] * b.first[..., None, :]
        return Jet(
            a.value * b.value,
            a.value[..., None] * b.first + b.value[..., None] * a.first,
            a.value[..., None, None] * b.second
            + b.value[..., None, None] * a.second
            + cross
            + np.swapaxes(cross, -1, -2),
        )

    def __truediv__(self, other: "Jet") -> "Jet":
        return self * other.power(-1.0)

    def __getitem__(self, place: int) -> "Jet":
        """Return one component of vectors, the last axis of the values."""
        return Jet(self.value[..., place], self.first[..., place, :], self.second[..., place, :, :])

    def times(self, factor: Array | float) -> "Jet":
        """Multiply with numbers that do not vary."""
        f = np.asarray(factor, dtype=np.float64)
        return Jet(self.value * f, self.first * f[..., None], self.second * f[..., None, None])

    def less(self, number: Array | float) -> "Jet":
        """Subtract numbers that do not vary."""
        return Jet(self.value - number, self.first, self.second)

    def power(self, exponent: float) -> "Jet":
        """Raise positive values to a power."""
        v, e = self.value, exponent
        outer = self.first[..., :, None] * self.first[..., None, :]
        slope, bend = e * v ** (e - 1), e * (e - 1) * v ** (e - 2)
        return Jet(
            v**e, slope[..., None] * self.first, slope[..., None, None] * self.second + bend[..., None, None] * outer
        )


def dot(a: Jet, b: Jet) -> Jet:
    """Return the products of vectors (..., 3)."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Jet, b: Jet) -> Jet:
    """Return the cross products of vectors (..., 3)."""
    parts = [a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3] for i in range(3)]
    return Jet(
        np.stack([each.value for each in parts], axis=-1),
        np.stack([each.first for each in parts], axis=-2),
        np.stack([each.second for each in parts], axis=-3),
    )


def unit(a: Jet) -> Jet:
    """Return vectors of length one in the directions of vectors (..., 3)."""
    scale = dot(a, a).power(-0.5)
    return a * Jet(scale.value[..., None], scale.first[..., None, :], scale.second[..., None, :, :])


def angle(sine: Jet, cosine: Jet) -> Jet:
    """Return the angle whose sine and cosine are proportional to two numbers, between −π and π."""
    s, c = sine, cosine
    square = s.value**2 + c.value**2
    turned = c.value[..., None] * s.first - s.value[..., None] * c.first
    grown = s.value[..., None] * s.first + c.value[..., None] * c.first
    product = turned[..., :, None] * grown[..., None, :]
    return Jet(
        np.arctan2(s.value, c.value),
        turned / square[..., None],
        (c.value[..., None, None] * s.second - s.value[..., None, None] * c.second) / square[..., None, None]
        - (product + np.swapaxes(product, -1, -2)) / square[..., None, None] ** 2,
    )
