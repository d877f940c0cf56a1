"""Outcome: the results of a run, and the files that hold them."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from turgor.finding import Finding, Severity
from turgor.job.job import Job
from turgor.response import Response
from turgor.solvers.solution import Solution


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RunOutcome:
    """What a run found and where it wrote it.

    Parameters
    ----------
    job : Job
        What was asked.
    solution : Solution
        The path, complete or not.
    response : Response
        The measures along it.
    findings : tuple of Finding
        What the checks noticed before, during and after the solve.
    written_by : mapping
        Versions of the programs, threads and linear solver.
    notices : tuple of str
        What was done before the solve ended, in order.
    folder : Path
        Where everything was written.
    files : tuple of Path
        What was written, in the order of interest.
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
