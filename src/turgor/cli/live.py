"""Live display: progress of a job as a bar on a terminal."""

from typing import Self

from rich.console import Console
from rich.progress import BarColumn, Progress, ProgressColumn, SpinnerColumn, Task, TextColumn
from rich.table import Column
from rich.text import Text

from turgor.cli.console import Course, bending, clock, cut_back, fitting, of_stage
from turgor.cli.exits import write_nowhere
from turgor.finding import Finding
from turgor.solvers.solution import Iteration, State

#: Characters of a line beside the texts that change: spinner, the shortest bar, times, and gaps between them.
BESIDE = 2 + 10 + 7 + 5


class PatientConsole(Console):
    """A console whose reader may go away, as in ``turgor run job.toml | head``: the run goes on in silence."""

    def on_broken_pipe(self) -> None:
        """Write nothing more."""
        self.quiet = True
        write_nowhere()


class _Elapsed(ProgressColumn):
    """Elapsed time of a task."""

    def render(self, task: Task) -> Text:
        """Write it as minutes and seconds."""
        return Text(clock(task.elapsed or 0.0))


class LiveDisplay:
    """Display for terminals: a bar over the load factor with step, iteration, residual, angle and remaining time."""

    def __init__(self, console: Console) -> None:
        self.told: list[Finding] = []
        self._console = console
        self._course = Course()
        self._bar = Progress(
            SpinnerColumn(),
            TextColumn("{task.description}", table_column=Column(no_wrap=True)),
            BarColumn(bar_width=None),
            TextColumn("{task.fields[state]}", table_column=Column(no_wrap=True)),
            _Elapsed(),
            TextColumn("{task.fields[left]}", table_column=Column(no_wrap=True)),
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
            self._print(text)
        else:
            self._bar.update(self._task, description=fitting([text], self._console.width - BESIDE), state="", left="")

    def found(self, finding: Finding) -> None:
        """Print a finding above the bar."""
        self.told.append(finding)
        self._console.print(str(finding), highlight=False, markup=False)

    def progress(self, iteration: Iteration, state: State | None) -> None:
        """Move the bar; a rejected step leaves a line above it."""
        self._course.follow(state)
        if iteration.rejected is not None:
            self._print(f"{of_stage(self._course.stage)}{cut_back(iteration)}")
        factor, left = f"{self._course.load_factor:.3f}", f"{clock(self._course.seconds_left)} left"
        free = self._console.width - BESIDE - len(left)
        description = fitting([f"{of_stage(self._course.stage)}load factor {factor}", factor], free, alternatives=True)
        work = (
            f"step {iteration.step}",
            f"iteration {iteration.iteration}",
            f"residual {iteration.residual:.1e}",
            *([bending(self._course.angle)[2:]] if self._course.angle is not None else []),
        )
        self._bar.update(
            self._task,
            completed=self._course.load_factor,
            description=description,
            state=fitting(work, free - len(description)),
            left=left,
        )

    def _print(self, text: str) -> None:
        """Print one line, cut off where the terminal ends."""
        self._console.print(Text(text, overflow="ellipsis", no_wrap=True), highlight=False)
