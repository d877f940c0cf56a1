"""Command ``turgor calibrate``: numbers of a job fitted to experiments."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from turgor.cli.exits import DONE, NOT_CONVERGED, errors_as_sentences
from turgor.cli.options import Changes, Compliance, Debug, JobOrStudy, Json, Retry, command_of, output_option
from turgor.cli.start.signals import ends_at_once, saved_in_folder

if TYPE_CHECKING:
    from turgor.studies.runs.executors.run_outcome import Ended
    from turgor.studies.study_file.study_file import StudyFile

Texts = list[str] | None

#: What states each key of the table of a study file.
OPTIONS = {
    "experiments": "EXPERIMENT", "hold_out": "--hold-out", "rig": "--rig", "units": "--unit", "spread": "--spread",
    "y": "--y", "x": "--x", "loading": "--loading", "unloading": "--unloading", "by": "--by",
    "remove": "--remove", "ranges": "--range", "compliance": "--compliance",
}  # fmt: skip


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
    job: JobOrStudy
    experiments: Annotated[
        list[Path] | None, typer.Argument(metavar="EXPERIMENT...", help="Tables of a laboratory.", show_default=False)
    ] = None
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
    only_unloading: Annotated[bool, typer.Option("--unloading", help="Leave out rows in which the drive rises.")] = (
        False
    )
    by: Annotated[
        str, typer.Option(help="Column that tells specimens apart: their mean is fitted, weighted by their spread.")
    ] = ""
    remove: Annotated[Texts, often("--remove", "PART", "drift: what has not come back at the end of a record.")] = None
    compliance: Compliance = ""
    ranges: Annotated[
        Texts,
        often(
            "--range",
            "NAME=FROM..TO",
            "Rows to take by a measured column, such as pressure='0..30 kPa'; as often as needed.",
        ),
    ] = None
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


def _run(options: _Options) -> None:
    """Fit numbers of a job to experiments, with their errors, and report what is not determined.

    Killed and called again, it goes on: nothing is computed twice.
    """
    with errors_as_sentences(options.debug, options.as_json) as answer, ends_at_once():
        from turgor.cli.answers.studies import calibration_result
        from turgor.studies.calibration.job_calibration import CALIBRATED, calibrate_job, equal_constants
        from turgor.studies.calibration.write import write_calibration
        from turgor.studies.runs.evaluations import saved_in
        from turgor.studies.runs.jobs.job_function import RUNS, job_function

        study, name = _stated(options)
        plan = study.calibrate
        assert plan is not None
        if options.most_solves is not None:
            plan = replace(plan, most_solves=options.most_solves)
        folder = options.output if options.output is not None else Path(f"{name}-calibration")
        base = job_function(study.job, folder)
        for note in equal_constants(plan.free, base):
            typer.echo(note, err=True)
        runs = saved_in(folder / RUNS, processes=options.processes, progress=report_run, retry=options.retry)
        with saved_in_folder(folder):
            calibration = calibrate_job(plan, base, runs)
        files = [*write_calibration(calibration, folder), folder / CALIBRATED]
        base.write(calibration.values, files[-1], f"Calibrated:\n{calibration.summary()}")
        typer.echo(calibration.summary())
        typer.echo(f"Written in {folder}: {', '.join(file.name for file in files)}.")
        answer.give(lambda: calibration_result(calibration, files))
        raise typer.Exit(DONE if calibration.converged else NOT_CONVERGED)


calibrate_command = command_of(_Options, _run)


def _stated(options: _Options) -> "tuple[StudyFile, str]":
    """Read the study file, or what the options state."""
    from turgor.cli.analyses.stated import free_factors, stated_study
    from turgor.cli.options import name_and_unit

    factors = free_factors(options.free, options.prior)
    given: dict[str, Any] = {
        "experiments": [str(file) for file in options.experiments or ()],
        "hold_out": [str(file) for file in options.hold_out or ()],
        "rig": list(options.rig or ()),
        "units": dict(name_and_unit(each) for each in options.unit or ()),
        "spread": list(options.spread or ()),
        "y": options.y,
        "x": options.x,
        "loading": options.only_loading,
        "unloading": options.only_unloading,
        "by": options.by,
        "remove": list(options.remove or ()),
        "ranges": list(options.ranges or ()),
        "compliance": options.compliance,
    }
    table = {key: value for key, value in given.items() if value}
    places: dict[tuple[str, ...], str] = {}
    places |= {("factors", key): "--prior" if "prior" in each else "--free" for key, each in factors.items()}
    places |= {("calibrate", key): OPTIONS[key] for key in table}
    return stated_study(options.job, "calibrate", factors, table, places, options.changes)


def report_run(ended: "Ended") -> None:
    """Print how a run ended.

    Parameters
    ----------
    ended : Ended
    """
    seconds = "" if ended.result is None else f", {ended.result.seconds:.1f} CPU s"
    what = "failed" if ended.problem else "read" if ended.again else "done"
    typer.echo(f"  {ended.run.name}: {what}{seconds}{ended.problem and f': {ended.problem}'}", err=True)
