"""Ended: how one run ended; and one run computed in this process."""

import errno
import traceback
from dataclasses import dataclass, replace
from pathlib import Path
from time import process_time

from turgor.foundation.errors import NotHere, NotSolved, TurgorError
from turgor.foundation.response import Response
from turgor.studies.runs.files.run_files import save_problem, save_run, saved_problem, saved_run
from turgor.studies.runs.run import Computed, Run

#: Errors of a full disk, and of one that cannot be written.
_NO_ROOM = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EROFS})


@dataclass(frozen=True, slots=True, kw_only=True)
class Ended:
    """How one run ended.

    Parameters
    ----------
    run : Run
    result : Computed or None
        None where the run failed.
    problem : str
        Why it failed; empty where it did not.
    again : bool
        Whether it was read from disk.
    final : bool
        Whether it failed by a sentence of turgor that the same call would give again. Such a failure is saved; where a
        worker was killed, a function broke or this machine lacks something, the next call tries again.
    """

    run: Run
    result: Computed | None
    problem: str = ""
    again: bool = False
    final: bool = False

    @property
    def early(self) -> bool:
        """Whether its path ended early."""
        return self.result is not None and bool(self.result.response.message)


def compute(run: Run, folder: Path | None = None) -> Ended:
    """Compute one run in this process.

    Parameters
    ----------
    run : Run
    folder : Path or None
        Where it is saved before this returns; None saves nothing.

    Returns
    -------
    Ended
        With the sentence that says why, where the run failed.
    """
    try:
        return save_ended(_called(run), folder)
    except OSError as error:
        if error.errno not in _NO_ROOM:
            raise
        where = f"'{error.filename}'" if error.filename else "its files"
        return Ended(run=run, result=None, problem=f"{where} cannot be written: {error.strerror}; make room and go on.")


def _called(run: Run) -> Ended:
    begun = process_time()
    try:
        answer = run.call()
    except TurgorError as error:
        if isinstance(error, NotSolved) and error.interrupted:
            raise KeyboardInterrupt from None  # Ctrl-C ends the study; this run has not ended
        return Ended(run=run, result=None, problem=str(error), final=not isinstance(error, NotHere))
    except Exception as error:  # the function of a study may raise anything; the other runs go on
        if isinstance(error, OSError) and error.errno in _NO_ROOM:
            raise
        return Ended(run=run, result=None, problem=traceback.format_exc().strip())
    computed = Computed(response=answer) if isinstance(answer, Response) else answer
    return Ended(run=run, result=replace(computed, seconds=computed.seconds or process_time() - begun))


def save_ended(ended: Ended, folder: Path | None) -> Ended:
    """Save the result of a run, or why it failed where that is final.

    Parameters
    ----------
    ended : Ended
    folder : Path or None
        None saves nothing.

    Returns
    -------
    Ended
        With what a later call reads. A table may differ from it in the last bit, and an analysis that goes on after it
        was killed must find what it finds at once.
    """
    if folder is not None and ended.result is not None:
        save_run(ended.run, ended.result, folder)
        return replace(ended, result=saved_run(ended.run, folder) or ended.result)
    if folder is not None and ended.final:
        save_problem(ended.run, ended.problem, folder)
    return ended


def ended_before(run: Run, folder: Path) -> Ended | None:
    """Read how a run ended before.

    Parameters
    ----------
    run : Run
    folder : Path
        Where it was saved.

    Returns
    -------
    Ended or None
        None where it has not ended.
    """
    computed = saved_run(run, folder)
    if computed is not None:
        return Ended(run=run, result=computed, again=True)
    problem = saved_problem(run, folder)
    return Ended(run=run, result=None, problem=problem, again=True, final=True) if problem else None
