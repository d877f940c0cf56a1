"""Goals of an optimization: targets and paths to meet, numbers to make small or large, limits to stay below."""

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, replace
from math import isfinite
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError
from turgor.studies.optimization.row_values import At, Measure, Read, read, shown_of, unit_of, words_of
from turgor.studies.optimization.slopes import slopes_of
from turgor.studies.runs.study import Row
from turgor.units import mm

Array = NDArray[np.float64]

#: Points at which a path is compared.
PATH_POINTS = 9


@dataclass(frozen=True, slots=True)
class Target:
    """A measure that is to have a value, such as an angle at a pressure.

    Parameters
    ----------
    measure : str or callable
        Column of the response, or name of a factor, or a function of a `Response` that returns a number.
    value : float [SI]
        The target.
    at : (str, float), optional
        Column and value [SI] at which it is read, such as ``("pressure", 30e3)``; by default the last state.
    scale : float or None [SI]
        What differences are divided by; by default the size of ``value``.
    tolerance : float [-]
        Share of the scale within which the target is met.
    unit : str
        Unit in which it is shown; by default that of the column.

    Raises
    ------
    TurgorError
        If the value is 0 and has no scale, or a number is out of range.

    Examples
    --------
    >>> Target("bending_angle", 1.57, at=("pressure", 30e3)).scale
    1.57
    """

    measure: Measure
    value: float
    _: KW_ONLY
    at: At = None
    scale: float | None = None
    tolerance: float = 0.01
    unit: str = ""

    def __post_init__(self) -> None:
        _check(self, self.value, "value")
        object.__setattr__(self, "scale", _scale(self, self.value))

    def read(self, row: Row) -> Array:
        """Return what is read from a row, (1,) [SI]; NaN where the path does not reach it."""
        return np.array([read(row, self.measure, self.at)])

    def slopes(self, row: Row, factors: Sequence[str]) -> Array:
        """Return the derivatives of what is read by each factor, (1, factors); NaN where they are not known."""
        return slopes_of(row, self.measure, self.at, factors)[None]

    def linear(self) -> tuple[Array, Array]:
        """Return divisor and target of the differences: the goal is met where their length is below 1."""
        return np.array([_size(self.scale) * self.tolerance]), np.array([self.value])

    def reading(self, row: Row) -> Read:
        """Return the value in words."""
        request = f"wanted {shown_of(self.value, self.shown_unit(row))}"
        return Read.of(row, self.measure, self.at, self.shown_unit(row), request)

    def shown_unit(self, row: Row) -> str:
        """Return the unit in which it is shown."""
        return self.unit or unit_of(row, self.measure)


@dataclass(frozen=True, slots=True)
class Limit:
    """A measure that is to stay below or above a value, such as a stress.

    Parameters
    ----------
    measure : str or callable
        As in `Target`.
    most, least : float or None [SI]
        Largest and smallest value allowed; one of them, or both.
    at, scale
        As in `Target`.
    tolerance : float [-]
        Share of the scale by which a limit may be passed.
    unit : str
        As in `Target`.

    Raises
    ------
    TurgorError
        If there is no limit, or a number is out of range.

    Examples
    --------
    >>> Limit("von_mises_p99", most=0.4e6, at=("pressure", 30e3)).scale
    400000.0
    """

    measure: Measure
    _: KW_ONLY
    most: float | None = None
    least: float | None = None
    at: At = None
    scale: float | None = None
    tolerance: float = 0.002
    unit: str = ""

    def __post_init__(self) -> None:
        ends = [each for each in (self.least, self.most) if each is not None]
        if not ends:
            raise TurgorError(f"the limit of {words_of(self.measure)} needs most or least.")
        for each in ends:
            _check(self, each, "most or least")
        if len(ends) == 2 and not ends[0] < ends[1]:
            raise TurgorError(f"the limit of {words_of(self.measure)} has least {ends[0]:g} above most {ends[1]:g}.")
        object.__setattr__(self, "scale", _scale(self, max(ends, key=abs)))

    def read(self, row: Row) -> Array:
        """Return what is read from a row, (1,) [SI]; NaN where the path does not reach it."""
        return np.array([read(row, self.measure, self.at)])

    def slopes(self, row: Row, factors: Sequence[str]) -> Array:
        """Return the derivatives of what is read by each factor, (1, factors); NaN where they are not known."""
        return slopes_of(row, self.measure, self.at, factors)[None]

    def linear(self) -> tuple[Array, Array]:
        """Return signed divisors and limits of each end; a value beyond 0 passes the limit, beyond 1 too far."""
        unit = _size(self.scale) * self.tolerance
        ends = [(unit, self.most), (-unit, self.least)]
        given = [(sign, end) for sign, end in ends if end is not None]
        return np.array([sign for sign, _ in given]), np.array([end for _, end in given])

    def reading(self, row: Row) -> Read:
        """Return the value in words."""
        unit = self.unit or unit_of(row, self.measure)
        request = [f"most {shown_of(self.most, unit)}"] if self.most is not None else []
        request += [f"least {shown_of(self.least, unit)}"] if self.least is not None else []
        return Read.of(row, self.measure, self.at, unit, ", ".join(request))


