"""Pictures for the figures of guidelines."""

from dataclasses import replace

import turgor as tg
from turgor.views.pictures.state_picture import bare_picture
from turgor.views.plots.figures import PlotFigure, png_of
from turgor.views.plots.section import plot_section

#: Width of the pictures [pixels]: up to five stand beside each other in a figure.
WIDTH = 480

#: Size and resolution of the outlines of sections [inch, dots per inch].
OUTLINE, DPI = 2.2, 100


def picture_of(solution: tg.Solution, limit: float | None = None) -> bytes:
    """Picture of the last state, colored by von Mises stress, as PNG.

    Parameters
    ----------
    solution : Solution
    limit : float or None [Pa]
        Stress of the last color; by default what 99 % of the volume stay below. Pictures that are compared need one
        limit.

    Returns
    -------
    bytes
        Empty where the path has no state.
    """
    if not len(solution.states):
        return b""
    view = tg.pictures.shared_view([solution.states[-1]], width=WIDTH)
    return bare_picture(solution.states[-1], view if limit is None else replace(view, limit=limit))


def outline_of(solution: tg.sections.SectionSolution) -> bytes:
    """Outline of a section at rest, gray, and in its last state, as PNG.

    Parameters
    ----------
    solution : SectionSolution

    Returns
    -------
    bytes
        Empty where the path has no state.
    """
    if not len(solution.response):
        return b""
    figure = PlotFigure(figsize=(OUTLINE, OUTLINE))
    axes = plot_section(figure.subplots(), solution)
    axes.set_axis_off()
    legend = axes.get_legend()
    if legend is not None:
        legend.remove()
    return png_of(figure, dpi=DPI)
