"""Drawing of a comparison: both curves with their bands above, their difference below."""

from typing import Any

from turgor.accuracy.laboratory.compare import Comparison
from turgor.accuracy.laboratory.loops import rising_rows
from turgor.accuracy.laboratory.runs import SPREAD
from turgor.foundation.response import Column, unit_text
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.response_plots import BLUE, COLORS, plot_response
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, QUIET, style_axes


def comparison_figure(comparison: Comparison, title: str = "") -> PlotFigure:
    """Draw a comparison.

    Parameters
    ----------
    comparison : Comparison
        What `compare` returned.
    title : str
        Line above the panels.

    Returns
    -------
    matplotlib.figure.Figure
        The computed curve with its mesh error, the measured one with the spread of its runs; below, the difference,
        of loading and unloading apart.
    """
    figure = PlotFigure(figsize=(6.4, 5.4))
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    computed, y = comparison.computed, comparison.computed.find(comparison.y)
    _measured(upper, comparison)
    plot_response(upper, computed, comparison.x, comparison.y, color=BLUE, label=f"computed: {computed.source.text}")
    upper.set_xlabel("")
    upper.legend(frameon=False, labelcolor=INK)
    rows = comparison.to_response()
    drive = rows.columns[0]
    lower.axhline(0.0, color=QUIET, lw=0.8)
    away = rows.columns[3].in_unit
    if comparison.loop is None:
        lower.plot(drive.in_unit, away, ".", color=COLORS[1], ms=3)
    else:
        rises = rising_rows(drive.values)
        lower.plot(drive.in_unit[rises], away[rises], ".", color=COLORS[1], ms=3, label="loading")
        lower.plot(drive.in_unit[~rises], away[~rises], ".", color=COLORS[2], ms=3, label="unloading")
        lower.legend(frameon=False, labelcolor=INK, fontsize=8)
    lower.set_xlabel(computed.find(comparison.x).label, color=INK)
    lower.set_ylabel(f"difference [{unit_text(y.unit)}]", color=INK)
    style_axes(lower)
    if title:
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=13)
    return figure


def _measured(axes: Any, comparison: Comparison) -> None:
    """Draw the measured curve in the units of the computed one, with the spread of its runs."""
    response = comparison.measured
    x, y = comparison.computed.find(comparison.x), comparison.computed.find(comparison.y)
    drive = Column(comparison.x, x.unit, response.column(comparison.measured_x))
    value = Column(comparison.y, y.unit, response.column(comparison.measured_y))
    spread = comparison.measured_y + SPREAD
    if spread in response:
        reach = response.column(spread)
        low, high = (Column(comparison.y, y.unit, value.values + sign * reach).in_unit for sign in (-1, 1))
        axes.fill_between(drive.in_unit, low, high, color=COLORS[1], alpha=0.2, lw=0)
    style = "o" if len(response) <= PLOT.marks else "-"  # more dots than these would merge into a bar
    label = f"{comparison.other}: {response.source.text}"
    axes.plot(drive.in_unit, value.in_unit, style, color=COLORS[1], lw=1.4, ms=4, label=label)
