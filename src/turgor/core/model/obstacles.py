"""Obstacles: rigid bodies that the actuator may touch, and the shapes that they have."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.directions import normalized
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import name as name_of
from turgor.foundation.given import one, vector
from turgor.units import plain_number

Vector = tuple[float, float, float]

#: Points (load factor, displacement of the obstacle [m]).
Path = tuple[tuple[float, Vector], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Plane:
    """A rigid half space.

    Parameters
    ----------
    point : (3,) floats [m]
        Any point of its surface.
    normal : (3,) floats
        Direction out of the rigid side, towards the actuator; any length but zero.

    Examples
    --------
    >>> Plane(point=(0, 0, -0.01), normal=(0, 0, 2)).normal
    (0.0, 0.0, 1.0)
    """

    point: Vector
    normal: Vector

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", vector(self.point, "plane: point", "length"))
        object.__setattr__(self, "normal", _direction("plane: normal", self.normal))


@dataclass(frozen=True, slots=True, kw_only=True)
class Sphere:
    """A rigid ball.

    Parameters
    ----------
    center : (3,) floats [m]
        Its center.
    radius : float [m]
        More than 0.
    """

    center: Vector
    radius: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", vector(self.center, "sphere: center", "length"))
        _positive("sphere: radius", self.radius)


@dataclass(frozen=True, slots=True, kw_only=True)
class Cylinder:
    """A rigid round bar, endless or with flat ends.

    Parameters
    ----------
    center : (3,) floats [m]
        A point of its axis: the middle of a bar that has ends.
    axis : (3,) floats
        Direction of its axis; any length but zero.
    radius : float [m]
        More than 0.
    length : float [m], optional
        More than 0; endless if left out.
    """

    center: Vector
    axis: Vector
    radius: float
    length: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", vector(self.center, "cylinder: center", "length"))
        object.__setattr__(self, "axis", _direction("cylinder: axis", self.axis))
        _positive("cylinder: radius", self.radius)
        if self.length is not None:
            _positive("cylinder: length", self.length)


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """A rigid block with its edges along x, y and z.

    Parameters
    ----------
    center : (3,) floats [m]
        Its center.
    size : (3,) floats [m]
        Its lengths, more than 0 each.
    rounding : float [m]
        Radius of its edges, from 0 to half the shortest length. A sharp edge touches a soft body in a line, where
        pressure and penetration are unbounded; steps also converge better with round edges.
    """

    center: Vector
    size: Vector
    rounding: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", vector(self.center, "box: center", "length"))
        object.__setattr__(self, "size", vector(self.size, "box: size", "length"))
        for length in self.size:
            _positive("box: size", length)
        if not 0 <= self.rounding <= min(self.size) / 2:
            raise TurgorError(
                f"box: rounding is {self.rounding * 1e3:g} mm; allowed is 0 to half the shortest length, "
                f"{min(self.size) * 500:g} mm."
            )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RigidSurface:
    """A rigid body given by triangles, for instance from an STL file (`read_rigid`).

    Parameters
    ----------
    points : (n, 3) array [m]
    triangles : (f, 3) int array
        Counterclockwise seen from outside, so that normals point out of the rigid body.
    name : str
        Where it came from, for messages.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int64]
    name: str = "triangles"

    __repr__ = brief

    def __post_init__(self) -> None:
        points = np.ascontiguousarray(self.points, dtype=np.float64)
        triangles = np.ascontiguousarray(self.triangles, dtype=np.int64)
        if points.ndim != 2 or points.shape[1:] != (3,) or not np.isfinite(points).all():
            raise TurgorError(f"rigid surface '{self.name}': points must be an (n, 3) array of finite numbers.")
        if triangles.ndim != 2 or triangles.shape[1:] != (3,) or not len(triangles):
            raise TurgorError(f"rigid surface '{self.name}': triangles must be an (f, 3) array with at least one row.")
        if triangles.min() < 0 or triangles.max() >= len(points):
            raise TurgorError(f"rigid surface '{self.name}': triangles name points that are not there.")
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "triangles", triangles)


Shape = Plane | Sphere | Cylinder | Box | RigidSurface


