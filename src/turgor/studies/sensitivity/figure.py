"""Figures of sensitivities: bars of Sobol indices, and of the shares of an analysis of variance."""

from collections.abc import Sequence

import numpy as np

from turgor.studies.runs.rounding import percent
from turgor.studies.sensitivity.anova import Anova
from turgor.studies.sensitivity.indices import Indices
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.response_plots import COLORS
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, QUIET, style_axes

#: Height of a bar with its gap, and of what stands around the bars [inch].
BAR, AROUND = 0.42, 1.3


def indices_figure(indices: Sequence[Indices]) -> PlotFigure:
    """Draw first and total indices with their 95 % intervals, a panel for each measure.

    Parameters
    ----------
    indices : sequence of Indices

    Returns
    -------
    matplotlib.figure.Figure
    """
    heights = [max(len(each.factors), 2) * BAR + AROUND for each in indices]
    figure = PlotFigure(figsize=(1.5 * PLOT.panel_width, sum(heights)))
    for axes, each in zip(np.atleast_1d(figure.subplots(len(indices), 1, height_ratios=heights)), indices, strict=True):
        order = [each.factors.index(name) for name in reversed(each.ranking)]
        place = np.arange(len(order))
        for which, index, off, color in (
            ("total", each.total, -0.19, COLORS[0]),
            ("first", each.first, 0.19, COLORS[4]),
        ):
            low, high = each.interval(which)
            explained = 1 - each.unexplained
            values = explained * index[order]
            bars = np.maximum([values - low[order], high[order] - values], 0.0)
            label = "with interactions (total)" if which == "total" else "alone (first order)"
            axes.barh(place - off, 100 * values, height=0.36, color=color, label=label)
            axes.errorbar(100 * values, place - off, xerr=100 * bars, fmt="none", ecolor=INK, elinewidth=1, capsize=2)
        axes.set_yticks(place, [each.factors[n] for n in order])
        axes.set_xlabel(f"share of the variance of {each.measure.replace('_', ' ')} [%]", color=INK)
        axes.set_xlim(left=0.0)
        style_axes(axes)
        axes.grid(False, axis="y")
        axes.legend(frameon=False, labelcolor=INK, fontsize=8, loc="lower right")
        axes.set_title(_title(each), loc="left", color=INK, fontsize=9)
    return figure


def anova_figure(anovas: Sequence[tuple[str, Anova]]) -> PlotFigure:
    """Draw the shares of main effects and pairs, with the bars of the analyses side by side.

    Parameters
    ----------
    anovas : sequence of (str, Anova)
        Name in the legend, and analysis. All have the same terms.

    Returns
    -------
    matplotlib.figure.Figure
    """
    first = anovas[0][1]
    names = [term.name for term in (*first.terms, first.remainder)]
    figure = PlotFigure(figsize=(1.5 * PLOT.panel_width, len(names) * BAR + AROUND))
    axes = figure.subplots()
    thick = 0.8 / len(anovas)
    place = np.arange(len(names))[::-1]
    for n, (label, each) in enumerate(anovas):
        shares = [100 * term.share for term in (*each.terms, each.remainder)]
        off = (n - (len(anovas) - 1) / 2) * thick
        bars = axes.barh(place - off, shares, height=0.9 * thick, color=COLORS[n % len(COLORS)], label=label)
        axes.bar_label(bars, [f"{share:.2g}" for share in shares], padding=3, fontsize=8, color=QUIET)
    axes.set_yticks(place, names)
    axes.set_xlabel(f"share of the sum of squares of {first.measure.replace('_', ' ')} [%]", color=INK)
    style_axes(axes)
    axes.grid(False, axis="y")
    if any(label for label, _ in anovas):
        axes.legend(frameon=False, labelcolor=INK, fontsize=8, loc="lower right")
    return figure


def _title(indices: Indices) -> str:
    unexplained = f"; the surrogate leaves {percent(indices.unexplained)} % unexplained" if indices.unexplained else ""
    return f"{indices.count} points, lines: 95 %{unexplained}"
