"""Command line: each command is a thin call of a public function.

Exit codes: 0 done, 1 usage or bad input, 2 a check found an error, 3 not converged (the path so far is written).
Heavy imports stand inside the commands, so that help and error messages appear at once.
"""

import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor import __version__
from turgor.cli.again import measure_command, report_command
from turgor.cli.answers.document import document
from turgor.cli.answers.results import run_result
from turgor.cli.check import check_command
from turgor.cli.convergence import convergence_command
from turgor.cli.exits import BAD_INPUT, DONE, FOUND_ERROR, NOT_CONVERGED, errors_as_sentences
from turgor.cli.export import export_command
from turgor.cli.families.actuators import actuators_command
from turgor.cli.families.init import init_command
from turgor.cli.fitting.fit import fit_command
from turgor.cli.inspect import inspect_command
from turgor.cli.materials import materials_app
from turgor.cli.mesh import mesh_command
from turgor.cli.modes import modes_command
from turgor.cli.options import JSON, Changes, Debug, JobFile, Json, asked_job
from turgor.cli.signals import ends_at_once

if TYPE_CHECKING:
    from turgor.finding import Finding
    from turgor.job.job import Job
    from turgor.job.output.outcome import RunOutcome

app = typer.Typer(
    add_completion=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="Finite element modeling of soft fluidic actuators.",
    epilog="Exit codes: 0 done, 1 usage or bad input, 2 a check found an error, 3 not converged.",
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return the exit code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        code = app(given or ["--help"], prog_name="turgor", standalone_mode=False)
    except typer.Abort:
        return NOT_CONVERGED
    except Exception as error:
        # mistakes in the arguments are exceptions of typer with a message
        if not hasattr(error, "format_message"):
            raise
        sentence = f"{_sentence(error.format_message())} See 'turgor --help'."
        if JSON in given:
            typer.echo(document(BAD_INPUT, None, (), sentence))
        else:
            typer.echo(f"turgor: {sentence}", err=True)
        return BAD_INPUT
    if not given:
        return BAD_INPUT
    return code if isinstance(code, int) else DONE


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"turgor {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version and stop.")
    ] = False,
) -> None:
    """Read the options before the command."""


@app.command("run")
def _run(
    job: JobFile,
    output: Annotated[
        Path | None, typer.Option(help="Folder of results; by default NAME-results here.", show_default=False)
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the results that the folder holds.")] = False,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on with the run in the folder, from its last state.")
    ] = False,
    quiet: Annotated[bool, typer.Option("--quiet", help="Print errors and warnings only.")] = False,
    threads: Annotated[
        int | None, typer.Option(min=1, help="Number of threads; by default all processors.", show_default=False)
    ] = None,
    changes: Changes = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Run a job: check, build, mesh, solve, measure, and write everything into a folder."""
    with errors_as_sentences(debug, as_json) as answer, ends_at_once():
        from turgor.adaptivity.findings import matter

        outcome, told = _solve(asked_job(job, changes), output, (force, resume), quiet or as_json, threads)
        if not quiet:
            _tell(outcome)
        answer.give(partial(run_result, outcome))
        heavy = matter(outcome.findings, mesh_error=False)
        answer.warn(outcome.findings, [found for found in heavy if found not in told])
        if not outcome.solution.complete and not as_json:
            typer.echo(f"{outcome.solution.message} {outcome.solution.advice}".strip(), err=True)
        if not outcome.solution.complete:
            raise typer.Exit(NOT_CONVERGED)
        raise typer.Exit(FOUND_ERROR if outcome.errors else DONE)


app.add_typer(materials_app, name="materials")
app.command("actuators")(actuators_command)
app.command("check")(check_command)
app.command("init")(init_command)
app.command("report")(report_command)
app.command("measure")(measure_command)
app.command("inspect")(inspect_command)
app.command("fit")(fit_command)
app.command("export")(export_command)
app.command("mesh")(mesh_command)
app.command("modes")(modes_command)
app.command("convergence")(convergence_command)


def _solve(
    job: "Job", output: Path | None, again: tuple[bool, bool], quiet: bool, threads: int | None
) -> "tuple[RunOutcome, list[Finding]]":
    """Run a job; return the outcome, and the findings that were printed before the solve.

    ``again`` says whether to replace the results in the folder, and whether to go on with its run.
    """
    from turgor.cli.console import LiveDisplay, PatientConsole, PlainDisplay
    from turgor.job.run import run_job

    console, (force, resume) = PatientConsole(quiet=quiet), again
    with LiveDisplay(console) if console.is_terminal and not quiet else PlainDisplay(console) as show:
        outcome = run_job(
            job,
            output,
            force=force,
            resume=resume,
            threads=threads,
            notify=show.notify,
            progress=show.progress,
            found=show.found,
        )
    return outcome, show.told


def _tell(outcome: "RunOutcome") -> None:
    """Print the end of the solve, the last values of the response, the folder of results, and where notes are."""
    from turgor.finding import Severity
    from turgor.job.output.folder import LOG
    from turgor.results.measures.headlines import in_regions, with_parts
    from turgor.results.report.error_text import last_with_error
    from turgor.solvers.pressures import pressure_text

    solution, response = outcome.solution, outcome.response
    if solution.complete:
        typer.echo(f"{solution.message} {solution.advice}".strip())
    numbers: dict[str, str] = {}
    for each in outcome.job.output.measures:
        regions = in_regions(response, each)
        for name in [each] if regions else with_parts(response, each):
            column = response.find(name)
            said = f"{column.label.split(' [')[0]} {last_with_error(response, column)}"
            numbers[name] = f"{said} [{regions}]" if regions else said
    drive = pressure_text(solution.states[-1]) or "the end"
    typer.echo(f"At {drive}: {', '.join(numbers.values())}.")
    typer.echo(f"Results in {outcome.folder}: {', '.join(str(f.relative_to(outcome.folder)) for f in outcome.files)}.")
    notes = sum(found.severity is Severity.NOTE for found in outcome.findings)
    if notes:
        where = outcome.files[0].name if outcome.job.output.report else LOG
        typer.echo(f"{notes} note{'s' if notes > 1 else ''} on the results in {where}.")


def _sentence(text: str) -> str:
    """End a text with a period."""
    return text if text.endswith((".", "?", "!", ")")) else f"{text}."
