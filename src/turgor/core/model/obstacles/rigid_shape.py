"""RigidShape: the base of the shapes of obstacles, with what follows from one."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.directions import normalized
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import vector
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

Vector = tuple[float, float, float]

#: Two directions are the same, and a point lies on an axis [m], up to this.
SAME = ROUND_OFF.same


class RigidShape:
    """The shape of an obstacle: how a report describes it, and whether it is the same after turns."""

    __slots__ = ()

    def text(self) -> str:
        """Return the shape and its place in words."""
        return type(self).__name__.lower()

    def turned(self, axis: int, center: Vector) -> bool:
        """Whether the shape is the same after any turn about an axis.

        Parameters
        ----------
        axis : int
            Number of its direction.
        center : (3,) floats [m]
            A point of the axis.
        """
        return False


def across(values: Vector, axis: int) -> NDArray[np.float64]:
    """Return the two components of a vector across an axis."""
    return np.delete(np.array(values), axis)


def in_mm(values: Vector) -> str:
    """Return a place or a way in millimeters, in words."""
    return f"({listed(value / mm for value in values)}) mm"


def listed(values: Iterable[float]) -> str:
    """Return numbers in words."""
    return ", ".join(f"{value:.4g}" for value in values)


def positive(what: str, value: float, unit: str = " mm") -> None:
    """Refuse a value that is not more than 0."""
    if not (np.isfinite(value) and value > 0):
        shown = value * 1e3 if unit else value
        raise TurgorError(f"{what} is {shown:g}{unit}; allowed is more than 0.")


def direction(what: str, values: Any) -> Vector:
    """Return the unit vector of a direction that was given."""
    given = vector(values, what)
    unit = normalized(given)
    if unit is None:
        why = "a zero vector" if not any(given) else f"{values!r}, whose length cannot be computed"
        raise TurgorError(f"{what} is {why}; give a direction such as (0, 0, 1).")
    return unit
