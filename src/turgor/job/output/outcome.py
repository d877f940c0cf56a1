"""Outcome: the results of a run and their files."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from turgor.core.solvers.solution import Solution
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Response
from turgor.job.job import Job


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RunOutcome:
    """Results of a run and their files.

    Parameters
    ----------
    job : Job
        The job.
    solution : Solution
        The path, complete or not.
    response : Response
        The measures along it.
    findings : tuple of Finding
        Findings of the checks before, during and after the solve.
    written_by : mapping
        Versions of the programs, threads and linear solver.
    notices : tuple of str
        Notices of the run, in order.
    folder : Path
        Folder of the results.
    files : tuple of Path
        Files, the most important first.
    """

    job: Job
    solution: Solution
    response: Response
    findings: tuple[Finding, ...]
    written_by: Mapping[str, str | int]
    notices: tuple[str, ...]
    folder: Path
    files: tuple[Path, ...] = ()

    @property
    def errors(self) -> tuple[Finding, ...]:
        """Findings that invalidate the results or a part of them."""
        return tuple(finding for finding in self.findings if finding.severity is Severity.ERROR)
