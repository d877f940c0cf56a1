"""Plot of a section: strains and sizes against pressure, and its outline at rest and under the last pressure."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from turgor.fast_models.section.solution import SectionSolution
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm
from turgor.views.plots.figures import PlotFigure, check_ending, write_figure
from turgor.views.plots.response_plots import BLUE, plot_response
from turgor.views.plots.styling import INK, QUIET, style_axes

#: Columns that get a panel if they change along the path.
SHOWN = ("curvature_y", "curvature_z", "twist", "stretch", "cavity_ballooning", "outside_ballooning")


def plot_section(axes: Axes, solution: SectionSolution) -> Axes:
    """Draw the outlines of a section at rest and in its last state, in the rod's frame.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw.
    solution : SectionSolution

    Returns
    -------
    matplotlib.axes.Axes
        The axes that were given.
    """
    share = np.linspace(0, 1, 9)
    N = np.stack([(1 - share) * (1 - 2 * share), share * (2 * share - 1), 4 * share * (1 - share)], axis=1)
    for edges, color, label in ((solution.outline(None), QUIET, "at rest"), (solution.outline(-1), BLUE, "last state")):
        curves = np.einsum("pa,eai->epi", N, edges)[..., 1:] / mm
        for number, curve in enumerate(curves):
            axes.plot(*curve.T, color=color, lw=1.6, label=label if number == 0 else None)
    axes.set_aspect("equal")
    axes.set_xlabel("y [mm]", color=INK)
    axes.set_ylabel("z [mm]", color=INK)
    style_axes(axes)
    axes.legend(frameon=False, labelcolor=INK, fontsize=8)
    return axes


def section_figure(solution: SectionSolution, title: str = "") -> Figure:
    """Make a figure of the columns that change with the pressure, and of the outline.

    Parameters
    ----------
    solution : SectionSolution
    title : str
    """
    response = solution.response
    drive = response.names[0]
    rest = {"stretch": 1.0, "cavity_ballooning": 1.0, "outside_ballooning": 1.0}
    shown = [name for name in SHOWN if name in response]
    shown = [name for name in shown if np.abs(response[name] - rest.get(name, 0.0)).max(initial=0.0) > ROUND_OFF.same]
    panels = len(shown) + 1
    columns = min(panels, 3)
    figure = PlotFigure(figsize=(4.0 * columns, 3.2 * -(-panels // columns)))
    grid = figure.subplots(-(-panels // columns), columns, squeeze=False).ravel()
    plot_section(grid[0], solution)
    for axes, name in zip(grid[1:], shown, strict=False):
        plot_response(axes, response, drive, name)
    for axes in grid[panels:]:
        axes.set_visible(False)
    if title:
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=13)
    return figure


def write_section_plot(path: str | Path, solution: SectionSolution, title: str = "") -> None:
    """Write `section_figure` as PNG or SVG, by the ending of the path."""
    check_ending(path, "plot")
    write_figure(path, section_figure(solution, title), dpi=160)
