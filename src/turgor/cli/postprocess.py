"""Commands on the folder of a run: measure it again, report it again, and compare it with an experiment."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Compliance, Debug, Json, check_new, name_and_unit, output_option
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.accuracy.laboratory.compare import Comparison

Folder = Annotated[Path, typer.Argument(metavar="FOLDER", help="Folder of a run, finished or not.")]


def report_command(folder: Folder, as_json: Json = False, debug: Debug = False) -> None:
    """Write response, pictures and report of a run again, from the states that it has saved."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.results import run_result
        from turgor.job.postprocess import report_folder

        outcome = report_folder(folder, lambda text: typer.echo(text, err=True))
        answer.warn(outcome.findings)
        answer.give(partial(run_result, outcome))
        typer.echo(f"{outcome.solution.message} {outcome.solution.advice}".strip())
        typer.echo(f"Written in {folder}: {', '.join(str(file.relative_to(folder)) for file in outcome.files)}.")
        raise typer.Exit(DONE)


def measure_command(
    folder: Folder,
    names: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[MEASURE]...", help="What to measure, with blanks or commas between; as the job says by default."
        ),
    ] = None,
    output: Annotated[
        Path | None,
        output_option("CSV file; the table is printed where none is given."),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the file of --output if it exists.")] = False,
    debug: Debug = False,
) -> None:
    """Measure the path of a run again, as far as it goes."""
    with errors_as_sentences(debug):
        from turgor.job.postprocess import measure_folder

        if output is not None:
            check_new(output, force, "--output")
        response = measure_folder(
            folder, tuple(name for each in names or () for name in each.replace(",", " ").split())
        )
        if output is not None:
            response.to_csv(output)
            typer.echo(f"{len(response)} states in {output}.")
        else:
            typer.echo(",".join(column.header for column in response.columns))
            for row in zip(*(column.in_unit.tolist() for column in response.columns), strict=True):
                typer.echo(",".join(f"{value:.7g}" for value in row))
        raise typer.Exit(DONE)


def branch_of(loading: bool, unloading: bool) -> str:
    """Return the branch that ``--loading`` and ``--unloading`` choose."""
    if loading and unloading:
        raise TurgorError("--loading and --unloading leave nothing; leave both out to compare both.")
    return "loading" if loading else "unloading" if unloading else "both"


def _tell_runs(run: Path, other: Path, comparison: "Comparison") -> None:
    """Print in which keys the jobs of two runs differ, and every column that both have."""
    from turgor.accuracy.laboratory.two_runs import differences, differing_keys
    from turgor.job.compare import stated_values

    stated = {path: stated_values(path) for path in (run, other)}
    unknown = [str(path) for path in stated if not stated[path]]
    keys = [] if unknown else differing_keys(stated[run], stated[other])
    for key, first, second in keys:
        typer.echo(f"  {key}: {first} against {second}")
    if unknown:
        typer.echo(f"The jobs are not compared: there is no lock file of {' and '.join(unknown)}.")
    elif not keys:
        typer.echo("The jobs have the same values, as far as their lock files say.")
    rows: list[tuple[str, ...]] = [("column", run.name, other.name, "RMS", "of range")]
    rows += [each.cells() for each in differences(comparison.computed, comparison.measured, comparison)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        typer.echo("  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip())


def compare_command(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="Folder of a run, or a CSV file of a response.")],
    experiment: Annotated[
        Path, typer.Argument(metavar="EXPERIMENT", help="Table of a laboratory: CSV or text; or another run.")
    ],
    y: Annotated[
        str | None,
        typer.Option("--y", help="What to compare: NAME, or NAME=NAME THERE.", show_default=False),
    ] = None,
    x: Annotated[
        str | None, typer.Option("--x", help="What drives, such as pressure; in the same manner.", show_default=False)
    ] = None,
    unit: Annotated[
        list[str] | None,
        typer.Option(help="Unit of a column whose header has none: NAME=UNIT; as often as needed.", show_default=False),
    ] = None,
    only_loading: Annotated[bool, typer.Option("--loading", help="Leave out rows in which the drive falls.")] = False,
    only_unloading: Annotated[
        bool, typer.Option("--unloading", help="Leave out rows in which the drive rises.")
    ] = False,
    by: Annotated[
        str, typer.Option(help="Column that tells specimens or runs apart: their mean is compared, and each.")
    ] = "",
    remove: Annotated[
        str, typer.Option(help="offset, drift, or both with a comma: what is taken away from the measured values.")
    ] = "",
    compliance: Compliance = "",
    ranges: Annotated[
        list[str] | None,
        typer.Option(
            "--range",
            metavar="NAME=FROM..TO",
            help="Rows to take by a measured column, such as pressure='0..30 kPa'; as often as needed.",
            show_default=False,
        ),
    ] = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Compare a run with an experiment: differences, the best shift of the drive, table and picture."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.accuracy.laboratory.chosen_rows import ChosenRows
        from turgor.cli.answers.results import compared_result
        from turgor.core.materials.experiments.machine import stated_machine
        from turgor.job.compare import ComparisonOptions, compare_folder, is_run

        units = dict(name_and_unit(each) for each in unit or ())
        rows = ChosenRows(
            units=units, ranges=ranges or (), branch=branch_of(only_loading, only_unloading), by=by,
            remove=[each.strip() for each in remove.split(",") if each.strip()], machine=stated_machine(compliance),
        )  # fmt: skip
        options = ComparisonOptions(y=y, x=x, rows=rows)
        comparison, files = compare_folder(run, experiment, options)
        typer.echo(comparison.summary()[:1].upper() + comparison.summary()[1:])
        for note in comparison.notes:
            typer.echo(note)
        if is_run(experiment):
            _tell_runs(run, experiment, comparison)
        if files:
            typer.echo(f"Written: {', '.join(map(str, files))}. 'turgor report {run}' adds it to the report.")
        answer.give(partial(compared_result, comparison, files))
        raise typer.Exit(DONE)
