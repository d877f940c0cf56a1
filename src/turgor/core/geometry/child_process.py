"""Tasks in a child process: compiled code may crash or hang on files of others, and this process must go on.

The CAD kernel and the mesh generator are trusted with the built-in families. A damaged STEP file or a surface of
slivers can end them with a segmentation fault or an abort, which no exception handler sees. Tasks on such files run in
a fresh interpreter; it imports nothing of the script that called, so that scripts need no ``__name__ == "__main__"``.

Task and reply are pickled, as `multiprocessing` does, into a folder that only this user can read.
"""

import pickle
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass
from os import _exit
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

from turgor.foundation.errors import TurgorError

Result = TypeVar("Result")

_START = "import sys; sys.path[:] = {path!r}; from turgor.core.geometry.child_process import serve; serve(sys.argv[1])"
_TASK, _REPLY, _OUTPUT = "task.pickle", "reply.pickle", "output.txt"


@dataclass(frozen=True, slots=True, kw_only=True)
class Work:
    """A task in words, for the sentence about its failure.

    Parameters
    ----------
    who : str
        What works, such as ``"the CAD kernel"``.
    doing : str
        What it does, such as ``"reading 'part.step'"``.
    advice : str
        What a person can do if it fails: a sentence.
    limit : float [s]
        Time after which it is stopped.
    """

    who: str
    doing: str
    advice: str
    limit: float


def in_child(work: Work, task: Callable[..., Result], *given: object) -> Result:
    """Carry out a task in a fresh interpreter and return its result.

    Parameters
    ----------
    work : Work
        The task in words.
    task : callable
        Function of a module, not of the script that runs.
    *given : objects
        Its arguments; they and the result can be pickled.

    Raises
    ------
    TurgorError
        The one that the task raises; or one that tells of any other exception, of the death of the child, or that it
        took too long.

    Examples
    --------
    >>> from math import sqrt
    >>> work = Work(who="the kernel", doing="taking a root", advice="Take another number.", limit=60.0)
    >>> in_child(work, sqrt, 4.0)
    2.0
    >>> in_child(work, sqrt, -1.0)
    Traceback (most recent call last):
    turgor.TurgorError: the kernel failed while taking a root (ValueError: ...). Take another number.
    """
    with TemporaryDirectory(prefix="turgor-") as folder:
        place = Path(folder)
        (place / _TASK).write_bytes(pickle.dumps((task, given)))
        code = _run(place, work)
        reply = place / _REPLY
        if code != 0 or not reply.exists():
            raise TurgorError(f"{work.who} died while {work.doing} ({_cause(code, place)}). {work.advice}")
        value, error = pickle.loads(reply.read_bytes())
    if isinstance(error, TurgorError):
        raise error
    if error is not None:
        what = f"{type(error).__name__}: {error}".strip().rstrip(".:")
        raise TurgorError(f"{work.who} failed while {work.doing} ({what}). {work.advice}") from error
    result: Result = value
    return result


def serve(folder: str) -> None:
    """Carry out the task in a folder; the child calls this.

    Parameters
    ----------
    folder : str
        Where the task is and the reply goes.
    """
    threading.Thread(target=_end_with_parent, daemon=True).start()
    value, error = None, None
    try:
        task, given = pickle.loads((Path(folder) / _TASK).read_bytes())
        value = task(*given)
    except Exception as raised:
        error = raised
    try:
        reply = pickle.dumps((value, error))
    except Exception as raised:  # exceptions of compiled code cannot always be pickled
        reply = pickle.dumps((None, RuntimeError(f"{type(error or raised).__name__}: {error or raised}")))
    (Path(folder) / _REPLY).write_bytes(reply)
    sys.stdout.flush()
    _exit(0)  # a kernel with damaged memory may die while it cleans up, after its work is done


def _end_with_parent() -> None:
    """End this process when the other end of its input closes, because the parent has ended."""
    sys.stdin.read()
    _exit(1)


def _run(place: Path, work: Work) -> int:
    """Start the child, wait for its end, and return its exit code."""
    start = [sys.executable, "-c", _START.format(path=sys.path), str(place)]
    with (place / _OUTPUT).open("wb") as output:
        child = subprocess.Popen(start, stdin=subprocess.PIPE, stdout=output, stderr=output)
        try:
            return child.wait(timeout=work.limit)
        except subprocess.TimeoutExpired:
            raise TurgorError(
                f"{work.who} did not end {work.doing} within {work.limit:.0f} s and was stopped. {work.advice}"
            ) from None
        finally:
            child.kill()
            child.wait()
            if child.stdin is not None:
                child.stdin.close()


def _cause(code: int, place: Path) -> str:
    """Write how a child ended: the signal or exit code, and its last words."""
    if code < 0:
        try:
            how = f"signal {-code}, {signal.Signals(-code).name}"
        except ValueError:
            how = f"signal {-code}"
    else:
        how = f"exit code {code}"
    lines = (place / _OUTPUT).read_text(encoding="utf-8", errors="replace").strip().splitlines()
    lines = [line for line in lines if not line.startswith("Extension modules:")]  # what Python adds to a crash
    return f"{how}: {lines[-1].strip()[:200]}" if lines else how
