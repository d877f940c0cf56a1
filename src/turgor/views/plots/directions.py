"""Plot of a law with directions against the specimens that were cut along them."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from turgor.core.materials.fitting.fit_directions import specimen_stress
from turgor.units import MPa
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.fits import COLORS
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, style_axes

if TYPE_CHECKING:
    from turgor.core.materials.fitting.fit_directions import DirectionsFit


def directions_figure(result: "DirectionsFit", *, title: str = "") -> Figure:
    """Draw the measured points of each specimen, and the curve of the law in its direction.

    Parameters
    ----------
    result : DirectionsFit
    title : str
        Line above the plot.
    """
    figure = PlotFigure(figsize=(6.4, 4.2))
    axes = figure.add_subplot()
    cuts = list(dict.fromkeys(cut for cut, _ in result.tests))
    for cut, color in zip(cuts, COLORS, strict=False):
        tests = [test for each, test in result.tests if each == cut]
        for number, test in enumerate(tests):
            label = f"{cut}, measured" if number == 0 else None
            axes.plot(test.stretch, test.nominal_stress / MPa, "o", color=color, ms=3.5, alpha=0.5, mew=0, label=label)
        grid = np.linspace(1.0, max(test.range[1] for test in tests), PLOT.curve_points)
        axes.plot(grid, specimen_stress(result.material(cut), grid) / MPa, "-", color=color, lw=1.5, label=cut)
    axes.set_xlabel("stretch [-]", color=INK)
    axes.set_ylabel("nominal stress [MPa]", color=INK)
    axes.legend(frameon=False, fontsize=8, labelcolor=INK)
    if title:
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=12)
    style_axes(axes)
    return figure
