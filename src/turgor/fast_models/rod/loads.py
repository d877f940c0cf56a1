"""Loads of rods: forces at plates, forces along rods, pressure in chambers. Gravity is `turgor.loads.Gravity`."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from turgor.core.model.history import RAMP, History, checked, share_at
from turgor.core.model.loads import Gravity
from turgor.foundation.errors import TurgorError

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlateForce:
    """A force and a moment on a plate, by default on the tip.

    Parameters
    ----------
    plate : str
    force : (3,) floats [N]
    moment : (3,) floats [N m]
    at : (3,) floats [m]
        Where the force acts, in the axes of the plate.
    follows : bool
        Whether force and moment turn with the plate; their components are then along its axes.
    history : sequence of (float, float), or str, optional
        As that of a `turgor.Pressure`.

    Raises
    ------
    TurgorError
        If a vector does not have three finite numbers.

    Examples
    --------
    >>> PlateForce(force=(0, 0, -1)).share(0.5)
    0.5
    """

    plate: str = "tip"
    force: Vector = (0.0, 0.0, 0.0)
    moment: Vector = (0.0, 0.0, 0.0)
    at: Vector = (0.0, 0.0, 0.0)
    follows: bool = False
    history: History = RAMP

    def __post_init__(self) -> None:
        what = f"force on plate '{self.plate}'"
        for name in ("force", "moment", "at"):
            object.__setattr__(self, name, vector(f"{what}: {name}", getattr(self, name)))
        object.__setattr__(self, "history", checked(self.history, what))

    def share(self, load_factor: float) -> float:
        """Return the share that acts at a load factor."""
        return share_at(self.history, load_factor)


@dataclass(frozen=True, slots=True, kw_only=True)
class LineLoad:
    """An even force along a rod, for each length at rest.

    Parameters
    ----------
    force : (3,) floats [N/m]
    rod : str or None
        Which rod; None is every rod.
    follows : bool
        Whether the force turns with the sections; its components are then along their axes.
    history : sequence of (float, float), or str, optional
        As that of a `turgor.Pressure`.

    Raises
    ------
    TurgorError
        If the force does not have three finite numbers.

    Examples
    --------
    >>> LineLoad(force=(0, 0, -0.1)).force
    (0.0, 0.0, -0.1)
    """

    force: Vector
    rod: str | None = None
    follows: bool = False
    history: History = RAMP

    def __post_init__(self) -> None:
        object.__setattr__(self, "force", vector("line load: force", self.force))
        object.__setattr__(self, "history", checked(self.history, "line load"))

    def share(self, load_factor: float) -> float:
        """Return the share that acts at a load factor."""
        return share_at(self.history, load_factor)


@dataclass(frozen=True, slots=True, kw_only=True)
class ChamberPressure:
    """Gauge pressure in a chamber of a rod, or of every rod that has a chamber of this name.

    Parameters
    ----------
    pressure : float [Pa]
    chamber : str
    rod : str or None
        Which rod; None is every one with such a chamber.
    history : sequence of (float, float), or str, optional
        As that of a `turgor.Pressure`.

    Raises
    ------
    TurgorError
        If the pressure is not a finite number.

    Examples
    --------
    >>> ChamberPressure(pressure=20e3).chamber
    'cavity'
    """

    pressure: float
    chamber: str = "cavity"
    rod: str | None = None
    history: History = RAMP

    def __post_init__(self) -> None:
        if not np.isfinite(self.pressure):
            raise TurgorError(f"pressure in chamber '{self.chamber}' is {self.pressure:g} Pa; it must be finite.")
        object.__setattr__(self, "history", checked(self.history, f"pressure in chamber '{self.chamber}'"))

    def share(self, load_factor: float) -> float:
        """Return the share that acts at a load factor."""
        return share_at(self.history, load_factor)


RodLoad = PlateForce | LineLoad | ChamberPressure | Gravity


def vector(what: str, values: Any) -> Vector:
    """Return three finite numbers.

    Raises
    ------
    TurgorError
        If they are none.

    Examples
    --------
    >>> vector("force", (1, 2))
    Traceback (most recent call last):
    turgor.TurgorError: force is (1, 2); three finite numbers are needed.
    """
    try:
        numbers = np.array(values, dtype=np.float64)
    except (TypeError, ValueError):
        numbers = np.empty(0)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise TurgorError(f"{what} is {values}; three finite numbers are needed.")
    x, y, z = numbers.tolist()
    return x, y, z
