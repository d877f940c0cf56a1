"""Executors: where the runs of a study are computed. `Evaluations` hands runs to one of them.

`Here` computes in this process; `turgor.studies.runs.executors.worker_processes.Workers` in processes of this machine.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path
from time import sleep
from typing import Protocol

from turgor.studies.runs.executors.claims import Claims
from turgor.studies.runs.executors.run_outcome import Ended, compute
from turgor.studies.runs.run import Run
from turgor.studies.runs.settings import RUNS


class Executor(Protocol):
    """Where runs are computed."""

    def compute(self, runs: Sequence[Run], folder: Path | None) -> Iterator[Ended]:
        """Compute runs, and give each as it ends, in any order.

        None of them is saved yet, and no two have one key. With a folder, a run is saved there by the process that
        computes it before it is given, so that the study may be killed at any moment. Its lock (`Claims`) lets other
        processes compute the same study: how a run ended there is given like any other. A run that fails is given with
        its problem, and the others go on. If the caller stops before the last one, the remaining runs are ended.
        """

    def close(self) -> None:
        """End processes that wait for further runs; a later call of `compute` starts them again."""


class Here:
    """Computes runs in this process, one after the other, which suits formulas."""

    def compute(self, runs: Sequence[Run], folder: Path | None) -> Iterator[Ended]:
        """Compute runs, and give each as it ends."""
        with Claims(runs, folder) as claims:
            while claims:
                taken = claims.take()
                if isinstance(taken, Run):
                    ended = compute(taken, folder)
                    claims.release(taken)
                    yield ended
                elif taken is not None:
                    yield taken
                else:
                    sleep(RUNS.poll)

    def close(self) -> None:
        """Do nothing; there is no process to end."""
