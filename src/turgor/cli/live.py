"""Live display: progress of a job as a bar on a terminal."""

from rich.console import Console
from rich.text import Text

from turgor.cli.console import AngleCourse
from turgor.cli.exits import write_nowhere
from turgor.core.solvers.progress.bar import Bar
from turgor.core.solvers.progress.progress import cut_back, of_stage
from turgor.core.solvers.solution import Iteration, State
from turgor.foundation.finding import Finding


class PatientConsole(Console):
    """A console whose reader may go away, as in ``turgor run job.toml | head``: the run continues in silence."""

    def on_broken_pipe(self) -> None:
        """Write nothing more."""
        self.quiet = True
        write_nowhere()


class LiveDisplay(Bar):
    """Display for terminals: a bar with the bending angle; results, findings and rejected steps are lines above it."""

    def __init__(self, console: Console) -> None:
        super().__init__(console, AngleCourse(), patience=0.0)
        self.reported: list[Finding] = []

    def notify(self, text: str) -> None:
        """Print a notice; results stay on the screen, activities do not."""
        if ":" in text:
            self._print(text)
        else:
            super().notify(text)

    def report(self, finding: Finding) -> None:
        """Print a finding above the bar."""
        self.reported.append(finding)
        self._console.print(str(finding), highlight=False, markup=False)

    def progress(self, iteration: Iteration, state: State | None) -> None:
        """Move the bar; a rejected step leaves a line above it."""
        super().progress(iteration, state)
        if iteration.rejected is not None:
            self._print(f"{of_stage(self._course.stage)}{cut_back(iteration)}")

    def _print(self, text: str) -> None:
        """Print one line, cut off where the terminal ends."""
        self._console.print(Text(text, overflow="ellipsis", no_wrap=True), highlight=False)
