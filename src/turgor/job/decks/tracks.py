"""Tracks: what the steps of a deck prescribe, each as points of time and value."""

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.meshing.exchange.formats.raw import numbers
from turgor.core.model.history import RAMP, History
from turgor.foundation.errors import TurgorError, unknown
from turgor.job.decks.deck import words_of

#: Points of time [s] and value.
Points = tuple[tuple[float, float], ...]

#: Kinds of targets: what stands first in their keys.
FORCE, PRESSURE, GRAVITY, SHIFT, TRACTION, HEAT = "force", "pressure", "gravity", "shift", "traction", "heat"
SPIN = "spin"

#: Difference of shares, and of times as a share of a step, that is round-off of the digits of a deck.
SAME = 1e-9


#: Supports with a name instead of degrees of freedom.
_NAMED = {
    "ENCASTRE": (1, 2, 3), "PINNED": (1, 2, 3), "XSYMM": (1,), "YSYMM": (2,), "ZSYMM": (3,), "XASYMM": (2, 3),
    "YASYMM": (1, 3), "ZASYMM": (1, 2),
}  # fmt: skip

#: Share of the whole time in which a sudden load rises where a deck has inertia: motion of turgor begins in equilibrium
#: with the loads that are there, that of a deck in the shape of its mesh.
SUDDEN = 1e-4


@dataclass(frozen=True, slots=True, kw_only=True)
class Amplitude:
    """An amplitude of a deck: points of time and factor."""

    points: Points
    total: bool

    def factor(self, time: float) -> float:
        """Factor at a time of the step, or of all steps."""
        times, factors = np.array(self.points).T
        return float(np.interp(time, times, factors))


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """Time [s] of one step, counted through all steps, and whether its loads are there at once."""

    start: float
    end: float
    at_once: bool = False


@dataclass(slots=True)
class Track:
    """What one target, such as the pressure on a side, has been given so far."""

    points: list[tuple[float, float]]
    value: float = 0.0
    amplitude: Amplitude | None = None

    def follow(self, span: Span, stated: tuple[float, Amplitude | None] | None) -> None:
        """Go through a step, with a value and an amplitude that it states, or on with what was stated before."""
        if stated is not None:
            self.value, self.amplitude = stated
        last = self.points[-1][1]
        amplitude = self.amplitude
        if amplitude is not None and (stated is not None or amplitude.total):
            self._sample(span, amplitude)
        elif stated is None:
            self.points.append((span.end, last))
        elif span.at_once:
            self._jump(span)
        else:
            self.points.append((span.end, self.value))

    def _jump(self, span: Span) -> None:
        if span.start > 0 and abs(self.points[-1][1] - self.value) > 0:
            raise TurgorError("a load that jumps between two steps has no form here; let it ramp.")
        self.points[-1] = (span.start, self.value)
        self.points.append((span.end, self.value))

    def _sample(self, span: Span, amplitude: Amplitude) -> None:
        shift = 0.0 if amplitude.total else span.start
        first = self.value * amplitude.factor(span.start - shift)
        if span.start == 0:
            self.points[-1] = (0.0, first)
        elif abs(first - self.points[-1][1]) > SAME * max(1.0, abs(first)):
            raise TurgorError("a load that jumps between two steps has no form here; let its amplitude begin there.")
        inner = [time + shift for time, _ in amplitude.points if span.start < time + shift < span.end]
        self.points += [(t, self.value * amplitude.factor(t - shift)) for t in (*inner, span.end)]

    def rise(self) -> None:
        """Let what is there from the start rise from zero in a short time."""
        first = self.points[0][1]
        if first:
            self.points[:1] = [(0.0, 0.0), (SUDDEN * self.points[-1][0], first)]

    def history(self) -> tuple[float, History]:
        """The value of largest size, and the history of the shares of it over the load factor."""
        end = self.points[-1][0]
        largest = max((value for _, value in self.points), key=abs)
        if not largest:
            return 0.0, RAMP
        shares = [(time / end, value / largest) for time, value in self.points]
        return largest, _straightened(shares)


