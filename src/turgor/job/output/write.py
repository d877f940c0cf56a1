"""Files of a run: its tables, fields, pictures and report."""

from collections.abc import Callable, Mapping, Sequence
from datetime import datetime
from pathlib import Path

from turgor.core.meshing.quality.cell_quality import quality
from turgor.core.results.fields.path_fields import PathFields
from turgor.core.results.files.vtu import series_files, write_series
from turgor.job.compare import comparison_sections, measured_points
from turgor.job.output.folder import (
    BONDS,
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
)
from turgor.job.output.lock import dimensions, lock_text
from turgor.job.output.manifest import list_files
from turgor.job.output.outcome import RunOutcome
from turgor.job.output.path_files import FIELD_FILES, PICTURES, SERIES, current_files, drawn_from
from turgor.job.output.tables import write_tables
from turgor.views.pictures.path_pictures import CAPTIONS, path_figures, pictured
from turgor.views.pictures.state_picture import picture_title
from turgor.views.plots.figures import write_figure
from turgor.views.plots.response_plots import write_plot
from turgor.views.report.headline import headline
from turgor.views.report.page import Picture, Report, write_report
from turgor.views.viewer.scene import scene_of

#: Description of each file, for the report.
CONTENTS: Mapping[str, str] = {
    RESPONSE: "the measures at every state, with units in the header",
    LOCK: "every value that was used, from which the run can be repeated",
    STEPS: "every attempted step of the solve",
    LOG: "how the run went",
    f"{FIELDS}/state.pvd": "the fields of every state, for ParaView",
    f"{FIELDS}/state_obstacles.pvd": "the obstacles at every state, to open together with it",
    PLOT: "the response as a plot",
    UNDEFORMED: "the actuator at rest",
    DEFORMED: "the actuator at the last state",
    BONDS: "damage of bonds at the last state",
    CONTACT: "what touches at the last state, seen through the actuator",
}


def write_results(outcome: RunOutcome, notify: Callable[[str], None], path: PathFields) -> tuple[Path, ...]:
    """Write all files that the job requests, tables first; return them with the most important first.

    Fields and pictures that show this path are left as they are, because they are most of the work; other results of an
    earlier run in the folder are removed.
    """
    folder, output = outcome.folder, outcome.job.output
    note = drawn_from(outcome)
    current = current_files(outcome, note)
    files = list(write_tables(outcome, notify, current))
    if output.fields:
        files += write_fields(outcome, path, notify, current)
    notify("plotting")
    list_files(folder, (PLOT,))
    if PLOT not in current:
        title = picture_title(outcome.response, name=outcome.job.name)
        write_plot(folder / PLOT, outcome.response, title=title, note=note)
    files.append(folder / PLOT)
    if output.pictures:
        files += write_pictures(outcome, path, note, current)
    if output.report:
        notify("writing the report")
        list_files(folder, (REPORT,))
        write_report(folder / REPORT, report_of(outcome, files, path))
        files.insert(0, folder / REPORT)
    return tuple(files)


def draw_path(outcome: RunOutcome, notify: Callable[[str], None], path: PathFields) -> None:
    """Write fields and pictures that the job requests, and collect the scene of its report: no mesh error is needed."""
    output = outcome.job.output
    if output.fields:
        write_fields(outcome, path, notify, frozenset())
    if output.pictures:
        notify("drawing")
        write_pictures(outcome, path, drawn_from(outcome), frozenset())
    if output.report:
        scene_of(outcome.solution, outcome.response, fields=path)  # `path` remembers what it draws


def write_fields(
    outcome: RunOutcome, path: PathFields, notify: Callable[[str], None], current: frozenset[str]
) -> list[Path]:
    """Write the fields of all states unless they are up to date; return the files to open."""
    folder = outcome.folder / FIELDS
    if not current.issuperset(FIELD_FILES):
        notify("writing the fields")
        list_files(outcome.folder, (f"{FIELDS}/{name}" for name in series_files(SERIES, len(outcome.solution.states))))
        write_series(folder, outcome.solution, SERIES, path)
    obstacles = folder / f"{SERIES}_obstacles.pvd"
    return [folder / f"{SERIES}.pvd", *([obstacles] if obstacles.exists() else [])]


def report_of(outcome: RunOutcome, files: Sequence[Path], fields: PathFields) -> Report:
    """Collect the content of the report about a run and its files."""
    job, solution = outcome.job, outcome.solution
    by_name = {str(file.relative_to(outcome.folder)): file for file in files}
    return Report(
        title=headline(solution),
        solution=solution,
        response=outcome.response,
        findings=outcome.findings,
        dimensions={name: str(value) for name, value in dimensions(job.actuator).items()},
        quality=quality(solution.model.mesh),
        pictures=tuple(
            Picture(caption=CAPTIONS[kind], png=by_name[name].read_bytes())
            for kind, name in PICTURES.items()
            if name in by_name
        ),
        versions={**outcome.written_by, "threads": job.threads or ""},
        repeat=f"turgor run {LOCK} --output {job.name}-again",
        files={name: CONTENTS[name] for name in by_name},
        job=lock_text(job, outcome.written_by),
        comparisons=comparison_sections(outcome.folder, outcome.response),
        measured=measured_points(outcome.folder, outcome.response),
        fields=fields,
        created=datetime.now().astimezone().strftime("%Y-%m-%d %H:%M %Z"),
    )


def write_pictures(outcome: RunOutcome, path: PathFields, note: str, current: frozenset[str]) -> list[Path]:
    """Draw the states of `path_figures` into files, unless these are up to date."""
    files = {kind: PICTURES[kind] for kind in pictured(outcome.solution)}
    list_files(outcome.folder, files.values())
    if not current.issuperset(files.values()):
        for kind, figure in path_figures(path, outcome.response, outcome.job.name):
            write_figure(outcome.folder / files[kind], figure, kind="picture", note=note)
    return [outcome.folder / name for name in files.values()]
