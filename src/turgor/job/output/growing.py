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
    notices: list[str] = field(default_factory=list)
    _reader: Reader = field(default_factory=Reader)

    def begin(self) -> None:
        """Write the lock file and the head of the log, before anything is computed."""
        self._reader = Reader(tuple(find_measure(name) for name in self.job.output.measures))
        (self.folder / LOCK).write_text(lock_text(self.job, versions()), encoding="utf-8")
        (self.folder / LOG).write_text(f"job {self.job.name}\n", encoding="utf-8")

    def say(self, text: str) -> None:
        """Note an activity in the log, and pass it on."""
        self.notices.append(text)
        with (self.folder / LOG).open("a", encoding="utf-8") as log:
            log.write(f"{text}\n")
        self.notify(text)

    def grow(self, record: RunRecord) -> None:
        """Write the response and the steps of the path so far, and the last step into the log."""
        solution = path_so_far(record)
        self._reader.response(solution).to_csv(self.folder / RESPONSE)
        write_steps(self.folder / STEPS, solution)
        if solution.steps:
            step, state = solution.steps[-1], solution.states[-1]
            with (self.folder / LOG).open("a", encoding="utf-8") as log:
                log.write(
                    f"step {len(solution.steps)}: load factor {state.load_factor:.6g}, {step.iterations} iterations\n"
                )
