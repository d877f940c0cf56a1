"""Plot of a network of air or liquid: pressures, volumes, temperatures and flows against time."""

from pathlib import Path

from matplotlib.figure import Figure

from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response, unit_text
from turgor.views.plots.figures import PlotFigure, check_ending, write_figure
from turgor.views.plots.response_plots import COLORS
from turgor.views.plots.styling import INK, style_axes

#: Panels: the first word of the columns, and the title of the axis.
PANELS = {
    "pressure": "gauge pressure", "volume": "volume", "temperature": "temperature", "bending_angle": "bending angle",
    "twist_angle": "twist", "tip_displacement": "displacement of tip", "flow": "flow at 100 kPa, 20 °C",
}  # fmt: skip


def air_figure(response: Response, title: str = "") -> Figure:
    """Draw a panel for each kind of quantity, with a line for each node or part.

    Parameters
    ----------
    response : Response
        With ``time`` and columns such as ``pressure_tank`` and ``flow_valve``.
    title : str
        Line above the panels.
    """
    groups = {kind: [name for name in response if name.startswith(f"{kind}_")] for kind in PANELS}
    groups = {kind: names for kind, names in groups.items() if names}
    if not groups or "time" not in response:
        raise TurgorError("the response has no time, or nothing over time; that of a network is needed.")
    figure = PlotFigure(figsize=(7.2, 2.4 * len(groups) + (0.5 if title else 0.2)))
    nodes, parts = dict[str, int](), dict[str, int]()  # a node has one color in all panels
    panels = figure.subplots(len(groups), 1, squeeze=False, sharex=True)[:, 0]
    for axes, (kind, names) in zip(panels, groups.items(), strict=True):
        for name in names:
            label = name.removeprefix(f"{kind}_").replace("_", " ")
            number = (parts if kind == "flow" else nodes).setdefault(label, len(parts if kind == "flow" else nodes))
            look = {"color": COLORS[number % len(COLORS)], "ls": "-" if number < len(COLORS) else "--"}
            axes.plot(response["time"], response.find(name).in_unit, lw=1.6, label=label, **look)
        axes.set_ylabel(f"{PANELS[kind]} [{unit_text(response.find(names[0]).unit)}]", color=INK, fontsize=9)
        style_axes(axes)
        axes.legend(frameon=False, fontsize=8, labelcolor=INK, loc="center left", bbox_to_anchor=(1.0, 0.5))
    panels[-1].set_xlabel("time [s]", color=INK)
    figure.align_ylabels(panels)
    if title:
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=13)
    return figure


def write_air_plot(path: str | Path, response: Response, title: str = "") -> None:
    """Write `air_figure` as PNG or SVG, by the ending of the path."""
    check_ending(path, "plot")
    write_figure(path, air_figure(response, title), dpi=160)
