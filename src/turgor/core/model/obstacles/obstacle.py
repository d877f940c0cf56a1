"""Obstacles: rigid bodies that the actuator may touch, and contact of the actuator with itself."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.directions import rotation_of
from turgor.core.model.obstacles.pose import Pose
from turgor.core.model.obstacles.rigid_shape import RigidShape, Vector, in_mm, listed, positive
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import name as name_of
from turgor.foundation.given import one, vector
from turgor.units import deg, plain_number

#: Points (load factor, displacement of the obstacle [m]).
Path = tuple[tuple[float, Vector], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Obstacle:
    """A rigid body that the actuator may touch: fixed, moved along a path, turned, or on a spring.

    Parameters
    ----------
    name : str
        What its results are called.
    shape : RigidShape
        `Plane`, `Sphere`, `Cylinder`, `Box`, `RigidSurface` or one of your own.
    friction : float [-]
        Coulomb's coefficient, from 0 (frictionless) to 2.
    path : sequence of (float, (3,) floats [m]), optional
        Points (load factor, displacement), straight lines between them; from load factor 0 to 1. Left out, it stays.
    rotation : sequence of (float, (3,) floats [rad]), optional
        Points (load factor, axis times angle), straight lines between them; from load factor 0 to 1. The angle may be
        several turns. Left out, it does not turn.
    about : (3,) floats [m], optional
        Point about which it turns, where it is before ``path`` moves it; by default the middle of the shape.
    spring : float [N/m], optional
        Stiffness in all three directions of the spring that holds it at its place, or at its path's; it does not
        turn. Of the whole obstacle, also where a half of the actuator is modeled. Left out, it cannot give way.
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
    >>> from turgor.core.model.obstacles import Plane
    >>> plate = Obstacle(name="plate", shape=Plane(point=(0, 0, -2e-3), normal=(0, 0, 1)),
    ...                  path=[(0, (0, 0, 0)), (1, (0, 0, 5e-3))])
    >>> plate.displacement(0.5)
    array([0.    , 0.    , 0.0025])
    """

    name: str
    shape: RigidShape
    friction: float = 0.0
    path: Path = ()
    rotation: Path = ()
    about: Vector | None = None
    spring: float | None = None
    face: str | None = None
    stiffness: float | None = None
    elastic_slip: float | None = None

    #: Whether it is a body that pictures and reports of contact show.
    drawn: ClassVar[bool] = True
    #: Names of the measures that a response has by itself; None: the force on it.
    measures: ClassVar[tuple[str, ...] | None] = None

    def __post_init__(self) -> None:
        if not name_of(self.name, "name of an obstacle", "plate").isidentifier():
            raise TurgorError(f"obstacle '{self.name}': a name holds letters, digits and underscores only.")
        one(self.shape, RigidShape, f"obstacle '{self.name}': shape", "a shape is needed, such as Plane or Sphere")
        check_friction(f"obstacle '{self.name}'", self.friction)
        for key in ("spring", "stiffness"):
            if getattr(self, key) is not None:
                positive(f"obstacle '{self.name}': {key}", getattr(self, key), "")
        if self.elastic_slip is not None:
            positive(f"obstacle '{self.name}': elastic_slip", self.elastic_slip)
        object.__setattr__(self, "path", _path(self.name, "path", self.path))
        object.__setattr__(self, "rotation", _path(self.name, "rotation", self.rotation))
        if self.about is not None:
            object.__setattr__(self, "about", vector(self.about, f"obstacle '{self.name}': about", "length"))
            if not self.rotation:
                raise TurgorError(
                    f"obstacle '{self.name}': about is {in_mm(self.about)}, and it does not turn; add a rotation."
                )

    @property
    def tip(self) -> str:
        """Face whose tip it stops; empty of other obstacles."""
        return ""

    @property
    def push(self) -> Vector | None:
        """Unit vector along which a tip pushes on its flat side; None where its shape has none."""
        normal = self.shape.facing
        return None if normal is None else (-normal[0], -normal[1], -normal[2])

    def text(self) -> str:
        """Return shape, place, friction and motion in words.

        Examples
        --------
        >>> from turgor.core.model.obstacles import Sphere
        >>> Obstacle(name="ball", shape=Sphere(center=(0, 0, -5e-3), radius=2e-3), friction=0.3).text()
        'ball: sphere of radius 2 mm around (0, 0, -5) mm; with friction 0.3.'
        """
        parts = [self.shape.text(), friction_text(self.friction)]
        if self.face is not None:
            parts.append(f"touches {self.face} only")
        if self.path:
            way = self.path if any(self.path[0][1]) else self.path[1:]
            parts.append("moved by " + ", ".join(f"{in_mm(to)} at load factor {factor:g}" for factor, to in way))
        if self.rotation:
            way = self.rotation if any(self.rotation[0][1]) else self.rotation[1:]
            turned = ", ".join(
                f"({listed(part / deg for part in to)})° at load factor {factor:g}" for factor, to in way
            )
            parts.append(f"turned about {in_mm(self.about or self.shape.middle)} by {turned}")
        if self.spring is not None:
            parts.append(f"supported by a spring of {self.spring:g} N/m")
        if self.tip and self.push is not None:
            parts.append(push_text(self.push))
        return f"{self.name}: {'; '.join(parts)}."

    def displacement(self, load_factor: float) -> NDArray[np.float64]:
        """Return how far its path has moved it at a load factor, (3,) [m]."""
        return _along(self.path, load_factor)

    def pose(self, load_factor: float) -> Pose:
        """Return where its path and its rotation have brought it at a load factor [m].

        Examples
        --------
        >>> from math import pi
        >>> from turgor.core.model.obstacles import Sphere
        >>> wheel = Obstacle(name="wheel", shape=Sphere(center=(0, 0, 2), radius=1),
        ...                  rotation=[(0, (0, 0, 0)), (1, (0, pi, 0))])
        >>> wheel.pose(0.5).moved(np.array([1.0, 0, 2])).round(9).tolist()
        [0.0, 0.0, 1.0]
        """
        place = self.displacement(load_factor)
        if not self.rotation:
            return Pose(place)
        return Pose(place, rotation_of(_along(self.rotation, load_factor)), np.array(self.about or self.shape.middle))

    def outline(self, pose: Pose, extent: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Return its triangles in a pose: points (p, 3) [m] and triangles (t, 3).

        Planes and endless cylinders end a little beyond the extent (2, 3) of the actuator.
        """
        if pose.turn is None:
            return self.shape.outline(pose.place, extent)
        corners = np.array([[extent[i, 0], extent[j, 1], extent[k, 2]] for i, j, k in np.ndindex(2, 2, 2)])
        seen = pose.at_first(corners)
        points, triangles = self.shape.outline(np.zeros(3), np.stack([seen.min(axis=0), seen.max(axis=0)]))
        return pose.moved(points), triangles

    def turned_at(self, load_factor: float) -> Path:
        """Return a rotation that stays what it is at a load factor."""
        x, y, z = (float(each) for each in _along(self.rotation, load_factor))
        return ((0.0, (x, y, z)), (1.0, (x, y, z))) if self.rotation else ()

    def moves(self, before: float, after: float) -> bool:
        """Whether its path or its rotation brings it elsewhere between two load factors."""
        ways = (self.path, self.rotation)
        return any(bool((_along(way, before) != _along(way, after)).any()) for way in ways)

    @property
    def stops(self) -> tuple[float, ...]:
        """Load factors of the points of its path and its rotation, rising."""
        return tuple(sorted({factor for way in (self.path, self.rotation) for factor, _ in way}))


