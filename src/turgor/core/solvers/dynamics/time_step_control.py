"""Time step control: how long the next step is, from the error of the last one."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from turgor.core.solvers.continuation.settings import STEP_CONTROL
from turgor.core.solvers.dynamics.settings import TIME_STEP_CONTROL
from turgor.core.solvers.procedures.time_options import TimeOptions


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeControl:
    """Length of the next step and the times still to be hit [s]."""

    length: float
    max_step: float
    min_step: float
    accuracy: float
    adaptive: bool
    targets: tuple[float, ...]

    @staticmethod
    def of(procedure: TimeOptions, kinks: Sequence[float] = ()) -> "TimeControl":
        """Start as requested, and hit the kinks of the load histories too.

        Examples
        --------
        >>> from turgor.core.solvers.procedures.dynamic import Dynamic
        >>> TimeControl.of(Dynamic(duration=2.0, at=(0.25,)), kinks=(0.5,)).targets
        (0.5, 1.0, 2.0)
        """
        first, longest, shortest = procedure.step_bounds
        targets = sorted({factor * procedure.duration for factor in (*procedure.at, *kinks)} | {procedure.duration})
        return TimeControl(
            length=first,
            max_step=longest,
            min_step=shortest,
            accuracy=procedure.accuracy,
            adaptive=procedure.adaptive,
            targets=tuple(targets),
        )

    def next_time(self, time: float) -> float:
        """Return the time to try next: one step on, or the next target exactly.

        Examples
        --------
        >>> from turgor.core.solvers.procedures.dynamic import Dynamic
        >>> control = TimeControl.of(Dynamic(duration=1.0, first_step=0.3, max_step=0.3))
        >>> control.next_time(0.0), control.next_time(0.4), control.next_time(0.7)
        (0.3, 0.7, 1.0)
        """
        target = next(t for t in self.targets if t > time)
        remaining = target - time
        if remaining <= TIME_STEP_CONTROL.stretch * self.length:
            return target
        return time + (remaining / 2 if self.adaptive and remaining < 2 * self.length else self.length)

    def failed(self, length: float) -> "TimeControl | None":
        """Cut the step; None when it would fall below the shortest."""
        shorter = STEP_CONTROL.step_cut * length
        return None if shorter < self.min_step else replace(self, length=shorter)

    def after(self, length: float, error: float) -> tuple["TimeControl", bool]:
        """Choose the next length from the relative error of a step, and whether that step is rejected.

        Examples
        --------
        >>> from turgor.core.solvers.procedures.dynamic import Dynamic
        >>> control = TimeControl.of(Dynamic(duration=1.0, first_step=0.01, max_step=0.1, accuracy=1e-3))
        >>> longer, taken_back = control.after(0.01, 1e-4)
        >>> round(longer.length, 6), taken_back
        (0.015, False)
        >>> shorter, taken_back = control.after(0.01, 8e-3)
        >>> round(shorter.length, 6), taken_back
        (0.0045, True)
        """
        if not self.adaptive:
            return self, False
        factor = TIME_STEP_CONTROL.grow
        if error > 0:
            factor = min(factor, TIME_STEP_CONTROL.safety * (self.accuracy / error) ** (1 / 3))
        taken_back = error > TIME_STEP_CONTROL.taken_back * self.accuracy and length * factor >= self.min_step
        if TIME_STEP_CONTROL.steady[0] < factor < TIME_STEP_CONTROL.steady[1] and not taken_back:
            return self, False
        reference = max(length, self.length) if factor >= 1 and not taken_back else length
        return replace(self, length=min(self.max_step, max(self.min_step, factor * reference))), taken_back
