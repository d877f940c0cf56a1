"""Valves: passages that a command opens."""

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar

from turgor.foundation.errors import TurgorError
from turgor.systems.air.parts.connection import Connection
from turgor.systems.air.parts.part import Around, Part, PartFlow, PartRates, Port
from turgor.systems.air.parts.passages import Passage
from turgor.systems.air.signals import AnySignal, signal_of, switched, values_in


@dataclass(frozen=True, slots=True)
class OnOffValve(Connection):
    """A valve that is open or closed, with delays.

    Parameters
    ----------
    start, end : str
    passage : Restriction or Orifice
        What it is when it is open.
    command : float, Signal or Pwm
        More than 0.5 opens it. It is closed before the start.
    on_delay, off_delay : float [s]
        From the command until it is open, and until it is closed. Shorter pulses have no effect.
    sign : float
        −1 where a command of less than −0.5 opens it instead.
    """

    kind: ClassVar[str] = "on_off_valve"

    command: AnySignal = field(metadata={"signal": "steps"})
    on_delay: float = field(default=0.0, metadata={"dimension": "time"})
    off_delay: float = field(default=0.0, metadata={"dimension": "time"})
    sign: float = 1.0

    def __post_init__(self) -> None:
        for name in ("on_delay", "off_delay"):
            if not 0 <= getattr(self, name) < 3600:
                raise TurgorError(f"{name} of a valve is {getattr(self, name):g} s; allowed is 0 or more.")

    @property
    def open_ever(self) -> bool:
        """Whether any command opens it."""
        return any(self.sign * value > 0.5 for value in values_in(self.command))

    def _switches(self, until: float) -> tuple[list[float], list[bool]]:
        signal = signal_of(self.command)
        return switched(
            lambda time: self.sign * signal.at(time) > 0.5, signal.breaks(until), self.on_delay, self.off_delay
        )

    def breaks(self, until: float) -> Sequence[float]:
        """Times at which it opens or closes."""
        return self._switches(until)[0]

    def flow(self, around: Around) -> PartFlow:
        """Return the flow while it is open."""
        through = Connection.flow(self, around)
        times, states = self._switches(around.until)

        def flow(time: float, own: Sequence[float], a: Port, b: Port) -> float:
            return through(time, own, a, b) if states[max(bisect_right(times, time) - 1, 0)] else 0.0

        return flow


@dataclass(frozen=True, slots=True)
class ProportionalValve(Connection):
    """A valve that a command opens in part.

    Parameters
    ----------
    start, end : str
    passage : Restriction or Orifice
        What it is when it is open.
    command : float, Signal or Sine [-]
        0 closes it, 1 opens it.
    time_constant : float [s]
        Lag of first order between command and opening.
    dead_band : float [-]
        Command up to which it stays closed, in [0, 1).
    sign : float
        −1 where negative commands open it instead.
    """

    kind: ClassVar[str] = "proportional_valve"

    command: AnySignal = field(metadata={"signal": "lines"})
    time_constant: float = field(default=0.0, metadata={"dimension": "time"})
    dead_band: float = 0.0
    sign: float = 1.0

    def __post_init__(self) -> None:
        if not 0 <= self.time_constant < 3600:
            raise TurgorError(f"time_constant of a valve is {self.time_constant:g} s; allowed is 0 or more.")
        if not 0 <= self.dead_band < 1:
            raise TurgorError(f"dead_band of a valve is {self.dead_band:g}; allowed is 0 or more and less than 1.")

    @property
    def open_ever(self) -> bool:
        """Whether any command opens it."""
        return any(self.sign * value > self.dead_band for value in values_in(self.command))

    def _wanted(self) -> Callable[[float], float]:
        signal = signal_of(self.command)

        def wanted(time: float) -> float:
            return min(max((self.sign * signal.at(time) - self.dead_band) / (1 - self.dead_band), 0.0), 1.0)

        return wanted

    def breaks(self, until: float) -> Sequence[float]:
        """Times at which the command bends or jumps."""
        return signal_of(self.command).breaks(until)

    def first(self, around: Around) -> tuple[float, ...]:
        """Its opening: that of the first command."""
        return (self._wanted()(0.0),) if self.time_constant else ()

    def flow(self, around: Around) -> PartFlow:
        """Return the share of the flow that its opening lets through."""
        through, wanted = Connection.flow(self, around), self._wanted()

        def flow(time: float, own: Sequence[float], a: Port, b: Port) -> float:
            return (own[0] if own else wanted(time)) * through(time, own, a, b)

        return flow

    def rates(self, around: Around) -> PartRates | None:
        """The opening follows the command."""
        wanted = self._wanted()
        return (lambda time, own, a, b: ((wanted(time) - own[0]) / self.time_constant,)) if self.time_constant else None


@dataclass(frozen=True, slots=True)
class ThreeWayValve(Part):
    """A 3/3 valve: 1 fills from the supply, 0 closes, −1 vents to the exhaust.

    Parameters
    ----------
    start : str
        The supply.
    end : str
        What it fills.
    passage : Restriction or Orifice
        From the supply to the end, when it is open.
    command : float, Signal or Sine
        From −1 to 1.
    exhaust : str
        Where it vents to.
    vent : Restriction or Orifice, optional
        From the end to the exhaust; as ``passage`` by default.
    on_delay, off_delay : float [s]
        Of both ways.
    proportional : bool
        Whether it opens in proportion to the command, and not fully beyond ±0.5.
    time_constant : float [s]
        Lag of a proportional one.
    """

    kind: ClassVar[str] = "three_way_valve"

    passage: Passage
    command: AnySignal = field(metadata={"signal": "steps"})
    exhaust: str = "ambient"
    vent: Passage | None = None
    on_delay: float = field(default=0.0, metadata={"dimension": "time"})
    off_delay: float = field(default=0.0, metadata={"dimension": "time"})
    proportional: bool = False
    time_constant: float = field(default=0.0, metadata={"dimension": "time"})

    def __post_init__(self) -> None:
        self.parts("")

    @property
    def ends(self) -> tuple[str, ...]:
        """Supply, end and exhaust."""
        return (self.start, self.end, self.exhaust)

    @property
    def open_ever(self) -> bool:
        """Whether any command opens a way."""
        return any(part.open_ever for part in self.parts("").values())

    def parts(self, name: str) -> Mapping[str, Part]:
        """Two valves, one for each way."""
        vent = self.vent or self.passage
        ways = {"fill": (self.start, self.end, self.passage, 1.0), "vent": (self.end, self.exhaust, vent, -1.0)}
        if self.proportional:
            return {
                f"{name}_{way}": ProportionalValve(*it[:3], self.command, self.time_constant, 0.0, it[3])
                for way, it in ways.items()
            }
        return {
            f"{name}_{way}": OnOffValve(*it[:3], self.command, self.on_delay, self.off_delay, it[3])
            for way, it in ways.items()
        }

    def widened(self, factor: float) -> "ThreeWayValve":
        """Return it with wider ways."""
        vent = None if self.vent is None else self.vent.widened(factor)
        return replace(self, passage=self.passage.widened(factor), vent=vent)
