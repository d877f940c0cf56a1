"""Drawing: HTML and plots of values for notebooks, in functions that ``turgor/__init__`` looks up by name."""

from typing import Any

from matplotlib.axes import Axes

from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.result import Fit
from turgor.core.materials.material import Material
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.model import Model
from turgor.core.results.drive import drive_of
from turgor.core.solvers.solution import Solution, State
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response
from turgor.views.notebook import pages
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.response_plots import plot_response, response_figure


def html_of(value: Any) -> str:
    """Return what a notebook shows of a value, as HTML.

    Parameters
    ----------
    value : Material, Geometry, Mesh, Model, State, Solution, Response, MaterialTest or Fit

    Returns
    -------
    str
    """
    match value:
        case Material():
            return pages.material(value)
        case Geometry():
            return pages.geometry(value)
        case Mesh():
            return pages.mesh(value)
        case Model():
            return pages.model(value)
        case State():
            return pages.state(value)
        case Solution():
            return pages.solution(value)
        case Response():
            return pages.response(value)
        case MaterialTest():
            return pages.test(value)
        case Fit():
            return pages.fit(value)
        case _:
            raise TurgorError(f"a {type(value).__name__} has no page for notebooks.")


def plot(response: Response, y: str | None, x: str | None, axes: Axes | None) -> Any:
    """Plot a response for `turgor.foundation.response.Response.plot`.

    Parameters
    ----------
    response : Response
    y, x : str or None
    axes : matplotlib.axes.Axes or None
        See `turgor.foundation.response.Response.plot`.

    Returns
    -------
    matplotlib.figure.Figure
    """
    if y is None:
        if x is not None or axes is not None:
            raise TurgorError("plot: x and axes belong to one column; name it as y, such as plot('bending_angle').")
        return response_figure(response)
    if axes is None:
        axes = PlotFigure(figsize=(5.2, 3.4)).add_subplot()
    plot_response(axes, response, x or drive_of(response), y)
    return axes.get_figure()
