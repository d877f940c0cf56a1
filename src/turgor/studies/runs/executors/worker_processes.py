"""Workers: processes of this machine, each with one thread, that stay over all batches of a study."""

import os
import signal
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess
from pathlib import Path
from time import sleep
from typing import cast

from turgor.foundation.errors import TurgorError
from turgor.studies.runs.executors.claims import Claims
from turgor.studies.runs.executors.run_outcome import Ended, ended_before
from turgor.studies.runs.executors.worker import READY, serve
from turgor.studies.runs.run import Run
from turgor.studies.runs.settings import RUNS

#: Variables that give each worker one thread: of the kernels, the linear solver and the libraries below NumPy.
ONE_THREAD = ("NUMBA_NUM_THREADS", "RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


@dataclass(slots=True, eq=False)
class _Worker:
    """A process, and the connection to it."""

    process: SpawnProcess
    connection: Connection
    ready: bool = False

    def end(self) -> None:
        """End the process at once."""
        self.process.kill()
        self.process.join()
        self.connection.close()


@dataclass(slots=True, kw_only=True, eq=False)
class Workers:
    """Computes runs in processes of this machine, each with one thread.

    A process imports and compiles once, and then computes one run after another. If it dies, its run is marked and
    another process takes its place. The processes end with this one, even if this one is killed.

    Parameters
    ----------
    processes : int
        Processes at once, at least 1; they start when runs are there for them.

    Raises
    ------
    TurgorError
        If ``processes`` is below 1.
    """

    processes: int
    _idle: list[_Worker] = field(default_factory=list, repr=False)

    def __post_init__(self) -> None:
        if self.processes < 1:
            raise TurgorError(f"processes is {self.processes}; allowed is 1 or more.")

    def compute(self, runs: Sequence[Run], folder: Path | None) -> Iterator[Ended]:
        """Compute runs, and give each as it ends; where the caller stops, those that have begun are ended.

        Raises
        ------
        TurgorError
            If the processes do not start.
        """
        busy: dict[Connection, tuple[_Worker, Run]] = {}
        with Claims(runs, folder) as claims:
            try:
                while claims or busy:
                    taken = claims.take() if len(busy) < self.processes else None
                    if isinstance(taken, Run):
                        worker = self._given(taken, folder)
                        busy[worker.connection] = worker, taken
                        continue
                    if taken is not None:
                        yield taken
                        continue
                    for run, answer in self._answers(busy, bool(claims) and len(busy) < self.processes):
                        claims.release(run)
                        yield _ended(run, answer, folder)
            finally:
                for worker, _ in busy.values():
                    worker.end()

    def close(self) -> None:
        """End all processes."""
        while self._idle:
            self._idle.pop().end()

    def _answers(self, busy: dict[Connection, tuple[_Worker, Run]], elsewhere: bool) -> Iterator[tuple[Run, object]]:
        """Wait until runs have ended; where others are computed elsewhere, for a short time only."""
        if not busy:
            sleep(RUNS.poll)
            return
        for connection in cast("list[Connection]", wait(list(busy), RUNS.poll if elsewhere else None)):
            worker, run = busy[connection]
            answer = _answer(worker)
            if answer == READY:
                worker.ready = True
                continue
            del busy[connection]
            if worker.ready and worker.process.is_alive():
                self._idle.append(worker)
            yield run, answer

    def _given(self, run: Run, folder: Path | None) -> _Worker:
        """Give a run to a process that waits, or to a new one."""
        while self._idle:
            worker = self._idle.pop()
            with suppress(OSError):  # it was killed while it waited
                worker.connection.send((run, folder))
                return worker
            worker.end()
        worker = _started()
        with suppress(OSError):  # its problem is noticed when its answer is read
            worker.connection.send((run, folder))
        return worker


def _started() -> _Worker:
    """Start a fresh interpreter, because a copy of this process would contain its threads and their locks."""
    context = get_context("spawn")
    here, there = context.Pipe()
    process = context.Process(target=serve, args=(there,), daemon=True)
    with _one_thread():
        process.start()
    there.close()
    return _Worker(process, here)


@contextmanager
def _one_thread() -> Iterator[None]:
    """Set the variables that a new process reads as it loads its libraries."""
    before = {name: os.environ.get(name) for name in ONE_THREAD}
    os.environ.update(dict.fromkeys(ONE_THREAD, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _answer(worker: _Worker) -> object:
    """Read a message of a process: that it is ready, how a run ended, or why the process died."""
    try:
        return worker.connection.recv()
    except (EOFError, OSError):
        worker.process.join(RUNS.patience)
        code = worker.process.exitcode
        worker.end()
    if not worker.ready and code is not None and code > 0:
        raise TurgorError(
            "worker processes do not start: they import the script that runs. Put what it computes under "
            "'if __name__ == \"__main__\":', or call with processes=1."
        )
    how = f" by the signal {signal.Signals(-code).name}" if code is not None and code < 0 else ""
    return f"its process was killed{how}, perhaps for want of memory; call again, with fewer processes if it was."


def _ended(run: Run, answer: object, folder: Path | None) -> Ended:
    """Return how a run ended: by the answer of the worker, or by the saved files with the problem as text."""
    if isinstance(answer, Ended):
        return answer
    before = None if folder is None else ended_before(run, folder)
    return Ended(run=run, result=None, problem=str(answer)) if before is None else replace(before, again=False)
