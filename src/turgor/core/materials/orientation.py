"""Orientation: how the directions of a material with fibers, or of a printed one, lie in its body."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.table_keys import table
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity, number, shown
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import format_quantity

Array = NDArray[np.float64]
Vector = tuple[float, float, float]

_TABLE_KEYS = ("along", "across", "around", "angle")


@dataclass(frozen=True, slots=True, kw_only=True)
class Orientation:
    """First, second and third direction of a material in its body at rest.

    Parameters
    ----------
    along : (float, float, float) [-]
        First direction, of any length.
    across : (float, float, float) or None [-]
        Second direction; the part of it along the first one does not count.
    around : (float, float, float) or None [m]
        Instead of ``across``: a point on the axis of a tube. The first direction is that of the axis, the second one
        runs around it, the third one is radial.
    angle : float [rad]
        Angle of two families of fibers to the first direction, one on each side of it, towards the second one; from 0,
        where both are one, to a right angle. It is for laws with fibers, such as `HolzapfelGasserOgden`.

    Examples
    --------
    >>> wound = Orientation(along=(0, 0, 1), around=(0, 0, 0), angle="54.7 deg")
    >>> wound.frames(np.array([[2e-3, 0.0, 5e-3]]))[0] + 0.0
    array([[ 0.,  0.,  1.],
           [ 0.,  1.,  0.],
           [-1.,  0.,  0.]])
    """

    along: Vector
    across: Vector | None = None
    around: Vector | None = None
    angle: float = 0.0

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            along: Iterable[float],
            across: Iterable[float] | None = None,
            around: Iterable[Quantity] | None = None,
            angle: Quantity = 0.0,
        ) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "along", _vector(self.along, "along"))
        if (self.across is None) == (self.around is None):
            raise TurgorError("orientation: give either across, the second direction, or around, a point on an axis.")
        for name, dimension in (("across", ""), ("around", "length")):
            given = getattr(self, name)
            if given is not None:
                object.__setattr__(self, name, _vector(given, name, dimension))
        angle = number(self.angle, "orientation: angle", "angle")
        object.__setattr__(self, "angle", angle)
        if not 0 <= angle <= pi / 2 + ROUND_OFF.same:
            raise TurgorError(f"orientation: angle is {angle * 180 / pi:g}°; allowed is 0° to 90°.")
        first, second = np.array(self.along), np.array(self.along if self.across is None else self.across)
        if not first.any():
            raise TurgorError("orientation: along is (0, 0, 0); a direction needs a length.")
        size = np.linalg.norm(first) * np.linalg.norm(second)
        if self.across is not None and not np.linalg.norm(np.cross(first, second)) > ROUND_OFF.same * size:
            raise TurgorError(f"orientation: across is {shown(self.across)}, parallel to along; they span a plane.")

    def frames(self, points: Array) -> Array:
        """First, second and third direction at points of the body at rest.

        Parameters
        ----------
        points : (..., 3) array [m]

        Returns
        -------
        (..., 3, 3) array [-]
            Unit vectors as rows. On the axis of a tube they are not numbers.
        """
        first = np.array(self.along) / np.linalg.norm(self.along)
        if self.across is not None:
            second = np.array(self.across) - first * (first @ np.array(self.across))
            second = np.broadcast_to(second / np.linalg.norm(second), points.shape)
        else:
            arms = points - np.array(self.around)
            second = np.cross(first, arms)
            with np.errstate(invalid="ignore"):
                second = second / np.linalg.norm(second, axis=-1, keepdims=True)
        along = np.broadcast_to(first, points.shape)
        return np.stack([along, second, np.cross(along, second)], axis=-2)


def read_orientation(values: Any) -> Orientation:
    """Read the directions of a material from a table.

    Parameters
    ----------
    values : mapping
        With ``along``, and ``across`` or ``around``, and perhaps ``angle``; see `Orientation`.

    Examples
    --------
    >>> read_orientation({"along": [1, 0, 0], "across": [0, 1, 0], "angle": "30 deg"}).angle
    0.5235987755982988
    """
    return Orientation(**table(values, "orientation", _TABLE_KEYS, ("along",)))


def orientation_table(orientation: Orientation) -> dict[str, Any]:
    """Write the directions of a material as a table that reads back to the same.

    Examples
    --------
    >>> orientation_table(Orientation(along=(0, 0, 1), around=(0, 0, 0)))
    {'along': [0.0, 0.0, 1.0], 'around': ['0 mm', '0 mm', '0 mm']}
    """
    values: dict[str, Any] = {"along": list(orientation.along)}
    if orientation.across is not None:
        values["across"] = list(orientation.across)
    if orientation.around is not None:
        values["around"] = [format_quantity(each, "mm") for each in orientation.around]
    if orientation.angle:
        values["angle"] = format_quantity(orientation.angle, "deg")
    return values


def _vector(given: object, name: str, dimension: str = "") -> Vector:
    values = list(given) if isinstance(given, Iterable) and not isinstance(given, str) else []
    if len(values) != 3:
        raise TurgorError(f"orientation: {name} is {shown(given)}; three numbers are needed.")
    x, y, z = (number(each, f"orientation: {name}", dimension) for each in values)
    return x, y, z
