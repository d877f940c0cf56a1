"""Report: one self-contained HTML page with the question, the results, and the findings about them."""

import json
import struct
from base64 import b64encode
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path

from matplotlib.figure import Figure

from turgor.core.engine.percentiles import PERCENTILE
from turgor.core.meshing.quality.cell_quality import MeshQuality
from turgor.core.results.drive import drive_of, pressures_in
from turgor.core.results.error_text import is_zero, last_with_error
from turgor.core.results.fields.path_fields import PathFields
from turgor.core.results.measures.field_measures import BY_REGION
from turgor.core.results.measures.headlines import headlines, in_regions, with_parts
from turgor.core.results.measures.measures import MEASURES, find_measure
from turgor.core.solvers.solution import Solution, Timing
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Column, Response, unit_text
from turgor.views.pictures.picture import Picture as Picture
from turgor.views.plots.figures import svg_of
from turgor.views.plots.linked_plots import places_of_points
from turgor.views.plots.response_plots import panel_figures
from turgor.views.report import describe, describe_procedure
from turgor.views.report.contact_report import contact_columns, contact_section
from turgor.views.report.headline import modeled_part
from turgor.views.report.job_text import tidy
from turgor.views.report.material_plots import law_plot
from turgor.views.report.references import references
from turgor.views.report.response_table import parted, response_table
from turgor.views.report.settings import PAGE
from turgor.views.report.templating import rendered
from turgor.views.viewer.assets import viewer_scripts, viewer_style
from turgor.views.viewer.curves import Measured
from turgor.views.viewer.scene import Scene, scene_of
from turgor.views.viewer.settings import VIEWER
from turgor.views.viewer.viewer import viewer_markup

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Report:
    """Content of a report.

    Parameters
    ----------
    title : str
        Headline.
    solution : Solution
        The question and the path.
    response : Response
        What was measured along it.
    findings : tuple of Finding
        What all checks noticed, before, during and after the solve.
    dimensions : mapping of str to str
        Dimensions of the actuator with their units, as text.
    quality : MeshQuality or None
        Counts, sizes and shapes of the cells.
    pictures : tuple of Picture
        Pictures of the actuator.
    versions : mapping
        Programs, machine and linear solver.
    repeat : str
        Commands that repeat the run.
    files : mapping of str to str
        Files next to the report and what each holds.
    created : str
        Time of the report; it is left out if it is empty.
    comparisons : tuple of (str, str, str)
        Title, text and picture (SVG) of each comparison with an experiment.
    job : str
        Text of the job file that repeats the run.
    measured : tuple of Measured
        Points of experiments, drawn with the curve next to the viewer.
    fields : PathFields or None
        Fields of the solution that others read, too.
    """

    title: str
    solution: Solution
    response: Response
    findings: tuple[Finding, ...] = ()
    dimensions: Mapping[str, str] = field(default_factory=dict)
    quality: MeshQuality | None = None
    pictures: tuple[Picture, ...] = ()
    versions: Mapping[str, str | int] = field(default_factory=dict)
    repeat: str = ""
    files: Mapping[str, str] = field(default_factory=dict)
    created: str = ""
    comparisons: tuple[tuple[str, str, str], ...] = ()
    job: str = ""
    measured: tuple[Measured, ...] = ()
    fields: PathFields | None = None


def write_report(path: str | Path, report: Report) -> None:
    """Write a report as one HTML file that needs no other: viewer, pictures, plots and style are inside.

    Where the browser has no WebGL, and in print, the still pictures take the place of the viewer. The viewer shows as
    many states as fit on a page that can be sent by mail, and two at least.

    Parameters
    ----------
    path : str or Path
        File to write.
    report : Report
        What it tells.
    """
    scene = _scene(report)
    page = _page(report, scene)
    while scene is not None and (excess := len(page) - VIEWER.page_bytes) > 0:
        fewer = _scene(report, max(0, scene.letters - excess))
        if fewer is None or fewer.steps == scene.steps:  # the rest of the page is too large by itself
            break
        scene, page = fewer, _page(report, fewer)
    Path(path).write_bytes(page)


def _page(report: Report, scene: Scene | None) -> bytes:
    """The page with this scene in its viewer."""
    source = files("turgor.views.report").joinpath("templates/report.html").read_text(encoding="utf-8")
    return rendered(source, _context(report, scene)).encode()


def _context(report: Report, scene: Scene | None) -> dict[str, object]:
    """Everything the template names, as text, lists and pairs."""
    solution, model = report.solution, report.solution.model
    staged = bool(solution.procedure.stages)
    return {
        "title": report.title,
        "part": modeled_part(model.mesh),
        "status": describe_procedure.ending(solution.status),
        "good": solution.complete and all(finding.severity is not Severity.ERROR for finding in report.findings),
        "message": solution.message,
        "advice": solution.advice,
        "findings": list(report.findings),
        "warnings": [each for each in report.findings if each.severity is Severity.WARNING],
        **_viewer(scene),
        **_response(report),
        "pictures": [{"caption": p.caption, "data": b64encode(p.png).decode()} for p in report.pictures],
        "picture_width": _picture_width(report.pictures),
        **contact_section(solution),
        **_model(report, staged),
        "staged": staged,
        "steps": list(solution.steps),
        "path_summary": _path_summary(solution),
        "procedure": describe_procedure.procedure(solution.procedure),
        "versions": [(name.replace("_", " "), str(value)) for name, value in report.versions.items() if value != ""],
        "references": references(model, str(report.versions.get("turgor", ""))),
        "repeat": report.repeat,
        "job": report.job,
        "files": list(report.files.items()),
        "created": report.created,
        "comparisons": list(report.comparisons),
    }


