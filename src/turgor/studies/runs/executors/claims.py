"""Claims: runs that wait, each locked before it is computed, so that processes and machines may share one folder."""

from collections import deque
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Self

from filelock import BaseFileLock, FileLock, SoftFileLock, Timeout

from turgor.studies.runs.executors.run_outcome import Ended, ended_before
from turgor.studies.runs.run import Run


class Claims:
    """Runs that wait to be computed, handed out one after the other.

    Before a run is handed out, its file ``KEY.lock`` in the folder is locked by the system, which unlocks it when this
    process ends, however it ends; a shared file system does so when the machine stops. A run that another process
    holds goes to the end of the queue, and is read when that one has saved it. Where a file system has no locks, runs
    are handed out without, and two studies in one folder may compute a run twice.

    Parameters
    ----------
    runs : sequence of Run
    folder : Path or None
        Where runs are saved; None locks nothing.
    """

    def __init__(self, runs: Sequence[Run], folder: Path | None) -> None:
        self._waiting = deque(runs)
        self._folder = folder
        self._locks: dict[str, BaseFileLock] = {}

    def __bool__(self) -> bool:
        """Whether runs wait."""
        return bool(self._waiting)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for lock in self._locks.values():
            _unlocked(lock)
        self._locks.clear()

    def take(self) -> Run | Ended | None:
        """Return a run to compute, or how one has ended elsewhere; None where all that wait are computed elsewhere."""
        for _ in range(len(self._waiting)):
            run = self._waiting.popleft()
            if self._folder is None:
                return run
            before = ended_before(run, self._folder)
            if before is not None:  # without a lock, whose file would stay if this process were killed now
                return before
            try:
                lock = _locked(self._folder / f"{run.key}.lock")
            except Timeout:
                self._waiting.append(run)
                continue
            before = ended_before(run, self._folder)
            if before is not None:
                _unlocked(lock)
                return before
            if lock is not None:
                self._locks[run.key] = lock
            return run
        return None

    def release(self, run: Run) -> None:
        """Unlock a run, after it was saved or failed."""
        _unlocked(self._locks.pop(run.key, None))


def drop_lock(key: str, folder: Path) -> None:
    """Remove the file of the lock of a run that has ended, which a killed process left."""
    file = folder / f"{key}.lock"
    if file.exists():
        with suppress(Timeout):  # the process that has computed it is about to remove it
            _unlocked(_locked(file))


def _locked(file: Path) -> BaseFileLock | None:
    """Lock a file at once, or raise a `Timeout`; None where the file system has no locks."""
    file.parent.mkdir(parents=True, exist_ok=True)
    lock: BaseFileLock = FileLock(file, timeout=0, thread_local=False)
    try:
        lock.acquire()
    except (NotImplementedError, OSError) as error:
        if isinstance(error, Timeout):
            raise
        return None
    if isinstance(lock, SoftFileLock):  # stands in for a lock of the system, and would stay when its machine stops
        lock.release()
        return None
    return lock


def _unlocked(lock: BaseFileLock | None) -> None:
    """Remove the file of a lock while it is locked, so that no other process locks a removed file, and unlock it."""
    if lock is not None:
        with suppress(OSError):  # Windows does not remove an open file
            Path(lock.lock_file).unlink(missing_ok=True)
        lock.release()
