"""Signals: pressures, commands and volumes over time, with the times at which they bend or jump."""

from bisect import bisect_right
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import inf, isfinite, pi, sin
from typing import TypeAlias

from turgor.foundation.errors import TurgorError
from turgor.systems.air.settings import SOLVER


@dataclass(frozen=True, slots=True)
class Signal:
    """Values over time, in steps or with straight lines between them; the last one stays.

    Parameters
    ----------
    times : sequence of float [s]
        In rising order; two may be equal for a jump between lines.
    values : sequence of float
    lines : bool
        Whether values change along straight lines; otherwise each stays until the next time.
    period : float [s], optional
        Time after which the signal repeats.

    Examples
    --------
    >>> push = Signal((0.0, 0.5), (1.0, -1.0))
    >>> push.at(0.2), push.at(0.5)
    (1.0, -1.0)
    >>> Signal((0.0, 2.0), (0.0, 50e3), lines=True).at(1.0)
    25000.0
    """

    times: Sequence[float]
    values: Sequence[float]
    lines: bool = False
    period: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "times", tuple(map(float, self.times)))
        object.__setattr__(self, "values", tuple(map(float, self.values)))
        if not self.times or len(self.times) != len(self.values):
            raise TurgorError(
                f"a signal has {len(self.times)} times and {len(self.values)} values; as many are needed, and one at "
                "least."
            )
        if not all(map(isfinite, (*self.times, *self.values))):
            raise TurgorError("a signal has a time or a value that is not finite.")
        for first, second in zip(self.times, self.times[1:], strict=False):
            if second < first or (second == first and not self.lines):
                raise TurgorError(f"times of a signal must rise; {second:g} s follows {first:g} s.")
        if self.period is not None and not self.times[-1] - self.times[0] <= self.period < inf:
            raise TurgorError(f"period of a signal is {self.period:g} s; it ends at {self.times[-1]:g} s.")

    def at(self, time: float) -> float:
        """Return the value at a time; before the first time it is the first value."""
        if self.period is not None:
            time = self.times[0] + (time - self.times[0]) % self.period
        k = bisect_right(self.times, time) - 1
        if k < 0:
            return self.values[0]
        if not self.lines or k == len(self.times) - 1:
            return self.values[k]
        share = (time - self.times[k]) / (self.times[k + 1] - self.times[k])
        return self.values[k] + share * (self.values[k + 1] - self.values[k])

    def slope(self, time: float) -> float:
        """Return the rate at a time."""
        if self.period is not None:
            time = self.times[0] + (time - self.times[0]) % self.period
        k = bisect_right(self.times, time) - 1
        if not self.lines or k < 0 or k == len(self.times) - 1:
            return 0.0
        return (self.values[k + 1] - self.values[k]) / (self.times[k + 1] - self.times[k])

    def breaks(self, until: float) -> list[float]:
        """Return the times before an end at which the signal bends or jumps."""
        if self.period is None:
            return [time for time in self.times if 0 < time < until]
        counts = range(_count((until - self.times[0]) / self.period) + 1)
        return [time for n in counts for each in self.times if 0 < (time := each + n * self.period) < until]


