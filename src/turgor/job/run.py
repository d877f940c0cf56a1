"""Run of a job: mesh, solve, measure, and write the folder of results."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from threading import Thread

from turgor.accuracy.adaptivity.findings import matter, mesh_error_findings
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.warmup.compiling import announce_needs
from turgor.core.model.model import Model
from turgor.core.results.measures.measures import find_measure
from turgor.core.setups.with_setup import with_choices
from turgor.core.solvers.checkpoints.record import INDEX, Question, RunRecord
from turgor.core.solvers.listeners import Listeners
from turgor.core.solvers.load import PATH_FOLDER
from turgor.core.solvers.progress.watchers import Heard, Progress, watched
from turgor.core.solvers.solution import Solution, Status
from turgor.core.solvers.solve import follow_question
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, by_weight, not_reported, show_warning
from turgor.foundation.response import Response
from turgor.job.expected import expected_of, remember
from turgor.job.job import Job
from turgor.job.kernel_needs import kernel_needs
from turgor.job.meshes import save_mesh_of
from turgor.job.output.folder import claimed, default_folder
from turgor.job.output.growing_files import GrowingFiles
from turgor.job.output.identity import check_same_job
from turgor.job.output.manifest import MOVING, bring_back, drop_previous, set_aside
from turgor.job.output.outcome import RunOutcome
from turgor.job.output.tables import write_tables
from turgor.job.output.versions import versions
from turgor.job.prepare import Notify, prepare, silent

Report = Callable[[Finding], None]

#: What takes long to load and is needed after the solve: for the estimate, pictures and report; where walls may touch.
AFTERWARDS, TOUCHING = ("turgor.accuracy.measure", "turgor.job.output.write"), ("scipy.spatial",)


def run_job(
    job: Job,
    output: str | Path | None = None,
    *,
    force: bool = False,
    resume: bool = False,
    threads: int | None = None,
    notify: Notify | None = None,
    progress: Progress = None,
    report: Report | None = None,
) -> RunOutcome:
    """Run a job: check, build, mesh, solve, measure, and write everything into a folder of its own.

    Every accepted state is in the folder at once, in ``path``; response, steps and log grow with it. A run that stops
    early, or that the user interrupts, writes the path so far; ``outcome.solution.status`` says how it ended.

    Parameters
    ----------
    job : Job
        Usually from `read_job`.
    output : str or Path, optional
        Folder of results; ``<name>-results`` in the working directory if it is not given.
    force : bool
        Whether existing results in the folder are replaced.
    resume : bool
        Whether an unfinished run of this job in the folder continues from its last state; without one, the run begins.
    threads : int, optional
        Number of threads; by default that of the job, else all processors.
    notify : callable, optional
        ``notify(text)``, called with each activity.
    progress : callable or bool, optional
        As that of `solve`: a function, or whether a bar is shown; by default where a terminal or a notebook looks on.
    report : callable, optional
        ``found(finding)``, called before the solve with each error and warning that is known by then. By default these
        and the later ones are warnings of Python.

    Returns
    -------
    RunOutcome

    Raises
    ------
    TurgorError
        If the folder holds files, is in use or cannot be written (before the computation), the job cannot be meshed,
        or the run to continue is one of another job.
    """
    options = EngineOptions()
    count = threads if threads is not None else job.threads
    if count is not None:
        options = replace(options, threads=count)
    chosen = Path(output) if output is not None else default_folder(job.name)
    with claimed(chosen, force, resume) as folder, watched(progress) as watcher:
        files = GrowingFiles(folder, replace(job, threads=options.threads), notify or watcher.notify or silent)
        options = replace(options, notify=files.say)
        with _earlier_results(folder), closing(files):
            record = _record(files, options, resume)
            early = matter(record.question.findings or (), bool(job.output.mesh_error))
            for each in early:
                (report or show_warning)(each)
            outcome = _solved(files, record, options, watcher.progress)
        if outcome.solution.status is not Status.INTERRUPTED:
            drop_previous(folder)
        for each in matter(outcome.findings, mesh_error=False) if report is None else ():
            if each not in early:
                show_warning(each)
        return outcome


@contextmanager
def _earlier_results(folder: Path) -> Iterator[None]:
    """Bring the results of an earlier run back if the run that replaces them fails before its first state."""
    try:
        yield
    except Exception:
        with suppress(TurgorError, OSError):
            if not any((folder / PATH_FOLDER).glob("state-*")):
                bring_back(folder)
        raise


def _outcome(files: GrowingFiles, solution: Solution, response: Response, findings: tuple[Finding, ...]) -> RunOutcome:
    """Collect the results of a run that has ended, its files not yet."""
    return RunOutcome(
        job=files.job,
        solution=solution,
        response=response,
        findings=findings,
        written_by=versions() | {"linear_solver": solution.timing.linear_solver},
        notices=tuple(files.notices),
        folder=files.folder,
    )


def _record(files: GrowingFiles, options: EngineOptions, resume: bool) -> RunRecord:
    """Open the record of a run to continue, or prepare a job and begin one."""
    folder = files.folder / PATH_FOLDER
    if resume and (folder / INDEX).exists() and not (files.folder / MOVING).exists():  # else a new run was to begin
        record = RunRecord.open(folder)
        files.job = _settled(files.job, record.question.model)
        check_same_job(files.job, files.folder)
        files.go_on()
        files.say("continuing the path in the folder")
        return record
    announce_needs(kernel_needs(files.job))
    model, findings = prepare(files.job, files.say)
    files.job = _settled(files.job, model)
    save_mesh_of(files.job)
    set_aside(files.folder)
    files.begin()
    files.say(f"expected: {expected_of(files.job, model, options.threads)}")
    question = Question(model=model, procedure=files.job.procedure, options=options, findings=findings)
    return RunRecord.create(folder, question)


def _settled(job: Job, model: Model) -> Job:
    """A job whose setup states what was chosen in its model, as its lock file must."""
    return replace(job, setup=with_choices(job.setup, model))


def _solved(files: GrowingFiles, record: RunRecord, options: EngineOptions, progress: Heard | None) -> RunOutcome:
    """Solve a job, refine its mesh where it has a target, measure, and write all files; tables if the user ended it."""
    findings = record.question.findings or ()
    files.say("solving")
    record.on_checkpoint = _AtCheckpoints(files, record, ahead=options.threads > 1)
    question = replace(record.question, options=options)
    solution = follow_question(question, Listeners(progress), record, throw=False)
    if solution.status is Status.INTERRUPTED:
        reported = by_weight((*findings, *not_reported(solution.findings, findings)))
        outcome = _outcome(files, solution, files.response(solution), reported)
        return replace(outcome, files=write_tables(outcome, files.say))
    remember(files.job, solution)
    solution, refined = _refined(files.job, solution, options)
    files.say("measuring")
    outcome = _outcome(files, solution, files.response(solution), findings)
    return _written(files, outcome, refined, options)


@dataclass(slots=True)
class _AtCheckpoints:
    """What a run does at each checkpoint.

    If ``ahead``, the first one begins to load what is needed after the solve on another thread: the solve leaves
    processors idle.
    """

    files: GrowingFiles
    record: RunRecord
    ahead: bool

    def __call__(self) -> None:
        if self.ahead:
            self.ahead = False
            model = self.record.question.model
            touching = model.contact.for_mesh(model.mesh) is not None
            Thread(target=_load, args=((*AFTERWARDS, *(TOUCHING if touching else ())),), name="turgor-loads").start()
        self.files.grow(self.record)


def _load(names: Sequence[str]) -> None:
    with suppress(Exception):  # it is raised again where the module is needed
        for name in names:
            import_module(name)


def _written(
    files: GrowingFiles, outcome: RunOutcome, refined: tuple[Finding, ...], options: EngineOptions
) -> RunOutcome:
    """Add mesh errors and findings to an outcome, and write all files.

    Fields and pictures are written while the second mesh is solved: that leaves processors idle, and they need no
    mesh error.
    """
    solution, path = outcome.solution, files.fields(outcome.solution)
    pool = ThreadPoolExecutor(1)
    try:
        estimate = pool.submit(_with_errors, outcome.job, outcome.response, solution, options, bool(refined))
        from turgor.job.output.write import draw_path, write_results  # here: it loads what draws

        draw_path(outcome, files.say, path)
        response, unknown = estimate.result()
    finally:
        pool.shutdown(wait=False)  # an interrupt does not wait for it
    findings = outcome.findings
    hexahedra = solution.model.mesh.cell_type.corners == 8
    before = (*mesh_error_findings(response, findings, outcome.job.mesh.quality, hexahedra), *refined, *unknown)
    reported = by_weight((*before, *not_reported(solution.findings, findings)))
    outcome = _outcome(files, solution, response, reported)
    return replace(outcome, files=write_results(outcome, files.say, path))


def _refined(job: Job, solution: Solution, options: EngineOptions) -> tuple[Solution, tuple[Finding, ...]]:
    """Refine the mesh to the target of a job, if it has one and the path is complete."""
    if job.mesh_target is None or not solution.complete:
        return solution, ()
    from turgor.accuracy.adaptivity.mesh_to import refine_to  # here: few jobs need it

    measure = find_measure(job.mesh_target_measure or job.output.measures[0])
    refined = refine_to(
        solution,
        measure,
        job.mesh_target,
        most_unknowns=job.mesh_most_unknowns,
        options=options,
        notify=options.notify,
    )
    return refined.solution, (refined.finding,)


def _with_errors(
    job: Job, response: Response, solution: Solution, options: EngineOptions, refined: bool
) -> tuple[Response, tuple[Finding, ...]]:
    """Add the mesh errors to a response if the job requests them, and a finding where these are unknown."""
    if not job.output.mesh_error or len(solution.states) < 2:
        return response, ()
    from turgor.accuracy.measure import (  # here: not needed before a solve
        LINEAR,
        mesh_error_of,
        with_mesh_error,
    )

    if options.notify is not None:
        options.notify("estimating the mesh error")
    measures = job.output.chosen()
    estimate = mesh_error_of(solution, measures, options, refined, job.output.mesh_error == LINEAR, response)
    if options.notify is not None and estimate.states:
        options.notify(
            f"mesh error from a second mesh of {estimate.unknowns} unknowns in {estimate.seconds:.1f} s; "
            f"states solved on it: {len(estimate.states)}"
        )
    return with_mesh_error(response, estimate), () if estimate.finding is None else (estimate.finding,)
