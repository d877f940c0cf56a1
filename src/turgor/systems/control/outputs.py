"""Outputs: what is to follow a target, as functions of the states of a reduced model."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces import surfaces
from turgor.core.results.fields.state_fields import MeshFacts
from turgor.foundation.errors import TurgorError, unknown
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.reduced import Reduced

Array = NDArray[np.float64]


class OutputOf(Protocol):
    """An output of one reduced model."""

    @property
    def names(self) -> tuple[str, ...]:
        """Name of each number."""

    @property
    def unit(self) -> str:
        """Unit that the numbers are shown in."""

    @property
    def size(self) -> float:
        """What an error of the output is compared with [SI]."""

    def at(self, state: ReducedState) -> tuple[Array, Array]:
        """Values (m,) and derivatives (m, n) by the inputs."""


class Output(Protocol):
    """What is to follow a target."""

    def of(self, reduced: Reduced) -> OutputOf:
        """Prepare it for a reduced model."""


@dataclass(frozen=True, slots=True, eq=False)
class Linear:
    """Displacements that are linear in the coordinates.

    Parameters
    ----------
    names : tuple of str
    matrix : (m, r) array [m]
    size : float [m]
        Length of the actuator.
    unit : str
    """

    names: tuple[str, ...]
    matrix: Array
    size: float
    unit: str = "mm"

    def at(self, state: ReducedState) -> tuple[Array, Array]:
        """Values (m,) [m] and derivatives (m, n) by the inputs."""
        return self.matrix @ state.q, self.matrix @ state.rates[: len(state.q)]


@dataclass(frozen=True, slots=True)
class Tip:
    """Mean displacement of the face ``tip`` [m], along some axes.

    Parameters
    ----------
    axes : str
        Those that follow, such as ``"xz"``.

    Examples
    --------
    >>> Tip("yz")
    Tip(axes='yz')
    """

    axes: str = "xyz"

    def __post_init__(self) -> None:
        if not self.axes or set(self.axes) - set("xyz") or len(set(self.axes)) < len(self.axes):
            raise TurgorError(f"axes of the tip are '{self.axes}'; some of x, y and z are needed, each once.")

    def of(self, reduced: Reduced) -> Linear:
        """Prepare it for a reduced model."""
        if not reduced.tip.any():
            raise TurgorError("the reduced model has no face 'tip'; follow points instead.")
        rows = ["xyz".index(axis) for axis in self.axes]
        names = tuple(f"tip_{axis}" for axis in self.axes)
        return Linear(names, reduced.tip[rows] * reduced.scales[0], length_of(reduced))


@dataclass(frozen=True, slots=True)
class Points:
    """Displacements [m] of the nodes that are nearest to some places at rest.

    Parameters
    ----------
    places : sequence of (float, float, float) [m]

    Examples
    --------
    >>> Points([(0.06, 0, 0)]).places
    [(0.06, 0, 0)]
    """

    places: Sequence[tuple[float, float, float]]

    def of(self, reduced: Reduced) -> Linear:
        """Prepare it for a reduced model."""
        points = reduced.model.mesh.points
        rows, names, length = [], [], length_of(reduced)
        for number, place in enumerate(np.asarray(self.places, dtype=np.float64).reshape(-1, 3), start=1):
            away = np.linalg.norm(points - place, axis=1)
            node = int(away.argmin())
            if not away[node] <= length / 2:
                raise TurgorError(
                    f"point {number} is {away[node] * 1e3:.4g} mm from the nearest node; allowed is half of the "
                    f"length, {length * 5e2:.4g} mm."
                )
            rows.append(_rows(reduced, node))
            names += [f"point_{number}_{axis}" for axis in "xyz"]
        if not rows:
            raise TurgorError("a target of points needs a place; there is none.")
        return Linear(tuple(names), np.vstack(rows), length)


@dataclass(frozen=True, slots=True)
class Shape:
    """Mean displacements [m] of slices across x, at some shares of the length: the shape of the center line.

    Parameters
    ----------
    stations : sequence of float [-]
        Shares of the length from 0 to 1.
    thickness : float [-]
        Thickness of a slice over the length.

    Examples
    --------
    >>> Shape((0.5, 1.0)).stations
    (0.5, 1.0)
    """

    stations: Sequence[float] = (0.25, 0.5, 0.75, 1.0)
    thickness: float = 0.1

    def of(self, reduced: Reduced) -> Linear:
        """Prepare it for a reduced model."""
        x = reduced.model.mesh.points[:, 0]
        facts, rows, names, length = MeshFacts(reduced.model.mesh), [], [], float(np.ptp(x))
        for station in self.stations:
            if not 0 <= station <= 1:
                raise TurgorError(f"a station of the shape is {station:g}; allowed is 0 to 1.")
            inside = np.abs(x - x.min() - station * length) <= 0.5 * self.thickness * length
            if not inside.any():
                raise TurgorError(f"no node lies within the slice at {station:g}; take thicker slices.")
            modes = reduced.modes.reshape(len(x), 3, -1)[inside].mean(axis=0)
            rows.append(facts.of_whole(modes.T).T * reduced.scales[0])
            names += [f"shape_{station:g}_{axis}" for axis in "xyz"]
        if not rows:
            raise TurgorError("a target of shape needs a station; there is none.")
        return Linear(tuple(names), np.vstack(rows).astype(np.float64), length_of(reduced))


@dataclass(frozen=True, slots=True)
class Angle:
    """Bending angle [rad] as `turgor.bending_angle` has it: of the vector area of the face ``tip`` in the plane x, z.

    Examples
    --------
    >>> Angle()
    Angle()
    """

    def of(self, reduced: Reduced) -> "AngleOf":
        """Prepare it for a reduced model."""
        mesh = reduced.model.mesh
        if "tip" not in mesh.faces:
            raise unknown("face", "tip", mesh.faces)
        facts, nodes = MeshFacts(mesh), np.unique(mesh.face("tip"))
        triangles = np.searchsorted(nodes, mesh.face("tip"))
        rest = mesh.points[nodes]
        modes = reduced.modes.reshape(len(mesh.points), 3, -1)[nodes].astype(np.float64) * reduced.scales[0]

        def area(points: Array) -> Array:
            return np.asarray(facts.of_whole(surfaces.vector_area(points, triangles)))

        return AngleOf(_quadratic(area, rest, modes), reduced.trained[:, : modes.shape[2]], reduced.trained_inputs)


def _quadratic(area: "Area", rest: Array, modes: Array) -> Array:
    """Coefficients (3, R, R) of a function of positions that is quadratic, by its values at sums of modes."""
    shapes = [rest, *(modes[:, :, k] for k in range(modes.shape[2]))]
    alone = [area(shape) for shape in shapes]
    out = np.empty((3, len(shapes), len(shapes)))
    for i, first in enumerate(shapes):
        for j in range(i, len(shapes)):
            both = alone[i] if i == j else 0.5 * (area(first + shapes[j]) - alone[i] - alone[j])
            out[:, i, j] = out[:, j, i] = both
    return out


class Area(Protocol):
    """A vector area of positions."""

    def __call__(self, points: Array, /) -> Array:
        """Vector area (3,)."""


@dataclass(frozen=True, eq=False)
class AngleOf:
    """The bending angle of one reduced model: an angle of a vector area, which is quadratic in the coordinates.

    Parameters
    ----------
    forms : (3, R, R) array
    trained : (t, r) array
        Trained coordinates, along which the angle is continued past half a turn.
    inputs : (t, 1 + n) array
        Their inputs.
    names : tuple of str
    unit : str
    size : float [rad]
    """

    forms: Array
    trained: Array
    inputs: Array
    names: tuple[str, ...] = ("bending_angle",)
    unit: str = "deg"
    size: float = 1.0

    def at(self, state: ReducedState) -> tuple[Array, Array]:
        """Value (1,) [rad] and derivatives (1, n) by the inputs."""
        q = state.q
        one = np.concatenate([[1.0], q])
        once = self.forms @ one
        x, _, z = once @ one
        slopes = 2.0 * once[:, 1:]
        angle = np.arctan2(-z, x)
        near = self._angles[np.argmin(((self.trained - q) ** 2).sum(axis=1))]
        angle += 2 * np.pi * np.round((near - angle) / (2 * np.pi))
        by_coordinates = (z * slopes[0] - x * slopes[2]) / (x**2 + z**2)
        return np.array([angle]), (by_coordinates @ state.rates[: len(q)])[None]

    @cached_property
    def _angles(self) -> Array:
        """Angles of the trained states, continued along each path from rest."""
        one = np.column_stack([np.ones(len(self.trained)), self.trained])
        x, _, z = np.einsum("aij,ti,tj->at", self.forms, one, one)
        angles, last = np.arctan2(-z, x), 0.0
        for place, share in enumerate(self.inputs[:, 0]):
            if place and share <= self.inputs[place - 1, 0]:
                last = 0.0  # another path begins
            angles[place] += 2 * np.pi * np.round((last - angles[place]) / (2 * np.pi))
            last = angles[place]
        return np.asarray(angles)


def _rows(reduced: Reduced, node: int) -> Array:
    return reduced.modes[3 * node : 3 * node + 3].astype(np.float64) * reduced.scales[0]


def length_of(reduced: Reduced) -> float:
    """Largest extent of the actuator [m]."""
    return float(np.ptp(reduced.model.mesh.points, axis=0).max())


def trained_states(reduced: Reduced) -> list[ReducedState]:
    """The training states of a reduced model, without derivatives by the inputs."""
    none = np.zeros((reduced.trained.shape[1], len(reduced.inputs.keys)))
    return [
        ReducedState(reduced, inputs[1:], y, none, 0.0, 0.0, 0)
        for inputs, y in zip(reduced.trained_inputs, reduced.trained, strict=True)
    ]
