"""Curves of CAD edges: points at parameters, and parameters of points."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.moving.settings import MOVING

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Curve:
    """The curve of a CAD edge.

    Parameters
    ----------
    edge : CAD edge
    low, high : float
        Range of its parameter, in the direction in which shares count.
    scale : float [m]
        Length of one CAD unit.
    """

    edge: Any
    low: float
    high: float
    scale: float

    def points(self, at: Array) -> Array:
        """Points (n, 3) [m] at shares (n,) of the range of the parameter."""
        if self.straight:
            one, other = self.samples[[0, -1]]
            return np.asarray(one + at[:, None] * (other - one))
        return self._values(self.edge.Value, at)

    def shares(self, points: Array) -> Array:
        """Shares (n,) of the range of the parameter at the nearest points, 0 to 1."""
        one, other = self.samples[[0, -1]]
        if self.straight:
            along = other - one
            return np.asarray(np.clip((points - one) @ along / (along @ along), 0.0, 1.0))
        away = np.linalg.norm(points[:, None] - self.samples, axis=2)
        at = away.argmin(axis=1) / (MOVING.samples - 1)
        for _ in range(MOVING.iterations):
            tangents = self._values(self.edge.Tangent, at) * (self.high - self.low)
            square = np.einsum("ni,ni->n", tangents, tangents)
            step = np.einsum("ni,ni->n", points - self.points(at), tangents) / np.where(square > 0, square, 1.0)
            before, at = at, np.clip(at + step, 0.0, 1.0)
            if np.abs(at - before).max(initial=0.0) < MOVING.exact:
                break
        return at

    @cached_property
    def samples(self) -> Array:
        """Points (s, 3) [m] along the edge, evenly in its parameter."""
        return self._values(self.edge.Value, np.linspace(0.0, 1.0, MOVING.samples))

    @cached_property
    def straight(self) -> bool:
        """Whether the edge is straight, and its parameter grows evenly along it."""
        one, other = self.samples[[0, -1]]
        even = one + np.linspace(0.0, 1.0, MOVING.samples)[:, None] * (other - one)
        return bool(np.abs(self.samples - even).max() <= MOVING.exact * np.abs(self.samples).max())

    def _values(self, function: Any, at: Array) -> Array:
        points = [function(t) for t in (self.low + at * (self.high - self.low)).tolist()]
        return np.array([(each.x, each.y, each.z) for each in points]).reshape(-1, 3) * self.scale


def curve_of(edge: Any, scale: float) -> Curve:
    """Return the curve of a CAD edge.

    Parameters
    ----------
    edge : CAD edge
    scale : float [m]
        Length of one CAD unit.

    Returns
    -------
    Curve
    """
    low, high = edge.parameter_interval
    return Curve(edge, float(low), float(high), scale)