@dataclass(frozen=True, slots=True, kw_only=True)
class Plate(Obstacle):
    """The plate that stops a tip: its force is the blocked force.

    Parameters
    ----------
    tip : str
        The face that is meant to bear on it.
    along : (3,) floats, optional
        Unit vector along which the tip pushes, for a shape without a flat side.
    """

    tip: str = "tip"
    along: Vector | None = None

    measures = ("blocked_force", "bearing_distance")

    @property
    def push(self) -> Vector | None:
        """Unit vector along which a tip pushes on it."""
        return self.along or Obstacle.push.fget(self)  # type: ignore[attr-defined]


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
    cavities : tuple of str, optional
        Cavities whose walls may touch each other within, besides those whose pressure is at some load below that of
        another one, or below zero.
    """

    friction: float = 0.0
    stiffness: float | None = None
    elastic_slip: float | None = None
    cavities: tuple[str, ...] | None = None

    def __post_init__(self) -> None:
        check_friction("self_contact", self.friction)
        if self.stiffness is not None:
            positive("self_contact: stiffness", self.stiffness, "")
        if self.elastic_slip is not None:
            positive("self_contact: elastic_slip", self.elastic_slip)


def push_text(direction: Vector) -> str:
    """Return the direction in which a tip is blocked, which is that of a positive blocked force, in words.

    Examples
    --------
    >>> push_text((0.0, 0.0, -1.0))
    'the blocked force is positive along -z'
    """
    axis = int(np.abs(direction).argmax())
    straight = max(map(abs, direction)) > 1 - 1e-9
    listed = ", ".join(f"{part:.4g}" for part in direction)
    along = f"{'+' if direction[axis] > 0 else '-'}{'xyz'[axis]}" if straight else f"({listed})"
    return f"the blocked force is positive along {along}"


def friction_text(friction: float) -> str:
    """Return a coefficient of friction in words."""
    return f"with friction {friction:g}" if friction else "without friction"


def check_friction(what: str, friction: float) -> None:
    """Refuse a coefficient of friction outside 0 to 2."""
    if not 0 <= friction <= 2:
        raise TurgorError(f"{what}: friction is {friction:g}; Coulomb's coefficient lies between 0 and 2.")


def _along(way: Path, load_factor: float) -> NDArray[np.float64]:
    """Displacement or rotation (3,) at a load factor; zeros without points."""
    if not way:
        return np.zeros(3)
    factors, values = [factor for factor, _ in way], np.array([value for _, value in way])
    return np.array([np.interp(load_factor, factors, values[:, i]) for i in range(3)])


def _path(name: str, key: str, path: Iterable[Any]) -> Path:
    subject = f"obstacle '{name}': {key} is {path!r}"
    what, dimension = ("displacement", "length") if key == "path" else ("axis times angle", "angle")
    try:
        where = f"obstacle '{name}': {key}"
        points = tuple((plain_number(factor), vector(value, where, dimension)) for factor, value in path)
    except (TypeError, ValueError):
        raise TurgorError(
            f"{subject}; points (load factor, {what}) are needed, such as [(0, (0, 0, 0)), (1, (0, 0, 0.01))]."
        ) from None
    if points and (points[0][0] != 0 or points[-1][0] != 1 or not all(a < b for (a, _), (b, _) in pairwise(points))):
        factors = ", ".join(f"{factor:g}" for factor, _ in points)
        raise TurgorError(
            f"obstacle '{name}': {key} is given at the load factors {factors}; they must rise from 0 to 1."
        )
    return points
