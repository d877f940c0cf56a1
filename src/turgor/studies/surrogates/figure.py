"""Figure of a surrogate: predicted against computed values of held-out rows, with their intervals."""

from collections.abc import Sequence

import numpy as np

from turgor.foundation.response import Column
from turgor.studies.runs.settings import HALF_WIDTH
from turgor.studies.surrogates.surrogate import Surrogate
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.response_plots import BLUE, COLORS
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, QUIET, style_axes


def surrogate_figure(surrogate: Surrogate, measures: Sequence[str] = ()) -> PlotFigure:
    """Draw each measure of rows that were held out: predicted against computed, with 95 % intervals.

    Parameters
    ----------
    surrogate : Surrogate
    measures : sequence of str
        By default all.

    Returns
    -------
    matplotlib.figure.Figure
    """
    shown = [surrogate.error(name) for name in measures or surrogate.measures]
    columns = min(len(shown), PLOT.columns)
    rows = -(-len(shown) // columns)
    figure = PlotFigure(figsize=(3.6 * columns + 0.3, 3.6 * rows))
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes, each in zip(grid, shown, strict=False):
        computed, predicted, deviation = (
            Column(each.name, each.unit, values).in_unit for values in (each.computed, each.predicted, each.deviation)
        )
        half = HALF_WIDTH * deviation
        outside = np.abs(computed - predicted) > half
        ends = [float(min(computed.min(), predicted.min())), float(max(computed.max(), predicted.max()))]
        axes.plot(ends, ends, color=QUIET, lw=1)
        for among, color, label in ((~outside, BLUE, "within 95 %"), (outside, COLORS[1], "outside")):
            if not among.any():
                continue
            name = f"{label}: {int(among.sum())}"
            if len(computed) > PLOT.marks:
                axes.plot(computed[among], predicted[among], ".", ms=3, color=color, label=name)
                continue
            axes.errorbar(
                computed[among], predicted[among], yerr=half[among], fmt="o", ms=3, elinewidth=0.8, color=color,
                label=name,
            )  # fmt: skip
        label = Column(each.name, each.unit, np.zeros(1)).label
        axes.set_xlabel(f"computed {label}", color=INK)
        axes.set_ylabel(f"predicted {label}", color=INK)
        axes.set_title(f"RMS {100 * each.share:.2g} % of the range, R² {each.r_squared:.4f}", color=INK, fontsize=9)
        axes.legend(frameon=False, labelcolor=INK, fontsize=8)
        style_axes(axes)
    for axes in grid[len(shown) :]:
        axes.set_visible(False)
    return figure
