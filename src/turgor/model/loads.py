"""Loads: what drives the actuator. All grow in proportion to the load factor, unless a pressure has its own history."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.errors import TurgorError

STANDARD_GRAVITY = 9.80665

History = tuple[tuple[float, float], ...]

#: The history of a load that grows in proportion to the load factor.
RAMP: History = ((0.0, 0.0), (1.0, 1.0))


@dataclass(frozen=True, slots=True)
class Pressure:
    """Gauge pressure on a face: a follower load on the current surface, normal to it.

    Parameters
    ----------
    face : str
        Name of the face, usually ``"cavity"``, or ``"cavity_1"`` where there are several.
    pressure : float [Pa], gauge
        The whole pressure; positive pushes against the solid.
    history : sequence of (float, float), optional
        Points (load factor, share of the pressure that acts then), straight lines between them. The load factor
        rises from 0 to 1; the share is 0 at first, within -1 to 1, and may fall again. By default the pressure grows
        in proportion to the load factor. `solve` makes a state at every point.

    Raises
    ------
    TurgorError
        If the history is no such sequence.

    Examples
    --------
    >>> first = Pressure("cavity_1", 20e3, history=[(0, 0), (0.5, 1), (1, 0.5)])
    >>> first.at(0.25), first.at(0.5), first.at(1.0)
    (10000.0, 20000.0, 10000.0)
    """

    face: str
    pressure: float
    history: History = RAMP

    def __post_init__(self) -> None:
        object.__setattr__(self, "history", _points(self.face, self.history))

    def share(self, load_factor: float) -> float:
        """Return the share of the pressure that acts at a load factor."""
        factors, shares = zip(*self.history, strict=True)
        return float(np.interp(load_factor, factors, shares))

    def at(self, load_factor: float) -> float:
        """Return the pressure at a load factor [Pa]."""
        return self.share(load_factor) * self.pressure


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


def _points(face: str, history: Iterable[Any]) -> History:
    """Check a history and return it as floats."""
    said = f"pressure on '{face}': history is {history!r}"
    try:
        points = tuple((float(factor), float(share)) for factor, share in history)
    except (TypeError, ValueError):
        raise TurgorError(
            f"{said}; points (load factor, share) are needed, such as [[0, 0], [0.5, 1], [1, 0.5]]."
        ) from None
    if not points or points[0] != (0.0, 0.0):
        raise TurgorError(f"{said}; it must begin with (0, 0), because the actuator starts without load.")
    if points[-1][0] != 1 or not all(a < b for (a, _), (b, _) in pairwise(points)):
        raise TurgorError(f"{said}; the load factors must rise from 0 to 1.")
    if not all(-1 <= share <= 1 for _, share in points):
        raise TurgorError(f"{said}; shares of the pressure lie between -1 and 1.")
    return points
