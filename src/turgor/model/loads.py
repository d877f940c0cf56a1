"""Loads: what drives the actuator. All grow in proportion to the load factor."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

STANDARD_GRAVITY = 9.80665


@dataclass(frozen=True, slots=True)
class Pressure:
    """Gauge pressure on a face: a follower load on the current surface, normal to it.

    Parameters
    ----------
    face : str
        Name of the face, usually ``"cavity"``.
    pressure : float [Pa], gauge
        Value at load factor 1; positive pushes against the solid.
    """

    face: str
    pressure: float


@dataclass(frozen=True, slots=True)
class Traction:
    """Dead load on a face: force per reference area, fixed in direction.

    Parameters
    ----------
    face : str
        Name of the face.
    vector : (3,) floats [Pa]
        Force per reference area at load factor 1.
    """

    face: str
    vector: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Gravity:
    """Weight of every region.

    Parameters
    ----------
    direction : (3,) floats
        Direction of the fall; normalized.
    acceleration : float [m/s²]
        Its magnitude.
    """

    direction: tuple[float, float, float] = (0.0, 0.0, -1.0)
    acceleration: float = STANDARD_GRAVITY


@dataclass(frozen=True, slots=True)
class BodyForce:
    """Force per reference volume given as a function of the reference position, for manufactured solutions.

    Parameters
    ----------
    value : callable
        ``value(points) -> (n, 3) force per volume [N/m³]`` at the (n, 3) reference points [m].
    """

    value: Callable[[NDArray[np.float64]], NDArray[np.float64]]


Load = Pressure | Traction | Gravity | BodyForce
