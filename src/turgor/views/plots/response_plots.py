"""Plots of a response, without global state of matplotlib: functions take axes and return them, or make a figure."""

from itertools import cycle
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from turgor.core.model.contact import SELF
from turgor.core.results.drive import drive_of, face_of, pressures_in
from turgor.core.results.measures.headlines import HEADLINE, headlines, with_parts
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response, unit_text
from turgor.views.plots.figures import PlotFigure, check_ending, svg_of, write_figure
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, style_axes

BLUE = "#1f5fa8"

#: Colors of lines that share a panel, in this order, distinct for color-blind readers too (Okabe and Ito 2008).
COLORS = (BLUE, "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")

#: Headlines without a panel of their own: the bending angle tells more than the displacement of the tip.
LEFT_OUT = ("tip_displacement",)


def plot_response(axes: Axes, response: Response, x: str, y: str, *, color: str = BLUE, label: str = "") -> Axes:
    """Plot one column of a response against another, in their units, with a dot for every state.

    Where the mesh error of ``y`` is known, a band shows it.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw; several responses may share it.
    response : Response
        What to draw.
    x, y : str
        Names of columns.
    color : str
        Color of the line.
    label : str
        Name of the line in the legend, if there is one.

    Returns
    -------
    matplotlib.axes.Axes
        The axes that were given.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from turgor.foundation.response import Column
    >>> from turgor.foundation.source import Source
    >>> columns = (Column("pressure", "kPa", [0, 50e3]), Column("bending_angle", "deg", [0, 1.5]))
    >>> response = Response(columns=columns, source=Source(text="a ruler"))
    >>> plot_response(Figure().add_subplot(), response, "pressure", "bending_angle").get_xlabel()
    'pressure [kPa]'
    """
    across, upward = response.find(x), response.find(y)
    errors = response.mesh_error(y)
    if errors is not None:
        low, high = (Column(y, upward.unit, upward.values + sign * errors).in_unit for sign in (-1, 1))
        axes.fill_between(across.in_unit, low, high, color=color, alpha=0.2, lw=0)
    axes.plot(across.in_unit, upward.in_unit, "-o", color=color, lw=1.8, ms=3.5, label=label or None, clip_on=False)
    axes.set_xlabel(across.label, color=INK)
    axes.set_ylabel(upward.label, color=INK)
    style_axes(axes)
    if x == "stage" and response.stages:
        _name_stages(axes, list(dict.fromkeys(response.stages)))
    return axes


def _name_stages(axes: Axes, names: list[str]) -> None:
    """Write the names of stages below their parts of the axis, with a grid line where a stage ends."""
    axes.set_xticks(range(len(names) + 1), labels=[""] * (len(names) + 1))
    turned = sum(map(len, names)) > PLOT.letters
    how = {"rotation": 30, "ha": "right", "rotation_mode": "anchor"} if turned else {}
    axes.set_xticks([number + 0.5 for number in range(len(names))], labels=names, minor=True, color=INK, **how)
    axes.tick_params(axis="x", which="minor", length=0)


def response_figure(response: Response, title: str = "") -> Figure:
    """Draw the response against its drive: bending angle, cavity volume, stretch and von Mises stress (99 % of volume).

    Panels whose column is missing are left out; if no panel is left, every measured column gets a panel. Several
    pressures share a panel of their own, which comes first; the other panels are then drawn against the load factor.

    Parameters
    ----------
    response : Response
        At least one column besides the drive.
    title : str
        Line above the panels.
    """
    drive, panels = drive_of(response), _panels(response)
    columns = min(2, len(panels))
    rows = -(-len(panels) // columns)
    figure = PlotFigure(figsize=(5.2 * columns, 3.3 * rows + (0.4 if title else 0)))
    for number, names in enumerate(panels):
        _plot_lines(figure.add_subplot(rows, columns, number + 1), response, drive, names)
    if title:
        known = any(response.mesh_error(name) is not None for names in panels for name in names)
        title += " · bands: estimated mesh error" if known else ""
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=13)
    return figure


