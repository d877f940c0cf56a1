"""Drawing of a comparison: both curves with their bands above, their difference below."""

from typing import Any

from turgor.accuracy.laboratory.compare import Comparison
from turgor.accuracy.laboratory.runs import SPREAD
from turgor.foundation.response import Column, unit_text
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.response_plots import BLUE, COLORS, plot_response
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, QUIET, style_axes


def comparison_figure(found: Comparison, title: str = "") -> PlotFigure:
    """Draw a comparison.

    Parameters
    ----------
    found : Comparison
        What `compare` returned.
    title : str
        Line above the panels.

    Returns
    -------
    matplotlib.figure.Figure
        The computed curve with its mesh error, the measured one with the spread of its runs; below, the difference.
    """
    figure = PlotFigure(figsize=(6.4, 5.4))
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    y = found.computed.find(found.y)
    _measured(upper, found)
    plot_response(upper, found.computed, found.x, found.y, color=BLUE, label=f"computed: {found.computed.source.text}")
    upper.set_xlabel("")
    upper.legend(frameon=False, labelcolor=INK)
    rows = found.to_response()
    drive = rows.columns[0]
    lower.axhline(0.0, color=QUIET, lw=0.8)
    lower.plot(drive.in_unit, rows.columns[3].in_unit, ".", color=COLORS[1], ms=3)
    lower.set_xlabel(found.computed.find(found.x).label, color=INK)
    lower.set_ylabel(f"difference [{unit_text(y.unit)}]", color=INK)
    style_axes(lower)
    if title:
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=13)
    return figure


def _measured(axes: Any, found: Comparison) -> None:
    """Draw the measured curve in the units of the computed one, with the spread of its runs."""
    response = found.measured
    x, y = found.computed.find(found.x), found.computed.find(found.y)
    drive = Column(found.x, x.unit, response.column(found.measured_x))
    value = Column(found.y, y.unit, response.column(found.measured_y))
    spread = found.measured_y + SPREAD
    if spread in response:
        low, high = (Column(found.y, y.unit, value.values + sign * response.column(spread)).in_unit for sign in (-1, 1))
        axes.fill_between(drive.in_unit, low, high, color=COLORS[1], alpha=0.2, lw=0)
    style = "o" if len(response) <= PLOT.marks else "-"  # more dots than these would merge into a bar
    label = f"measured: {response.source.text}"
    axes.plot(drive.in_unit, value.in_unit, style, color=COLORS[1], lw=1.4, ms=4, label=label)
