"""Figure of a calibration: each trial with its curves at the start and at the end, and the differences below."""

from typing import Any

import numpy as np

from turgor.accuracy.laboratory.compare import first_branch
from turgor.foundation.response import Column, unit_text
from turgor.studies.calibration.curve import PathCurve
from turgor.studies.calibration.result import Calibration, Fitted
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.response_plots import BLUE, COLORS
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, QUIET, style_axes


def calibration_figure(calibration: Calibration) -> PlotFigure:
    """Draw a calibration.

    Parameters
    ----------
    calibration : Calibration

    Returns
    -------
    matplotlib.figure.Figure
        A panel for each trial, those held out last: measured, as corrected for the rig; computed at the start and with
        the fitted values; below, the residuals.
    """
    fits = [(each, False) for each in calibration.fits] + [(each, True) for each in calibration.held_out]
    columns = min(len(fits), PLOT.columns)
    rows = -(-len(fits) // columns)
    figure = PlotFigure(figsize=(max(4.6 * columns, 5.4), 4.6 * rows))
    axes = figure.subplots(2 * rows, columns, squeeze=False, height_ratios=(3, 1) * rows)
    for k in range(rows * columns):
        upper, lower = axes[2 * (k // columns), k % columns], axes[2 * (k // columns) + 1, k % columns]
        if k < len(fits):
            _panel(upper, lower, *fits[k])
        else:
            upper.set_axis_off()
            lower.set_axis_off()
    return figure


def _panel(upper: Any, lower: Any, each: Fitted, held_out: bool) -> None:
    data = each.data
    x, y = each.fitted.find(data.x), each.fitted.find(data.y)
    rows = each.to_response()
    drive, measured = rows.columns[0].in_unit, rows.columns[1].in_unit
    spread = Column(data.y, y.unit, data.spread).in_unit
    if not data.assumed:
        upper.errorbar(drive, measured, yerr=spread, fmt="none", ecolor=COLORS[1], alpha=0.4, lw=1.0)
    upper.plot(drive, measured, "o", color=COLORS[1], ms=4, label="measured, held out" if held_out else "measured")
    ends = {}
    for response, style, label in ((each.start, "--", "start"), (each.fitted, "-", "calibrated")):
        known = first_branch(response, data.x)[0].column(data.x)
        at = np.linspace(
            np.nanmin(known),
            min(float(np.nanmax(known)), 1.1 * float(np.max(rows.columns[0].values))),
            PLOT.curve_points,
        )
        curve = Column(data.y, y.unit, PathCurve.of(response, data.x, data.y).at(at))
        ends[label] = curve.in_unit
        color = QUIET if style == "--" else BLUE
        upper.plot(Column(data.x, x.unit, at).in_unit, curve.in_unit, style, color=color, lw=1.8, label=label)
    _limit(upper, measured, ends["calibrated"])
    upper.set_title(data.trial.name, loc="left", color=INK, fontsize=10)
    upper.set_ylabel(y.label, color=INK)
    upper.legend(frameon=False, labelcolor=INK, fontsize=8)
    lower.axhline(0.0, color=QUIET, lw=0.8)
    lower.plot(drive, rows.columns[3].in_unit - measured, "o", color=BLUE, ms=3)
    lower.set_ylabel(f"difference [{unit_text(y.unit)}]" if y.unit else "difference", color=INK)
    lower.set_xlabel(x.label, color=INK)
    lower.sharex(upper)
    upper.tick_params(labelbottom=False)
    style_axes(upper)
    style_axes(lower)


def _limit(axes: Any, measured: Any, fitted: Any) -> None:
    """Choose limits such that a start far off does not flatten the measured curve."""
    both = np.concatenate([measured, fitted])
    low, high = float(np.min(both)), float(np.max(both))
    bottom, top = axes.get_ylim()
    reach = high - low
    axes.set_ylim(max(bottom, low - 0.5 * reach), min(top, high + reach))
