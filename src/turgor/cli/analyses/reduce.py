"""Command ``turgor reduce``: a model of an actuator that answers in milliseconds, and what it says."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.analyses.calibrate import often
from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Changes, Debug, JobFile, Json, check_new, command_of, job_without_stages, output_option

if TYPE_CHECKING:
    from turgor.core.model.model import Model


@dataclass(frozen=True, slots=True, kw_only=True)
class _Options:
    job: JobFile
    along: Annotated[
        list[str] | None,
        often(
            "--along",
            "KEY=FROM..TO",
            "A load or the place of an obstacle, and its range: loads.pressure='0..20 kPa'; as often as needed.",
        ),
    ] = None
    output: Annotated[Path, output_option("The file; its ending is .reduced.")] = Path("actuator.reduced")
    error: Annotated[float, typer.Option(help="Wanted error of displacements, over the largest.")] = 0.005
    paths: Annotated[int, typer.Option(help="Training paths at most.", min=1)] = 24
    steps: Annotated[int, typer.Option(help="Steps of a path at least.", min=1)] = 12
    held_out: Annotated[int, typer.Option("--held-out", help="Paths of full solves kept from training.", min=0)] = 2
    folder: Annotated[
        Path | None, typer.Option(help="Where training paths are saved; the same call goes on.", show_default=False)
    ] = None
    processes: Annotated[int, typer.Option(help="Processes at once; more than one needs --folder.", min=1)] = 1
    motion: Annotated[bool, typer.Option("--motion", help="Train modes for motion with inertia, too.")] = False
    force: Annotated[bool, typer.Option("--force", help="Replace the file.")] = False
    changes: Changes = None
    as_json: Json = False
    debug: Debug = False


def _run(options: _Options) -> None:
    """Train a reduced model of a job: it answers in milliseconds, with its error."""
    with errors_as_sentences(options.debug, options.as_json) as answer:
        from turgor.cli.answers.reduced import reduced_result
        from turgor.foundation.errors import TurgorError
        from turgor.job.prepare import prepare
        from turgor.reduced.measures import with_measures
        from turgor.reduced.page import reduced_page
        from turgor.reduced.reduce import Budget, reduce
        from turgor.reduced.training.path_runs import PathRuns

        check_new(options.output, options.force, "--output")
        page = options.output.with_suffix(".html")
        check_new(page, options.force, "--output")
        job = job_without_stages(options.job, options.changes, "a reduced model")
        model, findings = prepare(job)
        ranges = _ranges(options.along or (), model)
        answer.warn(findings)
        budget = Budget(
            error=options.error, paths=options.paths, held_out=options.held_out, steps=options.steps,
            motion=options.motion,
        )  # fmt: skip
        if options.folder is None and options.processes > 1:
            raise TurgorError(f"--processes is {options.processes}, and more than one needs --folder.")
        runs = None if options.folder is None else PathRuns(options.folder, options.processes)
        reduced = with_measures(reduce(model, ranges, budget=budget, runs=runs, say=typer.echo), job.output.measures)
        file = reduced.save(options.output)
        errors = reduced.held_out
        if len(errors.inputs):
            shares = f"displacement {errors.worst:.2g} of the largest, tip {errors.tip.max():.2g} of its travel"
            typer.echo(
                f"{len(errors.inputs)} held-out states. Largest errors: {shares}, volume {errors.volume.max():.2g}."
            )
            if errors.force.any():
                typer.echo(f"Forces on obstacles: {errors.force.max():.2g} of the largest.")
        if errors.worst > options.error:
            typer.echo(f"The wanted error {options.error:g} is not reached; take more --steps or --paths.")
        page.write_text(reduced_page(reduced), encoding="utf-8")
        typer.echo(f"Written to {file}; its errors with pictures: {page}.")
        answer.give(lambda: reduced_result(reduced, file))
        raise typer.Exit(DONE)


reduce_command = command_of(_Options, _run)


def _ranges(texts: Sequence[str], model: "Model") -> dict[str, tuple[float, float]]:
    """Read what ``--along`` states, such as ``loads.pressure=0..20 kPa``; the first may have the other's unit."""
    from turgor.accuracy.gradients.model_keys import model_variation
    from turgor.foundation.errors import TurgorError
    from turgor.reduced.training.box import components_of
    from turgor.units import split_quantity

    ranges = {}
    for text in texts:
        key, sign, values = (part.strip() for part in text.partition("="))
        first, dots, last = (part.strip() for part in values.partition(".."))
        if not (sign and key and dots and first and last):
            raise TurgorError(f"--along is '{text}'; write KEY=FROM..TO, such as --along loads.pressure='0..20 kPa'.")
        single = components_of(model, key)[0]
        unit = model_variation(model, [single], inputs=True).units.get(single, "")
        given = split_quantity(last)
        if unit and given is not None and first.removeprefix("-").replace(".", "", 1).isdigit():
            first = f"{first} {given[1]}"
        high = number_of(last, key, unit, "--along")
        ranges[key] = (number_of(first, key, unit, "--along"), high)
    return ranges


def number_of(text: str, key: str, unit: str, option: str) -> float:
    """Read a value with its unit; a number in SI units where the key has none."""
    from turgor.studies.runs.jobs.job_numbers import JobNumber, read_number

    return read_number(text, JobNumber(key=key, value=0.0, unit=unit), f"{option} {key}")
