"""Plot of an actuator that follows a path: wanted and reached places, distance, and pressures."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response, unit_text
from turgor.views.plots.figures import PlotFigure, check_ending, write_figure
from turgor.views.plots.response_plots import COLORS
from turgor.views.plots.styling import INK, QUIET, style_axes

WANTED = "_wanted"


def track_figure(response: Response, title: str = "") -> Figure:
    """Draw what an actuator was to follow and what it reached, the distance between both, and the pressures.

    Parameters
    ----------
    response : Response
        That of a `turgor.control.Track`: time, inputs, outputs and those wanted, distance.
    title : str
        Line above the plots.
    """
    outputs = [name for name in response if f"{name}{WANTED}" in response.names]
    if not outputs or "time" not in response:
        raise TurgorError("the response has no wanted outputs over time; that of a track is needed.")
    first = response.names.index(f"{outputs[0]}{WANTED}")
    figure = PlotFigure(figsize=(9.0, 4.8 if title else 4.5))
    grid = figure.add_gridspec(2, 2, width_ratios=(1.25, 1.0))
    _draw_path(figure.add_subplot(grid[:, 0]), response, outputs)
    inputs, distance = figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1])
    for number, name in enumerate(response.names[1:first]):
        column = response.find(name)
        label = name.replace("_", " ")
        inputs.plot(response["time"], column.in_unit, color=COLORS[number % len(COLORS)], lw=1.4, label=label)
    unit = response.columns[1].unit
    inputs.set_ylabel(f"inputs [{unit_text(unit)}]" if unit else "inputs", color=INK)
    inputs.legend(frameon=False, fontsize=8, labelcolor=INK)
    column = response.find("distance")
    distance.plot(response["time"], column.in_unit, color=INK, lw=1.4)
    distance.set_ylabel(f"distance [{unit_text(column.unit)}]", color=INK)
    distance.set_xlabel("time [s]", color=INK)
    distance.set_ylim(bottom=0.0)
    style_axes(inputs)
    style_axes(distance)
    if title:
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=13)
    return figure


def _draw_path(axes: Axes, response: Response, outputs: list[str]) -> None:
    """Draw wanted and reached outputs: in the plane of the two tip axes that move most, or against time."""
    tips = [name for name in outputs if name.startswith("tip_")]
    if len(tips) < 2 or len(tips) < len(outputs):
        for number, name in enumerate(outputs):
            color = COLORS[number % len(COLORS)]
            axes.plot(response["time"], response.find(f"{name}{WANTED}").in_unit, color=QUIET, lw=4, alpha=0.6)
            axes.plot(response["time"], response.find(name).in_unit, color=color, lw=1.4, label=name.replace("_", " "))
        axes.set_xlabel("time [s]", color=INK)
        axes.set_ylabel(f"[{unit_text(response.find(outputs[0]).unit)}]", color=INK)
    else:
        spans = [float(np.ptp(response[f"{name}{WANTED}"])) for name in tips]
        across, upward = (tips[place] for place in sorted(np.argsort(spans)[-2:]))
        unit = unit_text(response.find(across).unit)
        for end, color, width, alpha in ((WANTED, QUIET, 4.0, 0.6), ("", COLORS[0], 1.4, 1.0)):
            x, y = (response.find(f"{name}{end}").in_unit for name in (across, upward))
            axes.plot(x, y, label="wanted" if end else "reached", color=color, lw=width, alpha=alpha)
        axes.set_xlabel(f"{across.replace('_', ' ')} [{unit}]", color=INK)
        axes.set_ylabel(f"{upward.replace('_', ' ')} [{unit}]", color=INK)
        axes.set_aspect("equal", adjustable="datalim")
    axes.legend(frameon=False, fontsize=8, labelcolor=INK)
    style_axes(axes)


def write_track_plot(path: str | Path, response: Response, title: str = "") -> None:
    """Write `track_figure` as PNG or SVG, by the ending of the path."""
    check_ending(path, "plot")
    write_figure(path, track_figure(response, title), dpi=160)
