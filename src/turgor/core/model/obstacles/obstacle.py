"""Obstacles: rigid bodies that the actuator may touch, and contact of the actuator with itself."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.obstacles.rigid_shape import RigidShape, Vector, in_mm, positive
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import name as name_of
from turgor.foundation.given import one, vector
from turgor.units import plain_number

#: Points (load factor, displacement of the obstacle [m]).
Path = tuple[tuple[float, Vector], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Obstacle:
    """A rigid body that the actuator may touch: fixed, moved along a path, or on a spring.

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
        object.__setattr__(self, "path", _path(self.name, self.path))

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
        if self.spring is not None:
            parts.append(f"supported by a spring of {self.spring:g} N/m")
        if self.tip and self.push is not None:
            parts.append(push_text(self.push))
        return f"{self.name}: {'; '.join(parts)}."

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
        Cavities whose walls may touch each other within; by default those whose pressure is at some load below that of
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


def _path(name: str, path: Iterable[Any]) -> Path:
    subject = f"obstacle '{name}': path is {path!r}"
    try:
        where = f"obstacle '{name}': path"
        points = tuple((plain_number(factor), vector(place, where, "length")) for factor, place in path)
    except (TypeError, ValueError):
        raise TurgorError(
            f"{subject}; points (load factor, displacement) are needed, such as [(0, (0, 0, 0)), (1, (0, 0, 0.01))]."
        ) from None
    if points and (points[0][0] != 0 or points[-1][0] != 1 or not all(a < b for (a, _), (b, _) in pairwise(points))):
        raise TurgorError(f"{subject}; the load factors must rise from 0 to 1.")
    return points
