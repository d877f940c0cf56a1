"""Heat map: a measure over two factors."""

from collections.abc import Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from numpy.typing import NDArray

from turgor.views.plots.response_plots import COLORS
from turgor.views.plots.settings import PLOT
from turgor.views.plots.studies.effects import HIDDEN, SCALE
from turgor.views.plots.styling import INK, QUIET

Array = NDArray[np.float64]


def plot_heat_map(
    axes: Axes, levels: tuple[Sequence[str], Sequence[str]], values: Array, errors: Array, labels: tuple[str, str, str]
) -> Axes:
    """Plot a measure as colored cells with its values, and dots between cells that mesh errors do not tell apart.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    levels : (sequence of str, sequence of str)
        Levels along x and y, as text.
    values, errors : (ny, nx) array
        Of the measure; NaN where a run failed, or no mesh error is known.
    labels : (str, str, str)
        Of x, y and the measure.

    Returns
    -------
    matplotlib.axes.Axes

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> none = np.full((1, 2), np.nan)
    >>> axes = plot_heat_map(Figure().add_subplot(), (["1", "2"], ["4"]), np.array([[9.0, 3.0]]), none,
    ...                      ("wall [mm]", "chambers", "angle [°]"))
    >>> axes.get_title(loc="left")
    'angle [°]'
    """
    across, up = levels
    scale = colormaps[SCALE].with_extremes(bad="#eceef1")
    axes.imshow(np.ma.masked_invalid(values), origin="lower", aspect="auto", cmap=scale)
    axes.set_xticks(range(len(across)), labels=[each.replace("/", "/\n", 1) for each in across])
    axes.set_yticks(range(len(up)), labels=[each.replace("/", "/\n", 1) for each in up])
    axes.set_xlabel(labels[0], color=INK)
    axes.set_ylabel(labels[1], color=INK)
    axes.set_title(labels[2], loc="left", color=INK, fontsize=10)
    axes.tick_params(colors=INK, color=QUIET, length=0)
    axes.spines[:].set_visible(False)
    axes.set_xticks(np.arange(-0.5, len(across)), minor=True)
    axes.set_yticks(np.arange(-0.5, len(up)), minor=True)
    axes.grid(which="minor", color="white", lw=2)
    axes.tick_params(which="minor", length=0)
    if values.size <= PLOT.marks:
        _write(axes, values)
    _dots(axes, values, errors)
    return axes


def _write(axes: Axes, values: Array) -> None:
    """Write each value into its cell, in the color that is seen best."""
    finite = values[np.isfinite(values)]
    scale = Normalize(*(finite.min(), finite.max()) if finite.size else (0.0, 1.0))
    for (row, column), value in np.ndenumerate(values):
        if np.isfinite(value):
            color = "white" if scale(value) < 0.6 else INK
            axes.text(column, row, f"{value:.3g}", ha="center", va="center", color=color, fontsize=9)
        else:
            axes.text(column, row, "failed", ha="center", va="center", color=QUIET, fontsize=8)


def _dots(axes: Axes, values: Array, errors: Array) -> None:
    """Dot the edge between neighbors whose difference is smaller than their mesh errors together."""
    some = False
    for axis in (0, 1):
        along, wide = np.moveaxis(values, axis, 0), np.moveaxis(errors, axis, 0)
        hidden = np.abs(np.diff(along, axis=0)) < wide[:-1] + wide[1:]
        for k, other in np.argwhere(hidden):
            line = ([other - 0.42, other + 0.42], [k + 0.5, k + 0.5])
            axes.plot(*(line if axis == 0 else line[::-1]), ":", color=COLORS[1], lw=2.4)
            some = True
    if some:
        axes.set_title(f"dotted: {HIDDEN}", loc="right", color=COLORS[1], fontsize=7)
