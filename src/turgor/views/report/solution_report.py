"""Report of a solution from Python: that of a job without the parts that only a job file states."""

from pathlib import Path

from turgor.core.meshing.quality.cell_quality import quality
from turgor.core.results.fields.path_fields import PathFields
from turgor.core.results.measures.measures import Reader
from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import one
from turgor.foundation.response import Response
from turgor.views.pictures.path_pictures import CAPTIONS
from turgor.views.pictures.picture import Picture
from turgor.views.pictures.state_picture import picture_title, shared_view, state_figure
from turgor.views.plots.figures import png_of
from turgor.views.report.headline import headline
from turgor.views.report.page import Report, write_report
from turgor.views.report.settings import PAGE


def report(of: Solution, path: str | Path, *, response: Response | None = None, title: str | None = None) -> Path:
    """Write a report about a solution: one HTML file with a viewer, the response, materials, findings and the mesh.

    Parameters
    ----------
    of : Solution
        The path, complete or not.
    path : str or Path
        HTML file to write.
    response : Response, optional
        What was measured along the path; by default the standard measures, without their mesh errors. Give
        ``tg.measure(solution)`` to have these.
    title : str, optional
        Headline; by default the name of the actuator and the largest pressure.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    TurgorError
        If the path does not end in ``.html``, or the response has other rows than the path has states.

    Examples
    --------
    >>> report(None, "finger.pdf")
    Traceback (most recent call last):
    turgor.TurgorError: report 'finger.pdf' ends in '.pdf'; allowed is .html.
    """
    path = Path(path)
    if path.suffix.lower() != ".html":
        raise TurgorError(f"report '{path}' ends in '{path.suffix}'; allowed is .html.")
    one(of, Solution, "what a report is of", "a Solution is needed, as solve(model) returns it")
    fields = PathFields(of)
    shown = Reader().response(of, fields) if response is None else response
    if len(shown) != len(of.states):
        raise TurgorError(f"the response has {len(shown)} rows, but the solution {len(of.states)} states.")
    name = of.model.mesh.name if title is None else title
    content = Report(
        title=headline(of) if title is None else title,
        solution=of,
        response=shown,
        findings=of.findings,
        quality=quality(of.model.mesh),
        pictures=(_picture(fields, shown, name),) if of.states else (),
        fields=fields,
    )
    write_report(path, content)
    return path


def _picture(fields: PathFields, response: Response, name: str) -> Picture:
    """The last state with the outline of the first, for print and for browsers without WebGL."""
    first, last = fields.at(0), fields.at(-1)
    figure = state_figure(
        last,
        shared_view([first, last], PAGE.width),
        title=picture_title(response, -1, name),
        ghost=first if len(fields.solution.states) > 1 else None,
    )
    return Picture(caption=CAPTIONS["deformed"], png=png_of(figure))
