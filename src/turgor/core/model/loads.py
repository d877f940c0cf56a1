"""Loads: what drives the actuator. All grow in proportion to the load factor, unless one has its own history."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.history import RAMP as RAMP
from turgor.core.model.history import History as History
from turgor.core.model.history import checked, share_at
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, Quantity, number, vector
from turgor.foundation.given import name as name_of

STANDARD_GRAVITY = 9.80665


@dataclass(frozen=True, slots=True)
class Pressure:
    """Gauge pressure on a face: a follower load on the current surface, normal to it.

    Parameters
    ----------
    face : str
        Name of the face, usually ``"cavity"``, or ``"cavity_1"`` where there are several.
    pressure : float [Pa], gauge
        The whole pressure; positive pushes against the solid.
    history : sequence of (float, float), or str, optional
        Points (load factor, share of the pressure that acts then), straight lines between them. The load factor
        rises from 0 to 1; the share is 0 at first, within -1 to 1, and may fall again. By default the pressure grows
        in proportion to the load factor. `solve` makes a state at every point. An expression of the load factor ``s``
        such as ``"sin(pi * s)"`` says the same without points; `over_time` turns times into load factors.

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

    if TYPE_CHECKING:

        def __init__(self, face: str, pressure: Quantity, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        said = f"pressure on '{name_of(self.face, 'face of a pressure', 'cavity')}'"
        object.__setattr__(self, "pressure", number(self.pressure, said, "pressure"))
        object.__setattr__(self, "history", checked(self.history, said))

    def share(self, load_factor: float) -> float:
        """Return the share of the pressure that acts at a load factor."""
        return share_at(self.history, load_factor)

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
        Force per reference area, all of it.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.
    """

    face: str
    vector: tuple[float, float, float]
    history: History = RAMP

    if TYPE_CHECKING:

        def __init__(self, face: str, vector: Quantities, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        said = f"traction on '{name_of(self.face, 'face of a traction', 'tip')}'"
        object.__setattr__(self, "vector", vector(self.vector, said, "pressure"))
        object.__setattr__(self, "history", checked(self.history, said))


@dataclass(frozen=True, slots=True)
class Force:
    """Dead load of a known total on a face: spread evenly over its reference area and fixed in direction.

    A weight that hangs from a face, a pull by a long thread, a push by a soft spring. The inertia of what hangs there
    is not included; that of a `Hanging` weight is. On a `ReferencePoint` the force acts at the point.

    Parameters
    ----------
    face : str
        Name of the face, or of a reference point.
    vector : (3,) floats [N]
        The whole force, on the whole actuator: where a half is modeled, its mirror image carries the other half.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.
    follower : bool
        Whether the force turns with the reference point on which it acts, and is stated as it is at rest.

    Raises
    ------
    TurgorError
        If the history is none, or the force is not finite.

    Examples
    --------
    >>> Force("tip", (0, 0, -0.05 * 9.80665)).share(0.5)
    0.5
    """

    face: str
    vector: tuple[float, float, float]
    history: History = RAMP
    follower: bool = False

    if TYPE_CHECKING:

        def __init__(self, face: str, vector: Quantities, history: History = RAMP, follower: bool = False) -> None: ...

    def __post_init__(self) -> None:
        said = f"force on '{name_of(self.face, 'face of a force', 'tip')}'"
        object.__setattr__(self, "vector", vector(self.vector, said, "force"))
        object.__setattr__(self, "history", checked(self.history, said))

    def share(self, load_factor: float) -> float:
        """Return the share of the force that acts at a load factor."""
        return share_at(self.history, load_factor)


@dataclass(frozen=True, slots=True)
class PointForce:
    """Dead load at a point of the surface: fixed in direction, carried by the side of a cell on which the point lies.

    The deformation at the point itself depends on the mesh, as that of any body under a point load does.

    Parameters
    ----------
    at : (3,) floats [m]
        Where it acts at rest, up to 1 % of the size of the part beside the surface.
    vector : (3,) floats [N]
        The force at this point. On a mirror plane the modeled part carries its share; elsewhere the mirror image of the
        point carries the mirror image of the force.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.

    Raises
    ------
    TurgorError
        If the history is none, or a number is not finite.

    Examples
    --------
    >>> PointForce((0.1, 0, 0.02), (0, 0, -0.3)).vector
    (0.0, 0.0, -0.3)
    """

    at: tuple[float, float, float]
    vector: tuple[float, float, float]
    history: History = RAMP

    if TYPE_CHECKING:

        def __init__(self, at: Quantities, vector: Quantities, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "at", vector(self.at, "point force: at", "length"))
        object.__setattr__(self, "vector", vector(self.vector, "point force", "force"))
        object.__setattr__(self, "history", checked(self.history, "point force"))


@dataclass(frozen=True, slots=True)
class LineForce:
    """Dead load along the edge between two faces: force per reference length, fixed in direction.

    Parameters
    ----------
    faces : (str, str)
        Two faces that meet along the line.
    vector : (3,) floats [N/m]
        Force per length at rest, on the whole actuator.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.

    Raises
    ------
    TurgorError
        If the history is none, the faces are not two, or a number is not finite.

    Examples
    --------
    >>> LineForce(("tip", "outside"), (0, 0, -2.0)).faces
    ('tip', 'outside')
    """

    faces: tuple[str, str]
    vector: tuple[float, float, float]
    history: History = RAMP

    if TYPE_CHECKING:

        def __init__(self, faces: tuple[str, str], vector: Quantities, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "faces", tuple(self.faces))
        if len(set(self.faces)) != 2:
            raise TurgorError(f"line force: faces is {self.faces!r}; two faces are needed that meet along the line.")
        object.__setattr__(
            self, "vector", vector(self.vector, f"line force on {' and '.join(self.faces)}", "force per length")
        )
        object.__setattr__(self, "history", checked(self.history, "line force"))


@dataclass(frozen=True, slots=True)
class Moment:
    """Moment on a reference point.

    Parameters
    ----------
    point : str
        Name of the `ReferencePoint`.
    vector : (3,) floats [N m]
        The whole moment, on the whole actuator.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.
    follower : bool
        False: its axis stays fixed in space, whatever way the point turns. True: it turns with the point, and is
        stated as it is at rest. Neither kind has a potential where the point turns about changing axes.

    Raises
    ------
    TurgorError
        If the history is none, or the moment is not finite.

    Examples
    --------
    >>> Moment("plate", (0.02, 0, 0)).vector
    (0.02, 0.0, 0.0)
    """

    point: str
    vector: tuple[float, float, float]
    history: History = RAMP
    follower: bool = False

    if TYPE_CHECKING:

        def __init__(self, point: str, vector: Quantities, history: History = RAMP, follower: bool = False) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "vector", vector(self.vector, f"moment on '{self.point}'", "moment"))
        object.__setattr__(self, "history", checked(self.history, f"moment on '{self.point}'"))


@dataclass(frozen=True, slots=True)
class Hanging:
    """A weight that hangs from a reference point: its weight is a dead load, and its mass moves with the point.

    Parameters
    ----------
    point : str
        Name of the `ReferencePoint`.
    mass : float [kg]
        Of the whole actuator; 0 or more. `Gravity` gives it no second weight.
    direction : (3,) floats
        Direction of the fall; any length but zero.
    acceleration : float [m/s²]
        That of gravity.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`: the share of the weight. The inertia is always there.

    Raises
    ------
    TurgorError
        If the mass is negative, the direction is none, or the history is none.

    Examples
    --------
    >>> Hanging("plate", 0.1).force
    (0.0, 0.0, -0.980665)
    """

    point: str
    mass: float
    direction: tuple[float, float, float] = (0.0, 0.0, -1.0)
    acceleration: float = STANDARD_GRAVITY
    history: History = RAMP

    if TYPE_CHECKING:

        def __init__(
            self,
            point: str,
            mass: Quantity,
            direction: Quantities = (0, 0, -1),
            acceleration: Quantity = STANDARD_GRAVITY,
            history: History = RAMP,
        ) -> None: ...

    def __post_init__(self) -> None:
        what = f"weight on '{self.point}'"
        object.__setattr__(self, "mass", number(self.mass, f"{what}: mass", "mass"))
        object.__setattr__(self, "acceleration", number(self.acceleration, f"{what}: acceleration", "acceleration"))
        if self.mass < 0:
            raise TurgorError(f"{what}: mass is {self.mass} kg; allowed is 0 or more.")
        object.__setattr__(self, "direction", _direction(self.direction, what))
        object.__setattr__(self, "history", checked(self.history, what))

    @property
    def force(self) -> tuple[float, float, float]:
        """The whole weight [N]."""
        weight = self.mass * self.acceleration / float(np.linalg.norm(self.direction))
        x, y, z = (0.0 + weight * part for part in self.direction)
        return x, y, z


@dataclass(frozen=True, slots=True)
class Gravity:
    """Weight of every region, and of the mass of every reference point.

    Parameters
    ----------
    direction : (3,) floats
        Direction of the fall; normalized.
    acceleration : float [m/s²]
        Its magnitude.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`: ``[(0, 0), (0.2, 1), (1, 1)]`` lets the weight act first, and then stay.

    Raises
    ------
    TurgorError
        If the history is none.

    Examples
    --------
    >>> Gravity((0, 0, -1), history=[(0, 0), (0.2, 1), (1, 1)]).share(0.5)
    1.0
    """

    direction: tuple[float, float, float] = (0.0, 0.0, -1.0)
    acceleration: float = STANDARD_GRAVITY
    history: History = RAMP

    if TYPE_CHECKING:

        def __init__(
            self, direction: Quantities = (0, 0, -1), acceleration: Quantity = STANDARD_GRAVITY, history: History = RAMP
        ) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", _direction(self.direction, "gravity"))
        object.__setattr__(self, "acceleration", number(self.acceleration, "gravity: acceleration", "acceleration"))
        object.__setattr__(self, "history", checked(self.history, "gravity"))

    def share(self, load_factor: float) -> float:
        """Return the share of the weight that acts at a load factor."""
        return share_at(self.history, load_factor)


@dataclass(frozen=True, slots=True)
class BodyForce:
    """Force per reference volume given as a function of the reference position, for manufactured solutions.

    Parameters
    ----------
    value : callable
        ``value(points) -> (n, 3) force per volume [N/m³]`` at the (n, 3) reference points [m].
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.
    """

    value: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    history: History = RAMP

    def __post_init__(self) -> None:
        object.__setattr__(self, "history", checked(self.history, "body force"))


Load = Pressure | Traction | Force | PointForce | LineForce | Moment | Hanging | Gravity | BodyForce


def _direction(value: object, what: str) -> tuple[float, float, float]:
    """A direction of any length but zero."""
    found = vector(value, f"{what}: direction")
    if not np.linalg.norm(found) > 0:
        raise TurgorError(f"{what}: direction is a zero vector; give for example (0, 0, -1).")
    return found
