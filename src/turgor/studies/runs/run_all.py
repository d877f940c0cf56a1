"""Many runs in processes of their own: what has ended is saved at once, and is not computed again."""

from collections.abc import Callable, Sequence
from pathlib import Path

from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.executors.run_outcome import Ended
from turgor.studies.runs.executors.worker_processes import Workers
from turgor.studies.runs.run import Run


def run_all(
    runs: Sequence[Run],
    folder: Path,
    *,
    processes: int = 1,
    progress: Callable[[Ended], None] | None = None,
    retry: bool = False,
) -> dict[str, Ended]:
    """Compute runs that have not ended before, each in a process with one thread, and save them as they end.

    Killed at any moment, nothing that has ended is lost: the next call reads it. A run that fails is no hole: it has
    the sentence that says why.

    Parameters
    ----------
    runs : sequence of Run
        Runs of one key are computed once.
    folder : Path
        Where they are saved.
    processes : int
        Processes at once, at least 1.
    progress : callable or None
        Called with every run that has ended, those read from disk first.
    retry : bool
        Whether runs that failed or ended early before are computed again.

    Returns
    -------
    dict of str to Ended
        How each ended, by the key of the run, in the order of ``runs``.

    Raises
    ------
    TurgorError
        If ``processes`` is below 1.
    """
    executor = Workers(processes=processes)
    with Evaluations(folder=folder, executor=executor, progress=progress, retry=retry) as evaluations:
        evaluations.of(runs)
        return evaluations.ended
