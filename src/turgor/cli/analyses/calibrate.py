"""Command ``turgor calibrate``: numbers of a job found from experiments."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, nan
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, NOT_CONVERGED, errors_as_sentences
from turgor.cli.options import Changes, Debug, JobFile, Json, Retry, asked_job, command_of, output_option
from turgor.cli.start.signals import ends_at_once, kept_in_folder

if TYPE_CHECKING:
    from turgor.foundation.response import Response
    from turgor.studies.runs.executors.run_outcome import Ended

Texts = list[str] | None


def often(name: str, metavar: str, text: str) -> typer.models.OptionInfo:
    """Make an option that may be given as often as needed.

    Parameters
    ----------
    name, metavar, text : str

    Returns
    -------
    typer.models.OptionInfo
    """
    option: typer.models.OptionInfo = typer.Option(name, metavar=metavar, help=text, show_default=False)
    return option


@dataclass(frozen=True, slots=True, kw_only=True)
class _Options:
    job: JobFile
    experiments: Annotated[list[Path], typer.Argument(metavar="EXPERIMENT...", help="Tables of a laboratory.")]
    free: Annotated[
        Texts,
        often(
            "--free",
            "KEY[=START[:LOWER:UPPER]]",
            "A number of the job to find, such as materials.body.C10; as often as needed.",
        ),
    ] = None
    prior: Annotated[Texts, often("--prior", "KEY=MEAN+-DEVIATION", "What is known of a free number.")] = None
    rig: Annotated[
        Texts, often("--rig", "NAME", "Offset or scale of a measured column to find, such as pressure_offset.")
    ] = None
    hold_out: Annotated[
        list[Path] | None, often("--hold-out", "EXPERIMENT", "An experiment to predict, not to fit.")
    ] = None
    y: Annotated[
        str | None, typer.Option("--y", help="What to compare: NAME, or NAME=NAME THERE.", show_default=False)
    ] = None
    x: Annotated[str | None, typer.Option("--x", help="What drives; in the same manner.", show_default=False)] = None
    unit: Annotated[Texts, often("--unit", "NAME=UNIT", "Unit of a column whose header has none.")] = None
    spread: Annotated[
        Texts,
        often("--spread", "VALUE", "Standard deviation of a measured value, such as '1 deg'; one for each unit."),
    ] = None
    only_loading: Annotated[bool, typer.Option("--loading", help="Leave out rows in which the drive falls.")] = False
    processes: Annotated[int, typer.Option(help="Processes at once, each with one thread.", min=1)] = 1
    most_solves: Annotated[int | None, typer.Option(help="Runs after which the search ends.", show_default=False)] = (
        None
    )
    output: Annotated[
        Path | None,
        output_option("Folder of results; by default NAME-calibration."),
    ] = None
    retry: Retry = False
    changes: Changes = None
    as_json: Json = False
    debug: Debug = False


def _run(asked: _Options) -> None:
    """Find numbers of a job from experiments, with their errors, and say what is not determined.

    Killed and called again, it goes on: nothing is computed twice.
    """
    with errors_as_sentences(asked.debug, asked.as_json) as answer, ends_at_once():
        from turgor.cli.answers.studies import calibration_result
        from turgor.studies.calibration.calibrate import calibrate
        from turgor.studies.calibration.job_files import CALIBRATED, free_parameters, job_trial, left_as_they_are
        from turgor.studies.calibration.write import write_calibration
        from turgor.studies.runs.evaluations import kept_in
        from turgor.studies.runs.jobs.job_file import RUNS, job_file

        measured = [_measured(file, asked) for file in (*asked.experiments, *(asked.hold_out or ()))]
        job = asked_job(asked.job, asked.changes)
        folder = asked.output if asked.output is not None else Path(f"{job.name}-calibration")
        base = job_file(job, folder)
        free = free_parameters(asked.free or (), asked.prior or (), base)
        for note in left_as_they_are(free, base):
            typer.echo(note, err=True)
        pairs = zip(measured, _spreads(asked, measured), strict=True)
        count = len(asked.experiments)
        trials = [
            job_trial(base, each, y=asked.y, x=asked.x, spread=spread, fitted=measured[:count])
            for each, spread in pairs
        ]
        with kept_in_folder(folder):
            found = calibrate(
                trials[:count],
                free,
                rig=asked.rig or (),
                hold_out=trials[count:],
                most_solves=asked.most_solves,
                evaluations=kept_in(folder / RUNS, processes=asked.processes, progress=told_run, retry=asked.retry),
            )
        files = [*write_calibration(found, folder), folder / CALIBRATED]
        base.write(found.values, files[-1], f"Calibrated:\n{found.summary()}")
        typer.echo(found.summary())
        typer.echo(f"Written in {folder}: {', '.join(file.name for file in files)}.")
        answer.give(lambda: calibration_result(found, files))
        raise typer.Exit(DONE if found.converged else NOT_CONVERGED)


calibrate_command = command_of(_Options, _run)


def _measured(file: Path, asked: _Options) -> "Response":
    from turgor.accuracy.laboratory.read_experiment import read_experiment
    from turgor.accuracy.laboratory.runs import loading
    from turgor.cli.options import name_and_unit
    from turgor.core.results.drive import drive_of

    measured = read_experiment(file, units=dict(name_and_unit(each) for each in asked.unit or ()))
    return loading(measured, drive_of(measured)) if asked.only_loading else measured


def _spreads(asked: _Options, measured: "Sequence[Response]") -> list[float | None]:
    """Read standard deviations; each is that of the experiments with a column in its unit."""
    from turgor.foundation.errors import TurgorError
    from turgor.foundation.response import COLUMN_UNITS

    found: list[float | None] = [None] * len(measured)
    for text in asked.spread or ():
        number, _, unit = text.strip().partition(" ")
        fitting = [n for n, each in enumerate(measured) if any(unit and unit in c.units for c in each.columns)]
        try:
            value = float(number) * COLUMN_UNITS.get(unit, nan)
        except ValueError:
            value = nan
        if not (fitting and isfinite(value)):
            units = ", ".join(sorted({c.unit for each in measured for c in each.columns if c.unit}))
            raise TurgorError(f"--spread is '{text}'; write a number and a unit of the experiments ({units}).")
        for n in fitting:
            found[n] = value
    return found


def told_run(ended: "Ended") -> None:
    """Print how a run ended.

    Parameters
    ----------
    ended : Ended
    """
    seconds = "" if ended.found is None else f", {ended.found.seconds:.1f} CPU s"
    what = "failed" if ended.problem else "read" if ended.again else "done"
    typer.echo(f"  {ended.run.name}: {what}{seconds}{ended.problem and f': {ended.problem}'}", err=True)
