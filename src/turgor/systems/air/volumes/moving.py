"""MovingActuator: chambers of a reduced model in motion, with mass and damping."""

from bisect import bisect_right
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.reduced.states.following import Moving
    from turgor.reduced.states.reduced import Reduced

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class MovingActuator:
    """A reduced model in motion, each of whose inputs is the pressure of a chamber.

    Where a chamber fills within the time of a vibration of the actuator, its volume does not follow from the pressure
    alone. `simulate` then steps gas and actuator together.

    Parameters
    ----------
    reduced : Reduced
        Trained with motion.
    moving : Moving
        Time step, damping.
    """

    reduced: "Reduced"
    moving: "Moving"

    def __post_init__(self) -> None:
        if self.reduced.masses is None:
            raise TurgorError("this reduced model was trained without motion; train it with motion.")
        if not self.drives.any(axis=0).all():
            raise TurgorError(
                f"the inputs of the reduced model are {', '.join(self.reduced.inputs.keys)}; each must be a pressure."
            )

    def __repr__(self) -> str:
        return f"MovingActuator({', '.join(self.reduced.inputs.keys)}; steps of {self.moving.step:g} s)"

    @property
    def drives(self) -> NDArray[np.bool_]:
        """Which faces (k, n) each input presses."""
        return np.asarray(self.reduced.equations.pressures[:, 1:] != 0)

    def chamber(self, number: int = 0) -> "MovingChamber":
        """Return one of the chambers, counted from 0 in the order of the inputs, as the volume of a `Chamber`."""
        count = len(self.reduced.inputs.keys)
        if not 0 <= number < count:
            raise TurgorError(f"chamber {number} is not among {count} chambers, 0 to {count - 1}.")
        return MovingChamber(self, number)


@dataclass(frozen=True, slots=True)
class MovingChamber:
    """One of the chambers of an actuator in motion.

    Parameters
    ----------
    actuator : MovingActuator
    number : int
        From 0.
    """

    actuator: MovingActuator
    number: int


@dataclass(frozen=True, slots=True, eq=False)
class FollowedVolume:
    """The volume of a chamber in motion over time, as far as it was followed; straight between the steps.

    Parameters
    ----------
    times : list of float [s]
    volumes : list of float [m³]
    """

    times: list[float] = field(default_factory=list)
    volumes: list[float] = field(default_factory=list)

    def _piece(self, time: float) -> int:
        return min(max(bisect_right(self.times, time) - 1, 0), len(self.times) - 2)

    def at(self, place: float, time: float) -> tuple[float, float, float, float]:
        """Pressure and volume; the coordinate is the gauge pressure."""
        if len(self.times) == 1:
            return place, self.volumes[0], 1.0, 0.0
        k = self._piece(time)
        return place, self.volumes[k] + self.rate(time) * (time - self.times[k]), 1.0, 0.0

    def rate(self, time: float) -> float:
        """Rate at which the volume changes [m³/s]."""
        if len(self.times) == 1:
            return 0.0
        k = self._piece(time)
        return (self.volumes[k + 1] - self.volumes[k]) / (self.times[k + 1] - self.times[k])

    def work(self, place: float, ambient: float) -> float:
        """No work of its own: that on the walls follows from the rate of the volume."""
        return 0.0

    def place(self, pressure: float, time: float) -> float:
        """The pressure itself."""
        return pressure

    def bounds(self, ambient: float) -> tuple[float, float]:
        """From vacuum up."""
        return -ambient, 1e10

    def outside(self, place: float) -> str:
        """Nothing lies outside: the range of the reduced model is checked in each step."""
        return ""
