"""Screw motions: rotation about an axis with a translation along it, which lays out an arc or a helix."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.directions import rotation_vector

Array = NDArray[np.float64]

#: Below this angle [rad] sines are replaced by their first terms.
SMALL = 1e-6


def screw_between(turn: Array, shift: Array) -> tuple[Array, Array]:
    """Constant velocities that make a rigid motion in a unit of time, seen from the moving body.

    Parameters
    ----------
    turn : (3, 3) array
        Rotation, by less than half a turn.
    shift : (3,) array [m]
        Where the origin gets to.

    Returns
    -------
    tuple of (3,) array [rad], (3,) array [m]
        Angular velocity and velocity of the origin.
    """
    vector = rotation_vector(turn)
    reach = np.stack([screw_path(vector, axis, np.ones(1))[1][0] for axis in np.eye(3)], axis=1)
    return vector, np.linalg.solve(reach, shift)


def screw_path(angular: Array, linear: Array, times: Array) -> tuple[Array, Array]:
    """Rigid motions that constant velocities make, the inverse of `screw_between` at the time 1.

    Parameters
    ----------
    angular : (3,) array [rad]
    linear : (3,) array [m]
        Velocities seen from the moving body, for a unit of time.
    times : (k,) array

    Returns
    -------
    tuple of (k, 3, 3) array, (k, 3) array [m]
        Rotations, and where the origin gets to.

    Examples
    --------
    >>> half_circle = np.array([0.0, 0.0, np.pi]), np.array([np.pi, 0.0, 0.0])
    >>> screw_path(*half_circle, np.array([0.5, 1.0]))[1].round(9).tolist()
    [[1.0, 1.0, 0.0], [0.0, 2.0, 0.0]]
    """
    angle = float(np.linalg.norm(angular))
    if angle < SMALL:
        x, y, z = angular
        K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        return np.eye(3) + times[:, None, None] * K, np.outer(times, linear)
    x, y, z = angular / angle
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])  # Rodrigues
    sine, cosine = np.sin(angle * times), np.cos(angle * times)
    turns = np.eye(3) + sine[:, None, None] * K + (1 - cosine)[:, None, None] * K @ K
    ways = np.outer(times, linear) + np.outer((1 - cosine) / angle, K @ linear)
    return turns, ways + np.outer(times - sine / angle, K @ K @ linear)