@dataclass(frozen=True, slots=True)
class Minimize:
    """A measure that is to be as small as possible, under the targets and limits.

    Parameters
    ----------
    measure : str or callable
        As in `Target`: the user's own objective is a function of a `Response`.
    at
        As in `Target`.
    scale : float or None [SI]
        What it is divided by; by default its size at the start.
    unit : str
        As in `Target`.

    Examples
    --------
    >>> Minimize("solid_volume").sign, Maximize("blocked_force").sign
    (1.0, -1.0)
    """

    measure: Measure
    _: KW_ONLY
    at: At = None
    scale: float | None = None
    unit: str = ""

    @property
    def sign(self) -> float:
        """1, or −1 for a measure to maximize."""
        return 1.0

    def read(self, row: Row) -> Array:
        """Return what is read from a row, (1,) [SI]; NaN where the path does not reach it."""
        return np.array([read(row, self.measure, self.at)])

    def slopes(self, row: Row, factors: Sequence[str]) -> Array:
        """Return the derivatives of what is read by each factor, (1, factors); NaN where they are not known."""
        return slopes_of(row, self.measure, self.at, factors)[None]

    def linear(self) -> tuple[Array, Array]:
        """Return the signed divisor, and 0."""
        return np.array([self.sign * _size(self.scale)]), np.zeros(1)

    def reading(self, row: Row) -> Read:
        """Return the value in words."""
        request = "as small as possible" if self.sign > 0 else "as large as possible"
        return Read.of(row, self.measure, self.at, self.unit or unit_of(row, self.measure), request)


@dataclass(frozen=True, slots=True)
class Maximize(Minimize):
    """A measure that is to be as large as possible; the fields are those of `Minimize`."""

    @property
    def sign(self) -> float:
        """−1: the search makes everything small."""
        return -1.0