@dataclass(frozen=True, slots=True, kw_only=True)
class Obstacle:
    """A rigid body that the actuator may touch: fixed, moved along a path, or held by a spring.

    Parameters
    ----------
    name : str
        What its results are called.
    shape : Plane, Sphere, Cylinder, Box or RigidSurface
    friction : float [-]
        Coulomb's coefficient, from 0 (frictionless) to 2.
    path : sequence of (float, (3,) floats [m]), optional
        Points (load factor, displacement), straight lines between them; from load factor 0 to 1. Left out, it stays.
    spring : float [N/m], optional
        Stiffness in all three directions of the spring that holds it at its place, or at its path's; it does not
        turn. Of the whole obstacle, also where a half of the actuator is modeled. Left out, it is held rigidly.
    face : str, optional
        The only face of the actuator that may touch it; by default the whole surface outside the cavities.
    stiffness : float [Pa/m], optional
        Penalty: pressure per depth of penetration. By default it follows from the material and the mesh, and is raised
        where the penetration exceeds its tolerance.
    elastic_slip : float [m], optional
        How far a point that sticks slips elastically before it slides; half a percent of the side of its cell by
        default. A smaller one holds better and makes steps harder.

    Examples
    --------
    >>> plate = Obstacle(name="plate", shape=Plane(point=(0, 0, -2e-3), normal=(0, 0, 1)),
    ...                  path=[(0, (0, 0, 0)), (1, (0, 0, 5e-3))])
    >>> plate.displacement(0.5)
    array([0.    , 0.    , 0.0025])
    """

    name: str
    shape: Shape
    friction: float = 0.0
    path: Path = ()
    spring: float | None = None
    face: str | None = None
    stiffness: float | None = None
    elastic_slip: float | None = None

    def __post_init__(self) -> None:
        if not name_of(self.name, "name of an obstacle", "plate").isidentifier():
            raise TurgorError(f"obstacle '{self.name}': a name holds letters, digits and underscores only.")
        one(self.shape, Shape, f"obstacle '{self.name}': shape", "a shape is needed, such as Plane or Sphere")
        check_friction(f"obstacle '{self.name}'", self.friction)
        for key in ("spring", "stiffness"):
            if getattr(self, key) is not None:
                _positive(f"obstacle '{self.name}': {key}", getattr(self, key), "")
        if self.elastic_slip is not None:
            _positive(f"obstacle '{self.name}': elastic_slip", self.elastic_slip)
        object.__setattr__(self, "path", _path(self.name, self.path))

    def displacement(self, load_factor: float) -> NDArray[np.float64]:
        """Return how far its path has moved it at a load factor, (3,) [m]."""
        if not self.path:
            return np.zeros(3)
        factors = [factor for factor, _ in self.path]
        moved = np.array([place for _, place in self.path])
        return np.array([np.interp(load_factor, factors, moved[:, i]) for i in range(3)])


@dataclass(frozen=True, slots=True, kw_only=True)
class Plate(Obstacle):
    """The plate that stops a tip: its force is the blocked force.

    Parameters
    ----------
    tip : str
        The face that is meant to bear on it.
    """

    tip: str = "tip"


@dataclass(frozen=True, slots=True, kw_only=True)
class SelfContact:
    """Contact of the actuator with itself: chamber walls, folds, several bodies in one mesh.

    Parameters
    ----------
    friction : float [-]
        Coulomb's coefficient, from 0 (frictionless) to 2.
    stiffness : float [Pa/m], optional
        Pressure per depth of penetration; see `Obstacle`.
    elastic_slip : float [m], optional
        How far a point that sticks slips elastically; see `Obstacle`.
    """

    friction: float = 0.0
    stiffness: float | None = None
    elastic_slip: float | None = None

    def __post_init__(self) -> None:
        check_friction("self_contact", self.friction)
        if self.stiffness is not None:
            _positive("self_contact: stiffness", self.stiffness, "")
        if self.elastic_slip is not None:
            _positive("self_contact: elastic_slip", self.elastic_slip)


def check_friction(what: str, friction: float) -> None:
    """Refuse a coefficient of friction outside 0 to 2."""
    if not 0 <= friction <= 2:
        raise TurgorError(f"{what}: friction is {friction:g}; Coulomb's coefficient lies between 0 and 2.")


def _positive(what: str, value: float, unit: str = " mm") -> None:
    if not (np.isfinite(value) and value > 0):
        shown = value * 1e3 if unit else value
        raise TurgorError(f"{what} is {shown:g}{unit}; allowed is more than 0.")


def _direction(what: str, values: Any) -> Vector:
    given = vector(values, what)
    unit = normalized(given)
    if unit is None:
        why = "a zero vector" if not any(given) else f"{values!r}, whose length cannot be computed"
        raise TurgorError(f"{what} is {why}; give a direction such as (0, 0, 1).")
    return unit


def _path(name: str, path: Iterable[Any]) -> Path:
    said = f"obstacle '{name}': path is {path!r}"
    try:
        where = f"obstacle '{name}': path"
        points = tuple((plain_number(factor), vector(place, where, "length")) for factor, place in path)
    except (TypeError, ValueError):
        raise TurgorError(
            f"{said}; points (load factor, displacement) are needed, such as [(0, (0, 0, 0)), (1, (0, 0, 0.01))]."
        ) from None
    if points and (points[0][0] != 0 or points[-1][0] != 1 or not all(a < b for (a, _), (b, _) in pairwise(points))):
        raise TurgorError(f"{said}; the load factors must rise from 0 to 1.")
    return points
