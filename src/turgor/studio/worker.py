"""Worker: a process that has loaded the engine, so that a task begins at once, and the server stays small."""

import multiprocessing
import threading
import time
from dataclasses import dataclass, field
from importlib import import_module
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any

from anyio import to_thread

from turgor.foundation.errors import TurgorError
from turgor.studio.settings import STUDIO


@dataclass(slots=True, eq=False)
class Worker:
    """A process that runs one task after another; it starts with the first one, and again after one that failed.

    A task is a function of a module of `turgor.studio.tasks`, named by the server as ``"module.function"``. What it
    takes and returns must be picklable. A crash, such as one of the CAD kernel, ends the task with a sentence.
    """

    _lock: threading.Lock = field(default_factory=threading.Lock)
    _process: BaseProcess | None = None
    _end: Connection | None = None
    _used: float = 0.0

    async def do(self, task: str, *values: Any, patience: float = STUDIO.patience) -> Any:
        """Run a task, and return what it returns.

        Raises
        ------
        TurgorError
            That the task has raised; or that it took longer than ``patience`` [s], or ended with its process.
        """
        return await to_thread.run_sync(self.call, task, values, patience, abandon_on_cancel=True)

    def call(self, task: str, values: tuple[Any, ...], patience: float = STUDIO.patience) -> Any:
        """Run a task, and wait for what it returns."""
        with self._lock:
            end = self._started()
            try:
                end.send((task, values))
                if not end.poll(patience):
                    self.stop()
                    raise TurgorError(f"this took longer than {patience:.0f} s, and was stopped.")
                done, value = end.recv()
            except (EOFError, OSError) as error:
                self.stop()
                raise TurgorError("the process that computes this has ended; try again.") from error
            finally:
                self._used = time.monotonic()
        if not done:
            raise value
        return value

    def stop(self) -> None:
        """End the process; the next task starts a new one."""
        if self._process is not None:
            self._process.kill()
            self._process.join()
        self._process = self._end = None

    def rest(self) -> None:
        """End the process if it was not used for long."""
        if self._process is not None and time.monotonic() - self._used > STUDIO.idle and self._lock.acquire(False):
            try:
                self.stop()
            finally:
                self._lock.release()

    def _started(self) -> Connection:
        if self._process is None or not self._process.is_alive() or self._end is None:
            context = multiprocessing.get_context("spawn")
            self._end, other = context.Pipe()
            self._process = context.Process(target=_work, args=(other,), daemon=True, name="turgor-studio-worker")
            self._process.start()
            other.close()
        return self._end


def _work(end: Connection) -> None:
    """Answer tasks until the server ends."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server, which ends this process
    while True:
        try:
            task, values = end.recv()
        except EOFError:
            return
        module, _, function = task.rpartition(".")
        try:
            answer = (True, getattr(import_module(f"turgor.studio.tasks.{module}"), function)(*values))
        except TurgorError as error:
            answer = (False, TurgorError(error.on_command_line))
        except Exception as error:
            answer = (False, TurgorError(f"{type(error).__name__}: {error}"))
        end.send(answer)
