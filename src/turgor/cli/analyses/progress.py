"""Progress of a study: a bar on a terminal, a line for each run elsewhere."""

import sys
from time import perf_counter
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn
from rich.table import Column
from rich.text import Text

from turgor.cli.analyses.calibrate import report_run
from turgor.cli.live import PatientConsole
from turgor.core.solvers.progress.progress import clock
from turgor.studies.runs.executors.run_outcome import Ended


class Counts:
    """Counts of the runs by how they ended, and the remaining time."""

    def __init__(self, total: int) -> None:
        self.total = total
        self.computed = self.failed = self.early = self.read = 0
        self._began = perf_counter()

    def take(self, ended: Ended) -> None:
        """Count a run."""
        if ended.again:
            self.read += 1
            self._began = perf_counter()  # those that are read come first, and do not count for the speed
        else:
            self.computed += 1
        self.failed += ended.result is None
        self.early += ended.result is not None and bool(ended.result.response.message)

    @property
    def ended(self) -> int:
        """Number of runs that have ended."""
        return self.computed + self.read

    @property
    def seconds_left(self) -> float | None:
        """Remaining time at the mean speed of this call [s]; None before the first run that was computed."""
        if not self.computed:
            return None
        return (self.total - self.ended) * (perf_counter() - self._began) / self.computed

    def text(self) -> str:
        """Return the counts in words."""
        parts = [f"{self.ended} of {self.total}"]
        parts += [f"{self.read} saved before"] if self.read else []
        parts += [f"{self.early} ended early"] if self.early else []
        parts += [f"{self.failed} failed"] if self.failed else []
        return ", ".join(parts)


class StudyProgress:
    """Display of the runs of a study, called with each that has ended.

    Parameters
    ----------
    total : int
        Number of runs.
    """

    def __init__(self, total: int) -> None:
        self.counts = Counts(total)
        console = PatientConsole(file=sys.stderr)
        self._bar = _bar(console) if console.is_terminal else None
        self._task = self._bar.add_task("", total=total, text=self.counts.text(), remaining="") if self._bar else None

    def __enter__(self) -> Self:
        if self._bar is not None:
            self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.stop()

    def __call__(self, ended: Ended) -> None:
        """Show a run that has ended."""
        self.counts.take(ended)
        if self._bar is None or self._task is None:
            report_run(ended)
            return
        if ended.problem:
            line = Text(f"{ended.run.name}: {ended.problem}", overflow="ellipsis", no_wrap=True)
            self._bar.console.print(line, highlight=False)
        remaining = f"{clock(self.counts.seconds_left)} left"
        self._bar.update(self._task, completed=self.counts.ended, text=self.counts.text(), remaining=remaining)


def _bar(console: Console) -> Progress:
    return Progress(
        SpinnerColumn(),
        TextColumn("{task.fields[text]}", table_column=Column(no_wrap=True)),
        BarColumn(bar_width=None),
        TextColumn("{task.fields[remaining]}", table_column=Column(no_wrap=True)),
        console=console,
        transient=True,
        refresh_per_second=5,
    )