def _model(report: Report, staged: bool) -> dict[str, object]:
    """The question in words: loads, supports, contact, dimensions, mesh and materials."""
    model = report.solution.model
    return {
        "loads": describe.loads(model),
        "loads_head": "Loads from the first stage on" if staged else "Loads at load factor 1",
        "supports": describe.supports(model),
        "contact": describe.contact(model),
        "mesh": describe.mesh(model.mesh, report.quality),
        "dimensions": [(name.replace("_", " "), tidy(value)) for name, value in report.dimensions.items()],
        "materials": [(text, law_plot(text.material)) for text in describe.materials(model)],
    }


def _scene(report: Report, most_text: int = VIEWER.page_bytes) -> Scene | None:
    """Scene of the viewer within a number of letters, unless two states need more; None without states."""
    if not report.solution.states:
        return None
    linked = report.response if len(report.response) == len(report.solution.states) else None
    return scene_of(report.solution, linked, report.measured, report.fields, most_text)


def _viewer(scene: Scene | None) -> dict[str, object]:
    """The viewer as markup, style and scripts, and what it leaves out."""
    if scene is None:
        return {"viewer": "", "viewer_style": "", "viewer_scripts": "", "viewer_notes": []}
    return {
        "viewer": viewer_markup(scene),
        "viewer_style": viewer_style(),
        "viewer_scripts": viewer_scripts(),
        "viewer_notes": list(scene.notes),
    }


def _response(report: Report) -> dict[str, object]:
    """The response: numbers at the end, plots, tables, definitions and mesh errors."""
    response = report.response
    linked = len(response) == len(report.solution.states)
    plots = [_linked(figure, len(response) if linked else 0) for figure in _figures(response)]
    table = response_table(response)
    return {
        "numbers": _numbers(response),
        "percentile": PERCENTILE if {each.name for each in BY_REGION} & set(response.names) else 0,
        "plots": plots,
        "response": {**table, "parts": parted(table)},
        "mesh_errors": _mesh_errors(response),
        "definitions": _definitions(response, contact_columns(report.solution.model)),
    }


def _figures(response: Response) -> Sequence[Figure]:
    """The panels of the response, if it has a path."""
    return panel_figures(response) if len(response) > 1 else ()


def _linked(figure: Figure, rows: int) -> tuple[str, str]:
    """A plot as SVG, and where the points of its lines lie; nothing where no state belongs to them."""
    plot = svg_of(figure)  # first, which lays the panel out
    return plot, json.dumps(places_of_points(figure, rows)) if rows else ""


def _mesh_errors(response: Response) -> list[tuple[str, str]]:
    """Mesh errors of the last state, with their share of the value."""
    rows = []
    for column in response.quantities:
        errors, value = response.mesh_error(column.name), float(column.values[-1])
        if errors is not None and errors[-1] > 0 and not is_zero(column):
            share = f" ({100 * errors[-1] / abs(value):.2g} %)" if errors[-1] < abs(value) else ""
            rows.append((column.words, f"{_last(response, column)}{share}"))
    return rows


def _picture_width(pictures: tuple[Picture, ...]) -> int:
    """Width at which none of the pictures is too tall, in pixels of the page; one for all keeps their scale equal."""
    widths = [float(PAGE.width)]
    for picture in pictures:
        if picture.png[:8] != PNG_SIGNATURE:
            raise TurgorError(f"picture '{picture.caption}' is no PNG.")
        width, height = struct.unpack(">II", picture.png[16:24])
        widths.append(VIEWER.height * width / height)
    return int(min(widths))


def _numbers(response: Response) -> list[tuple[str, str]]:
    """Values of the last state with their names: the drive, then what a reader looks for first."""
    drives = [column.name for column in pressures_in(response)] or [drive_of(response)]
    numbers = []
    for name in [*drives, *(name for name in headlines(response.names) if name not in drives)]:
        column, regions = response.find(name), in_regions(response, name)
        cavities = [] if regions else with_parts(response, name)[1:]
        numbers.append((_last(response, column), f"{column.words}; {regions}" if regions else column.words))
        numbers += [(_last(response, each), each.words) for each in map(response.find, cavities)]
    return numbers


def _last(response: Response, column: Column) -> str:
    """Value of the last state with its mesh error and the sign of its unit."""
    number = last_with_error(response, column).removesuffix(column.unit).rstrip().replace("-", "−")
    return f"{number}{'' if column.unit in ('', 'deg') else ' '}{unit_text(column.unit)}"


def _definitions(response: Response, contacts: set[str]) -> list[tuple[str, str]]:
    """Names and definitions of the columns that ready-made measures filled."""
    parts = {part for name in headlines(response.names) for part in with_parts(response, name)}
    known = {*MEASURES, *parts, *contacts}
    return [(column.words, find_measure(column.name).definition) for column in response.columns if column.name in known]


def _path_summary(solution: Solution) -> str:
    accepted = sum(step.accepted for step in solution.steps)
    parts = [f"{accepted} steps accepted, {len(solution.steps) - accepted} cut back, {solution.iterations} iterations."]
    timing: Timing = solution.timing
    if timing.total > 0:
        spent = timing.parts()
        listed = ", ".join(f"{name} {seconds:.1f} s" for name, seconds in spent.items())
        parts.append(f"Wall time {timing.total:.1f} s: {listed}.")
    if timing.linear_solver:
        parts.append(f"Linear solver {timing.linear_solver}.")
    return " ".join(parts)
