"""Regulator: a valve that opens until the pressure behind it is that which is set."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import pi
from typing import ClassVar

from turgor.foundation.errors import TurgorError
from turgor.systems.air.parts.connection import Connection
from turgor.systems.air.parts.part import Around, Part, PartFlow, PartRates, Port
from turgor.systems.air.parts.passages import Passage
from turgor.systems.air.signals import AnySignal, Signal, Sine, signal_of


@dataclass(frozen=True, slots=True)
class Gate(Connection):
    """A passage that opens with the distance of a pressure from the one that is set.

    Parameters
    ----------
    start, end : str
    passage : Passage
    pressure : float or Signal [Pa], gauge
        Where it closes.
    band : float [Pa]
        Distance over which it opens fully.
    relieves : bool
        Whether it opens where the pressure at its start is too high, and not where that at its end is too low.
    order : int
        0 opens at once, 1 with a lag, 2 as an oscillator.
    frequency : float [Hz]
        Of the oscillator, or 1/(2π time constant).
    damping : float [-]
        Of the oscillator.
    """

    kind: ClassVar[str] = ""

    pressure: AnySignal
    band: float
    relieves: bool = False
    order: int = 0
    frequency: float = 0.0
    damping: float = 0.7

    def breaks(self, until: float) -> Sequence[float]:
        """Times at which the pressure that is set bends or jumps."""
        return signal_of(self.pressure).breaks(until)

    def _wanted(self, ambient: float) -> Callable[[float, Port, Port], float]:
        signal = signal_of(self.pressure)

        def wanted(time: float, a: Port, b: Port) -> float:
            level = ambient + signal.at(time)
            away = a[0] - level if self.relieves else level - b[0]
            return min(max(away / self.band, 0.0), 1.0)

        return wanted

    def first(self, around: Around) -> tuple[float, ...]:
        """Closed and at rest."""
        return (0.0,) * self.order

    def scales(self, around: Around) -> tuple[float, ...]:
        """1 for the opening, and its rate."""
        return (1.0, 2 * pi * self.frequency)[: self.order]

    def flow(self, around: Around) -> PartFlow:
        """Return the flow through the opening."""
        through, wanted = Connection.flow(self, around), self._wanted(around.ambient)

        def flow(time: float, own: Sequence[float], a: Port, b: Port) -> float:
            opening = min(max(own[0], 0.0), 1.0) if own else wanted(time, a, b)
            return opening * through(time, own, a, b) if opening else 0.0

        return flow

    def rates(self, around: Around) -> PartRates | None:
        """The opening follows what is wanted."""
        wanted, w = self._wanted(around.ambient), 2 * pi * self.frequency
        if self.order == 1:
            return lambda time, own, a, b: (w * (wanted(time, a, b) - own[0]),)
        if self.order == 2:
            return lambda time, own, a, b: (
                own[1],
                w * w * (wanted(time, a, b) - own[0]) - 2 * self.damping * w * own[1],
            )
        return None


@dataclass(frozen=True, slots=True)
class Regulator(Part):
    """A pressure regulator of order 0, 1 or 2 with limited flow; one with an exhaust relieves.

    It opens in proportion to the missing pressure, fully where ``band`` is missing. It is closed from the set pressure
    on, and relieves from ``dead_band`` above it on.

    Parameters
    ----------
    start, end : str
        Flow from start to end.
    passage : Restriction or Orifice
        What it is when it is open: this limits the flow.
    pressure : float or Signal [Pa], gauge
        Set pressure at the end.
    band : float [Pa]
        Missing pressure at which it is fully open: its droop at full flow.
    exhaust : str, optional
        Where it relieves to; it does not by default.
    dead_band : float [Pa]
        Pressure above the set one from which it relieves.
    order : int
        0, 1 or 2.
    frequency : float [Hz]
        Of its dynamics, where the order is 1 or 2.
    damping : float [-]
        Of order 2.
    """

    kind: ClassVar[str] = "regulator"

    passage: Passage
    pressure: AnySignal = field(metadata={"dimension": "pressure"})
    band: float = field(default=5e3, metadata={"dimension": "pressure"})
    exhaust: str | None = None
    dead_band: float = field(default=1e3, metadata={"dimension": "pressure"})
    order: int = 0
    frequency: float = field(default=10.0, metadata={"dimension": "frequency"})
    damping: float = 0.7

    def __post_init__(self) -> None:
        for name in ("band", "frequency"):
            if not getattr(self, name) > 0:
                raise TurgorError(f"{name} of a regulator is {getattr(self, name):g}; allowed is more than 0.")
        if self.order not in (0, 1, 2):
            raise TurgorError(f"order of a regulator is {self.order}; allowed is 0, 1 or 2.")
        for name in ("dead_band", "damping"):
            if not getattr(self, name) >= 0:
                raise TurgorError(f"{name} of a regulator is {getattr(self, name):g}; allowed is 0 or more.")

    @property
    def ends(self) -> tuple[str, ...]:
        """Start, end, and the exhaust of one that relieves."""
        return (self.start, self.end) if self.exhaust is None else (self.start, self.end, self.exhaust)

    def parts(self, name: str) -> Mapping[str, Part]:
        """A gate that fills, and one that relieves."""
        how = (self.order, self.frequency, self.damping)
        fill = Gate(self.start, self.end, self.passage, self.pressure, self.band, False, *how)
        if self.exhaust is None:
            return {name: fill}
        signal = signal_of(self.pressure)
        level: AnySignal = _raised(signal, self.dead_band)
        relief = Gate(self.end, self.exhaust, self.passage, level, self.band, True, *how)
        return {f"{name}_fill": fill, f"{name}_vent": relief}

    def widened(self, factor: float) -> "Regulator":
        """Return it with a wider passage."""
        return replace(self, passage=self.passage.widened(factor))


def _raised(signal: AnySignal, by: float) -> AnySignal:
    """Return a signal that is higher by a constant."""
    if isinstance(signal, Sine):
        return replace(signal, mean=signal.mean + by)
    if isinstance(signal, Signal):
        return replace(signal, values=tuple(value + by for value in signal.values))
    raise TurgorError(f"pressure of a regulator is {signal!r}; a number, points or a sine is needed.")
