"""Plot of rods: their axes, sections and planes in two of the three directions, for some states of a path."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from turgor.fast_models.rod.solution import RodSolution, shapes_of
from turgor.fast_models.rod.system import RodSystem
from turgor.foundation.errors import TurgorError
from turgor.units import mm
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.response_plots import COLORS
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, QUIET, style_axes


def plot_rods(solution: RodSolution, states: Iterable[int] = (0, -1), *, view: str = "xz", axes: Any = None) -> Figure:
    """Plot rods in some states.

    Parameters
    ----------
    solution : RodSolution
    states : sequence of int
        Which states; the later, the darker.
    view : str
        The two directions that the plot shows.
    axes : matplotlib.axes.Axes, optional
        Where to draw; by default a new figure.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    TurgorError
        If the view does not name two of x, y and z.

    Examples
    --------
    >>> from turgor.fast_models.rod.model import Rod, RodModel
    >>> from turgor.fast_models.rod.path import static
    >>> from turgor.fast_models.rod.sections.section import RodSection
    >>> rod = Rod(section=RodSection.from_moduli(EA=100, GA=30, EI=1e-3, GJ=1e-3), length=0.1)
    >>> plot_rods(static(RodModel(rods=[rod]))).axes[0].get_xlabel()
    'x [mm]'
    """
    if len(set(view)) != 2 or len(view) != 2 or not set(view) <= set("xyz"):
        raise TurgorError(f"view is '{view}'; two different letters of x, y and z are needed, such as 'xz'.")
    across, up = ("xyz".index(letter) for letter in view)
    if axes is None:
        axes = PlotFigure(figsize=(4.8, 3.6)).add_subplot()
    system = RodSystem(solution.model)
    chosen = [solution.states[index] for index in states]
    for state, shade in zip(chosen, np.linspace(PLOT.pale, 1.0, len(chosen)), strict=True):
        for k, (rod, shape) in enumerate(zip(solution.model.rods, shapes_of(system, state), strict=True)):
            half = rod.section.contact_radius or PLOT.rod_mark * rod.length
            color = COLORS[k % len(COLORS)]
            for side in shape.frames[:, :, 1:].transpose(2, 0, 1):
                ends = np.stack([shape.position - half * side, shape.position + half * side]) / mm
                axes.plot(ends[..., across], ends[..., up], color=color, lw=0.7, alpha=0.6 * shade)
            line = shape.position / mm
            axes.plot(line[:, across], line[:, up], color=color, lw=2.2, alpha=shade, solid_capstyle="round")
    _draw_planes(solution, axes, across, up)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel(f"{view[0]} [mm]", color=INK)
    axes.set_ylabel(f"{view[1]} [mm]", color=INK)
    style_axes(axes)
    return axes.figure


def _draw_planes(solution: RodSolution, axes: Any, across: int, up: int) -> None:
    """Draw the planes that the plot sees from their edge."""
    for plane in solution.model.planes:
        normal, point = np.array(plane.normal), np.array(plane.point) / mm
        if np.hypot(normal[across], normal[up]) < 0.999:
            continue
        along = (-normal[up], normal[across])
        axes.axline((point[across], point[up]), (point[across] + along[0], point[up] + along[1]), color=QUIET, lw=3)
