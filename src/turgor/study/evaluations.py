"""Evaluations of functions that return a response, kept in memory or on disk, in this process or in others."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from turgor.study.run_all import Ended, compute, run_all
from turgor.study.runs import Run, keep, kept

#: Digits of the values that functions are called with: the last ones of a float may differ from machine to machine,
#: and a run is found again by its values.
DIGITS = 9


@dataclass(frozen=True, slots=True, kw_only=True)
class Evaluations:
    """Runs that an analysis asks for one batch after another, each computed once.

    Parameters
    ----------
    folder : Path or None
        Where they are kept as they end; None keeps nothing on disk, which suits formulas.
    processes : int
        Processes at once, each with one thread. One run alone is computed in this process, which has loaded everything.
    progress : callable or None
        Called with every run that has ended.
    ended : dict of str to Ended
        All runs so far by their keys, in the order in which they were asked for.
    """

    folder: Path | None = None
    processes: int = 1
    progress: Callable[[Ended], None] | None = None
    ended: dict[str, Ended] = field(default_factory=dict)

    def of(self, runs: Sequence[Run]) -> list[Ended]:
        """Return how runs ended, in their order; those that have not been asked for before are computed."""
        fresh = {run.key: run for run in runs if run.key not in self.ended}
        if self.folder is not None and self.processes > 1 and len(fresh) > 1:
            found = run_all(list(fresh.values()), self.folder, processes=self.processes, progress=self.progress)
            self.ended.update(found)
        else:
            for key, run in fresh.items():
                self.ended[key] = self._here(run)
                if self.progress is not None:
                    self.progress(self.ended[key])
        return [self.ended[run.key] for run in runs]

    def _here(self, run: Run) -> Ended:
        """Read one run, or compute it in this process and keep it."""
        before = kept(run, self.folder) if self.folder is not None else None
        if before is not None:
            return Ended(run=run, found=before, again=True)
        ended = compute(run)
        if self.folder is not None and ended.found is not None:
            keep(run, ended.found, self.folder)
        return ended


def rounded(value: float) -> float:
    """Return a value with the digits that functions are called with.

    Parameters
    ----------
    value : float

    Returns
    -------
    float

    Examples
    --------
    >>> rounded(0.1 + 0.2)
    0.3
    """
    return float(f"{value:.{DIGITS}g}")
