"""Pictures for the figures of guidelines, and figures as PNG and SVG: equal figures give equal files."""

from dataclasses import replace
from io import BytesIO, StringIO

import matplotlib
from matplotlib.figure import Figure

import turgor as tg

#: Width of the pictures [pixels]: up to five stand side by side in a figure.
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
    return tg.pictures.bare_picture(solution.states[-1], view if limit is None else replace(view, limit=limit))


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
    figure = Figure(figsize=(OUTLINE, OUTLINE), layout="constrained", facecolor="white")
    axes = tg.sections.plot_section(figure.subplots(), solution)
    axes.set_axis_off()
    legend = axes.get_legend()
    if legend is not None:
        legend.remove()
    return png_of(figure, dpi=DPI)


def png_of(figure: Figure, dpi: float) -> bytes:
    """Figure as PNG.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    dpi : float
        Dots per inch.

    Returns
    -------
    bytes
    """
    stream = BytesIO()
    figure.savefig(stream, format="png", dpi=dpi, metadata={"Software": "turgor"})
    return stream.getvalue()


def svg_of(figure: Figure) -> str:
    """Figure as SVG text that can stand inside a web page.

    Parameters
    ----------
    figure : matplotlib.figure.Figure

    Returns
    -------
    str
    """
    stream = StringIO()
    with matplotlib.rc_context({"svg.hashsalt": "turgor"}):
        figure.savefig(stream, format="svg", metadata={"Creator": "turgor", "Date": None})
    text = stream.getvalue()
    return text[text.index("<svg") :]
