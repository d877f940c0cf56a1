"""Command ``turgor gradient``: how measures of a job change with its numbers."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from turgor.cli.analyses.calibrate import often
from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Changes, Debug, JobFile, Json, command_of, output_option, requested_job


@dataclass(frozen=True, slots=True, kw_only=True)
class _Options:
    job: JobFile
    wrt: Annotated[
        list[str] | None,
        often("--wrt", "KEY", "A number of the job, such as actuator.wall or materials.body.C10; as often as needed."),
    ] = None
    measures: Annotated[
        list[str] | None, often("--measure", "NAME", "What is differentiated; by default what the job measures.")
    ] = None
    output: Annotated[Path | None, output_option("A CSV file for the derivatives.")] = None
    changes: Changes = None
    as_json: Json = False
    debug: Debug = False


def _run(options: _Options) -> None:
    """Solve a job, and differentiate its measures at the full load by dimensions, materials and loads.

    The derivatives cost a fraction of the run, whatever their number.
    """
    with errors_as_sentences(options.debug, options.as_json) as answer:
        from turgor.cli.answers.studies import gradient_result
        from turgor.studies.runs.jobs.job_gradients import gradient_of_job

        job = requested_job(options.job, options.changes)
        gradient = gradient_of_job(job, options.wrt or (), options.measures or ())
        typer.echo(repr(gradient))
        if options.output is not None:
            typer.echo(f"Written to {gradient.to_csv(options.output)}.")
        answer.give(lambda: gradient_result(gradient, options.output))
        raise typer.Exit(DONE)


gradient_command = command_of(_Options, _run)
