"""Console: progress of a job, as a bar on a terminal and line by line elsewhere."""

from collections import deque
from math import pi
from time import perf_counter
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, Progress, ProgressColumn, SpinnerColumn, Task, TextColumn
from rich.text import Text

from turgor.cli.exits import write_nowhere
from turgor.errors import TurgorError
from turgor.results.measures.measures import bending_angle
from turgor.solvers.pressures import pressure_text
from turgor.solvers.solution import Iteration, State
from turgor.units import deg

#: Number of last accepted steps for the estimate of the remaining time; only a few, because steps grow along a path.
RECENT_STEPS = 4


class PatientConsole(Console):
    """A console whose reader may go away, as in ``turgor run job.toml | head``: the run goes on in silence."""

    def on_broken_pipe(self) -> None:
        """Write nothing more."""
        self.quiet = True
        write_nowhere()


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

    def __init__(self, console: Console) -> None:
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
        """Write a line for an accepted step."""
        self._course.follow(state)
        if state is None:
            return
        left = clock(self._course.seconds_left)
        self._line(f"{describe(iteration, state)}{bending(self._course.angle)}, {left} left")

    def _line(self, text: str) -> None:
        self._console.out(f"[{clock(perf_counter() - self._began):>5}] {text}", highlight=False)


class _Elapsed(ProgressColumn):
    """Elapsed time of a task."""

    def render(self, task: Task) -> Text:
        """Write it as minutes and seconds."""
        return Text(clock(task.elapsed or 0.0))


class LiveDisplay:
    """Display for terminals: a bar over the load factor with step, iteration, residual, angle and remaining time."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._course = Course()
        self._bar = Progress(
            SpinnerColumn(),
            TextColumn("{task.description}"),
            BarColumn(bar_width=None),
            TextColumn("{task.fields[state]}"),
            _Elapsed(),
            TextColumn("{task.fields[left]}"),
            console=console,
            transient=True,
            refresh_per_second=5,
        )
        self._task = self._bar.add_task("starting", total=1.0, state="", left="")

    def __enter__(self) -> Self:
        self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.stop()

    def notify(self, text: str) -> None:
        """Print a notice; results stay on the screen, activities do not."""
        if ":" in text:
            self._console.print(text, highlight=False, markup=False)
        else:
            self._bar.update(self._task, description=text, state="", left="")

    def progress(self, iteration: Iteration, state: State | None) -> None:
        """Move the bar."""
        self._course.follow(state)
        self._bar.update(
            self._task,
            completed=self._course.load_factor,
            description=f"{of_stage(self._course.stage)}load factor {self._course.load_factor:.3f}",
            state=f"step {iteration.step}, iteration {iteration.iteration}, residual {iteration.residual:.1e}"
            f"{bending(self._course.angle)}",
            left=f"{clock(self._course.seconds_left)} left",
        )


def describe(iteration: Iteration, state: State) -> str:
    """Write one accepted step in words."""
    pressures = pressure_text(state)
    load = f", {pressures}" if pressures else ""
    work = f"{iteration.iteration} iterations, residual {iteration.residual:.1e}"
    return f"{of_stage(state.stage)}step {iteration.step}: load factor {state.load_factor:.4f}{load}, {work}"


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
