"""Course: how far a solve has come, in numbers and in words."""

from collections import deque
from collections.abc import Sequence
from time import perf_counter

from turgor.core.solvers.pressures import pressure_text
from turgor.core.solvers.solution import Iteration, State

#: Number of last accepted steps for the estimate of the remaining time; only a few, because steps grow along a path.
RECENT_STEPS = 4


class Course:
    """Progress of a solve: load factor, stage and remaining time, from the calls of `solve`."""

    def __init__(self) -> None:
        self.load_factor = 0.0
        self.stage = ""
        self._accepted: deque[tuple[float, float]] = deque(maxlen=RECENT_STEPS + 1)

    def follow(self, state: State | None) -> None:
        """Record an iteration, and the state if a step was accepted."""
        if not self._accepted:  # the clock starts with the first iteration, which excludes the compilation
            self._accepted.append((0.0, perf_counter()))
        if state is None:
            return
        self.load_factor = state.load_factor
        if state.stage != self.stage:  # a new stage begins at load factor 0
            self.stage = state.stage
            self._accepted.clear()
        self._accepted.append((state.load_factor, perf_counter()))

    @property
    def words(self) -> tuple[str, ...]:
        """Further remarks on the last state."""
        return ()

    @property
    def seconds_left(self) -> float | None:
        """Remaining time at the speed of the last steps [s]; None before the first accepted step."""
        if len(self._accepted) < 2:
            return None
        (before, began), (now, last) = self._accepted[0], self._accepted[-1]
        if now <= before:
            return None  # beyond a limit point the load falls, so it does not show the remaining length of the path
        remaining = (1 - now) * (last - began) / (now - before) - (perf_counter() - last)
        return max(remaining, 0.0)


def clock(seconds: float | None) -> str:
    """Write a duration as minutes and seconds.

    Examples
    --------
    >>> clock(75.4), clock(3700), clock(None)
    ('1:15', '1:01:40', '-:--')
    """
    if seconds is None:
        return "-:--"
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


def fitting(parts: Sequence[str], width: int, alternatives: bool = False) -> str:
    """Join as many parts as fit into a width, or return the first of alternatives that does.

    Examples
    --------
    >>> fitting(["step 6", "iteration 3", "residual 1e-05"], 20)
    'step 6, iteration 3'
    >>> fitting(["load factor 0.412", "0.412"], 10, alternatives=True)
    '0.412'
    """
    if alternatives:
        return next((part for part in parts if len(part) <= width), parts[-1])
    counts = range(len(parts), 0, -1)
    return next((text for count in counts if len(text := ", ".join(parts[:count])) <= width), "")


def describe(iteration: Iteration, state: State) -> str:
    """Write one accepted step in words."""
    pressures = pressure_text(state)
    load = f", {pressures}" if pressures else ""
    work = f"{iteration.iteration} iterations, residual {iteration.residual:.1e}"
    return f"{of_stage(state.stage)}step {iteration.step}: load factor {state.load_factor:.4f}{load}, {work}"


def cut_back(iteration: Iteration) -> str:
    """Write one rejected step in words.

    Examples
    --------
    >>> from turgor.core.solvers.step_reasons import Cause, Reason
    >>> cut_back(Iteration(step=6, iteration=15, load_factor=0.4, residual=1.0, correction=0.0, step_length=1.0,
    ...                    rejected=Reason(Cause.TOO_MANY_ITERATIONS, 15)))
    'step 6 cut back: no convergence in 15 iterations at load factor 0.4000'
    """
    return f"step {iteration.step} cut back: {iteration.rejected} at load factor {iteration.load_factor:.4f}"


def of_stage(name: str) -> str:
    """Write the name of a stage before what happens in it.

    Examples
    --------
    >>> of_stage("fill"), of_stage("")
    ('fill, ', '')
    """
    return f"{name}, " if name else ""