def panel_figures(response: Response) -> tuple[Figure, ...]:
    """Draw each panel of `response_figure` as a figure of its own, for pages of any width.

    Parameters
    ----------
    response : Response

    Returns
    -------
    tuple of Figure
    """
    figures = []
    for names in _panels(response):
        figures.append(PlotFigure(figsize=(5.2, 3.3)))
        _plot_lines(figures[-1].add_subplot(), response, drive_of(response), names)
    return tuple(figures)


def _panels(response: Response) -> list[list[str]]:
    """Columns that share each panel."""
    drive = drive_of(response)
    pressures = [column.name for column in pressures_in(response)]
    measured = [column.name for column in response.quantities if column.name not in ("load_factor", drive, *pressures)]
    chosen = [name for name in headlines(measured) if name not in LEFT_OUT] or measured
    panels = [with_parts(response, name) for name in chosen]
    if not panels:
        raise TurgorError(f"the response holds {', '.join(response.names)} only; there is nothing to plot against it.")
    if pressures and drive not in pressures:
        panels.insert(0, pressures)
    return panels


def contact_figure(response: Response) -> Figure | None:
    """Draw the force on each obstacle and the contact areas, both over the drive.

    Parameters
    ----------
    response : Response
        With columns that end in ``_force`` or ``_contact_area``, as `force_on` and `area_on` fill them.

    Returns
    -------
    Figure or None
        None where the response has no such column.
    """
    kinds = {"_force": "force on the obstacle", "_contact_area": "contact area"}
    panels = {end: [name.removesuffix(end) for name in response.names if name.endswith(end)] for end in kinds}
    shown = {end: names for end, names in panels.items() if names}
    if not shown:
        return None
    every = dict.fromkeys(name for names in panels.values() for name in names)
    colors = dict(zip(every, cycle(COLORS), strict=False))
    figure = PlotFigure(figsize=(5.2 * len(shown), 3.3))
    for number, (end, names) in enumerate(shown.items()):
        axes = figure.add_subplot(1, len(shown), number + 1)
        for name in names:
            label = "walls of the actuator" if name == SELF else name.replace("_", " ")
            plot_response(axes, response, drive_of(response), name + end, color=colors[name], label=label)
        unit = unit_text(response.find(names[0] + end).unit)
        axes.set_ylabel(f"{kinds[end]} [{unit}]", color=INK)
        axes.legend(frameon=False, labelcolor=INK)
    return figure


def _plot_lines(axes: Axes, response: Response, drive: str, names: list[str]) -> Axes:
    """Plot columns of one kind into one panel, with a legend where there are several."""
    if len(names) == 1:
        return plot_response(axes, response, drive, names[0])
    whole = names[0] if names[0] in HEADLINE else None
    for name, color in zip(names, cycle(COLORS), strict=False):
        part = name.removesuffix(f"_{whole.removeprefix('cavity_')}") if whole else face_of(response.find(name))
        label = "all" if name == whole else part.replace("_", " ")
        plot_response(axes, response, drive, name, color=color, label=label)
    column = response.find(names[0])
    axes.set_ylabel(
        column.label if whole else f"{column.name.rpartition('_')[2]} [{unit_text(column.unit)}]", color=INK
    )
    axes.legend(frameon=False, labelcolor=INK)
    return axes


def write_plot(path: str | Path, response: Response, title: str = "", note: str = "") -> None:
    """Write `response_figure` as PNG or SVG, by the ending of the path; ``note`` is that of `write_figure`."""
    check_ending(path, "plot")
    write_figure(path, response_figure(response, title), dpi=160, note=note)


def response_svg(response: Response) -> str:
    """Return `response_figure` as SVG text that can stand inside a web page; equal responses give equal text."""
    return svg_of(response_figure(response))
