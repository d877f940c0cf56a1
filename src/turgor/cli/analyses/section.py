"""Command ``turgor section``: curvature, twist, stretch and ballooning of the uniform part of an actuator."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, NOT_CONVERGED, errors_as_sentences
from turgor.cli.options import Changes, Debug, JobFile, Json, job_without_stages, option_quantity, output_option

if TYPE_CHECKING:
    from turgor.fast_models.section.solution import SectionSolution
    from turgor.job.job import Job

#: Columns of the table on the screen.
PRINTED = ("curvature_y", "curvature_z", "twist", "stretch", "cavity_ballooning", "outside_ballooning")

#: What it writes.
FILES = ("section.csv", "section.png")


def section_command(
    job: JobFile,
    rows: Annotated[int, typer.Option(help="Number of states, up to the pressures of the job.")] = 20,
    size: Annotated[
        str, typer.Option(help="Longest edge of a cell, such as '1 mm'; by default some sixty cells.")
    ] = "",
    ends: Annotated[str, typer.Option(help="'closed': the pressure pushes on the ends, too; or 'open'.")] = "closed",
    output: Annotated[
        Path | None,
        output_option("Folder of table and plot; by default NAME-section."),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace what the folder holds.")] = False,
    changes: Changes = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Solve the cross-section of a long actuator: curvature, twist, stretch and ballooning against pressure."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.results import section_result
        from turgor.job.output.folder import claimed
        from turgor.job.section import section_of, solve_section

        length = _length(size)
        requested = job_without_stages(job, changes, "a section")
        section = section_of(requested, length, ends)
        typer.echo(f"{section!r}")
        solution = solve_section(requested, section, rows)
        with claimed(output if output is not None else Path(f"{requested.name}-section"), force, files=FILES) as folder:
            _write(folder, requested, solution)
        _show(solution)
        answer.warn(solution.response.findings)
        answer.give(lambda: section_result(requested.name, solution, folder))
        typer.echo(f"Table and plot in {folder}.")
        if solution.response.message:
            typer.echo(solution.response.message, err=True)
        raise typer.Exit(NOT_CONVERGED if solution.response.message else DONE)


def _length(size: str) -> float | None:
    return option_quantity("--size", size, "length") if size else None


def _write(folder: Path, job: "Job", solution: "SectionSolution") -> None:
    from turgor.job.output.manifest import list_files
    from turgor.views.plots.section import write_section_plot

    list_files(folder, FILES)
    table, plot = (folder / name for name in FILES)
    solution.response.to_csv(table)
    if len(solution.response):
        write_section_plot(plot, solution, title=f"{job.name}, section")


def _show(solution: "SectionSolution") -> None:
    """Print a line for each state, with the columns that are not zero all along, then the last one with mesh errors."""
    from turgor.core.results.error_text import last_with_error

    response = solution.response
    names = [response.names[0], *(name for name in PRINTED if name in response and abs(response[name]).max() > 1e-9)]
    columns = [response.find(name) for name in names]
    typer.echo("  ".join(f"{column.header:>18}" for column in columns) + "  stable")
    for row, stable in enumerate(solution.stable):
        typer.echo("  ".join(f"{column.in_unit[row]:18.5g}" for column in columns) + ("  yes" if stable else "  no"))
    if len(response):
        last = [f"{column.words} {last_with_error(response, column)}" for column in columns]
        typer.echo(f"Last state, ± the estimated mesh error: {', '.join(last)}.")
