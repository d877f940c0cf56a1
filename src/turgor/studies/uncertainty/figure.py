"""Figure of an uncertainty: a column with its bands, and where the variance comes from along the path."""

from typing import Any

import numpy as np

from turgor.foundation.response import Column, unit_text
from turgor.studies.uncertainty.band import Band, Uncertainty
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.response_plots import BLUE, COLORS
from turgor.views.plots.styling import INK, style_axes


def uncertainty_figure(uncertainty: Uncertainty, name: str | None = None) -> PlotFigure:
    """Draw the band of a column, and below the standard deviation that each input brings.

    Parameters
    ----------
    uncertainty : Uncertainty
    name : str, optional
        Column; by default the one that a reader looks for first.

    Returns
    -------
    matplotlib.figure.Figure
    """
    band = uncertainty.band(name or uncertainty.headline)
    figure = PlotFigure(figsize=(6.4, 5.6))
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    x = uncertainty.drive.in_unit
    _curve(upper, x, band)
    label = Column(band.name, band.unit, band.nominal).label
    for number, (part, values) in enumerate(_parts(band)):
        lower.plot(x, _shown(band, values), color=COLORS[number % len(COLORS)], lw=1.6, label=part)
    upper.set_ylabel(label, color=INK)
    unit = f" [{unit_text(band.unit)}]" if band.unit else ""
    lower.set_ylabel(f"standard deviation{unit}", color=INK)
    lower.set_xlabel(uncertainty.drive.label, color=INK)
    lower.set_ylim(bottom=0.0)
    for axes in (upper, lower):
        axes.legend(frameon=False, labelcolor=INK, fontsize=8)
        style_axes(axes)
    upper.set_title(uncertainty.sentence(band.name), loc="left", color=INK, fontsize=9, wrap=True)
    return figure


def _curve(axes: Any, x: Any, band: Band) -> None:
    axes.fill_between(x, _shown(band, band.low), _shown(band, band.high), color=BLUE, alpha=0.18, lw=0, label="95 %")
    low, high = band.mean - band.deviation, band.mean + band.deviation
    axes.fill_between(
        x, _shown(band, low), _shown(band, high), color=BLUE, alpha=0.3, lw=0, label="± 1 standard deviation"
    )
    axes.plot(x, _shown(band, band.nominal), color=BLUE, lw=1.8, label="nominal")


def _parts(band: Band) -> list[tuple[str, Any]]:
    parts = list(band.parts.items())
    if np.any(band.together > 0):
        parts.append(("inputs together", band.together))
    if band.mesh is not None and np.isfinite(band.mesh).any():
        parts.append(("mesh error", band.mesh))
    return parts


def _shown(band: Band, values: Any) -> Any:
    return Column(band.name, band.unit, values).in_unit
