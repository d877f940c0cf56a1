"""Command ``turgor sweep``: a job at many designs, in processes that stay; runs are saved as they end."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, NOT_CONVERGED, errors_as_sentences
from turgor.cli.options import Changes, Debug, Json, Retry, command_of, output_option
from turgor.cli.start.signals import ends_at_once
from turgor.foundation.display import MOST_ROWS

if TYPE_CHECKING:
    from turgor.studies.runs.designs import Designs
    from turgor.studies.runs.study import Study
    from turgor.studies.study_file.sweep_table import SweepPlan


@dataclass(frozen=True, slots=True, kw_only=True)
class _Options:
    study: Annotated[Path, typer.Argument(metavar="STUDY", help="Study file in TOML.", show_default=False)]
    output: Annotated[
        Path | None,
        output_option("Folder of results; by default NAME-study here."),
    ] = None
    processes: Annotated[int, typer.Option(help="Processes at once, each with one thread.", min=1)] = 1
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Compute on the workers of a Dask scheduler: tcp://host:8786.",
                                 show_default=False)
    ] = None  # fmt: skip
    index: Annotated[
        int | None, typer.Option(metavar="TASK", help="Compute the share of one task alone, from 1, such as of a SLURM "
                                 "array; no table is written.", min=1, show_default=False)
    ] = None  # fmt: skip
    of: Annotated[
        int | None, typer.Option(metavar="TASKS", help="Number of tasks for --index; by default one for each design.",
                                 min=1, show_default=False)
    ] = None  # fmt: skip
    gather: Annotated[bool, typer.Option("--gather", help="Compute nothing: write the table of the saved runs.")] = (
        False
    )
    sbatch: Annotated[
        Path | None, typer.Option(metavar="SCRIPT", help="Write a job script of SLURM, an array with --of tasks.",
                                  show_default=False)
    ] = None  # fmt: skip
    dry_run: Annotated[bool, typer.Option("--dry-run", help="List the designs and compute nothing.")] = False
    force: Annotated[bool, typer.Option("--force", help="Replace the file of --sbatch if it exists.")] = False
    retry: Retry = False
    changes: Changes = None
    as_json: Json = False
    debug: Debug = False


def _run(options: _Options) -> None:
    """Compute a job at many designs: a table, pictures, and the whole curve of each.

    Killed and called again, it goes on: nothing is computed twice.
    """
    with errors_as_sentences(options.debug, options.as_json) as answer, ends_at_once():
        from turgor.cli.analyses.given_study import computed_study
        from turgor.cli.analyses.machines import (
            Script,
            check_retry,
            check_together,
            executor_of,
            share_of,
            write_script,
        )
        from turgor.cli.answers.sweeps import designs_result, sweep_result
        from turgor.job.text.overrides import parse_changes
        from turgor.studies.runs.files.study_folder import write_study
        from turgor.studies.study_file.study_file import read_study_file

        given = read_study_file(options.study, parse_changes(options.changes or ()), "sweep")
        plan = given.sweep
        assert plan is not None
        if options.dry_run:
            _list(plan.designs)
            answer.give(partial(designs_result, plan.designs))
            raise typer.Exit(DONE)
        folder = options.output if options.output is not None else Path(f"{given.name}-study")
        check_together(options.scheduler, options.index, options.of, options.gather, options.sbatch)
        check_retry(options.retry, options.gather, options.sbatch)
        if options.sbatch is not None:
            script = Script(file=options.sbatch, tasks=options.of, force=options.force)
            typer.echo(write_script(given, options.study, folder, script))
            answer.give(partial(designs_result, plan.designs))
            raise typer.Exit(DONE)
        if options.index is not None:
            plan = share_of(plan, options.index, options.of)
            given = replace(given, sweep=plan)
        executor = executor_of(options.scheduler, options.gather, options.processes)
        study = computed_study(given, folder, executor, retry=options.retry)
        if options.index is not None:
            failed = sum(row.response is None for row in study.rows)
            typer.echo(f"Task {options.index}: {len(study)} designs, {failed} failed; saved in {folder}.")
            answer.give(partial(designs_result, plan.designs))
            raise typer.Exit(NOT_CONVERGED if study.problems else DONE)
        measures = plan.measures or study.measures
        files = [write_study(study, folder, measures, plan.at)]
        pictures, sentences = _drawn(study, folder, plan)
        files += pictures
        for line in (*study.problems, *sentences):
            typer.echo(line)
        failed = sum(row.response is None for row in study.rows)
        typer.echo(f"{len(study)} designs, {failed} failed. Written in {folder}: {', '.join(f.name for f in files)}.")
        answer.give(lambda: sweep_result(study, study.table(measures, plan.at), sentences, files))
        raise typer.Exit(NOT_CONVERGED if study.problems else DONE)


sweep_command = command_of(_Options, _run)


def _drawn(study: "Study", folder: Path, plan: "SweepPlan") -> tuple[list[Path], list[str]]:
    """Draw each measure; return the files, and sentences on what mesh errors hide."""
    from turgor.studies.runs.pictures import hidden_by_mesh, study_picture
    from turgor.views.plots.figures import write_figure

    files: list[Path] = []
    sentences: list[str] = []
    for name in plan.measures or study.measures:
        if name in study.measures and name != (plan.at or ("",))[0] and len(study) > 1:
            files.append(folder / f"{name}.png")
            write_figure(files[-1], study_picture(study, name, plan.at))
            sentences += hidden_by_mesh(study, name, plan.at)
    return files, sentences


def _list(designs: "Designs") -> None:
    """Print the designs as a table."""
    names = ["", *(each.name for each in designs.factors)]
    rows: list[Sequence[str]] = [names]
    for k, values in enumerate(designs.values[:MOST_ROWS], start=1):
        rows.append([str(k), *(each.shown(values[each.name]) for each in designs.factors)])
    widths = [max(len(row[k]) for row in rows) for k in range(len(names))]
    for row in rows:
        typer.echo("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip())
    if len(designs) > MOST_ROWS:
        typer.echo(f"… and {len(designs) - MOST_ROWS} more")
    typer.echo(f"{len(designs)} designs: {designs.rule}.")
