"""Arcs: the pose of a segment of constant curvature in three ways, several in series, and the way back for one.

Axes are those of the actuators: x leads out of the base, and a segment bends in the plane that holds x and the
direction (0, cos φ, sin φ), towards it. The frame at the tip does not turn about the arc, so that the pose of a
straight segment does not depend on φ. After Webster and Jones 2010, Int. J. Robot. Res. 29, 1661; they name axes
otherwise.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import atan2, cos, hypot, isfinite, pi, sin
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.foundation.errors import TurgorError, unknown
from turgor.units import mm

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Arc:
    """A segment of constant curvature: its configuration.

    Parameters
    ----------
    curvature : float [1/m]
        Not negative for the arcs that functions return; a negative one bends away from ``plane``.
    plane : float [rad]
        Angle φ of the direction (0, cos φ, sin φ) into which it bends; −π/2 is down, as benders do.
    length : float [m]
        Length of the arc, positive.

    Examples
    --------
    >>> Arc(curvature=10.0, plane=-pi / 2, length=0.1).angle
    1.0
    """

    curvature: float
    plane: float
    length: float

    def __post_init__(self) -> None:
        for name in ("curvature", "plane", "length"):
            if not isfinite(getattr(self, name)):
                raise TurgorError(f"{name} of an arc is {getattr(self, name)}; a finite number is needed.")
        if not self.length > 0:
            raise TurgorError(f"length of an arc is {self.length / mm:g} mm; it must be positive.")

    @property
    def angle(self) -> float:
        """Angle between the normals of its ends [rad]."""
        return self.curvature * self.length


def pose(arc: Arc, method: str = "geometry") -> Array:
    """Return where an arc leads: the frame of its tip in that of its base.

    Parameters
    ----------
    arc : Arc
    method : {"geometry", "denavit_hartenberg", "exponential"}
        Three ways to the same result: arc geometry; a chain of five joints; the exponential of a twist.

    Returns
    -------
    (4, 4) array
        Rotation and position [m] as a homogeneous matrix.

    Examples
    --------
    >>> quarter = Arc(curvature=pi / 2 / 0.1, plane=pi / 2, length=0.1)
    >>> [pose(quarter, method)[:3, 3].round(6).tolist() for method in ("geometry", "exponential")]
    [[0.063662, 0.0, 0.063662], [0.063662, 0.0, 0.063662]]
    """
    if method not in METHODS:
        raise unknown("method of a pose", str(method), METHODS)
    return METHODS[method](arc)


def poses(arcs: Sequence[Arc], method: str = "geometry") -> Array:
    """Return the frames of the base and of the tips of segments in series, (n + 1, 4, 4).

    Examples
    --------
    >>> half = Arc(curvature=pi / 2 / 0.1, plane=0.0, length=0.1)
    >>> poses([half, half])[-1][:3, 3].round(6).tolist()  # half a circle
    [0.0, 0.127324, 0.0]
    """
    frames = [np.eye(4)]
    for arc in arcs:
        frames.append(frames[-1] @ pose(arc, method))
    return np.array(frames)


def backbone(arcs: Sequence[Arc], points: int = 20) -> Array:
    """Return points along segments in series, ``points`` for each and the base, (n points + 1, 3) [m]."""
    frames, out = poses(arcs), [np.zeros((1, 3))]
    for frame, arc in zip(frames, arcs, strict=False):
        for share in np.arange(1, points + 1) / points:
            part = Arc(curvature=arc.curvature, plane=arc.plane, length=float(share) * arc.length)
            out.append((frame @ pose(part))[None, :3, 3])
    return np.concatenate(out)


def arc_to(position: ArrayLike) -> Arc:
    """Return the one arc of less than a full circle that leads from the base to a position.

    Parameters
    ----------
    position : (3,) array [m]
        Of the tip; x leads out of the base.

    Raises
    ------
    TurgorError
        If it is the base itself, or lies straight behind it.

    Examples
    --------
    >>> arc = arc_to(pose(Arc(curvature=12.0, plane=0.3, length=0.2))[:3, 3])
    >>> round(arc.curvature, 12), round(arc.plane, 12), round(arc.length, 12)
    (12.0, 0.3, 0.2)
    """
    x, y, z = np.asarray(position, dtype=np.float64).tolist()
    aside = hypot(y, z)
    if aside == 0 and x <= 0:
        raise TurgorError(f"no single arc leads to ({x / mm:g}, 0, 0) mm, straight behind the base or in it.")
    angle = 2 * atan2(aside, x)
    chord = hypot(x, aside)
    length = chord / np.sinc(angle / (2 * pi))
    return Arc(curvature=angle / float(length), plane=atan2(z, y) if aside else 0.0, length=float(length))


def _by_geometry(arc: Arc) -> Array:
    """Circle of radius 1/κ; chord and sag by functions that stay exact for a straight segment."""
    angle, c, s = arc.angle, cos(arc.plane), sin(arc.plane)
    out = np.eye(4)
    along, aside = sin(angle), 1 - cos(angle) if abs(angle) > 0.1 else 2 * sin(angle / 2) ** 2
    d = np.array([0.0, c, s])
    X = np.array([1.0, 0.0, 0.0])
    # turn in the plane of x and d
    out[:3, :3] += along * (np.outer(d, X) - np.outer(X, d)) - aside * (np.outer(X, X) + np.outer(d, d))
    chord = arc.length * float(np.sinc(angle / (2 * pi)))
    out[:3, 3] = chord * (cos(angle / 2) * X + sin(angle / 2) * d)
    return out


def _by_joints(arc: Arc) -> Array:
    """Denavit–Hartenberg parameters (θ, d, a, α) of five joints, with z along the segment; then the axes renamed."""
    half = arc.angle / 2
    chord = arc.length * float(np.sinc(half / pi))
    table = (
        (arc.plane, 0.0, 0.0, -pi / 2),
        (half, 0.0, 0.0, pi / 2),
        (0.0, chord, 0.0, -pi / 2),
        (half, 0.0, 0.0, pi / 2),
        (-arc.plane, 0.0, 0.0, 0.0),
    )
    out = np.eye(4)
    for theta, d, a, alpha in table:
        ct, st, ca, sa = cos(theta), sin(theta), cos(alpha), sin(alpha)
        out = out @ np.array(
            [[ct, -st * ca, st * sa, a * ct], [st, ct * ca, -ct * sa, a * st], [0, sa, ca, d], [0, 0, 0, 1.0]]
        )
    return np.asarray(_RENAMED.T @ out @ _RENAMED)


def _by_exponential(arc: Arc) -> Array:
    """Exponential of the twist: it moves along x and turns about the direction across the plane."""
    axis = np.array([0.0, -sin(arc.plane), cos(arc.plane)])  # x × d
    x, y, z = arc.angle * axis
    turn = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    angle = abs(arc.angle)
    if angle > 1e-4:
        A, B, C = sin(angle) / angle, (1 - cos(angle)) / angle**2, (angle - sin(angle)) / angle**3
    else:
        A, B, C = 1 - angle**2 / 6, 0.5 - angle**2 / 24, 1 / 6 - angle**2 / 120
    out = np.eye(4)
    square = turn @ turn
    out[:3, :3] += A * turn + B * square
    out[:3, 3] = (np.eye(3) + B * turn + C * square) @ np.array([arc.length, 0.0, 0.0])
    return out


#: From the axes (x, y, z) of an actuator to those of the joints, whose z leads along the segment.
_RENAMED = np.array([[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [0, 0, 0, 1.0]])

#: The ways to a pose.
METHODS: Mapping[str, Callable[[Arc], Array]] = MappingProxyType(
    {"geometry": _by_geometry, "denavit_hartenberg": _by_joints, "exponential": _by_exponential}
)
