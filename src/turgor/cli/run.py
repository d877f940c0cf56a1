"""Command ``turgor run``: check, build, mesh, solve, measure, and write everything into a folder."""

import signal
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, ENDED, FOUND_ERROR, NOT_CONVERGED, errors_as_sentences
from turgor.cli.options import Changes, Debug, JobFile, Json, command_of, output_option, requested_job
from turgor.cli.start.signals import RUN, ends_at_once
from turgor.foundation.startup.background_compiler import start_early

if TYPE_CHECKING:
    from turgor.cli.console import PlainDisplay
    from turgor.cli.live import LiveDisplay
    from turgor.foundation.finding import Finding
    from turgor.job.output.outcome import RunOutcome


@dataclass(frozen=True, slots=True, kw_only=True)
class RunOptions:
    """Arguments and options of ``turgor run``."""

    job: JobFile
    output: Annotated[
        Path | None,
        output_option("Folder of results; by default NAME-results here."),
    ] = None
    force: Annotated[bool, typer.Option("--force", help="Replace the results that the folder holds.")] = False
    resume: Annotated[bool, typer.Option("--resume", help="Continue the run in the folder from its last state.")] = (
        False
    )
    quiet: Annotated[bool, typer.Option("--quiet", help="Print errors and warnings only.")] = False
    threads: Annotated[
        int | None, typer.Option(min=1, help="Number of threads; by default all processors.", show_default=False)
    ] = None
    changes: Changes = None
    as_json: Json = False
    debug: Debug = False


def run(chosen: RunOptions) -> None:
    """Run a job: check, build, mesh, solve, measure, and write everything into a folder."""
    if chosen.job.exists():
        start_early()
    with errors_as_sentences(chosen.debug, chosen.as_json) as answer, ends_at_once(RUN) as received:
        from turgor.accuracy.adaptivity.findings import matter

        outcome, reported = _solve(chosen)
        if not chosen.quiet:
            _report(outcome)
        answer.give(lambda: _result(outcome))
        heavy = matter(outcome.findings, mesh_error=False)
        answer.warn(outcome.findings, [each for each in heavy if each not in reported])
        if not outcome.solution.complete and not chosen.as_json:
            typer.echo(f"{outcome.solution.message} {outcome.solution.advice}".strip(), err=True)
        if not outcome.solution.complete:
            code = _ended_early(outcome, received)
            if code > ENDED and not chosen.as_json:
                typer.echo("With --resume, it continues from its last state.", err=True)
            raise typer.Exit(code)
        raise typer.Exit(FOUND_ERROR if outcome.errors else DONE)


#: The command.
run_command = command_of(RunOptions, run)


def _solve(chosen: RunOptions) -> "tuple[RunOutcome, list[Finding]]":
    """Run a job; return the outcome, and the findings that were printed before the solve."""
    from turgor.job.run import run_job

    job = requested_job(chosen.job, chosen.changes)
    with _display(chosen.quiet or chosen.as_json) as show:
        outcome = run_job(
            job,
            chosen.output,
            force=chosen.force,
            resume=chosen.resume,
            threads=chosen.threads,
            notify=show.notify,
            progress=show.progress,
            report=show.report,
        )
    return outcome, show.reported


def _ended_early(outcome: "RunOutcome", received: list[int]) -> int:
    """Exit code of a run that was ended by a signal, or that stopped itself."""
    from turgor.core.solvers.solution import Status

    interrupted = outcome.solution.status is Status.INTERRUPTED
    return ENDED + (received or [signal.SIGINT])[0] if interrupted else NOT_CONVERGED


def _display(quiet: bool) -> "LiveDisplay | PlainDisplay":
    """Make a bar for a terminal, lines for anything else."""
    from turgor.cli.console import PlainConsole, PlainDisplay, may_be_terminal

    if quiet or not may_be_terminal():
        return PlainDisplay(PlainConsole(quiet))
    from turgor.cli.live import LiveDisplay, PatientConsole  # here: rich is slow to load, and logs need no bar

    console = PatientConsole()
    return LiveDisplay(console) if console.is_terminal else PlainDisplay(console)


def _result(outcome: "RunOutcome") -> object:
    from turgor.cli.answers.results import run_result  # here: it is for programs

    return run_result(outcome)


def _numbers(outcome: "RunOutcome") -> tuple[list[str], list[str]]:
    """Last values of what is measured, what the setup is for first, and names of what is zero throughout."""
    from turgor.core.results.error_text import is_zero, last_with_error
    from turgor.core.results.measures.headlines import in_regions, with_parts

    job, response = outcome.job, outcome.response
    own = [] if job.setup is None else [name for name in job.setup.measures if name in response]
    numbers: dict[str, str] = {}
    zeros: dict[str, str] = {}
    for each in (*own, *job.output.measures):
        regions = in_regions(response, each)
        for name in [each] if regions else with_parts(response, each):
            column = response.find(name)
            label = column.label.split(" [")[0]
            if is_zero(column) and name not in own:
                zeros[name] = label
                continue
            value = f"{label} {last_with_error(response, column)}"
            numbers[name] = f"{value} [{regions}]" if regions else value
    return list(numbers.values()), list(zeros.values())


def _report(outcome: "RunOutcome") -> None:
    """Print the end of the solve, the last values of the response, the folder of results, and where notes are."""
    from turgor.core.solvers.pressures import pressure_text
    from turgor.foundation.finding import Severity
    from turgor.job.output.folder import LOG

    solution = outcome.solution
    if solution.complete:
        typer.echo(f"{solution.message} {solution.advice}".strip())
    numbers, zeros = _numbers(outcome)
    drive = pressure_text(solution.states[-1]) or "the end"
    if numbers:
        typer.echo(f"At {drive}: {', '.join(numbers)}.")
    if zeros:
        typer.echo(f"Zero throughout: {', '.join(zeros)}.")
    typer.echo(f"Results in {outcome.folder}: {', '.join(str(f.relative_to(outcome.folder)) for f in outcome.files)}.")
    notes = sum(each.severity is Severity.NOTE for each in outcome.findings)
    if notes:
        where = outcome.files[0].name if outcome.job.output.report else LOG
        typer.echo(f"{notes} note{'s' if notes > 1 else ''} on the results in {where}.")
