"""Files of a run: tables, pictures, fields, report and log."""

import csv
import re
from collections.abc import Callable, Mapping, Sequence
from datetime import datetime
from pathlib import Path

from turgor.job.compare import comparison_sections, measured_points
from turgor.job.output.folder import (
    CONTACT,
    DEFORMED,
    FIELDS,
    LOCK,
    LOG,
    PLOT,
    REPORT,
    RESPONSE,
    STEPS,
    UNDEFORMED,
    clear_tables,
)
from turgor.job.output.lock import dimensions, lock_text
from turgor.job.output.outcome import RunOutcome
from turgor.meshing.quality.cell_quality import quality
from turgor.results.files.vtu import write_series
from turgor.results.pictures.path_pictures import CAPTIONS, path_figures
from turgor.results.pictures.state_picture import picture_title
from turgor.results.plots.figures import write_figure
from turgor.results.plots.response_plots import write_plot
from turgor.results.report.describe_procedure import ending
from turgor.results.report.headline import headline
from turgor.results.report.page import Picture, Report, write_report
from turgor.solvers.procedures.stages import Stages
from turgor.solvers.solution import Solution
from turgor.solvers.stored import PATH_FOLDER

#: Description of each file, for the report.
CONTENTS: Mapping[str, str] = {
    RESPONSE: "the measures at every state, with units in the header",
    LOCK: "every value that was used, from which the run can be repeated",
    STEPS: "every attempted step of the solve",
    LOG: "how the run went",
    f"{FIELDS}/state.pvd": "the fields of every state, for ParaView",
    f"{FIELDS}/state_obstacles.pvd": "the obstacles at every state, to open beside it",
    PLOT: "the response as a plot",
    UNDEFORMED: "the actuator at rest",
    DEFORMED: "the actuator at the last state",
    CONTACT: "what touches at the last state, seen through the actuator",
}

#: File of each picture of the path.
PICTURES: Mapping[str, str] = {"undeformed": UNDEFORMED, "deformed": DEFORMED, "contact": CONTACT}

#: Name of the files of fields.
SERIES = "state"

STEP_COLUMNS = ("load_factor", "increment", "iterations", "residual", "accepted", "seconds", "reason")


def write_results(outcome: RunOutcome, notify: Callable[[str], None], *, again: bool = False) -> tuple[Path, ...]:
    """Write all files that the job asks for, tables first; return them with the most important first.

    The results of an earlier run in the folder are removed. Fields are half of the work; where ``again`` is true,
    those that were written after the path are left as they are.
    """
    folder, output = outcome.folder, outcome.job.output
    kept = again and _has_fields(folder, len(outcome.solution.states))
    files = list(write_tables(outcome, notify, keep_fields=kept))
    if output.fields:
        if not kept:
            notify("writing the fields")
            write_series(folder / FIELDS, outcome.solution, SERIES)
        files.append(folder / FIELDS / f"{SERIES}.pvd")
        obstacles = folder / FIELDS / "state_obstacles.pvd"
        files += [obstacles] if obstacles.exists() else []
    notify("drawing")
    title = picture_title(outcome.response, name=outcome.job.name)
    write_plot(folder / PLOT, outcome.response, title=title)
    files.append(folder / PLOT)
    if output.pictures:
        files += write_pictures(outcome)
    if output.report:
        notify("writing the report")
        write_report(folder / REPORT, report_of(outcome, files))
        files.insert(0, folder / REPORT)
    return tuple(files)


def _has_fields(folder: Path, states: int) -> bool:
    """Whether the folder holds the fields of as many states, written after the last file of the path."""
    series, path = folder / FIELDS / f"{SERIES}.pvd", list((folder / PATH_FOLDER).glob("*"))
    if not series.exists() or not path:
        return False
    written = series.stat().st_mtime_ns >= max(file.stat().st_mtime_ns for file in path)
    named = re.findall(r'file="(.+?)"', series.read_text(encoding="utf-8"))
    return written and len(named) == states and all((series.parent / name).exists() for name in named)


def write_tables(outcome: RunOutcome, notify: Callable[[str], None], *, keep_fields: bool = False) -> tuple[Path, ...]:
    """Write the response, the lock file, the steps and the log alone, in place of the results of an earlier run."""
    folder = outcome.folder
    notify("writing the response")
    clear_tables(folder, keep_fields=keep_fields)
    outcome.response.to_csv(folder / RESPONSE)
    (folder / LOCK).write_text(lock_text(outcome.job, outcome.written_by), encoding="utf-8")
    write_steps(folder / STEPS, outcome.solution)
    (folder / LOG).write_text(log_text(outcome), encoding="utf-8")
    return folder / RESPONSE, folder / LOCK, folder / STEPS, folder / LOG


def report_of(outcome: RunOutcome, files: Sequence[Path]) -> Report:
    """Collect the content of the report about a run and its files."""
    job, solution = outcome.job, outcome.solution
    beside = {str(file.relative_to(outcome.folder)): file for file in files}
    return Report(
        title=headline(solution),
        solution=solution,
        response=outcome.response,
        findings=outcome.findings,
        dimensions={name: str(value) for name, value in dimensions(job.actuator).items()},
        quality=quality(solution.model.mesh),
        pictures=tuple(
            Picture(caption=CAPTIONS[kind], png=beside[name].read_bytes())
            for kind, name in PICTURES.items()
            if name in beside
        ),
        versions={**outcome.written_by, "threads": job.threads or ""},
        repeat=f"turgor run {LOCK} --output {job.name}-again",
        files={name: CONTENTS[name] for name in beside},
        job=lock_text(job, outcome.written_by),
        comparisons=comparison_sections(outcome.folder, outcome.response),
        measured=measured_points(outcome.folder, outcome.response),
        created=datetime.now().astimezone().strftime("%Y-%m-%d %H:%M %Z"),
    )


def write_pictures(outcome: RunOutcome) -> list[Path]:
    """Draw the states of `path_figures` into files."""
    files = []
    for kind, figure in path_figures(outcome.solution, outcome.response, outcome.job.name):
        files.append(outcome.folder / PICTURES[kind])
        write_figure(files[-1], figure, kind="picture")
    return files


def write_steps(file: Path, solution: Solution) -> None:
    """Write every attempted step as a line of CSV."""
    columns = ("stage", *STEP_COLUMNS) if isinstance(solution.procedure, Stages) else STEP_COLUMNS
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(f"{name}_s" if name == "seconds" else name for name in columns)
        for step in solution.steps:
            writer.writerow(getattr(step, name) for name in columns)


def log_text(outcome: RunOutcome) -> str:
    """Write the log of a run: versions, notices, the end with its advice, findings, and times."""
    solution, timing = outcome.solution, outcome.solution.timing
    made = ", ".join(f"{name} {value}" for name, value in outcome.written_by.items())
    accepted = sum(step.accepted for step in solution.steps)
    cut = len(solution.steps) - accepted
    spent = timing.parts() | {"total": timing.total}
    return "\n".join(
        [
            f"job {outcome.job.name}",
            f"with {made}",
            *outcome.notices,
            f"{ending(solution.status)}: {solution.message} {solution.advice}".rstrip(),
            f"{accepted} steps accepted, {cut} cut back, {solution.iterations} iterations",
            f"wall time: {', '.join(f'{name} {seconds:.2f} s' for name, seconds in spent.items())}",
            *map(str, outcome.findings),
            "",
        ]
    )
