"""Growing files: the response, the steps and the log of a run while it runs, so that nothing is lost with it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from turgor.job.job import Job
from turgor.job.output.folder import LOCK, LOG, RESPONSE, STEPS
from turgor.job.output.lock import lock_text
from turgor.job.output.versions import versions
from turgor.job.output.write import write_steps
from turgor.results.measures.measures import Reader, find_measure
from turgor.solvers.checkpoints.record import RunRecord
from turgor.solvers.stored import path_so_far


@dataclass(slots=True, eq=False)
class GrowingFiles:
    """Files of a run that grow with its path.

    Parameters
    ----------
    folder : Path
        Of the results.
    job : Job
    notify : callable
        Where notices go besides the log.

    Attributes
    ----------
    notices : list of str
        Notices so far.
    """

    folder: Path
    job: Job
    notify: Callable[[str], None]
    notices: list[str] = field(default_factory=list, init=False)
    _reader: Reader | None = None

    def begin(self) -> None:
        """Write the lock file and the notices so far, before the solve."""
        (self.folder / LOCK).write_text(lock_text(self.job, versions()), encoding="utf-8")
        (self.folder / LOG).write_text("\n".join((f"job {self.job.name}", *self.notices, "")), encoding="utf-8")

    def say(self, text: str) -> None:
        """Note an activity, in the log too if it has begun, and pass it on."""
        self.notices.append(text)
        self._log(text)
        self.notify(text)

    def _log(self, line: str) -> None:
        if (self.folder / LOG).exists():
            with (self.folder / LOG).open("a", encoding="utf-8") as log:
                log.write(f"{line}\n")

    def grow(self, record: RunRecord) -> None:
        """Write the response and the steps of the path so far, and the last step into the log."""
        solution = path_so_far(record)
        self._reader = self._reader or Reader(tuple(find_measure(name) for name in self.job.output.measures))
        self._reader.response(solution).to_csv(self.folder / RESPONSE)
        write_steps(self.folder / STEPS, solution)
        if solution.steps:
            factor, iterations = solution.states[-1].load_factor, solution.steps[-1].iterations
            self._log(f"step {len(solution.steps)}: load factor {factor:.6g}, {iterations} iterations")
