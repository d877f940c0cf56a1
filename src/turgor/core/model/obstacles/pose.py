"""Pose: where a rigid body is, turned about a point of it and then moved."""

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.directions import rotation_vector
from turgor.foundation.display import brief

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """Where a rigid body is: turned about a point of it, then moved.

    Parameters
    ----------
    place : (3,) array [m]
        How far the point has moved.
    turn : (3, 3) array, optional
        Rotation matrix; None where the body does not turn.
    about : (3,) array [m]
        The point, where it was at first.

    Examples
    --------
    >>> quarter = Pose(np.zeros(3), np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]), np.array([1.0, 0, 0]))
    >>> quarter.moved(np.array([[2.0, 0, 0]])).tolist(), quarter.at_first(np.array([[1.0, 1, 0]])).tolist()
    ([[1.0, 1.0, 0.0]], [[2.0, 0.0, 0.0]])
    """

    place: Array
    turn: Array | None = None
    about: Array = field(default_factory=lambda: np.zeros(3))

    __repr__ = brief

    @property
    def pivot(self) -> Array:
        """Where the point is now, (3,)."""
        return self.about + self.place

    def moved(self, points: Array) -> Array:
        """Return where points (..., 3) of the body are now."""
        return points + self.place if self.turn is None else self.turned(points - self.about) + self.pivot

    def at_first(self, points: Array) -> Array:
        """Return where points (..., 3) of the body were at first."""
        return points - self.place if self.turn is None else self.turned_back(points - self.pivot) + self.about

    def turned(self, vectors: Array) -> Array:
        """Return vectors (..., 3) of the body as they are now."""
        return vectors if self.turn is None else vectors @ self.turn.T

    def turned_back(self, vectors: Array) -> Array:
        """Return vectors (..., 3) as they were at first."""
        return vectors if self.turn is None else vectors @ self.turn

    def turned_tensors(self, tensors: Array) -> Array:
        """Return tensors (..., 3, 3) of the body as they are now."""
        return tensors if self.turn is None else self.turn @ tensors @ self.turn.T

    def turned_since(self, before: "Pose") -> Array:
        """Return the rotation (3,) since another pose, as axis times angle [rad], less than half a turn."""
        if self.turn is None or before.turn is None:
            return np.zeros(3)
        return rotation_vector(self.turn @ before.turn.T)

    def scaled(self, length: float, beyond: Array | float = 0.0) -> "Pose":
        """Return the pose in units of a length, with the place moved by ``beyond`` (3,) in this unit."""
        return replace(self, place=self.place / length + beyond, about=self.about / length)
