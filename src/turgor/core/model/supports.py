"""Supports: what holds the actuator."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.history import RAMP, History, checked, share_at
from turgor.core.model.points import Hinge, ReferencePoint, Rotation
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, name, vector

#: Displacement of points [m] at a load factor.
Move: TypeAlias = Callable[[NDArray[np.float64], float], NDArray[np.float64]]


@dataclass(frozen=True, slots=True)
class Fixed:
    """Hold a face: no displacement in the chosen directions.

    Parameters
    ----------
    face : str
        Name of the face, or of a `ReferencePoint`, which is then held where it is and may still turn.
    directions : str
        Which components are held, any of ``"x"``, ``"y"``, ``"z"``.
    """

    face: str
    directions: str = "xyz"

    def __post_init__(self) -> None:
        name(self.face, "face of a support", "fixed")
        _check_directions(self.directions, f"support of '{self.face}'")


@dataclass(frozen=True, slots=True)
class Symmetry:
    """Mirror plane: no displacement along the normal of a plane face aligned with the axes.

    Faces named ``symmetry_*`` get this support by themselves.
    """

    face: str


@dataclass(frozen=True, slots=True)
class Displacement:
    """Move a face along a prescribed displacement, scaled by the load factor.

    Parameters
    ----------
    face : str
        Name of the face, ``"*"`` for the whole surface of the body, or the name of a `ReferencePoint`.
    value : callable, or (3,) floats [m]
        ``value(points, load_factor) -> (n, 3) displacement [m]`` of the (n, 3) reference points [m]. Three lengths
        stand for a `Shift` by them.
    directions : str
        Which components are prescribed.
    """

    face: str
    value: Move
    directions: str = "xyz"

    if TYPE_CHECKING:

        def __init__(self, face: str, value: Move | Quantities, directions: str = "xyz") -> None: ...

    def __post_init__(self) -> None:
        name(self.face, "face of a displacement", "tip")
        value: object = self.value
        if not callable(value):
            object.__setattr__(self, "value", Shift(vector(value, f"displacement of '{self.face}'", "length")))
        _check_directions(self.directions, f"displacement of '{self.face}'")


@dataclass(frozen=True, slots=True)
class Shift:
    """The value of a `Displacement` by which the whole face goes the same way.

    Parameters
    ----------
    vector : (3,) floats [m]
        How far it is from where it was at first, at a share of one.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`: the share of the displacement; the load factor by default.

    Examples
    --------
    >>> Shift((0, 0, 2e-3))(np.zeros((1, 3)), 0.5)
    array([[0.   , 0.   , 0.001]])
    """

    vector: tuple[float, float, float]
    history: History = RAMP

    if TYPE_CHECKING:

        def __init__(self, vector: Quantities, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "vector", vector(self.vector, "displacement", "length"))
        object.__setattr__(self, "history", checked(self.history, "displacement"))

    def __call__(self, points: NDArray[np.float64], load_factor: float) -> NDArray[np.float64]:
        """Displacement (n, 3) [m] of points at a load factor."""
        share = share_at(self.history, load_factor)
        return np.tile(share * np.array(self.vector, dtype=np.float64), (len(points), 1))


@dataclass(frozen=True, slots=True)
class Radial:
    """Hold the radius of a cylindrical face: no displacement normal to the face; it may slide in the face.

    A dense winding of inextensible hoops does the same: the face keeps its radius, whatever the pressure, and is free
    to stretch along the axis and to turn about it.

    Parameters
    ----------
    face : str
        Name of a face that lies on one cylinder, or on a half or a quarter of it.
    axis : (3,) floats
        Direction of the axis of the cylinder; where it lies is found from the face.
    """

    face: str
    axis: tuple[float, float, float] = (1.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class PlaneSection:
    """Keep a plane cross-section plane: all its points move along its normal by the same amount, which is free.

    The face is a cut through a longer body, such as a length of a tube far from its ends. It slides along its normal
    without tilting; within it the points are free. A pressure in a cavity that the face cuts through also pushes on
    the opening, as on the closed end of the body (generalized plane strain with an end cap).

    Parameters
    ----------
    face : str
        Name of a plane face with its normal along x, y or z.
    """

    face: str


Support = Fixed | Symmetry | Displacement | Radial | PlaneSection | ReferencePoint | Rotation | Hinge


def _check_directions(directions: object, what: str) -> None:
    if not isinstance(directions, str) or not set(directions) <= set("xyz") or not directions:
        raise TurgorError(f"{what}: directions is {directions!r}; some of x, y and z are needed, such as 'xz'.")