def _straightened(shares: Sequence[tuple[float, float]]) -> History:
    """Points without those on the straight line between their neighbors, rising in time."""
    points: list[tuple[float, float]] = []
    for s, share in shares:
        if points and s - points[-1][0] <= SAME:
            raise TurgorError("an amplitude with two values at one time has no form here; let it take a little time.")
        while len(points) > 1:
            (a, first), (b, middle) = points[-2:]
            if abs(first + (share - first) * (b - a) / (s - a) - middle) > SAME:
                break
            points.pop()
        points.append((s, share))
    return tuple((round(s, 12), round(share, 12)) for s, share in points)


@dataclass(slots=True)
class Tracks:
    """All that the steps prescribe, by target."""

    of: dict[Hashable, Track] = field(default_factory=dict)
    keywords: dict[Hashable, Keyword] = field(default_factory=dict)
    pending: dict[Hashable, tuple[float, Amplitude | None]] = field(default_factory=dict)

    def state(self, target: Hashable, value: float, amplitude: Amplitude | None, keyword: Keyword) -> None:
        """State the value of a target in the present step; a second force on a node in the same step adds to it."""
        before = self.pending.get(target)
        adds = before is not None and isinstance(target, tuple) and target[0] == FORCE
        self.pending[target] = (value + (before[0] if before and adds else 0.0), amplitude)
        self.keywords[target] = keyword

    def end_all(self, kind: str) -> None:
        """End all targets of a kind that the present step does not state again, as ``OP=NEW`` does."""
        for target in self.of:
            if isinstance(target, tuple) and target[0] == kind:
                self.pending.setdefault(target, (0.0, None))

    def follow(self, span: Span) -> None:
        """Go through a step with all targets."""
        for target in self.pending:
            if target not in self.of:
                points = [(0.0, 0.0)] if span.start == 0 else [(0.0, 0.0), (span.start, 0.0)]
                self.of[target] = Track(points)
        for target, track in self.of.items():
            try:
                track.follow(span, self.pending.get(target))
            except TurgorError as error:
                keyword = self.keywords[target]
                raise TurgorError(f"'{keyword.path}', line {keyword.line}: {error}") from None
        self.pending.clear()


def amplitudes_of(keyword: Keyword) -> Amplitude:
    """Read an amplitude.

    Raises
    ------
    TurgorError
        If it is no table of factors.
    """
    kind = keyword.given.get("definition", "tabular").lower()
    if kind != "tabular":
        raise TurgorError(f"an amplitude by DEFINITION={kind.upper()} has no form here; give a table.")
    if keyword.given.get("value", "relative").lower() != "relative":
        raise TurgorError("an amplitude of absolute values has no form here; give factors.")
    values = [value for line in keyword.lines for value in numbers(line, keyword.path, "an amplitude")]
    pairs = tuple(zip(values[0::2], values[1::2], strict=False))
    if not pairs:
        raise TurgorError("the amplitude has no points.")
    return Amplitude(points=pairs, total=keyword.given.get("time", "step time").lower().startswith("total"))


def amplitude_named(keyword: Keyword, amplitudes: Mapping[str, Amplitude]) -> Amplitude | None:
    """Return the amplitude that a load names; None where it names none."""
    name = keyword.given.get("amplitude")
    if name is None:
        return None
    if name.lower() not in amplitudes:
        raise unknown("amplitude", name, amplitudes)
    return amplitudes[name.lower()]


def mass_target(label: str, values: Sequence[str]) -> Hashable:
    """Return the target of gravity, or of a centrifugal force: what it states besides its size."""
    parts = tuple(float(part or 0) for part in values[1:])
    if label == "CENTRIF":
        return SPIN, parts[:3], parts[3:6]
    return GRAVITY, parts[:3] if len(parts) > 2 else (0.0, 0.0, -1.0)


def boundary_row(line: str) -> tuple[str, float, tuple[int, ...]]:
    """Return the nodes, the value and the degrees of freedom that a line of ``*BOUNDARY`` states."""
    where, first, *rest = words_of(line)
    if first.upper() in _NAMED:
        return where, 0.0, _NAMED[first.upper()]
    last = int(rest[0]) if rest and rest[0] else int(first)
    return where, float(rest[1]) if len(rest) > 1 else 0.0, tuple(range(int(first), last + 1))
