"""Reference points: points tied to a face, through which a rig holds, turns, loads and weighs it."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from turgor.core.geometry.directions import AXES, rotation_of
from turgor.core.model.history import RAMP, History, checked, share_at, with_history
from turgor.core.model.loads.load import Deck, DeckRows
from turgor.core.model.supports.support import Support
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.given import name, vector
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import deg, mm

Vector = tuple[float, float, float]

#: How a face is tied to its point: it moves as a rigid body with it, or the point follows its average.
RIGID, AVERAGING = "rigid", "averaging"
COUPLINGS = (RIGID, AVERAGING)


@dataclass(frozen=True, slots=True)
class ReferencePoint(Support):
    """A point tied to a face: a plate or ring glued to it, a clamp, or the place of a resultant.

    Force, moment, mass, springs, prescribed displacement and rotation act on the point; rotations may be of any size.
    Other supports and loads name it as they name a face: ``Fixed("plate", "x")``, ``Force("plate", …)``.

    Parameters
    ----------
    name : str
        What supports, loads and results call it; letters, digits and underscores, and no name of a face.
    face : str
        The face that is tied to it.
    at : (3,) floats [m], optional
        Where it is at rest; the center of the face by default.
    coupling : str
        ``"rigid"``: the face moves as a rigid body with the point, as a plate glued to it (kinematic coupling).
        ``"averaging"``: the point has the mean displacement and the least-squares rotation of the face, weighted by
        area at rest, and what acts on it is spread over the face, which stays as soft as it is (distributing
        coupling, RBE3, remote force).
    mass : float [kg]
        Mass of the plate; `Gravity` gives it a weight.
    center : (3,) floats [m], optional
        Its center of mass at rest; the point itself by default.
    inertia : (3,) floats [kg m²]
        Its moments of inertia about the center of mass, about x, y and z at rest; they count in motion only. No one
        may be larger than the sum of the other two.
    spring : float or (3,) floats [N/m]
        Stiffness of a spring between the point and its place at rest, in all directions or along x, y and z.
    rotational_spring : float [N m/rad]
        Moment per angle of a spring that turns the point back, about whatever axis it has turned; up to half a turn.

    Raises
    ------
    TurgorError
        If a value is out of its range.

    Examples
    --------
    >>> plate = ReferencePoint("plate", "tip", coupling="rigid", mass=0.02)
    >>> plate.stiffness
    (0.0, 0.0, 0.0)
    """

    name: str
    face: str
    at: Vector | None = None
    coupling: str = RIGID
    mass: float = 0.0
    center: Vector | None = None
    inertia: Vector = (0.0, 0.0, 0.0)
    spring: float | Vector = 0.0
    rotational_spring: float = 0.0

    def __post_init__(self) -> None:
        if not self.name.isidentifier():
            raise TurgorError(f"reference point '{self.name}': a name holds letters, digits and underscores only.")
        name(self.face, f"reference point '{self.name}': face", "tip")  # no NodesAt: it has no area
        if self.coupling not in COUPLINGS:
            raise unknown(f"coupling of the reference point '{self.name}'", self.coupling, COUPLINGS)
        for key in ("at", "center"):
            if getattr(self, key) is not None:
                object.__setattr__(
                    self, key, vector(getattr(self, key), f"reference point '{self.name}': {key}", "length")
                )
        object.__setattr__(self, "inertia", vector(self.inertia, f"reference point '{self.name}': inertia"))
        if not isinstance(self.spring, int | float):
            object.__setattr__(
                self, "spring", vector(self.spring, f"reference point '{self.name}': spring", "spring stiffness")
            )
        for key, values in (
            ("mass", (self.mass,)),
            ("inertia", self.inertia),
            ("spring", self.stiffness),
            ("rotational_spring", (self.rotational_spring,)),
        ):
            if not (np.isfinite(values).all() and min(values) >= 0):
                raise TurgorError(
                    f"reference point '{self.name}': {key} is {getattr(self, key)}; allowed is 0 or more."
                )
        largest = max(self.inertia)
        if 2 * largest > sum(self.inertia) * (1 + ROUND_OFF.same):
            raise TurgorError(
                f"reference point '{self.name}': inertia is {self.inertia}; of the three moments of a body none is "
                "larger than the sum of the other two."
            )

    @property
    def label(self) -> str:
        """Its name and its face."""
        return f"ReferencePoint({self.name}, {self.face})"

    def text(self) -> str:
        """Return the sentence of a report."""
        how = "moves rigidly with" if self.coupling == RIGID else "moves on average with"
        parts = [f"{self.face} {how} the reference point {self.name}"]
        if self.at is not None:
            parts.append(f"at ({_listed(value / mm for value in self.at)}) mm")
        if self.mass:
            parts.append(f"of mass {self.mass:g} kg")
        if any(self.stiffness):
            parts.append(f"supported by springs of ({_listed(self.stiffness)}) N/m")
        if self.rotational_spring:
            parts.append(f"turned back by a spring of {self.rotational_spring:g} N m/rad")
        return f"{', '.join(parts)}."

    def boundary_rows(self, deck: Deck) -> tuple[str, ...]:
        """A point fixes nothing by itself; its nodes and couplings are written with the mesh."""
        return ()

    @property
    def stiffness(self) -> Vector:
        """Stiffness of its spring along x, y and z [N/m]."""
        return (float(self.spring),) * 3 if isinstance(self.spring, int | float) else self.spring


@dataclass(frozen=True, slots=True)
class Rotation(Support):
    """Turn a reference point about an axis by a finite angle, which grows with the load factor.

    Parameters
    ----------
    point : str
        Name of the reference point.
    angle : float [rad]
        The whole angle, of any size; right-handed about the axis. 0 keeps the point from turning.
    axis : (3,) floats
        Direction of the axis through the point, fixed in space; any length but zero.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`: the share of the angle.
    tilts : bool
        Whether the point may tilt besides: only its twist about the axis is prescribed, as by a shaft with a
        constant-velocity joint. The rotation is then the twist, followed by one about any axis across this one.

    Raises
    ------
    TurgorError
        If the angle is not finite, or the axis has no direction.

    Examples
    --------
    >>> Rotation("plate", np.pi / 2, (0, 0, 2)).matrix(1.0).round(12) + 0.0
    array([[ 0., -1.,  0.],
           [ 1.,  0.,  0.],
           [ 0.,  0.,  1.]])
    """

    point: str
    angle: float = 0.0
    axis: Vector = (1.0, 0.0, 0.0)
    history: History = RAMP
    tilts: bool = False

    jumps = False

    def __post_init__(self) -> None:
        if not np.isfinite(self.angle):
            raise TurgorError(f"rotation of '{self.point}': angle is {self.angle}; a finite number is needed.")
        object.__setattr__(self, "axis", _axis(f"rotation of '{self.point}': axis", self.axis))
        object.__setattr__(self, "history", checked(self.history, f"rotation of '{self.point}'"))

    @property
    def direction(self) -> Vector:
        """Direction of the axis (3,)."""
        return self.axis

    @property
    def turned_point(self) -> str:
        """The point."""
        return self.point

    @property
    def way(self) -> History:
        """History of the angle."""
        return self.history

    def text(self) -> str:
        """Return the sentence of a report.

        Examples
        --------
        >>> Rotation("plate", 0.5 * np.pi).text()
        'plate turned by 90 deg about (1, 0, 0).'
        """
        if not self.angle and not self.tilts:
            return f"{self.point} kept from turning."
        free = ", free to tilt" if self.tilts else ""
        return f"{self.point} turned by {self.angle / deg:g} deg about ({_listed(self.axis)}){free}."

    def continued(self, factor: float, new: Any) -> "Rotation":
        """Return the rotation of the next stage, at the angle that it has."""
        share = share_at(self.history, factor)
        rotation: Rotation = with_history(self, ((0.0, share), (1.0, share)))
        return rotation

    def deck_rows(self, deck: Deck) -> tuple[DeckRows, ...]:
        """Return the rows of the rotation vector."""
        turn = self.angle * np.array(self.axis) / np.linalg.norm(self.axis)
        return (DeckRows("*BOUNDARY", self.history, deck.rotated(self.point, turn)),)

    def angle_at(self, load_factor: float) -> float:
        """Angle [rad] at a load factor."""
        return share_at(self.history, load_factor) * self.angle

    def matrix(self, load_factor: float) -> np.ndarray[Any, np.dtype[np.float64]]:
        """Rotation matrix (3, 3) at a load factor, of a point that does not tilt."""
        return rotation_of(self.angle_at(load_factor) * np.asarray(self.axis) / np.linalg.norm(self.axis))


@dataclass(frozen=True, slots=True)
class Hinge(Support):
    """Let a reference point turn about one axis only, as on a bearing; its displacement stays free.

    Parameters
    ----------
    point : str
        Name of the reference point.
    axis : str or (3,) floats
        ``"x"``, ``"y"`` or ``"z"``, or the direction of another axis, fixed in space; any length but zero.

    Raises
    ------
    TurgorError
        If the axis is none.

    Examples
    --------
    >>> Hinge("plate", "y").direction, Hinge("plate", (1, 1, 0)).direction
    ((0.0, 1.0, 0.0), (1.0, 1.0, 0.0))
    """

    point: str
    axis: str | Vector = "x"

    jumps = False

    def __post_init__(self) -> None:
        if isinstance(self.axis, str) and self.axis not in AXES:
            raise TurgorError(
                f"hinge of '{self.point}': axis is {self.axis!r}; allowed are 'x', 'y', 'z' and a direction of three "
                "numbers."
            )
        if not isinstance(self.axis, str):
            object.__setattr__(self, "axis", _axis(f"hinge of '{self.point}': axis", self.axis))

    @property
    def direction(self) -> Vector:
        """Direction of the axis (3,)."""
        return AXES[self.axis] if isinstance(self.axis, str) else self.axis

    @property
    def turned_point(self) -> str:
        """The point."""
        return self.point

    def text(self) -> str:
        """Return the sentence of a report."""
        about = self.axis if isinstance(self.axis, str) else f"({_listed(self.axis)})"
        return f"{self.point} may turn about {about} only."


def _listed(values: Iterable[float]) -> str:
    return ", ".join(f"{value:g}" for value in values)


def _axis(what: str, values: Any) -> Vector:
    axis = vector(values, what)
    if not any(axis):
        raise TurgorError(f"{what} is a zero vector; give for example (1, 0, 0).")
    return axis
