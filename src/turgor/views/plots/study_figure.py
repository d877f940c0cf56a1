"""Figure of a study: panels of curves next to each other, and small pictures of the actuators below."""

from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.image import imread
from numpy.typing import ArrayLike

from turgor.foundation.response import Response
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.response_plots import COLORS, plot_response
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, style_axes


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Line:
    """A line of a panel.

    Parameters
    ----------
    x, y : (n,) array_like
        In the units of the panel's labels. Where ``x`` are names, horizontal bars are drawn, and the panel's ``x`` is
        not shown.
    label : str
        Name in the legend.
    error : (n,) array_like or None
        Mesh error of ``y``, drawn as bars.
    """

    x: ArrayLike
    y: ArrayLike
    label: str = ""
    error: ArrayLike | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Panel:
    """One diagram: lines, or columns of responses against each other.

    Parameters
    ----------
    x, y : str
        Labels of the axes; names of columns where ``responses`` are given.
    lines : sequence of Line
    responses : sequence of (str, Response)
        Responses with their names in the legend; mesh errors are bands.
    """

    x: str
    y: str
    lines: Sequence[Line] = ()
    responses: Sequence[tuple[str, Response]] = ()


def study_figure(panels: Sequence[Panel], pictures: Sequence[tuple[str, bytes]] = ()) -> PlotFigure:
    """Draw panels next to each other, and pictures below.

    Parameters
    ----------
    panels : sequence of Panel
    pictures : sequence of (str, bytes)
        Names and PNG files; of more than four, those spread evenly over them.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> figure = study_figure([Panel(x="wall [mm]", y="angle [deg]", lines=[Line(x=[1, 2], y=[9, 3])])])
    >>> len(figure.axes)
    1
    """
    shown = _spread(pictures)
    heights = [PLOT.panel_height] * bool(panels) + [PLOT.panel_width / 2] * bool(shown)
    width = max(PLOT.panel_width * len(panels), 1.6 * PLOT.panel_width if shown else 0.0)
    figure = PlotFigure(figsize=(width, sum(heights)))
    rows = iter(figure.subfigures(len(heights), 1, height_ratios=heights, squeeze=False)[:, 0])
    if panels:
        row = next(rows)
        for axes, panel in zip(row.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
            _panel(axes, panel)
    if shown:
        row = next(rows)
        for axes, (name, png) in zip(row.subplots(1, len(shown), squeeze=False)[0], shown, strict=True):
            axes.imshow(imread(BytesIO(png), format="png"))
            axes.set_axis_off()
            axes.set_title(fill(name, PLOT.letters // 2), color=INK, fontsize=9)
    return figure


def pictures_in_row(pictures: Sequence[tuple[str, bytes]], size: tuple[float, float]) -> PlotFigure:
    """Draw pictures next to each other, with a title each.

    Parameters
    ----------
    pictures : sequence of (str, bytes)
        Titles and PNG files.
    size : (float, float) [inch]

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = PlotFigure(figsize=size)
    for axes, (title, png) in zip(figure.subplots(1, len(pictures), squeeze=False)[0], pictures, strict=True):
        axes.imshow(imread(BytesIO(png), format="png"))
        axes.set_axis_off()
        axes.set_title(title, color=INK, fontsize=9)
    return figure


def _spread(pictures: Sequence[tuple[str, bytes]]) -> list[tuple[str, bytes]]:
    drawn = [each for each in pictures if each[1]]
    if len(drawn) <= PLOT.pictures:
        return drawn
    return [drawn[round(k)] for k in np.linspace(0, len(drawn) - 1, PLOT.pictures)]


def _panel(axes: Any, panel: Panel) -> None:
    colors = [COLORS[k % len(COLORS)] for k in range(len(panel.responses) + len(panel.lines))]
    for color, (name, response) in zip(colors, panel.responses, strict=False):
        plot_response(axes, response, panel.x, panel.y, color=color, label=name)
    named = [line for line in panel.lines if np.size(line.x) and isinstance(np.asarray(line.x).tolist()[0], str)]
    if named:
        _bars(axes, panel, named)
        return
    for color, line in zip(colors[len(panel.responses) :], panel.lines, strict=True):
        axes.errorbar(line.x, line.y, yerr=line.error, fmt="-o", ms=4, lw=1.6, capsize=3, color=color, label=line.label)
    if not panel.responses:
        axes.set_xlabel(panel.x, color=INK)
        axes.set_ylabel(panel.y, color=INK)
        style_axes(axes)
    if any(name for name, _ in panel.responses) or any(line.label for line in panel.lines):
        axes.legend(frameon=False, labelcolor=INK, fontsize=8)


def _bars(axes: Any, panel: Panel, lines: Sequence[Line]) -> None:
    """Draw values with names as horizontal bars, those of one name next to each other."""
    names = list(dict.fromkeys(name for line in lines for name in np.asarray(line.x).tolist()))
    height = 0.8 / len(lines)
    for k, line in enumerate(lines):
        places = [names.index(name) + (k - (len(lines) - 1) / 2) * height for name in np.asarray(line.x).tolist()]
        axes.barh(places, line.y, height, xerr=line.error, color=COLORS[k % len(COLORS)], label=line.label, capsize=2)
    axes.set_yticks(range(len(names)), labels=names, fontsize=8)
    axes.invert_yaxis()
    axes.set_xlabel(panel.y, color=INK)
    style_axes(axes)
    if any(line.label for line in lines):
        axes.legend(frameon=False, labelcolor=INK, fontsize=8)
