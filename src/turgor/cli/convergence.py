"""Command ``turgor convergence``: solve a job on three meshes and estimate the error."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.options import Changes, Debug, JobFile, Json, option_quantity, output_option, requested_job

if TYPE_CHECKING:
    from turgor.core.results.convergence.study import Convergence
    from turgor.job.job import Job

#: What it writes.
FILES = ("convergence.csv", "convergence.png", "convergence.txt")


def convergence_command(
    job: JobFile,
    sizes: Annotated[
        str, typer.Option(help="Mesh sizes, such as '4 mm, 2.8 mm, 2 mm', or their number, around that of the job.")
    ] = "3",
    measure: Annotated[str, typer.Option(help="Measure to compare.")] = "bending_angle",
    output: Annotated[
        Path | None,
        output_option("Folder of table and plot; by default NAME-convergence."),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace what the folder holds.")] = False,
    changes: Changes = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Solve a job on finer and finer meshes; print values, observed order, extrapolated value and error."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.results import convergence_result
        from turgor.core.results.measures.measures import find_measure
        from turgor.job.output.folder import claimed

        cell_sizes = _sizes(sizes)
        find_measure(measure)
        parsed = requested_job(job, changes)
        place = output if output is not None else Path(f"{parsed.name}-convergence")
        with claimed(place, force, files=FILES) as folder:
            study = _solve(parsed, cell_sizes, measure)
            _write(folder, parsed, study)
        _show(study)
        answer.give(lambda: convergence_result(study, folder))
        typer.echo(f"Table and plot in {folder}.")


def _sizes(text: str) -> int | list[float]:
    """Read ``"3"`` as a number of sizes and ``"4 mm, 2.8 mm, 2 mm"`` as sizes."""
    if text.strip().isdigit():
        return int(text)
    return [option_quantity("--sizes", part, "length") for part in text.split(",")]


def _solve(job: "Job", sizes: int | list[float], measure: str) -> "Convergence":
    from rich.console import Console

    from turgor.cli.console import PlainDisplay
    from turgor.cli.live import LiveDisplay
    from turgor.job.convergence import convergence

    console = Console()
    with LiveDisplay(console) if console.is_terminal else PlainDisplay(console) as display:
        return convergence(job, sizes, measure=measure, notify=display.notify, progress=display.progress)


def _write(folder: Path, job: "Job", study: "Convergence") -> None:
    from turgor.foundation.store.atomic_files import write_whole
    from turgor.job.output.manifest import list_files
    from turgor.views.plots.convergence import write_convergence_plot

    list_files(folder, FILES)
    table, plot, text = (folder / name for name in FILES)
    study.response.to_csv(table)
    write_convergence_plot(plot, study, title=job.name)
    write_whole(text, study.summary + "\n")


def _show(study: "Convergence") -> None:
    """Print a line for each mesh, and the extrapolation."""
    from turgor.units import mm

    rows = zip(study.sizes, study.effective_sizes, study.cells, study.unknowns, study.values, strict=True)
    typer.echo(f"{'size':>9}{'effective':>12}{'cells':>10}{'unknowns':>11}  {study.measure.name.replace('_', ' ')}")
    for size, effective, cells, unknowns, value in rows:
        typer.echo(
            f"{size / mm:>6.3g} mm{effective / mm:>9.3g} mm{cells:>10,}{unknowns:>11,}  {study.measure.text(value)}"
        )
    typer.echo(study.summary)
