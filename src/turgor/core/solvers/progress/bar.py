"""Bar: progress of a solve on a terminal."""

from time import perf_counter
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, Progress, ProgressColumn, SpinnerColumn, Task, TextColumn
from rich.table import Column
from rich.text import Text

from turgor.core.solvers.progress.progress import Course, clock, fitting, of_stage
from turgor.core.solvers.solution import Iteration, State

#: Characters of a line besides the texts that change: spinner, the shortest bar, times, and gaps between them.
OTHERS = 2 + 10 + 7 + 5

#: A solve that ends within this time [s] shows no bar.
AT_ONCE = 0.5


class _Elapsed(ProgressColumn):
    """Elapsed time of a task."""

    def render(self, task: Task) -> Text:
        """Write it as minutes and seconds."""
        return Text(clock(task.elapsed or 0.0))


class Bar:
    """A bar over the load factor with step, iteration, residual and remaining time, which goes away in the end.

    Parameters
    ----------
    console : Console
    course : Course, optional
        Estimates the remaining time, and describes the state.
    patience : float [s]
        How long it waits before it appears.
    """

    def __init__(self, console: Console, course: Course | None = None, patience: float = AT_ONCE) -> None:
        self._console = console
        self._course = course or Course()
        self._appears = perf_counter() + patience
        self._bar = Progress(
            SpinnerColumn(),
            TextColumn("{task.description}", table_column=Column(no_wrap=True)),
            BarColumn(bar_width=None),
            TextColumn("{task.fields[state]}", table_column=Column(no_wrap=True)),
            _Elapsed(),
            TextColumn("{task.fields[remaining]}", table_column=Column(no_wrap=True)),
            console=console,
            transient=True,
            refresh_per_second=5,
        )
        self._task = self._bar.add_task("starting", total=1.0, state="", remaining="")

    def __enter__(self) -> Self:
        self._appear()
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar.live.is_started:
            self._bar.stop()

    def notify(self, text: str) -> None:
        """Show what is being done."""
        self._appear(now=True)  # what is worth a notice takes long
        self._bar.update(self._task, description=fitting([text], self._console.width - OTHERS), state="", remaining="")

    def progress(self, iteration: Iteration, state: State | None) -> None:
        """Move the bar."""
        self._appear()
        self._course.follow(state)
        factor, remaining = f"{self._course.load_factor:.3f}", f"{clock(self._course.seconds_left)} left"
        free = self._console.width - OTHERS - len(remaining)
        description = fitting([f"{of_stage(self._course.stage)}load factor {factor}", factor], free, alternatives=True)
        work = (
            f"step {iteration.step}",
            f"iteration {iteration.iteration}",
            f"residual {iteration.residual:.1e}",
            *self._course.words,
        )
        self._bar.update(
            self._task,
            completed=self._course.load_factor,
            description=description,
            state=fitting(work, free - len(description)),
            remaining=remaining,
        )

    def _appear(self, now: bool = False) -> None:
        if not self._bar.live.is_started and (now or perf_counter() >= self._appears):
            self._bar.start()
