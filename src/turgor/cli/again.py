"""Commands on the folder of a run: measure it again, and report it again."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Debug, Json

Folder = Annotated[Path, typer.Argument(metavar="FOLDER", help="Folder of a run, finished or not.")]


def report_command(folder: Folder, as_json: Json = False, debug: Debug = False) -> None:
    """Write response, pictures and report of a run anew, as far as its path goes."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.results import run_result
        from turgor.job.again import report_folder

        outcome = report_folder(folder, lambda text: typer.echo(text, err=True))
        answer.warn(outcome.findings)
        answer.give(partial(run_result, outcome))
        typer.echo(f"{outcome.solution.message} {outcome.solution.advice}".strip())
        typer.echo(f"Written in {folder}: {', '.join(str(file.relative_to(folder)) for file in outcome.files)}.")
        raise typer.Exit(DONE)


def measure_command(
    folder: Folder,
    names: Annotated[
        list[str] | None, typer.Argument(metavar="[MEASURE]...", help="What to measure; as the job says by default.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option(help="CSV file; the table is printed where none is given.", show_default=False)
    ] = None,
    debug: Debug = False,
) -> None:
    """Measure the path of a run again, as far as it goes."""
    with errors_as_sentences(debug):
        from turgor.job.again import measure_folder

        response = measure_folder(folder, tuple(names or ()))
        if output is not None:
            response.to_csv(output)
            typer.echo(f"{len(response)} states in {output}.")
        else:
            typer.echo(",".join(column.header for column in response.columns))
            for row in zip(*(column.in_unit.tolist() for column in response.columns), strict=True):
                typer.echo(",".join(f"{value:.7g}" for value in row))
        raise typer.Exit(DONE)
