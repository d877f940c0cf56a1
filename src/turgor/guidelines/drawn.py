"""Pictures for the figures of guidelines."""

import turgor as tg
from turgor.results.pictures.state_picture import state_figure
from turgor.results.plots.figures import PlotFigure, png_of
from turgor.results.plots.section import plot_section

#: Resolution of the pictures [dots per inch]: some five stand beside each other in a figure.
DPI = 60


def picture_of(solution: tg.Solution) -> bytes:
    """Picture of the last state, colored by von Mises stress, as PNG.

    Parameters
    ----------
    solution : Solution

    Returns
    -------
    bytes
        Empty where the path has no state.
    """
    return png_of(state_figure(solution.states[-1]), dpi=DPI) if len(solution.states) else b""


def outline_of(solution: tg.sections.SectionSolution) -> bytes:
    """Outline of a section at rest and in its last state, as PNG.

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
    figure = PlotFigure(figsize=(2.6, 2.6))
    plot_section(figure.subplots(), solution)
    return png_of(figure, dpi=DPI)
