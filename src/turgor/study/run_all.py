"""Many runs in processes of their own: what has ended is kept at once, and is not computed again."""

import os
import traceback
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, replace
from multiprocessing import get_context
from pathlib import Path
from time import process_time

from turgor.errors import TurgorError
from turgor.response import Response
from turgor.study.runs import Computed, Run, keep, kept

#: Variables that give each worker one thread: of the kernels, the linear solver and the libraries below NumPy.
ONE_THREAD = ("NUMBA_NUM_THREADS", "RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


@dataclass(frozen=True, slots=True, kw_only=True)
class Ended:
    """How one run ended.

    Parameters
    ----------
    run : Run
    found : Computed or None
        None where the run failed.
    problem : str
        Why it failed; empty where it did not.
    again : bool
        Whether it was read from disk.
    """

    run: Run
    found: Computed | None
    problem: str = ""
    again: bool = False


def run_all(
    runs: Sequence[Run],
    folder: Path,
    *,
    processes: int = 1,
    progress: Callable[[Ended], None] | None = None,
) -> dict[str, Ended]:
    """Compute runs that have not ended before, each in a process with one thread, and keep them as they end.

    Killed at any moment, nothing that has ended is lost: the next call reads it. A run that fails is no hole: it has
    the sentence that says why, and the next call tries it again.

    Parameters
    ----------
    runs : sequence of Run
        Runs of one key are computed once.
    folder : Path
        Where they are kept.
    processes : int
        Processes at once, at least 1.
    progress : callable or None
        Called with every run that has ended, those read from disk first.

    Returns
    -------
    dict of str to Ended
        How each ended, by the key of the run, in the order of ``runs``.

    Raises
    ------
    TurgorError
        If ``processes`` is below 1.
    """
    if processes < 1:
        raise TurgorError(f"processes is {processes}; allowed is 1 or more.")
    asked = {run.key: run for run in runs}
    ended: dict[str, Ended] = {}
    for key, run in asked.items():
        before = kept(run, folder)
        if before is not None:
            ended[key] = Ended(run=run, found=before, again=True)
    for each in ended.values():
        if progress is not None:
            progress(each)
    for each in _computed([run for key, run in asked.items() if key not in ended], folder, processes):
        ended[each.run.key] = each
        if progress is not None:
            progress(each)
    return {key: ended[key] for key in asked}


def _computed(runs: Sequence[Run], folder: Path, processes: int) -> Iterator[Ended]:
    """Give each run as it ends; a worker that dies takes only the runs with it that had begun."""
    if not runs:
        return
    # A fresh interpreter for each worker: a copy of this one would hold its threads and what they have locked.
    workers = ProcessPoolExecutor(min(processes, len(runs)), mp_context=get_context("spawn"), initializer=_one_thread)
    with workers:
        waiting: dict[Future[str], Run] = {workers.submit(_compute, run, folder): run for run in runs}
        for future in as_completed(waiting):
            run = waiting[future]
            try:
                problem = future.result()
            except BrokenProcessPool:
                problem = "its process was killed, perhaps for want of memory; call again with fewer processes."
            found = None if problem else kept(run, folder)
            yield Ended(run=run, found=found, problem=problem)


def _one_thread() -> None:
    """Give this process one thread; what reads these variables is loaded by the first run."""
    os.environ.update(dict.fromkeys(ONE_THREAD, "1"))


def _compute(run: Run, folder: Path) -> str:
    """Compute and keep one run; return why it failed."""
    ended = compute(run)
    if ended.found is not None:
        keep(run, ended.found, folder)
    return ended.problem


def compute(run: Run) -> Ended:
    """Compute one run in this process, and keep nothing.

    Parameters
    ----------
    run : Run

    Returns
    -------
    Ended
        With the sentence that says why, where the run failed.
    """
    begun = process_time()
    try:
        found = run.function(**run.values)
    except TurgorError as error:
        return Ended(run=run, found=None, problem=str(error))
    except Exception:  # what a study's own function does is not known here; the others go on
        return Ended(run=run, found=None, problem=traceback.format_exc().strip())
    computed = Computed(response=found) if isinstance(found, Response) else found
    return Ended(run=run, found=replace(computed, seconds=computed.seconds or process_time() - begun))
