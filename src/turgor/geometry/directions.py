"""Directions: those along the axes, by their names in selectors, obstacles and job files, and unit vectors."""

from collections.abc import Mapping
from math import hypot
from types import MappingProxyType

Vector = tuple[float, float, float]

#: The three axes, by name.
AXES: Mapping[str, Vector] = MappingProxyType({"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)})

#: The six directions along them, by name with a sign.
DIRECTIONS: Mapping[str, Vector] = MappingProxyType(
    {
        "+x": (1.0, 0.0, 0.0),
        "-x": (-1.0, 0.0, 0.0),
        "+y": (0.0, 1.0, 0.0),
        "-y": (0.0, -1.0, 0.0),
        "+z": (0.0, 0.0, 1.0),
        "-z": (0.0, 0.0, -1.0),
    }
)

#: Lengths of vectors that can be normalized without overflow or loss of digits.
SHORTEST, LONGEST = 1e-100, 1e100


def normalized(vector: Vector) -> Vector | None:
    """Return the unit vector of a direction; None where its length is zero, no number, or too large to square.

    Examples
    --------
    >>> normalized((0.0, 0.0, 2.0)), normalized((1e300, 1e300, 0.0))
    ((0.0, 0.0, 1.0), None)
    """
    length = hypot(*vector)
    if not SHORTEST <= length <= LONGEST:
        return None
    if abs(length - 1) <= 1e-15:  # what was normalized before keeps every digit
        return vector
    x, y, z = vector
    return x / length, y / length, z / length
