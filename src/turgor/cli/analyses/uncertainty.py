"""Command ``turgor uncertainty``: the spread of rubber, dimensions and pressure propagated to the response of a job."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from turgor.cli.analyses.calibrate import often, report_run
from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Changes, Debug, JobOrStudy, Json, Retry, command_of, output_option
from turgor.cli.start.signals import ends_at_once, saved_in_folder

if TYPE_CHECKING:
    from turgor.studies.study_file.study_file import StudyFile

#: What the options state by default.
DEFAULTS = {
    "sets": {}, "records": {}, "leave_out_doubtful": False, "method": "linear", "at": "", "mesh_error": True
}  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class _Options:
    job: JobOrStudy
    spread: Annotated[
        list[str] | None,
        often("--spread", "KEY=DEVIATION", "Standard deviation of a number of the job, or of the pressure, such as "
              "actuator.wall='0.1 mm'; also KEY=MEAN+-DEVIATION, replicates '1 mm;1.1 mm', and 'as LABEL' behind it. "
              "materials.body=library is the spread between laboratories, materials.body=fitted that of a fit's file."),
    ] = None  # fmt: skip
    sets: Annotated[
        list[str] | None,
        often("--sets", "LABEL=FILE", "Table of constants that belong together, a line for each specimen or record."),
    ] = None
    records: Annotated[
        list[str] | None,
        often("--records", "KEY", "A material of the job, such as materials.body: all records of its rubber in the "
              "library, each with a run of its own."),
    ] = None  # fmt: skip
    leave_out_doubtful: Annotated[bool, typer.Option(help="Leave out records with a doubt, for --records.")] = False
    method: Annotated[str, typer.Option(help="linear, quadratic or interactions.")] = "linear"
    at: Annotated[str, typer.Option(help="Pressure at which values are reported, such as '40 kPa'.")] = ""
    mesh_error: Annotated[bool, typer.Option(help="Estimate the mesh error of the nominal run.")] = True
    processes: Annotated[int, typer.Option(help="Processes at once, each with one thread.", min=1)] = 1
    output: Annotated[
        Path | None,
        output_option("Folder of results; by default NAME-uncertainty."),
    ] = None
    retry: Retry = False
    changes: Changes = None
    as_json: Json = False
    debug: Debug = False


def _run(options: _Options) -> None:
    """Propagate the spread of rubber, dimensions and pressure to the response: bands, and where they come from.

    Killed and called again, it goes on: nothing is computed twice.
    """
    with errors_as_sentences(options.debug, options.as_json) as answer, ends_at_once():
        from turgor.cli.answers.studies import uncertainty_result
        from turgor.studies.runs.evaluations import saved_in
        from turgor.studies.runs.jobs.job_function import RUNS, job_function
        from turgor.studies.uncertainty.cases import write_cases
        from turgor.studies.uncertainty.figure import uncertainty_figure
        from turgor.studies.uncertainty.job_uncertainty import propagate_job
        from turgor.views.plots.figures import write_figure

        study, name = _stated(options)
        plan = study.uncertainty
        assert plan is not None
        at = plan.at
        folder = options.output if options.output is not None else Path(f"{name}-uncertainty")
        base = job_function(study.job, folder)
        runs = saved_in(folder / RUNS, processes=options.processes, progress=report_run, retry=options.retry)
        with saved_in_folder(folder):
            uncertainty = propagate_job(plan, base, runs)
        sentences = uncertainty.sentences(at)
        files = [folder / "uncertainty.csv", folder / "uncertainty.png", folder / "uncertainty.txt"]
        uncertainty.to_response().to_csv(files[0])
        if uncertainty.cases:
            files.append(folder / "records.csv")
            write_cases(uncertainty.cases, list(uncertainty.bands), files[-1])
        write_figure(files[1], uncertainty_figure(uncertainty))
        text = "\n".join([*sentences, uncertainty.checked(), *uncertainty.case_sentences(at=at), *uncertainty.notes])
        files[2].write_text(text + "\n", encoding="utf-8")
        typer.echo(text)
        typer.echo(f"Written in {folder}: {', '.join(file.name for file in files)}.")
        answer.give(lambda: uncertainty_result(uncertainty, files))
        raise typer.Exit(DONE)


uncertainty_command = command_of(_Options, _run)


def _stated(options: _Options) -> "tuple[StudyFile, str]":
    """Read the study file, or what the options state."""
    from turgor.cli.analyses.stated import files_by_label, labels_of_records, spread_factors, stated_study

    factors = spread_factors(options.spread)
    given: dict[str, Any] = {
        "sets": files_by_label(options.sets),
        "records": labels_of_records(options.records),
        "leave_out_doubtful": options.leave_out_doubtful,
        "method": options.method,
        "at": options.at,
        "mesh_error": options.mesh_error,
    }
    table = {key: value for key, value in given.items() if value != DEFAULTS.get(key)}
    places: dict[tuple[str, ...], str] = {("factors", key): "--spread" for key in factors}
    places |= {("uncertainty", key): f"--{key.replace('_', '-')}" for key in table}
    return stated_study(options.job, "uncertainty", factors, table, places, options.changes)