@dataclass(frozen=True, slots=True)
class Pwm:
    """Pulses of a fixed frequency: 1 for a share of each period, else 0.

    Parameters
    ----------
    frequency : float [Hz]
    duty : float or Signal [-]
        Share of each period, in [0, 1]; a signal is read where the period begins.

    Examples
    --------
    >>> pulses = Pwm(10.0, 0.25)
    >>> pulses.at(0.02), pulses.at(0.03), pulses.breaks(0.13)
    (1.0, 0.0, [0.025, 0.1, 0.125])
    """

    frequency: float
    duty: "float | Signal"

    def __post_init__(self) -> None:
        if not 0 < self.frequency < inf:
            raise TurgorError(f"frequency of pulses is {self.frequency:g} Hz; a positive number is needed.")
        values = self.duty.values if isinstance(self.duty, Signal) else (self.duty,)
        for value in values:
            if not 0 <= value <= 1:
                raise TurgorError(f"duty of pulses is {value:g}; allowed is 0 to 1.")

    def _duty(self, start: float) -> float:
        return self.duty.at(start) if isinstance(self.duty, Signal) else self.duty

    def at(self, time: float) -> float:
        """Return 1 or 0 at a time."""
        n = int(time * self.frequency + 1e-9)
        start = n / self.frequency
        return 1.0 if (time - start) * self.frequency < self._duty(start) - 1e-9 else 0.0

    def slope(self, time: float) -> float:
        """Return zero: pulses jump."""
        return 0.0

    def breaks(self, until: float) -> list[float]:
        """Return the switching times before an end."""
        starts = [n / self.frequency for n in range(_count(until * self.frequency) + 1)]
        times = [each for start in starts for each in (start, start + self._duty(start) / self.frequency)]
        return sorted({time for time in times if 0 < time < until})


@dataclass(frozen=True, slots=True)
class Sine:
    """A mean value with a sine: ``mean + amplitude sin(2π frequency t)``.

    Examples
    --------
    >>> round(Sine(50e3, 10e3, 1.0).at(0.25))
    60000
    """

    mean: float
    amplitude: float
    frequency: float

    def at(self, time: float) -> float:
        """Return the value at a time."""
        return self.mean + self.amplitude * sin(2 * pi * self.frequency * time)

    def slope(self, time: float) -> float:
        """Return the rate at a time."""
        w = 2 * pi * self.frequency
        return self.amplitude * w * sin(w * time + pi / 2)

    def breaks(self, until: float) -> list[float]:
        """Return no times: a sine is smooth."""
        return []


#: A number for a constant, or anything with ``at``, ``slope`` and ``breaks``.
AnySignal: TypeAlias = float | Signal | Pwm | Sine


def signal_of(value: AnySignal) -> Signal | Pwm | Sine:
    """Return a signal; a number is a constant one."""
    return value if isinstance(value, Signal | Pwm | Sine) else Signal((0.0,), (float(value),))


def values_in(value: AnySignal) -> Iterable[float]:
    """Return values between which a signal stays, to check them against a range."""
    each = signal_of(value)
    if isinstance(each, Sine):
        return (each.mean - abs(each.amplitude), each.mean + abs(each.amplitude))
    return each.values if isinstance(each, Signal) else (0.0, 1.0)


def switched(
    wanted: Callable[[float], bool], breaks: Iterable[float], on_delay: float, off_delay: float
) -> tuple[list[float], list[bool]]:
    """Return when a valve with delays is open: times, and whether it is open from each time on.

    A pulse that is shorter than the delays let it be has no effect.

    Parameters
    ----------
    wanted : callable
        Whether the command wants it open at a time.
    breaks : iterable of float [s]
        When the command may change.
    on_delay, off_delay : float [s]
        From the command until it is open, and until it is closed.

    Examples
    --------
    >>> switched(Pwm(10.0, 0.5).at, Pwm(10.0, 0.5).breaks(0.12), 0.01, 0.02)
    ([0.0, 0.01, 0.07, 0.11], [False, True, False, True])
    """
    times, states = [0.0], [False]
    for time in (0.0, *breaks):
        state = bool(wanted(time))
        at = round(time + (on_delay if state else off_delay), 15)
        while len(times) > 1 and at <= times[-1]:
            times.pop()
            states.pop()
        if state != states[-1]:
            times.append(at)
            states.append(state)
    if len(times) > 1 and times[1] == 0.0:
        return times[1:], states[1:]
    return times, states


def _count(number: float) -> int:
    if number > SOLVER.most_switches:
        raise TurgorError(f"a signal repeats {number:.3g} times; at most {SOLVER.most_switches} are integrated.")
    return int(number)