@dataclass(frozen=True, slots=True)
class TipPath:
    """A curve that the tip is to follow.

    Curves of different length are compared at equal shares of their arc length; with ``at``, at given pressures.

    Parameters
    ----------
    points : sequence of (float, float) [m]
        The target curve, from rest: displacements along ``x`` and ``z``.
    at : (str, sequence of float), optional
        Column and its values [SI] at the points, such as ``("pressure", [10e3, 20e3, 30e3])``.
    measures : tuple of str
        Columns with the place of the tip.
    tolerance : float [m]
        Root mean square of the distances within which the path is met.

    Raises
    ------
    TurgorError
        If there are fewer than two points, or not as many values as points.

    Examples
    --------
    >>> TipPath([(0.0, 0.0), (-5e-3, 20e-3), (-20e-3, 35e-3)]).target.shape
    (9, 2)
    """

    points: Sequence[tuple[float, ...]]
    _: KW_ONLY
    at: tuple[str, Sequence[float]] | None = None
    measures: tuple[str, ...] = ("tip_displacement_x", "tip_displacement_z")
    tolerance: float = 1 * mm

    def __post_init__(self) -> None:
        given = np.array(self.points, dtype=np.float64)
        if given.ndim != 2 or given.shape[1] != len(self.measures) or len(given) < 2:
            raise TurgorError(
                f"a path needs two points or more with a number for each of {', '.join(self.measures)}; "
                f"points has the shape {given.shape}."
            )
        if self.at is not None and len(self.at[1]) != len(given):
            raise TurgorError(f"a path has {len(given)} points and {len(self.at[1])} values of '{self.at[0]}'.")
        if not self.tolerance > 0:
            raise TurgorError(f"tolerance of the path is {self.tolerance:g} m; allowed is above 0.")

    @property
    def target(self) -> Array:
        """Points of the target at which the path is compared, (k, 2) [m]."""
        given = np.array(self.points, dtype=np.float64)
        return given if self.at is not None else _at_shares(given)

    def read(self, row: Row) -> Array:
        """Return the points of the tip of a row, (2k,) [m]; NaN where the path does not reach them."""
        missing = np.full(self.target.size, np.nan)
        if row.response is None:
            return missing
        if self.at is not None:
            name, values = self.at
            return np.array([read(row, each, (name, at)) for at in values for each in self.measures])
        table = np.column_stack([row.response.column(each) for each in self.measures])
        return _at_shares(table).ravel() if len(table) > 1 else missing

    def slopes(self, row: Row, factors: Sequence[str]) -> Array:
        """Return the derivatives of the points, (2k, factors); NaN where they are not known, as without ``at``."""
        if self.at is None:
            return np.full((self.target.size, len(factors)), np.nan)
        name, values = self.at
        return np.array([slopes_of(row, each, (name, at), factors) for at in values for each in self.measures])

    def linear(self) -> tuple[Array, Array]:
        """Return divisors and target points: the goal is met where the length of the differences is below 1."""
        target = self.target
        return np.full(target.size, self.tolerance * np.sqrt(len(target))), target.ravel()

    def distance(self, row: Row) -> float:
        """Return the root mean square of the distances [m]."""
        apart = self.read(row).reshape(self.target.shape) - self.target
        return float(np.sqrt(np.mean(np.sum(apart**2, axis=1))))

    def reading(self, row: Row) -> Read:
        """Return the distance in words."""
        request = f"within {shown_of(self.tolerance, 'mm')}"
        return Read(name="distance from the path", value=self.distance(row), unit="mm", request=request)


Goal: TypeAlias = Target | Limit | Minimize | TipPath

#: Goals that are met or not; their misfit is minimized where there is no objective.
MET = (Target, TipPath)


def with_scales(goals: Sequence[Goal], row: Row) -> tuple[Goal, ...]:
    """Give goals without a scale that of their value in a row."""
    scaled: list[Goal] = []
    for each in goals:
        if isinstance(each, Minimize) and each.scale is None:
            size = abs(float(each.read(row)[0]))
            each = replace(each, scale=size if isfinite(size) and size > 0 else 1.0)
        scaled.append(each)
    return tuple(scaled)


def _scale(goal: Target | Limit, value: float) -> float:
    scale = abs(value) if goal.scale is None else goal.scale
    if not (isfinite(scale) and scale > 0):
        raise TurgorError(f"{words_of(goal.measure)} has the value {value:g}; give a scale above 0.")
    return scale


def _size(scale: float | None) -> float:
    return 1.0 if scale is None else scale


def _check(goal: Target | Limit, value: float, field: str) -> None:
    if not isfinite(value):
        raise TurgorError(f"{field} of {words_of(goal.measure)} is {value}; allowed is a finite number.")
    if not 0 < goal.tolerance < 1:
        raise TurgorError(
            f"tolerance of {words_of(goal.measure)} is {goal.tolerance:g}; allowed is between 0 and 1, a share."
        )


def _at_shares(points: Array) -> Array:
    """Return points at equal shares of the arc length of a curve, its beginning left out."""
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    at = np.linspace(0, lengths[-1], PATH_POINTS + 1)[1:]
    return np.column_stack([np.interp(at, lengths, column) for column in points.T])
