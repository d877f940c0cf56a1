"""Nodes: where fluid is stored, at one pressure and one temperature."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol, TypeAlias

from turgor.foundation.errors import TurgorError, unknown
from turgor.systems.air.signals import AnySignal, signal_of
from turgor.systems.air.volumes.coupled import CoupledChamber
from turgor.systems.air.volumes.law import Law
from turgor.systems.air.volumes.moving import MovingChamber
from turgor.systems.air.volumes.rigid import Rigid

#: How the temperature of a gas changes: by name, or the exponent n of p/ρⁿ = constant.
PROCESSES = ("adiabatic", "isentropic", "isothermal")

#: Volume of a chamber: a number for a rigid one.
Volume: TypeAlias = float | Law | CoupledChamber | MovingChamber


class Node(Protocol):
    """A place with a pressure."""

    def breaks(self, until: float) -> Sequence[float]:
        """Times at which what is prescribed bends or jumps."""


@dataclass(frozen=True, slots=True)
class Supply:
    """A pressure that is prescribed, whatever flows: a compressor with a large reservoir, or a vacuum.

    Parameters
    ----------
    pressure : float or Signal [Pa], gauge
        What it is, whatever flows.
    temperature : float, optional [K]
        That of the network by default.

    Examples
    --------
    >>> Supply(200e3).breaks(1.0)
    []
    """

    pressure: AnySignal = field(metadata={"dimension": "pressure"})
    temperature: float | None = field(default=None, metadata={"dimension": "temperature"})

    def breaks(self, until: float) -> Sequence[float]:
        """Times at which the pressure bends or jumps."""
        return signal_of(self.pressure).breaks(until)


@dataclass(frozen=True, slots=True)
class Chamber:
    """A chamber that stores fluid: the cavity of an actuator, a reservoir, a junction or the barrel of a syringe.

    Parameters
    ----------
    volume : float [m³], tg.air.VolumeCurve, Rigid, CoupledChamber, MovingChamber or None
        A number is a rigid vessel. A junction of tubes has None: its volume is half of that of each tube.
    pressure : float [Pa], gauge
        At the start.
    process : str or float
        Of a gas: ``"isothermal"`` keeps its temperature (slow), ``"isentropic"`` keeps p/ρ^γ, a number n keeps p/ρⁿ,
        and ``"adiabatic"`` follows from the energy of what flows in and out.
    heat : float [W/K]
        Heat conductance to the air around of an adiabatic one.
    temperature : float, optional [K]
        At the start; that of the network by default.

    Examples
    --------
    >>> Chamber(18e-6).process
    'isothermal'
    """

    volume: Volume | None
    pressure: float = field(default=0.0, metadata={"dimension": "pressure"})
    process: str | float = "isothermal"
    heat: float = field(default=0.0, metadata={"dimension": "heat conductance"})
    temperature: float | None = field(default=None, metadata={"dimension": "temperature"})

    def __post_init__(self) -> None:
        if isinstance(self.process, str) and self.process not in PROCESSES:
            raise unknown("process", self.process, PROCESSES)
        if not isinstance(self.process, str) and not 1 <= self.process <= 2:
            raise TurgorError(f"process is {self.process:g}; an exponent from 1 to 2 is needed.")
        if not self.heat >= 0:
            raise TurgorError(f"heat is {self.heat:g} W/K; allowed is 0 or more.")
        if isinstance(self.volume, CoupledChamber) and self.process == "adiabatic":
            raise TurgorError(
                "process of a coupled chamber is adiabatic; isothermal, isentropic or an exponent is needed."
            )
        if isinstance(self.volume, int | float):
            object.__setattr__(self, "volume", Rigid(float(self.volume)))

    @property
    def law(self) -> Law | CoupledChamber | MovingChamber | None:
        """Its volume as a law."""
        assert not isinstance(self.volume, int | float)  # replaced above
        return self.volume

    def with_rigid(self, volume: float) -> "Chamber":
        """Return a junction with a volume."""
        return replace(self, volume=Rigid(volume))

    def breaks(self, until: float) -> Sequence[float]:
        """Times at which a plunger changes its speed."""
        return signal_of(self.volume.volume).breaks(until) if isinstance(self.volume, Rigid) else ()


def junction(volume: float | None = None) -> Chamber:
    """Return a place where parts meet: half of the volume of each tube there, and what is given.

    Examples
    --------
    >>> junction().volume is None
    True
    """
    return Chamber(volume)


def syringe(volume: AnySignal, pressure: float = 0.0) -> Chamber:
    """Return the barrel of a syringe whose plunger changes its volume over time.

    Parameters
    ----------
    volume : Signal [m³]
    pressure : float [Pa], gauge
        At the start.

    Examples
    --------
    >>> from turgor.systems.air.signals import Signal
    >>> syringe(Signal((0.0, 1.0), (20e-6, 5e-6), lines=True)).breaks(2.0)
    [1.0]
    """
    return Chamber(Rigid(volume), pressure)
