"""Plot of a mesh-convergence study."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from turgor.core.results.convergence.settings import EXTRAPOLATION
from turgor.core.results.convergence.study import Convergence
from turgor.foundation.response import COLUMN_UNITS
from turgor.units import mm
from turgor.views.plots.figures import PlotFigure, check_ending, write_figure
from turgor.views.plots.response_plots import BLUE, plot_response
from turgor.views.plots.styling import INK, QUIET


def plot_convergence(axes: Axes, study: Convergence) -> Axes:
    """Plot the measure against the effective size, with the extrapolated value and the error of the finest mesh.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw.
    study : Convergence
        What to draw.

    Returns
    -------
    matplotlib.axes.Axes
        The axes that were given.

    Examples
    --------
    >>> import numpy as np
    >>> from matplotlib.figure import Figure
    >>> from turgor.core.results.measures.standard_measures import bending_angle
    >>> cells, sizes = np.array([1000, 8000, 64000]), np.array([4e-3, 2e-3, 1e-3])
    >>> study = Convergence(measure=bending_angle, sizes=sizes, cells=cells, unknowns=20 * cells, values=1 - sizes**2)
    >>> plot_convergence(Figure().add_subplot(), study).get_xlabel()
    'effective size [mm]'
    """
    plot_response(axes, study.response, "effective_size", study.measure.name)
    limit, unit = study.extrapolation, COLUMN_UNITS[study.measure.unit]
    finest, size = study.values[-1] / unit, study.effective_sizes[-1] / mm
    axes.errorbar([size], [finest], yerr=[limit.error / unit], color=BLUE, capsize=4, lw=1.2, label="estimated error")
    if limit.reliable:
        label = f"extrapolated: {study.measure.text(limit.value)}"
        places = np.linspace(0, size, 50)
        order = min(limit.order or 1.0, EXTRAPOLATION.most_order)
        fitted = limit.value + (study.values[-1] - limit.value) * (places / size) ** order
        axes.plot(places, fitted / unit, ":", color=QUIET, lw=1.2)
        axes.plot([0], [limit.value / unit], "D", color=INK, ms=5, clip_on=False, label=label)
    for x, y, count in zip(study.effective_sizes / mm, study.values / unit, study.unknowns, strict=True):
        shift = (5, 7) if count in study.unknowns[::2] else (5, -13)  # labels of neighbors may overlap
        axes.annotate(f"{count:,} unknowns", (x, y), shift, textcoords="offset points", fontsize=8, color=INK)
    axes.set_xlim(0, 1.25 * study.effective_sizes[0] / mm)
    axes.margins(y=0.2)
    axes.legend(frameon=False, labelcolor=INK)
    return axes


def write_convergence_plot(path: str | Path, study: Convergence, title: str = "") -> None:
    """Write `plot_convergence` as PNG or SVG, by the ending of the path."""
    check_ending(path, "plot")
    figure = PlotFigure(figsize=(6.4, 4.2))
    plot_convergence(figure.add_subplot(), study)
    if title:
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=13)
    write_figure(path, figure, dpi=160)
