"""Selectors of faces and bodies of a CAD file."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.colors import hexadecimal, parse_color, same_color
from turgor.core.geometry.directions import AXES, DIRECTIONS, Vector, normalized
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.foundation.errors import TurgorError, near_match
from turgor.units import plain_number

Array = NDArray[np.float64]

#: What programs leave between things that touch [m].
SLACK = 1e-6

#: Directions by name; an axis without a sign is its positive direction.
NAMED = {**DIRECTIONS, **AXES}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Item:
    """Properties of a face or a body of a CAD part for selectors.

    Parameters
    ----------
    name : str
        Name in the file, empty where it has none.
    color : tuple of float or None
        Red, green and blue between 0 and 1.
    normal : (3,) tuple or None
        Outward normal of a plane face; None for curved faces and bodies.
    center, low, high : (3,) tuple [m]
        Centroid, and the corners of the bounding box.
    triangles : (t, 3, 3) float array [m]
        Its surface, for distances.
    """

    name: str
    color: Vector | None
    normal: Vector | None
    center: Vector
    low: Vector
    high: Vector
    triangles: Array


def vector(what: str, value: object) -> Vector:
    """Return three finite numbers, refusing anything else.

    Examples
    --------
    >>> vector("point of NearestTo", (0, 1))
    Traceback (most recent call last):
    turgor.TurgorError: point of NearestTo is (0, 1); three finite numbers are needed.
    """
    try:
        numbers = tuple(plain_number(number) for number in value)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        numbers = ()
    if len(numbers) != 3 or not all(isfinite(number) for number in numbers):
        raise TurgorError(f"{what} is {value!r}; three finite numbers are needed.")
    return numbers


def direction(what: str, value: object) -> Vector:
    """Return a unit vector from a name such as ``"-x"`` or from three numbers.

    Examples
    --------
    >>> direction("normal", "-x"), direction("normal", (0, 0, 2))
    ((-1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    """
    if isinstance(value, str):
        if value not in NAMED:
            raise TurgorError(f"{what} is '{value}'; allowed is '+x', '-x', '+y', '-y', '+z', '-z' or three numbers.")
        return NAMED[value]
    unit = normalized(vector(what, value))
    if unit is None:
        raise TurgorError(f"{what} is {value!r}, which has no direction; give '+x' or three numbers.")
    return unit


@dataclass(frozen=True, slots=True)
class ByName:
    """Selector of all faces or bodies with a name in the file.

    Parameters
    ----------
    name : str
        Name in the file; ``turgor inspect`` lists them.

    Examples
    --------
    >>> ByName("clamp")
    ByName(name='clamp')
    """

    name: str

    def pick(self, items: Sequence[Item]) -> list[int]:
        """Return the indices of the selected items; an empty selection is an error that lists what exists."""
        names = sorted({item.name for item in items} - {""})
        listed = f"t has {', '.join(names)}" if names else "t has no names"
        hint = near_match(self.name, names)
        return _selected(
            [i for i, item in enumerate(items) if item.name == self.name],
            f"name '{self.name}' is not in the file{f'{hint} I' if hint else '; i'}{listed}.",
        )


@dataclass(frozen=True, slots=True)
class ByColor:
    """Selector of all faces or bodies of one color.

    Parameters
    ----------
    color : str
        A name such as ``"red"`` or a hexadecimal number such as ``"#d02020"``; files with sRGB
        colors and files with linear colors are both understood.

    Examples
    --------
    >>> ByColor("red")
    ByColor(color='red')
    """

    color: str

    def __post_init__(self) -> None:
        parse_color(self.color)

    def pick(self, items: Sequence[Item]) -> list[int]:
        """Return the indices of the selected items; an empty selection is an error that lists what exists."""
        target = parse_color(self.color)
        known = sorted({hexadecimal(item.color) for item in items if item.color is not None})
        return _selected(
            [i for i, item in enumerate(items) if item.color is not None and same_color(item.color, target)],
            f"color {self.color} is not in the file; it has {', '.join(known) or 'no colors'}.",
        )


@dataclass(frozen=True, slots=True)
class NearestTo:
    """Selector of the face or body nearest to a point.

    Parameters
    ----------
    point : (3,) tuple [m]
        A point on it or near it. For the face of a cavity it means the whole cavity with the wall nearest to it.

    Examples
    --------
    >>> NearestTo((0.110, 0, 0.005)).point
    (0.11, 0.0, 0.005)
    """

    point: Vector

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", vector("point of NearestTo", self.point))

    def pick(self, items: Sequence[Item]) -> list[int]:
        """Return the index of the selected item."""
        return [int(np.argmin([distance(self.point, item.triangles) for item in items]))]


@dataclass(frozen=True, slots=True)
class InBox:
    """Selector of all faces or bodies that lie completely within a box.

    Parameters
    ----------
    low, high : (3,) tuple [m]
        Two opposite corners.

    Examples
    --------
    >>> InBox((0, 0, 0), (0.01, 0.02, -0.02))
    Traceback (most recent call last):
    turgor.TurgorError: box goes from 0 mm to -20 mm along z; its low corner must lie below the high one.
    """

    low: Vector
    high: Vector

    def __post_init__(self) -> None:
        object.__setattr__(self, "low", vector("low corner of InBox", self.low))
        object.__setattr__(self, "high", vector("high corner of InBox", self.high))
        for axis, a, b in zip("xyz", self.low, self.high, strict=True):
            if not a <= b:
                raise TurgorError(
                    f"box goes from {a * 1e3:.6g} mm to {b * 1e3:.6g} mm along {axis}; its low corner must lie below "
                    "the high one."
                )

    def pick(self, items: Sequence[Item]) -> list[int]:
        """Return the indices of the selected items; an empty selection is an error that lists what exists."""
        inside = [
            i
            for i, item in enumerate(items)
            if all(a - SLACK <= b for a, b in zip(self.low, item.low, strict=True))
            and all(a <= b + SLACK for a, b in zip(item.high, self.high, strict=True))
        ]
        low = np.min([item.low for item in items], axis=0) * 1e3
        high = np.max([item.high for item in items], axis=0) * 1e3
        return _selected(
            inside,
            f"box from {_mm(self.low)} to {_mm(self.high)} mm holds nothing whole; the part reaches from "
            f"{_mm(low / 1e3)} to {_mm(high / 1e3)} mm.",
        )


@dataclass(frozen=True, slots=True)
class WithNormal:
    """Selector of the plane faces with a normal that lie furthest out in its direction.

    Parameters
    ----------
    normal : str or (3,) tuple
        ``"+x"`` to ``"-z"``, or three numbers. ``WithNormal("-x")`` is the end face at the lowest x.

    Examples
    --------
    >>> WithNormal("-x").normal
    (-1.0, 0.0, 0.0)
    """

    normal: Vector

    def __post_init__(self) -> None:
        object.__setattr__(self, "normal", direction("normal", self.normal))

    def pick(self, items: Sequence[Item]) -> list[int]:
        """Return the indices of the selected items; an empty selection is an error that lists what exists."""
        normal = np.array(self.normal)
        looking = [
            i for i, it in enumerate(items) if it.normal is not None and normal @ it.normal >= TOLERANCE.direction
        ]
        depth = {i: float(normal @ items[i].center) for i in looking}
        size = max((float(np.ptp([item.low, item.high], axis=0).max()) for item in items), default=0.0)
        furthest = [i for i in looking if depth[i] >= max(depth.values()) - 1e-6 * size]
        return _selected(furthest, f"normal {_mm(normal / 1e3)} is that of no plane face.")


Selector = ByName | ByColor | NearestTo | InBox | WithNormal


def distance(point: Vector, triangles: Array) -> float:
    """Distance from a point to the nearest of some triangles [m].

    Examples
    --------
    >>> round(distance((0.25, 0.25, 2.0), np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0.0]]])), 12)
    2.0
    """
    p, a = np.array(point), triangles[:, 0]
    u, v = triangles[:, 1] - a, triangles[:, 2] - a
    normal = np.cross(u, v)
    area = np.einsum("ti,ti->t", normal, normal)
    safe = np.where(area > 0, area, 1.0)
    w = p - a
    s = np.einsum("ti,ti->t", np.cross(w, v), normal) / safe
    t = np.einsum("ti,ti->t", np.cross(u, w), normal) / safe
    above = (area > 0) & (s >= 0) & (t >= 0) & (s + t <= 1)
    height = np.abs(np.einsum("ti,ti->t", w, normal)) / np.sqrt(safe)
    nearest = np.where(above, height, np.inf)
    for i in range(3):
        start, along = triangles[:, i], triangles[:, (i + 1) % 3] - triangles[:, i]
        length = np.einsum("ti,ti->t", along, along)
        share = np.clip(np.einsum("ti,ti->t", p - start, along) / np.where(length > 0, length, 1.0), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(start + share[:, None] * along - p, axis=1))
    return float(nearest.min())


def _selected(places: list[int], otherwise: str) -> list[int]:
    if not places:
        raise TurgorError(otherwise)
    return places


def _mm(point: object) -> str:
    x, y, z = (float(value) * 1e3 for value in point)  # type: ignore[attr-defined]
    return f"({x:.6g}, {y:.6g}, {z:.6g})"
