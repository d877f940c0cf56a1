"""Command ``turgor optimize``: numbers of a job chosen so that targets are met, or that it is best within limits."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.analyses.calibrate import report_run
from turgor.cli.exits import DONE, NOT_CONVERGED, errors_as_sentences
from turgor.cli.options import Changes, Debug, Json, Retry, command_of, output_option
from turgor.cli.start.signals import ends_at_once, saved_in_folder

if TYPE_CHECKING:
    from turgor.studies.optimization.job_optimization import JobOptimization
    from turgor.studies.optimization.result import Optimization


@dataclass(frozen=True, slots=True, kw_only=True)
class _Options:
    study: Annotated[
        Path, typer.Argument(metavar="STUDY", help="Study file in TOML with a table [optimize].", show_default=False)
    ]
    most_solves: Annotated[
        int | None,
        typer.Option(help="Runs after which it ends; 25 by default.", show_default=False),
    ] = None
    mesh_error: Annotated[bool, typer.Option(help="Estimate the mesh error of the best design.")] = True
    processes: Annotated[int, typer.Option(help="Processes at once, each with one thread.", min=1)] = 1
    output: Annotated[
        Path | None,
        output_option("Folder of results; by default STUDY-optimization."),
    ] = None
    retry: Retry = False
    changes: Changes = None
    as_json: Json = False
    debug: Debug = False


def _run(options: _Options) -> None:
    """Choose numbers of a job so that targets are met, or that it is best within limits.

    Killed and called again, it goes on: nothing is computed twice.
    """
    with errors_as_sentences(options.debug, options.as_json) as answer, ends_at_once():
        from turgor.cli.answers.optimization import optimization_result
        from turgor.job.text.overrides import parse_changes
        from turgor.studies.optimization.job_optimization import job_optimization
        from turgor.studies.optimization.write import write_optimization
        from turgor.studies.study_file.study_file import read_study_file

        study = read_study_file(options.study, parse_changes(options.changes or ()), "optimize")
        plan = study.optimize
        assert plan is not None
        if options.most_solves is not None:
            plan = replace(plan, search=replace(plan.search, most_solves=options.most_solves))
        folder = options.output if options.output is not None else Path(f"{study.name}-optimization")
        problem = job_optimization(plan, study.job, folder, mesh_error=options.mesh_error)
        optimization = _searched(problem, folder, options)
        files = write_optimization(optimization, folder, problem.base)
        typer.echo(optimization.summary())
        typer.echo(f"Written in {folder}: {', '.join(file.name for file in files)}.")
        answer.give(lambda: optimization_result(optimization, files))
        raise typer.Exit(DONE if optimization.converged else NOT_CONVERGED)


def _searched(problem: "JobOptimization", folder: Path, options: _Options) -> "Optimization":
    from turgor.studies.runs.evaluations import saved_in
    from turgor.studies.runs.jobs.job_function import RUNS

    runs = saved_in(folder / RUNS, processes=options.processes, progress=report_run, retry=options.retry)
    with saved_in_folder(folder), runs:
        return problem.search(runs)


optimize_command = command_of(_Options, _run)
