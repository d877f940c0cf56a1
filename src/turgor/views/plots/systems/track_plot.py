"""Plot of an actuator that follows a path: wanted and reached places, distance, and pressures."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response, unit_text
from turgor.views.plots.figures import PlotFigure, check_ending, write_figure
from turgor.views.plots.response_plots import COLORS
from turgor.views.plots.styling import INK, QUIET, style_axes

WANTED = "_wanted"

#: Distance over the range of the path, that is the top of the axis of smaller ones.
NEGLIGIBLE = 1e-3


def track_figure(response: Response, title: str = "") -> Figure:
    """Draw what an actuator was to follow and what it reached, the distance between both, and the pressures.

    Parameters
    ----------
    response : Response
        That of a `turgor.control.Track`: time, inputs, outputs and those wanted, distance.
    title : str
        Line above the plots.
    """
    outputs = _outputs(response)
    figure = PlotFigure(figsize=(9.0, 4.8 if title else 4.5))
    grid = figure.add_gridspec(2, 2, width_ratios=(1.25, 1.0))
    _draw_path(figure.add_subplot(grid[:, 0]), response, outputs)
    _draw_inputs(figure.add_subplot(grid[0, 1]), response, outputs)
    _draw_distance(figure.add_subplot(grid[1, 1]), response)
    if title:
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=13)
    return figure


def track_panels(response: Response, active: Sequence[Sequence[str]]) -> list[Figure]:
    """Draw the same for a page, each part alone, and when the actuator was at which limit.

    Parameters
    ----------
    response : Response
    active : sequence of sequences of str
        Limits that each row has reached.
    """
    outputs = _outputs(response)
    panels: list[Figure] = [PlotFigure(figsize=(4.6, 3.5)) for _ in range(3)]
    _draw_path(panels[0].add_subplot(), response, outputs)
    _draw_inputs(panels[1].add_subplot(), response, outputs)
    _draw_distance(panels[2].add_subplot(), response)
    names = sorted({name for each in active for name in each})
    if names:
        panels.append(PlotFigure(figsize=(4.6, 1.1 + 0.3 * max(2, len(names)))))
        _draw_limits(panels[3].add_subplot(), response["time"], active, names)
    return panels


def _outputs(response: Response) -> list[str]:
    outputs = [name for name in response if f"{name}{WANTED}" in response.names]
    if not outputs or "time" not in response:
        raise TurgorError("the response has no wanted outputs over time; that of a track is needed.")
    return outputs


def _draw_inputs(axes: Axes, response: Response, outputs: list[str]) -> None:
    """The inputs that change, or all where none does."""
    columns = [response.find(name) for name in response.names[1 : response.names.index(f"{outputs[0]}{WANTED}")]]
    columns = [each for each in columns if _range(each.values) > 0] or columns
    for number, column in enumerate(columns):
        label, color = column.name.replace("_", " "), COLORS[number % len(COLORS)]
        axes.plot(response["time"], column.in_unit, color=color, lw=1.4, label=label)
    units = sorted({unit_text(column.unit) for column in columns if column.unit})
    axes.set_ylabel(f"inputs [{', '.join(units)}]" if units else "inputs", color=INK)
    axes.set_xlabel("time [s]", color=INK)
    axes.legend(frameon=False, fontsize=8, labelcolor=INK)
    style_axes(axes)


def _draw_distance(axes: Axes, response: Response) -> None:
    column = response.find("distance")
    axes.plot(response["time"], column.in_unit, color=INK, lw=1.4)
    axes.set_ylabel(f"distance [{unit_text(column.unit)}]", color=INK)
    axes.set_xlabel("time [s]", color=INK)
    wanted = max(_range(response.find(f"{name}{WANTED}").in_unit) for name in _outputs(response))
    # what is much smaller than the path counts as none
    axes.set_ylim(0.0, max(1.08 * float(np.nanmax(column.in_unit)), NEGLIGIBLE * wanted) or 1.0)
    style_axes(axes)


def _draw_limits(axes: Axes, time: NDArray[np.float64], active: Sequence[Sequence[str]], names: list[str]) -> None:
    """A bar for each stretch of time at a limit."""
    known = np.isfinite(time)
    ends = time[known]
    step = float(np.diff(ends).min()) if len(ends) > 1 else 1.0
    for place, name in enumerate(names):
        at = [float(t) - step / 2 for t, each in zip(ends, active, strict=True) if name in each]
        axes.broken_barh([(t, step) for t in at], (place - 0.22, 0.44), color=COLORS[place % len(COLORS)])
    axes.set_yticks(range(len(names)), names, fontsize=8, color=INK)
    axes.set_ylim(max(2, len(names)) - 0.5, -0.5)
    axes.set_xlim(ends[0] - step, ends[-1] + step)
    axes.set_xlabel("time [s]", color=INK)
    axes.set_title("at a limit", fontsize=9, color=INK, loc="left")
    style_axes(axes)


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
        spans = [_range(response[f"{name}{WANTED}"]) for name in tips]
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


def _range(values: NDArray[np.float64]) -> float:
    return float(np.nanmax(values) - np.nanmin(values))


def write_track_plot(path: str | Path, response: Response, title: str = "") -> None:
    """Write `track_figure` as PNG or SVG, by the ending of the path."""
    check_ending(path, "plot")
    write_figure(path, track_figure(response, title), dpi=160)
