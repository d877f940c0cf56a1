"""Directions: those along the axes, by their names in selectors, obstacles and job files, and unit vectors."""

from collections.abc import Mapping
from math import hypot, isfinite
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.foundation.errors import TurgorError

Vector = tuple[float, float, float]

#: Directions in a file of our x, y and z: names such as "-x", or three numbers each.
FileAxes = tuple[str | Vector, str | Vector, str | Vector]

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


def rotation_of(vector: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the rotation (3, 3) about an axis by an angle, given as axis times angle [rad] (Rodrigues).

    Examples
    --------
    >>> rotation_of(np.array([0.0, 0.0, np.pi / 2])).round(9).tolist()
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """
    angle = float(np.linalg.norm(vector))
    x, y, z = vector / angle if angle > 0 else vector
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)


def rotation_vector(rotation: NDArray[np.float64]) -> NDArray[np.float64]:
    """Axis times angle of a rotation (3, 3) by less than half a turn.

    Examples
    --------
    >>> c, s = np.cos(0.3), np.sin(0.3)
    >>> rotation_vector(np.array([[1, 0, 0], [0, c, -s], [0, s, c]])).round(9).tolist()
    [0.3, 0.0, 0.0]
    """
    axis = np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]])
    sine = float(np.linalg.norm(axis)) / 2
    angle = np.arctan2(sine, (np.trace(rotation) - 1) / 2)
    return np.asarray(axis / 2 * (angle / sine if sine > 1e-12 else 1.0))


def rotation_to(axes: FileAxes) -> NDArray[np.float64]:
    """Return the rotation from the axes of a file to ours.

    Parameters
    ----------
    axes : tuple of str or (3,) floats
        Directions in the file of our x, y and z.

    Returns
    -------
    (3, 3) array
        Our x, y and z in a row each.

    Raises
    ------
    TurgorError
        If they are not three directions at right angles to each other, or would mirror the part.

    Examples
    --------
    >>> rotation_to(("-x", "z", "y")).tolist()
    [[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]
    >>> rotation_to(("x", "y", "-z"))
    Traceback (most recent call last):
    turgor.TurgorError: axes x, y, -z are left-handed and would mirror the part; turn one sign.
    """
    named = {**DIRECTIONS, **AXES}
    rows = [named.get(axis) if isinstance(axis, str) else _unit(axis) for axis in axes]
    if len(rows) != 3 or any(row is None for row in rows):
        raise TurgorError(f"axes are {axes!r}; name x, y and z of the file once each, such as '-x', 'z', 'y'.")
    rotation = np.array(rows)
    if np.abs(rotation @ rotation.T - np.eye(3)).max() > TOLERANCE.square:
        if all(isinstance(axis, str) for axis in axes):
            raise TurgorError(f"axes are {axes!r}; name x, y and z of the file once each, such as '-x', 'z', 'y'.")
        raise TurgorError(f"axes are {axes!r}; they must be at right angles to each other.")
    if np.linalg.det(rotation) < 0:
        listed = ", ".join(str(axis) for axis in axes)
        raise TurgorError(f"axes {listed} are left-handed and would mirror the part; turn one sign.")
    u, _, v = np.linalg.svd(rotation)
    return np.asarray(rotation if all(isinstance(axis, str) for axis in axes) else u @ v)


def _unit(axis: object) -> Vector | None:
    try:
        numbers = [float(number) for number in axis]  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        return None
    length = float(np.linalg.norm(numbers))
    if len(numbers) != 3 or not (isfinite(length) and length > 0):
        return None
    x, y, z = (number / length for number in numbers)
    return x, y, z
