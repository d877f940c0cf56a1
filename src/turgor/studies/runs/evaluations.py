"""Evaluations of functions that return a response, stored in memory or on disk, in this process or in others."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

from turgor.studies.runs.executors.claims import drop_lock
from turgor.studies.runs.executors.executor import Executor, Here
from turgor.studies.runs.executors.run_outcome import Ended, ended_before
from turgor.studies.runs.executors.worker_processes import Workers
from turgor.studies.runs.files.run_files import forget
from turgor.studies.runs.run import Run

Progress = Callable[[Ended], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Evaluations:
    """Runs that an analysis requests in batches, each computed once.

    ``with`` ends processes that wait for further runs; without it they end with this process.

    Parameters
    ----------
    folder : Path or None
        Where they are saved as they end; None saves nothing on disk, which suits formulas.
    executor : Executor
        Where they are computed: by default in this process.
    progress : callable or None
        Called with every run that has ended, those read from disk first.
    retry : bool
        Whether runs that failed or ended early before are computed again; by default they are read, as all others.
        What was killed or broke has not ended, and is computed in any case.
    ended : dict of str to Ended
        All runs by their keys, in the order in which they were requested.
    """

    folder: Path | None = None
    executor: Executor = field(default_factory=Here)
    progress: Progress | None = None
    retry: bool = False
    ended: dict[str, Ended] = field(default_factory=dict)

    def of(self, runs: Sequence[Run]) -> list[Ended]:
        """Return how runs ended, in their order; those that have not been requested before are computed."""
        fresh = {run.key: run for run in runs if run.key not in self.ended}
        waiting = [run for run in fresh.values() if not self._read(run)]
        for each in self.executor.compute(waiting, self.folder) if waiting else ():
            self._take(each)
        for key in fresh:  # in the order of the request
            self.ended[key] = self.ended.pop(key)
        return [self.ended[run.key] for run in runs]

    def close(self) -> None:
        """End processes that wait for further runs."""
        self.executor.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _read(self, run: Run) -> bool:
        """Read a run that was saved before; return whether there is one."""
        before = ended_before(run, self.folder) if self.folder is not None else None
        if before is None or self.folder is None:
            return False
        drop_lock(run.key, self.folder)
        if self.retry and (before.problem or before.early):
            forget(run, self.folder)
            return False
        self._take(before)
        return True

    def _take(self, ended: Ended) -> None:
        self.ended[ended.run.key] = ended
        if self.progress is not None:
            self.progress(ended)


def saved_in(
    folder: str | Path, *, processes: int = 1, progress: Progress | None = None, retry: bool = False
) -> Evaluations:
    """Return where runs are computed, each saved on disk as it ends.

    Parameters
    ----------
    folder : str or Path
        Created if there is none.
    processes : int
        Processes at once, each with one thread, which stay until all batches are computed. One is this process itself.
    progress : callable, optional
        Called with every run that has ended.
    retry : bool
        Whether runs that failed or ended early before are computed again.

    Returns
    -------
    Evaluations
        For `sweep`, `calibrate` and others.

    Raises
    ------
    TurgorError
        If ``processes`` is below 1.
    """
    executor = Here() if processes == 1 else Workers(processes=processes)
    return Evaluations(folder=Path(folder), executor=executor, progress=progress, retry=retry)
