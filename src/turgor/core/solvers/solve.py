"""solve: follow the equilibrium path of a model."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from math import inf
from pathlib import Path
from time import perf_counter

from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.runtime import FEW_UNKNOWNS, EngineOptions, use_threads
from turgor.core.engine.system import System
from turgor.core.engine.warmup.compiling import compile_kernels
from turgor.core.engine.warmup.needs import Needs
from turgor.core.meshing.refining.serendipity import with_middles
from turgor.core.model.continued_model import at_start
from turgor.core.model.model import Model
from turgor.core.solvers.checkpoints.record import Question, RunRecord
from turgor.core.solvers.checks.contact import deep_penetrations, elastic_slips, meeting_walls
from turgor.core.solvers.checks.distortion import turned_cells
from turgor.core.solvers.checks.early_findings import check_before_solve
from turgor.core.solvers.checks.explanations import explained
from turgor.core.solvers.checks.materials import rubber_findings
from turgor.core.solvers.checks.membranes import compressed_membranes
from turgor.core.solvers.checks.plate import plate_findings
from turgor.core.solvers.checks.supports import free_motions
from turgor.core.solvers.checks.time_steps import steps_too_long_for_channels, too_long_steps
from turgor.core.solvers.guide import check_guide
from turgor.core.solvers.listeners import Listeners
from turgor.core.solvers.path_outcomes import limit_point_findings, unwatched_stability
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.procedure import Procedure, with_contact_within
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.progress.watchers import Progress as Progress
from turgor.core.solvers.progress.watchers import watched
from turgor.core.solvers.restart import Restart
from turgor.core.solvers.row_guide import guide_of
from turgor.core.solvers.solution import Solution, SolveError, State, Status, Timing
from turgor.core.solvers.stage_sequence import Follow, solve_stages
from turgor.foundation.finding import by_weight, show_warning
from turgor.foundation.given import one

Stop = Callable[[State], str | None]


def solve(
    model: Model,
    procedure: Procedure | None = None,
    *,
    progress: Progress = None,
    stop: Stop | None = None,
    options: EngineOptions | None = None,
    folder: str | Path | None = None,
    guide: Solution | None = None,
    throw: bool = True,
) -> Solution:
    """Follow the equilibrium path of a model from the undeformed state to the full load.

    Parameters
    ----------
    model : Model
        The question.
    procedure : Static, VolumeControl, GasMass, ArcLength, Auto, Stabilized, Dynamic or Stages
        How the path is followed; `Static` if it is not given. `Stages` follows several in turn.
    progress : callable or bool, optional
        Whether a bar is shown; by default where a terminal or a notebook looks on. Or a function
        ``progress(iteration, state)``, called after every Newton update (state None), after every accepted step (with
        its state), and after every rejected one (``iteration.rejected`` says why). The logger ``turgor`` has a record
        of each accepted step, too.
    stop : callable
        ``stop(state)`` ends the run early by returning the reason, a few words.
    options : EngineOptions
        Linear solver, threads, where notices go, Newton's method.
    folder : str or Path, optional
        Where every accepted state is saved at once. Whatever ends the run, `resume` goes on from the last one, and
        `load` reads the path so far.
    guide : Solution, optional
        The path of a similar model on the same elements: of another rubber, or of a design that differs a little. Steps
        of `Static` then start from its displacement and go straight to the requested load factors, at most ``max_step``
        apart.
    throw : bool
        Whether a run that stops early raises `SolveError` (which holds the path so far) or returns the path.

    Returns
    -------
    Solution
        The path with its status, message and advice.

    Raises
    ------
    TurgorError
        If the supports leave a rigid motion free, prescribe the whole surface of an incompressible body, or the folder
        holds a run already, or the guide is of another mesh or body, or the procedure is not `Static`.
    SolveError
        If the full load was not reached and ``throw`` is set.

    Warns
    -----
    FindingWarning
        For each finding that is a warning or an error, once; those that are known before the solve come before it.
    """
    one(model, Model, "model", "a Model is needed, as Model(mesh, materials, supports, loads) makes it")
    procedure = Static() if procedure is None else procedure
    one(procedure, Procedure, "procedure", "an object is needed, such as Static()")
    one(options or EngineOptions(), EngineOptions, "options", "EngineOptions are needed")
    one(stop, Callable | None, "stop", "a function of a state is needed")  # type: ignore[arg-type]
    if guide is not None:
        check_guide(model, procedure, guide)
    options = options or EngineOptions()
    question = Question(model=model, procedure=procedure, options=options, guide=guide)
    record = None if folder is None else RunRecord.create(Path(folder), question)
    return _followed(question, progress, stop, record, throw)


def resume(
    folder: str | Path,
    *,
    progress: Progress = None,
    stop: Stop | None = None,
    options: EngineOptions | None = None,
    throw: bool = True,
) -> Solution:
    """Go on with a solve that was ended from outside, from its last accepted state.

    The answers are those of a run that was not ended. A run that had ended by itself is returned as it is.

    Parameters
    ----------
    folder : str or Path
        That of `solve`.
    progress, stop, options, throw
        As those of `solve`; the options of the run by default.

    Returns
    -------
    Solution

    Raises
    ------
    TurgorError
        If the folder holds no run.
    SolveError
        If the full load was not reached and ``throw`` is set.
    """
    record = RunRecord.open(Path(folder))
    question = record.question if options is None else replace(record.question, options=options)
    return _followed(question, progress, stop, record, throw)


def _followed(
    question: Question, progress: Progress, stop: Stop | None, record: RunRecord | None, throw: bool
) -> Solution:
    """Follow a question for a script: with a bar in a terminal or a notebook, and its findings as warnings."""
    with watched(progress) as watcher:
        if question.options.notify is None and watcher.notify is not None:
            question = replace(question, options=replace(question.options, notify=watcher.notify))
        return follow_question(question, Listeners(watcher.progress, stop, show_warning), record, throw)


def follow_question(question: Question, listeners: Listeners, record: RunRecord | None, throw: bool) -> Solution:
    """Solve the question of a run, from its beginning or from where its record ends.

    Parameters
    ----------
    question : Question
    listeners : Listeners
    record : RunRecord or None
    throw : bool
        As that of `solve`.

    Returns
    -------
    Solution
    """
    model, procedure = question.model, question.procedure
    solution = None if record is None else record.finished()
    if solution is not None:
        listeners.tell(solution.findings)
    else:
        early = check_before_solve(model, procedure) if question.findings is None else question.findings
        listeners.tell(early)
        model, one = with_contact_within(model, procedure), partial(_from_start, question, record)
        if procedure.stages:
            solution = solve_stages(model, procedure, listeners, one)
        else:
            solution, _ = one(model, procedure, listeners, None)
        beyond = rubber_findings(solution.model, solution.states)  # its mesh may be a finer one
        plates = plate_findings(solution.model, solution.states)
        listeners.tell(each for each in by_weight((*beyond, *plates, *solution.findings)) if each not in early)
        solution = replace(solution, findings=by_weight((*early, *beyond, *plates, *solution.findings)))
        solution = explained(solution)
        if record is not None and solution.status is not Status.INTERRUPTED:
            record.finish(solution)
    if throw and not solution.complete:
        raise SolveError(solution)
    return solution


def _from_start(
    question: Question,
    record: RunRecord | None,
    model: Model,
    procedure: Procedure,
    listeners: Listeners,
    restart: Restart | None,
) -> tuple[Solution, Restart]:
    """Follow one procedure as `_solved` does, after an equilibrium of the loads that are there from the start."""
    if procedure.remesh:
        model = replace(model, mesh=with_middles(model.mesh))
    flies = procedure.may_be_free(model) and free_motions(model)  # without any equilibrium to begin with
    before = at_start(model) if restart is None and not flies else None
    follow: Follow = partial(_solved, question, record)
    if procedure.remesh:
        from turgor.core.solvers.remeshing.on_the_way import follow_remeshing  # here: few jobs need it

        follow = partial(follow_remeshing, follow, question.options)
    if before is None:
        return follow(model, procedure, listeners, restart)
    question = replace(question, guide=None)  # the path of another model, which begins at rest
    first, restart = _solved(question, record, before, Static(), Listeners(None, listeners.stop), None)
    if not first.complete:
        return replace(first, message=f"Loads that are there from the start: {first.message}"), restart
    solution, restart = follow(model, procedure, listeners, restart)
    return replace(solution, timing=Timing.together([first.timing, solution.timing])), restart


def _solved(
    question: Question,
    record: RunRecord | None,
    model: Model,
    procedure: Procedure,
    listeners: Listeners,
    restart: Restart | None,
) -> tuple[Solution, Restart]:
    """Follow one procedure from rest, or from the restart of a former stage; return its own restart, too."""
    options, start = question.options, perf_counter()
    stage, model = (None, model) if record is None else record.stage(model)
    threads = options.threads if model.mesh.unknown_count >= FEW_UNKNOWNS else 1
    with use_threads(threads):
        compiling = compile_kernels(options.notify, Needs.of(model))
        setup = perf_counter()
        system = System(model, procedure.controlled(model))
        history = system.history(step=inf)  # slow enough to relax, unless the procedure has a time
        tangent = Tangent(system, options.linear_solver, threads, options.iteration)
        setup = perf_counter() - setup
        if restart is not None:
            restart.restore(system)
            history = restart.history(system)
        leading = perf_counter()
        guide = None if restart is not None else guide_of(question.guide, system, tangent, procedure, options)
        leading = perf_counter() - leading
        problem = Problem(
            system=system,
            tangent=tangent,
            listeners=listeners,
            restart=restart,
            history=history,
            record=None if stage is None else stage.of(system),
            guide=guide,
        )
        problem.take_over()
        outcome = procedure.follow(problem)
    timing = _timing(tangent, (compiling, setup, leading), start)
    findings = (
        *meeting_walls(model, problem.states),
        *deep_penetrations(problem.states),
        *compressed_membranes(model, problem.states),
        *turned_cells(model, problem.states),
        *elastic_slips(system, problem.states),
        *limit_point_findings(problem.limits, procedure.limit_points),
        *unwatched_stability(tangent.iterative, system.size),
        *procedure.findings(problem.states),
        *too_long_steps(model, procedure, problem.states),
        *steps_too_long_for_channels(problem.states),
    )
    solution = Solution(
        model=model,
        procedure=procedure,
        states=tuple(problem.states),
        status=outcome.status,
        message=outcome.message,
        advice=outcome.advice,
        steps=tuple(problem.steps),
        findings=findings,
        timing=timing,
        limit_points=tuple(problem.limits),
    )
    return solution, Restart.of(system, problem.states[-1])


def _timing(tangent: Tangent, before: tuple[float, float, float], start: float) -> Timing:
    """Where the time since ``start`` went; ``before`` is that of compilation, setup and the guide."""
    clock, (compiling, setup, leading) = tangent.clock, before
    return Timing(
        compile=compiling,
        setup=setup,
        guide=leading,
        assembly=clock.assembly,
        residual=clock.residual,
        factorization=clock.factorization,
        solve=clock.solve,
        total=perf_counter() - start,
        factorizations=clock.factorizations,
        linear_solver=tangent.name,
    )
