"""Command line: each command is a thin call of a public function.

Exit codes: 0 done, 1 usage or bad input, 2 a check found an error, 3 not converged (the path so far is written).
Heavy imports stand inside the commands, so that help and error messages appear at once.
"""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor import __version__
from turgor.cli.again import measure_command, report_command
from turgor.cli.convergence import convergence_command
from turgor.cli.exits import BAD_INPUT, DONE, FOUND_ERROR, NOT_CONVERGED, errors_as_sentences, warn
from turgor.cli.export import export_command
from turgor.cli.fit import fit_command
from turgor.cli.inspect import inspect_command
from turgor.cli.materials import materials_app
from turgor.cli.mesh import mesh_command
from turgor.cli.modes import modes_command
from turgor.cli.signals import ends_at_once

if TYPE_CHECKING:
    from turgor.finding import Finding
    from turgor.job.output.outcome import RunOutcome

app = typer.Typer(
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="Finite element modeling of soft fluidic actuators.",
    epilog="Exit codes: 0 done, 1 usage or bad input, 2 a check found an error, 3 not converged.",
)

JobFile = Annotated[Path, typer.Argument(metavar="JOB", help="Job file in TOML.", show_default=False)]
Debug = Annotated[bool, typer.Option("--debug", help="Show where an error was raised.")]


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
        typer.echo(f"turgor: {_sentence(error.format_message())} See 'turgor --help'.", err=True)
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
    debug: Debug = False,
) -> None:
    """Run a job: check, build, mesh, solve, measure, and write everything into a folder."""
    with errors_as_sentences(debug), ends_at_once():
        from turgor.adaptivity.findings import matter

        outcome, told = _solve(job, output, (force, resume), quiet, threads)
        if not quiet:
            _tell(outcome)
        heavy = matter(outcome.findings, mesh_error=False)
        warn([found for found in heavy if found not in told])
        if not outcome.solution.complete:
            typer.echo(f"{outcome.solution.message} {outcome.solution.advice}".strip(), err=True)
            raise typer.Exit(NOT_CONVERGED)
        raise typer.Exit(FOUND_ERROR if outcome.errors else DONE)


@app.command("check")
def _check(job: JobFile, debug: Debug = False) -> None:
    """Read, build, mesh and check a job without solving it."""
    with errors_as_sentences(debug):
        from turgor.adaptivity.findings import ONLY_WITH_ERROR
        from turgor.finding import Severity
        from turgor.job.read import read_job
        from turgor.job.run import prepare
        from turgor.results.report.describe import contact
        from turgor.results.report.describe_procedure import procedure
        from turgor.solvers.procedures.stages import Stages

        asked = read_job(job)
        model, findings = prepare(asked)
        mesh = model.mesh
        typer.echo(f"{job} is a valid job: {mesh.name}; {len(mesh.cells)} cells, {mesh.unknown_count} unknowns.")
        for sentence in contact(model):
            typer.echo(sentence)
        if isinstance(asked.procedure, Stages):
            for name, changes in procedure(asked.procedure):
                typer.echo(f"Stage '{name}': {changes}.")
        warn([found for found in findings if found.code != ONLY_WITH_ERROR])
        raise typer.Exit(FOUND_ERROR if any(found.severity is Severity.ERROR for found in findings) else DONE)


@app.command("actuators")
def _actuators() -> None:
    """List the actuator families and their keys with defaults."""
    with errors_as_sentences(debug=False):
        from dataclasses import fields

        from turgor.job.job import ACTUATORS
        from turgor.job.output.lock import dimensions
        from turgor.job.text.quantities import shown

        for name, family in ACTUATORS.items():
            typer.echo(f"{name}: {(family.__doc__ or '').splitlines()[0]}")
            values = dimensions(family())
            for item in fields(family):  # type: ignore[arg-type]
                typer.echo(f"  {item.name} = {shown(values[item.name])}")
        typer.echo("cad_file: An actuator from a CAD file; `turgor inspect` shows what it holds.")
        typer.echo("  file, unit, faces, regions, split")


app.add_typer(materials_app, name="materials")
app.command("report")(report_command)
app.command("measure")(measure_command)
app.command("inspect")(inspect_command)
app.command("fit")(fit_command)
app.command("export")(export_command)
app.command("mesh")(mesh_command)
app.command("modes")(modes_command)
app.command("convergence")(convergence_command)


def _solve(
    job: Path, output: Path | None, again: tuple[bool, bool], quiet: bool, threads: int | None
) -> "tuple[RunOutcome, list[Finding]]":
    """Run a job; return the outcome, and the findings that were printed before the solve.

    ``again`` says whether to replace the results in the folder, and whether to go on with its run.
    """
    from turgor.job.read import read_job

    question = read_job(job)
    from turgor.cli.console import LiveDisplay, PatientConsole, PlainDisplay
    from turgor.job.run import run_job

    console, (force, resume) = PatientConsole(quiet=quiet), again
    with LiveDisplay(console) if console.is_terminal and not quiet else PlainDisplay(console) as show:
        outcome = run_job(
            question,
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
