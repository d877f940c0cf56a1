"""Coupled: chambers of one actuator, the volume of each of which depends on the pressures of all."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import NdBSpline, make_interp_spline

from turgor.foundation.errors import TurgorError
from turgor.systems.air.settings import SOLVER

if TYPE_CHECKING:
    from turgor.reduced.states.reduced import Reduced

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Coupled:
    """Volumes of several chambers over their pressures, as a table: splines through a grid.

    Parameters
    ----------
    pressures : sequence of k arrays [Pa], gauge
        Rising pressures of each chamber; four or more.
    volumes : (n1, ..., nk, k) array [m³]
        Volumes of the chambers at each combination.

    Examples
    --------
    >>> p = np.linspace(0.0, 20e3, 5)
    >>> first, second = np.meshgrid(p, p, indexing="ij")
    >>> table = Coupled([p, p], np.stack([10e-6 + 1e-10 * first - 1e-11 * second, 10e-6 + 1e-10 * second], axis=-1))
    >>> print(table.at(np.array([10e3, 10e3]))[0] * 1e6)
    [10.9 11. ]
    """

    pressures: Sequence[ArrayLike]
    volumes: ArrayLike
    spline: NdBSpline = field(init=False, repr=False)
    low: Array = field(init=False, repr=False)
    high: Array = field(init=False, repr=False)

    def __post_init__(self) -> None:
        axes = [np.array(axis, dtype=np.float64) for axis in self.pressures]
        values = np.array(self.volumes, dtype=np.float64)
        if any(axis.ndim != 1 or len(axis) < 4 or not (np.diff(axis) > 0).all() for axis in axes):
            raise TurgorError("pressures of coupled chambers must rise, four or more of each chamber.")
        if values.shape != (*(len(axis) for axis in axes), len(axes)):
            raise TurgorError(
                f"volumes of {len(axes)} coupled chambers have the shape {values.shape}; needed is "
                f"{(*(len(axis) for axis in axes), len(axes))}."
            )
        knots = []
        for number, axis in enumerate(axes):
            part = make_interp_spline(axis, np.moveaxis(values, number, 0), k=3)
            knots.append(part.t)
            values = np.moveaxis(part.c, 0, number)
        object.__setattr__(self, "spline", NdBSpline(tuple(knots), values, (3,) * len(axes)))
        object.__setattr__(self, "low", np.array([axis[0] for axis in axes]))
        object.__setattr__(self, "high", np.array([axis[-1] for axis in axes]))

    def __repr__(self) -> str:
        high = ", ".join(f"{each / 1e3:.4g}" for each in self.high)
        return f"Coupled({len(self.low)} chambers, up to {high} kPa)"

    @classmethod
    def of_reduced(cls, reduced: "Reduced", points: int = 7) -> "Coupled":
        """Sample a reduced model, each of whose inputs is the pressure of a chamber.

        Parameters
        ----------
        reduced : Reduced
        points : int
            Pressures of each chamber; there are as many states as the product.
        """
        k = len(reduced.inputs.keys)
        drives = reduced.equations.pressures[:, 1:] != 0
        if not drives.any(axis=0).all():
            raise TurgorError(
                f"the inputs of the reduced model are {', '.join(reduced.inputs.keys)}; each must be a pressure."
            )
        axes = [
            np.linspace(low, high, points) for low, high in zip(reduced.inputs.low, reduced.inputs.high, strict=True)
        ]
        table, last = np.zeros((points,) * k + (k,)), None
        for place in product(range(points), repeat=k):
            at = np.array([axis[n] for axis, n in zip(axes, place, strict=True)])
            last = reduced.at(at, last if place[-1] else None)
            volumes = np.array([last.volumes[face] for face in reduced.faces])
            table[place] = volumes @ drives[: len(volumes)]
        return cls(axes, table)

    def at(self, pressures: Array) -> tuple[Array, Array]:
        """Volumes (k,) [m³] and their derivatives (k, k) by the pressures; beyond the table they are straight."""
        inner = np.clip(pressures, self.low, self.high)
        k = len(inner)
        slopes = np.stack([self.spline(inner, nu=np.eye(k, dtype=np.int64)[j]) for j in range(k)], axis=-1)
        return self.spline(inner) + slopes @ (pressures - inner), slopes

    def chamber(self, number: int) -> "CoupledChamber":
        """Return one of the chambers, counted from 0, as the volume of a `Chamber`."""
        if not 0 <= number < len(self.low):
            raise TurgorError(f"chamber {number} is not among {len(self.low)} coupled ones, 0 to {len(self.low) - 1}.")
        return CoupledChamber(self, number)

    def outside(self, pressures: Array) -> str:
        """Say how pressures lie outside of the table."""
        margin = SOLVER.beyond * (self.high - self.low)
        away = (pressures < self.low - margin) | (pressures > self.high + margin)
        if not away.any():
            return ""
        j = int(np.argmax(away))
        return (
            f"{pressures[j] / 1e3:.4g} kPa, beyond its table of {self.low[j] / 1e3:.4g} to {self.high[j] / 1e3:.4g} kPa"
        )


@dataclass(frozen=True, slots=True)
class CoupledChamber:
    """One of several coupled chambers.

    Parameters
    ----------
    table : Coupled
    number : int
        From 0.
    """

    table: Coupled
    number: int
