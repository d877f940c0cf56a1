"""Known errors of a fast model against its inputs: at states that it was trained with, and at others."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter
from numpy.typing import NDArray

from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.response_plots import COLORS
from turgor.views.plots.styling import INK, QUIET, style_axes

Array = NDArray[np.float64]

#: Smaller errors are drawn here.
LEAST = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class KnownError:
    """Errors at some inputs.

    Parameters
    ----------
    label : str
        Name in the legend.
    inputs : (k, n) array
        In the units of the axes.
    errors : (k,) array [-]
        Not finite where nothing was found.
    trained : bool
        Whether the model was trained there; such errors stay in the background.
    """

    label: str
    inputs: Array
    errors: Array
    trained: bool = False


def error_figure(labels: Sequence[str], errors: Sequence[KnownError], wanted: float) -> Figure:
    """Draw errors against every input, on a logarithmic axis, with the wanted one as a line.

    Parameters
    ----------
    labels : sequence of str
        Of the axes of the n inputs, with units.
    errors : sequence of KnownError
    wanted : float [-]

    Examples
    --------
    >>> one = KnownError(label="tip", inputs=np.array([[1.0], [2.0]]), errors=np.array([1e-3, 2e-3]))
    >>> len(error_figure(["pressure [kPa]"], [one], 0.01).axes)
    1
    """
    count = len(labels)
    figure = PlotFigure(figsize=(3.2 * min(count, 3) + 2.6, 3.2 * -(-count // 3) + 0.3))
    for place, label in enumerate(labels):
        axes = figure.add_subplot(-(-count // 3), min(count, 3), place + 1)
        colors = iter(COLORS)
        for each in errors:
            color, marker = (QUIET, "x") if each.trained else (next(colors), "o")
            shown = np.maximum(each.errors, LEAST)
            axes.plot(each.inputs[:, place], shown, marker, color=color, ms=4, mew=0.9, label=each.label)
        axes.axhline(wanted, color=INK, lw=0.9, ls="--", label="wanted")
        axes.set_yscale("log")
        axes.yaxis.set_major_formatter(lambda value, _: f"{100 * value:g} %")
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.set_xlabel(label, color=INK)
        if place % 3 == 0:
            axes.set_ylabel("error", color=INK)
        style_axes(axes)
    handles, names = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside upper left", ncols=3, frameon=False, fontsize=8, labelcolor=INK)
    return figure


def summary(errors: Mapping[str, Array]) -> list[tuple[str, str, str]]:
    """Name, median and largest of errors in percent, as text; a value that is not finite says that nothing was found.

    Examples
    --------
    >>> summary({"tip": np.array([0.001, 0.004])})
    [('tip', '0.25 %', '0.4 %')]
    """

    def text(value: float) -> str:
        return f"{100 * value:.2g} %" if np.isfinite(value) else "not found"

    return [(name, text(float(np.median(values))), text(float(values.max()))) for name, values in errors.items()]
