"""Load: models, solutions and responses from files, and the path of a run that was ended from outside."""

from pathlib import Path
from typing import Any

from turgor.core.solvers.checkpoints.checkpoint_data import PathSoFar
from turgor.core.solvers.checkpoints.record import INDEX, RunRecord
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.solution import Solution, Status
from turgor.core.solvers.stage_sequence import together
from turgor.foundation.errors import TurgorError
from turgor.foundation.store.saved_objects import load_file, with_ending

#: Folder of the path in a folder of results.
PATH_FOLDER = "path"

#: Said of a path whose run has not ended.
MESSAGE = "The run was ended before its path was complete; the states up to there are saved."
ADVICE = "Go on from the last one with `turgor run JOB --resume`, or `turgor.resume` in Python."


def load(path: str | Path) -> Any:
    """Load a model, a solution or a response from a file, or the solution of a run from its folder.

    Parameters
    ----------
    path : str or Path
        A file that `Model.save`, `Solution.save` or `Response.save` wrote, with or without its ending; or the folder of
        a run, of `turgor run` or of `solve`, whose path is loaded as far as it goes.

    Returns
    -------
    Model, Solution or Response

    Raises
    ------
    TurgorError
        If there is nothing to load, it is damaged, or its format is of another version.

    Examples
    --------
    >>> load("none.turgor")
    Traceback (most recent call last):
    turgor.TurgorError: there is no file 'none.turgor'.
    """
    path = Path(path)
    if not path.is_dir():
        return load_file(path)
    for folder in (path, path / PATH_FOLDER):
        if (folder / INDEX).exists():
            return saved_path(RunRecord.open(folder))
    if with_ending(path).is_file():
        return load_file(path)
    raise TurgorError(f"the folder '{path}' holds no path of a run.")


def saved_path(record: RunRecord) -> Solution:
    """Return the solution of a run; if the run has not ended, the path so far.

    Parameters
    ----------
    record : RunRecord

    Returns
    -------
    Solution
        With the status ``interrupted`` where the run has not ended.

    Raises
    ------
    TurgorError
        If the run was ended before its first state.
    """
    known = record.solution()
    if known is not None:
        return known
    paths, question = record.paths(), record.question
    if not paths:
        raise TurgorError(f"the run in '{record.store.folder}' was ended before its first step was done.")
    procedure = question.procedure
    if not procedure.stages:
        return _unfinished(procedure, paths[-1])
    solutions = [_unfinished(stage.procedure, path) for stage, path in zip(procedure.stages, paths, strict=False)]
    whole = together(question.model, procedure, solutions)
    return Solution(
        model=question.model,
        procedure=procedure,
        states=whole.states,
        status=Status.INTERRUPTED,
        message=MESSAGE,
        advice=ADVICE,
        steps=whole.steps,
        limit_points=whole.limit_points,
    )


def _unfinished(procedure: Procedure, path: PathSoFar) -> Solution:
    return Solution(
        model=path.states[0].model,
        procedure=procedure,
        states=path.states,
        status=Status.INTERRUPTED,
        message=MESSAGE,
        advice=ADVICE,
        steps=path.steps,
        limit_points=path.limits,
    )
