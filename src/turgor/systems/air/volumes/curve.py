"""VolumeCurve: pressure against volume of an elastic chamber, as a table from any source."""

from bisect import bisect_right
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline, PchipInterpolator, PPoly

from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response
from turgor.systems.air.settings import SOLVER

if TYPE_CHECKING:
    from turgor.reduced.states.reduced import Reduced


@dataclass(frozen=True, slots=True, eq=False)
class VolumeCurve:
    """Gauge pressure of a chamber over its volume: a cubic spline through a table.

    Where the spline would turn between points that rise, it is a monotone one. The pressure may have limit points.

    Parameters
    ----------
    pressure : (n,) array [Pa], gauge
    volume : (n,) array [m³]
        In rising order.
    table : Response, optional
        What else is known at these volumes, such as the bending angle.

    Raises
    ------
    TurgorError
        If there are fewer than two points, or the volumes do not rise.

    Examples
    --------
    >>> curve = VolumeCurve([0.0, 10e3, 20e3], [10e-6, 11e-6, 12e-6])
    >>> round(curve.volume_at(5e3) * 1e6, 6)
    10.5
    """

    pressure: ArrayLike
    volume: ArrayLike
    table: Response | None = field(default=None, repr=False)
    knots: list[float] = field(init=False, repr=False)
    pieces: list[tuple[float, ...]] = field(init=False, repr=False)
    energy: PPoly = field(init=False, repr=False)

    def __post_init__(self) -> None:
        p, v = (np.array(each, dtype=np.float64) for each in (self.pressure, self.volume))
        if p.shape != v.shape or p.ndim != 1 or len(p) < 2:
            raise TurgorError(
                f"a table has pressures of shape {p.shape} and volumes of shape {v.shape}; two or more of each are "
                "needed."
            )
        if not (np.isfinite(p).all() and np.isfinite(v).all() and v[0] > 0 and (np.diff(v) > 0).all()):
            raise TurgorError("volumes of a table must be finite, positive, and rise from row to row.")
        spline = _spline(v, p)
        object.__setattr__(self, "knots", v.tolist())
        object.__setattr__(self, "pieces", [tuple(piece) for piece in spline.c.T.tolist()])
        object.__setattr__(self, "energy", spline.antiderivative())

    def __repr__(self) -> str:
        p, v = np.asarray(self.pressure), np.asarray(self.volume)
        return f"VolumeCurve({p.min() / 1e3:.4g} to {p.max() / 1e3:.4g} kPa, {v[0] * 1e6:.4g} to {v[-1] * 1e6:.4g} mL)"

    @classmethod
    def of_response(
        cls, response: Response, *, pressure: str = "pressure", volume: str = "cavity_volume", factor: float = 1.0
    ) -> "VolumeCurve":
        """Read a curve from a response of finite elements, a formula, a section or a laboratory.

        Parameters
        ----------
        response : Response
        pressure, volume : str
            Names of its columns.
        factor : float
            Factor on the volume: the length [m] for ``cavity_volume_per_length`` of a section.
        """
        p, v = response.column(pressure), response.column(volume) * factor
        rows = np.isfinite(p) & np.isfinite(v)
        first = np.concatenate([[True], np.diff(v[rows]) > 0])
        known = np.flatnonzero(rows)[first]
        columns = tuple(Column(each.name, each.unit, each.values[known]) for each in response.columns)
        return cls(p[known], v[known], Response(columns=columns, source=response.source))

    @classmethod
    def of_function(cls, volume: Callable[[float], float], low: float, high: float, points: int = 200) -> "VolumeCurve":
        """Sample a formula: volume [m³] by gauge pressure [Pa], which it rises with, from ``low`` to ``high``."""
        p = np.linspace(low, high, points)
        return cls(p, np.array([volume(each) for each in p.tolist()]))

    @classmethod
    def of_reduced(
        cls, reduced: "Reduced", pressures: Iterable[float] | None = None, faces: Iterable[str] | None = None
    ) -> "VolumeCurve":
        """Sample a reduced model whose one input is a pressure.

        Parameters
        ----------
        reduced : Reduced
        pressures : iterable of float [Pa], optional
            41 over its range by default.
        faces : iterable of str, optional
            Cavities that are one chamber; all by default.
        """
        low, high = float(reduced.inputs.low[0]), float(reduced.inputs.high[0])
        p = np.linspace(low, high, 41) if pressures is None else np.array(list(pressures))
        states = reduced.solve_all(p.tolist())
        names = tuple(reduced.faces if faces is None else faces)
        return cls(p, np.array([sum(state.volumes[name] for name in names) for state in states]))

    def at(self, place: float, time: float) -> tuple[float, float, float, float]:
        """Pressure, volume and derivatives; the coordinate is the volume. Beyond its ends the curve is straight."""
        knots, n = self.knots, len(self.pieces) - 1
        inner = min(max(place, knots[0]), knots[-1])
        k = min(max(bisect_right(knots, inner) - 1, 0), n)
        a, b, c, d = self.pieces[k]
        x = inner - knots[k]
        slope = (3 * a * x + 2 * b) * x + c
        return ((a * x + b) * x + c) * x + d + slope * (place - inner), place, slope, 1.0

    def work(self, place: float, ambient: float) -> float:
        """Integral of the absolute pressure over the volume [J]."""
        inner = min(max(place, self.knots[0]), self.knots[-1])
        pressure, _, slope, _ = self.at(inner, 0.0)
        away = place - inner
        return float(self.energy(inner)) + (pressure + slope * away / 2) * away + ambient * place

    def place(self, pressure: float, time: float) -> float:
        """The first volume with a gauge pressure [Pa]."""
        p = np.asarray(self.pressure, dtype=np.float64)
        k = int(np.argmax((p[:-1] - pressure) * (p[1:] - pressure) <= 0))
        if (p[k] - pressure) * (p[k + 1] - pressure) > 0:
            raise TurgorError(
                f"pressure is {pressure / 1e3:.4g} kPa; the table of the chamber has {p.min() / 1e3:.4g} to "
                f"{p.max() / 1e3:.4g} kPa."
            )
        low, high = self.knots[k], self.knots[k + 1]
        rising = p[k + 1] > p[k]
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if (self.at(middle, 0.0)[0] < pressure) == rising else (low, middle)
        return (low + high) / 2

    def volume_at(self, pressure: float) -> float:
        """The first volume [m³] with a gauge pressure [Pa]."""
        return self.place(pressure, 0.0)

    def measure(self, name: str, volumes: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return another column of its table at volumes, along straight lines."""
        if self.table is None:
            raise TurgorError("the chamber has a curve without further columns; `VolumeCurve.of_response` has them.")
        return np.interp(volumes, self.knots, self.table.column(name))

    def bounds(self, ambient: float) -> tuple[float, float]:
        """Beyond the table by its own length, so that steps may overshoot."""
        span = self.knots[-1] - self.knots[0]
        return max(self.knots[0] - span, 1e-3 * self.knots[0]), self.knots[-1] + 100 * span

    def rate(self, time: float) -> float:
        """No plunger."""
        return 0.0

    def outside(self, place: float) -> str:
        """Say how a volume lies outside of the table."""
        low, high = self.knots[0], self.knots[-1]
        margin = SOLVER.beyond * (high - low)
        if low - margin <= place <= high + margin:
            return ""
        pressure = self.at(place, 0.0)[0]
        p = np.asarray(self.pressure, dtype=np.float64)
        return (
            f"{pressure / 1e3:.4g} kPa and {place * 1e6:.4g} mL, beyond its table of {p.min() / 1e3:.4g} to "
            f"{p.max() / 1e3:.4g} kPa and {low * 1e6:.4g} to {high * 1e6:.4g} mL"
        )


def _spline(v: NDArray[np.float64], p: NDArray[np.float64]) -> PPoly:
    """A cubic spline; a monotone one where the spline turns within a rising or falling stretch."""
    if len(p) == 2:
        return PPoly(np.array([[0.0], [0.0], [(p[1] - p[0]) / (v[1] - v[0])], [p[0]]]), v)
    spline = CubicSpline(v, p)
    fine = spline(np.linspace(v[:-1], v[1:], 9, axis=1))
    overshoot = np.maximum(fine.max(axis=1) - np.maximum(p[:-1], p[1:]), np.minimum(p[:-1], p[1:]) - fine.min(axis=1))
    turns = np.sign(np.diff(p))
    inner = np.ones(len(p) - 1, dtype=bool)
    if len(turns) > 1:
        changes = np.flatnonzero(turns[1:] * turns[:-1] < 0)
        inner[changes], inner[changes + 1] = False, False
    return PchipInterpolator(v, p) if (overshoot[inner] > 1e-9 * np.ptp(p)).any() else spline
