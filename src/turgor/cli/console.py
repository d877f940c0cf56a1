"""Console: progress of a job line by line, for files and pipes; `turgor.cli.live` has the bar of a terminal."""

import os
import sys
from math import pi
from time import perf_counter
from typing import Protocol, Self

from turgor.cli.exits import write_nowhere
from turgor.core.results.measures.standard_measures import bending_angle
from turgor.core.solvers.progress.progress import Course, clock, cut_back, describe, of_stage
from turgor.core.solvers.solution import Iteration, State
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding
from turgor.units import deg

#: Variables by which rich takes a file or a pipe for a terminal.
AS_TERMINAL = ("FORCE_COLOR", "TTY_COMPATIBLE")


class Lines(Protocol):
    """What lines are written to: a console of rich is one, too."""

    def out(self, text: str, *, highlight: bool) -> None:
        """Write a line."""


class PlainConsole:
    """A console of lines whose reader may go away, as in ``turgor run job.toml | head``: the run continues in silence.

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
    """Return whether standard output may be a terminal, so that importing rich is worthwhile."""
    return sys.stdout.isatty() or any(os.environ.get(name) for name in AS_TERMINAL)


class AngleCourse(Course):
    """Progress of a solve with the bending angle."""

    def __init__(self) -> None:
        super().__init__()
        self.angle: float | None = None

    def follow(self, state: State | None) -> None:
        """Record an iteration, and the state and its angle if a step was accepted."""
        super().follow(state)
        if state is None:
            return
        try:
            angle = bending_angle(state)
        except TurgorError:
            return  # an actuator without a tip has no bending angle
        turns = 0.0 if self.angle is None else round((self.angle - angle) / (2 * pi))
        self.angle = angle + 2 * pi * turns

    @property
    def words(self) -> tuple[str, ...]:
        """The bending angle, where there is one."""
        return () if self.angle is None else (bending(self.angle)[2:],)


class PlainDisplay:
    """Display for files and pipes: one line for each notice and each accepted step."""

    def __init__(self, console: Lines) -> None:
        self.reported: list[Finding] = []
        self._console = console
        self._course = AngleCourse()
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
        remaining = clock(self._course.seconds_left)
        self._line(f"{describe(iteration, state)}{bending(self._course.angle)}, {remaining} left")

    def report(self, finding: Finding) -> None:
        """Print a finding on standard error, also where notices are off."""
        self.reported.append(finding)
        print(finding, file=sys.stderr, flush=True)

    def _line(self, text: str) -> None:
        self._console.out(f"[{clock(perf_counter() - self._began):>5}] {text}", highlight=False)


def bending(angle: float | None) -> str:
    """Write a bending angle [rad] as the end of a line, or nothing.

    Examples
    --------
    >>> bending(0.5), bending(None)
    (', bending 28.65 deg', '')
    """
    return "" if angle is None else f", bending {angle / deg:.2f} deg"
