"""Rigid: a vessel whose volume does not depend on its pressure, though a plunger may change it in time."""

from dataclasses import dataclass
from math import inf

from turgor.foundation.errors import TurgorError
from turgor.systems.air.signals import AnySignal, signal_of, values_in


@dataclass(frozen=True, slots=True)
class Rigid:
    """A rigid vessel, or the barrel of a syringe where the volume is a signal.

    Parameters
    ----------
    volume : float or Signal [m³]

    Examples
    --------
    >>> Rigid(18e-6).at(50e3, 0.0)
    (50000.0, 1.8e-05, 1.0, 0.0)
    """

    volume: AnySignal

    def __post_init__(self) -> None:
        for value in values_in(self.volume):
            if not 0 < value < inf:
                raise TurgorError(f"volume is {value:g} m³; a positive number is needed.")

    def at(self, place: float, time: float) -> tuple[float, float, float, float]:
        """Pressure and volume; the coordinate is the gauge pressure."""
        volume = self.volume if isinstance(self.volume, float) else signal_of(self.volume).at(time)
        return place, volume, 1.0, 0.0

    def work(self, place: float, ambient: float) -> float:
        """No work: the volume does not follow from the pressure."""
        return 0.0

    def place(self, pressure: float, time: float) -> float:
        """The pressure itself."""
        return pressure

    def bounds(self, ambient: float) -> tuple[float, float]:
        """From vacuum up."""
        return -ambient, 1e10

    def rate(self, time: float) -> float:
        """Rate at which a plunger changes the volume [m³/s]."""
        return 0.0 if isinstance(self.volume, float) else signal_of(self.volume).slope(time)

    def outside(self, place: float) -> str:
        """Nothing lies outside."""
        return ""
