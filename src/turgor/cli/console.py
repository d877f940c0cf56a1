"""Console: progress of a job line by line, for files and pipes; `turgor.cli.live` has the bar of a terminal."""

import os
import sys
from collections import deque
from collections.abc import Sequence
from math import pi
from time import perf_counter
from typing import Protocol, Self

from turgor.cli.exits import write_nowhere
from turgor.errors import TurgorError
from turgor.finding import Finding
from turgor.results.measures.measures import bending_angle
from turgor.solvers.pressures import pressure_text
from turgor.solvers.solution import Iteration, State
from turgor.units import deg

#: Number of last accepted steps for the estimate of the remaining time; only a few, because steps grow along a path.
RECENT_STEPS = 4


#: Variables by which rich takes a file or a pipe for a terminal.
AS_TERMINAL = ("FORCE_COLOR", "TTY_COMPATIBLE")


class Lines(Protocol):
    """What lines are written to: a console of rich is one, too."""

    def out(self, text: str, *, highlight: bool) -> None:
        """Write a line."""


class PlainConsole:
    """A console of lines whose reader may go away, as in ``turgor run job.toml | head``: the run goes on in silence.

    Parameters
    ----------
    quiet : bool
        Whether nothing is written.
    """

    def __init__(self, quiet: bool = False) -> None:
        self.quiet = quiet

    def out(self, text: str, *, highlight: bool = False) -> None:
        """Write a line, in which nothing is ever highlighted."""
        if self.quiet:
            return
        try:
            print(text, flush=True)
        except BrokenPipeError:
            self.quiet = True
            write_nowhere()


def may_be_terminal() -> bool:
    """Whether standard output may be a terminal, so that rich, which takes a while to load, has to be asked."""
    return sys.stdout.isatty() or any(os.environ.get(name) for name in AS_TERMINAL)


class Course:
    """Progress of a solve: bending angle and remaining time, from the calls of `solve`."""

    def __init__(self) -> None:
        self.angle: float | None = None
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
        try:
            angle = bending_angle(state)
        except TurgorError:
            return  # an actuator without a tip has no bending angle
        turns = 0.0 if self.angle is None else round((self.angle - angle) / (2 * pi))
        self.angle = angle + 2 * pi * turns

    @property
    def seconds_left(self) -> float | None:
        """Remaining time at the speed of the last steps [s]; None before the first accepted step."""
        if len(self._accepted) < 2:
            return None
        (before, began), (now, last) = self._accepted[0], self._accepted[-1]
        if now <= before:
            return None  # beyond a limit point the load falls, so it does not show the remaining length of the path
        left = (1 - now) * (last - began) / (now - before) - (perf_counter() - last)
        return max(left, 0.0)


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


class PlainDisplay:
    """Display for files and pipes: one line for each notice and each accepted step."""

    def __init__(self, console: Lines) -> None:
        self.told: list[Finding] = []
        self._console = console
        self._course = Course()
        self._began = perf_counter()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Do nothing; there is no bar to remove."""

    def notify(self, text: str) -> None:
        """Print a notice."""
        self._line(text)

    def progress(self, iteration: Iteration, state: State | None) -> None:
        """Write a line for an accepted or a rejected step."""
        self._course.follow(state)
        if iteration.rejected is not None:
            self._line(f"{of_stage(self._course.stage)}{cut_back(iteration)}")
        if state is None:
            return
        left = clock(self._course.seconds_left)
        self._line(f"{describe(iteration, state)}{bending(self._course.angle)}, {left} left")

    def found(self, finding: Finding) -> None:
        """Print a finding on standard error, also where notices are off."""
        self.told.append(finding)
        print(finding, file=sys.stderr, flush=True)

    def _line(self, text: str) -> None:
        self._console.out(f"[{clock(perf_counter() - self._began):>5}] {text}", highlight=False)


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
    >>> from turgor.solvers.reasons import Cause, Reason
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


def bending(angle: float | None) -> str:
    """Write a bending angle [rad] as the end of a line, or nothing.

    Examples
    --------
    >>> bending(0.5), bending(None)
    (', bending 28.65 deg', '')
    """
    return "" if angle is None else f", bending {angle / deg:.2f} deg"
