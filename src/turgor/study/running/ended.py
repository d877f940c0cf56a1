"""Ended: how one run ended; and one run computed in this process."""

import traceback
from dataclasses import dataclass, replace
from pathlib import Path
from time import process_time

from turgor.errors import TurgorError
from turgor.response import Response
from turgor.study.runs import Computed, Run, keep


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


def compute(run: Run, folder: Path | None = None) -> Ended:
    """Compute one run in this process.

    Parameters
    ----------
    run : Run
    folder : Path or None
        Where it is kept before this returns; None keeps nothing.

    Returns
    -------
    Ended
        With the sentence that says why, where the run failed.
    """
    begun = process_time()
    try:
        found = run.call()
    except TurgorError as error:
        return Ended(run=run, found=None, problem=str(error))
    except Exception:  # what a study's own function does is not known here; the others go on
        return Ended(run=run, found=None, problem=traceback.format_exc().strip())
    computed = Computed(response=found) if isinstance(found, Response) else found
    computed = replace(computed, seconds=computed.seconds or process_time() - begun)
    if folder is not None:
        keep(run, computed, folder)
    return Ended(run=run, found=computed)
