"""Shares: a study whose runs are computed by several calls, such as the tasks of a SLURM array."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from turgor.foundation.errors import TurgorError
from turgor.studies.runs.executors.run_outcome import Ended
from turgor.studies.runs.run import Run

#: Problem of a run that is not computed yet.
NOT_YET = "not computed yet"


class Gathering:
    """Computes nothing; runs that were not saved before are reported as not computed yet."""

    def compute(self, runs: Sequence[Run], folder: Path | None) -> Iterator[Ended]:
        """Give each run as not computed."""
        for run in runs:
            yield Ended(run=run, result=None, problem=NOT_YET)

    def close(self) -> None:
        """Do nothing; there is no process to end."""


def share(count: int, index: int, of: int) -> range:
    """Return which of the designs of a study a task computes: every ``of``-th one.

    Parameters
    ----------
    count : int
        Number of designs.
    index : int
        Number of the task, from 1.
    of : int
        Number of tasks.

    Returns
    -------
    range
        Places of the designs, from 0; empty for a task beyond the last design.

    Raises
    ------
    TurgorError
        If the number of the task is not from 1 to the number of tasks.

    Examples
    --------
    >>> [list(share(5, task, 2)) for task in (1, 2)]
    [[0, 2, 4], [1, 3]]
    """
    if not 1 <= index <= of:
        sentence = f"index is {index}; allowed is 1 to {of}, the number of tasks."
        raise TurgorError(python=sentence, command=f"--{sentence}")
    return range(index - 1, count, of)
