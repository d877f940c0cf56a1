"""run: everything that one job asks for, from the mesh to the folder of results."""

import csv
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from turgor.engine.runtime import EngineOptions
from turgor.finding import Finding, Severity
from turgor.job.folder import FIELDS, LOCK, LOG, RESPONSE, STEPS, claimed, clear, default_folder
from turgor.job.job import Job
from turgor.job.lock import lock_text
from turgor.job.versions import versions
from turgor.meshing.checks import check_mesh
from turgor.meshing.generate import mesh
from turgor.model.model import Model
from turgor.response import Response
from turgor.results.measures import check_measures, find_measure, measure
from turgor.results.vtu import write_series
from turgor.solvers.checks import check_supports
from turgor.solvers.driver import Progress, solve
from turgor.solvers.solution import Solution

Notify = Callable[[str], None]


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
    folder : Path
        Where everything was written.
    files : tuple of Path
        What was written, in the order of interest.
    """

    job: Job
    solution: Solution
    response: Response
    findings: tuple[Finding, ...]
    folder: Path
    files: tuple[Path, ...]

    @property
    def errors(self) -> tuple[Finding, ...]:
        """Findings that invalidate the results or a part of them."""
        return tuple(finding for finding in self.findings if finding.severity is Severity.ERROR)


def prepare(job: Job, notify: Notify | None = None) -> tuple[Model, tuple[Finding, ...]]:
    """Build, mesh and check a job without solving it.

    Parameters
    ----------
    job : Job
        What is asked.
    notify : callable, optional
        ``notify(text)``, called with what is being done.

    Returns
    -------
    model : Model
        The question, ready to be solved.
    findings : tuple of Finding
        What there is to doubt about it.

    Raises
    ------
    TurgorError
        If the job cannot be meshed, held or measured.
    """
    say = notify or _silent
    say("building the actuator")
    geometry = job.actuator.build()
    say("meshing")
    made = mesh(geometry, size=job.mesh_size, grading=job.mesh_grading)
    say(f"mesh: {len(made.cells)} cells, {made.unknown_count} unknowns")
    model = Model(made, materials=job.materials, supports=job.supports, loads=job.loads)
    check_supports(model)
    check_measures(model, [find_measure(name) for name in job.output.measures])
    return model, check_mesh(made)


def run(
    job: Job,
    output: str | Path | None = None,
    *,
    force: bool = False,
    options: EngineOptions | None = None,
    progress: Progress | None = None,
) -> RunOutcome:
    """Run a job: check, build, mesh, solve, measure, and write everything into a folder of its own.

    A run that stops early writes the path so far; ``outcome.solution.status`` says how it ended.

    Parameters
    ----------
    job : Job
        What is asked, usually from `read_job`.
    output : str or Path, optional
        Folder of results; ``<name>-results`` in the working directory if it is not given.
    force : bool
        Whether results that the folder holds already are replaced.
    options : EngineOptions, optional
        Linear solver, threads, and ``notify(text)``, called with what is being done.
    progress : callable, optional
        Called by `solve` after every iteration and every accepted step.

    Returns
    -------
    RunOutcome

    Raises
    ------
    TurgorError
        If the folder is taken or cannot be written (before anything is computed), or the job cannot be meshed.
    """
    options = options or EngineOptions()
    notices: list[str] = []

    def notify(text: str) -> None:
        notices.append(text)
        (options.notify or _silent)(text)

    with claimed(Path(output) if output is not None else default_folder(job.name), force) as folder:
        model, findings = prepare(job, notify)
        notify("solving")
        listening = EngineOptions(linear_solver=options.linear_solver, threads=options.threads, notify=notify)
        solution = solve(model, job.procedure, progress=progress, options=listening, throw=False)
        notify("measuring")
        response = measure(solution, *(find_measure(name) for name in job.output.measures))
        findings += solution.findings
        clear(folder)
        outcome = RunOutcome(
            job=job, solution=solution, response=response, findings=findings, folder=folder, files=()
        )
    return outcome


def _silent(_: str) -> None:
    """Say nothing."""
