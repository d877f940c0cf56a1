"""Picture of arms as links with their thickness, from the side and from above, with the object that they touch."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from turgor.core.model.obstacles.rigid_shape import RigidShape
from turgor.units import mm
from turgor.views.plots.figures import PlotFigure, check_ending, write_figure
from turgor.views.plots.response_plots import COLORS
from turgor.views.plots.styling import INK, QUIET, style_axes

Array = NDArray[np.float64]

#: Points of a circle.
CIRCLE = 32

#: Share of white in the color of a capsule.
PALE = 0.8


def write_mechanism_plot(
    path: str | Path,
    lines: Mapping[str, Array],
    radii: Mapping[str, Array],
    shape: RigidShape | None = None,
    title: str = "",
) -> None:
    """Draw lines (2 n + 2, 3) [m] of arms by name, and an object, as PNG or SVG by the ending of the path.

    Parameters
    ----------
    path : str or Path
    lines : mapping of str to (2 n + 2, 3) arrays [m]
        Base, both ends of the capsule of each link, tip.
    radii : mapping of str to (n,) arrays [m]
        Of the capsules.
    shape : RigidShape, optional
    title : str
    """
    check_ending(path, "plot")
    figure = PlotFigure(figsize=(9.0, 4.6))
    if title:
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=13)
    for place, (across, upward) in enumerate(((0, 2), (1, 2)), start=1):
        axes = figure.add_subplot(1, 2, place)
        for number, (name, line) in enumerate(lines.items()):
            tint = tuple(
                PALE + (1 - PALE) * part for part in to_rgb(COLORS[number % len(COLORS)])
            )  # opaque: links overlap
            for first, last, radius in zip(line[1:-1:2], line[2:-1:2], radii[name], strict=True):
                flat = [_capsule(each[[across, upward]] / mm, radius / mm) for each in (first, last)]
                axes.fill(*_around(np.vstack(flat)), color=tint, lw=0, zorder=0.5)
        _draw(axes, lines, shape, (across, upward))
    write_figure(path, figure, dpi=160)


def _capsule(center: Array, radius: float) -> Array:
    """Points (k, 2) of the circle at one end of a capsule."""
    angle = np.linspace(0, 2 * np.pi, CIRCLE, endpoint=False)
    return np.asarray(center + radius * np.column_stack([np.cos(angle), np.sin(angle)]))


def _around(points: Array) -> tuple[Array, Array]:
    """Outline of the convex hull of points (k, 2), as two rows of coordinates."""
    from scipy.spatial import ConvexHull

    hull = points[ConvexHull(points).vertices] if np.ptp(points, axis=0).min() > 0 else points
    return hull[:, 0], hull[:, 1]


def _draw(axes: Axes, lines: Mapping[str, Array], shape: RigidShape | None, plane: tuple[int, int]) -> None:
    across, upward = plane
    every = np.concatenate(list(lines.values()))
    if shape is not None:
        points, triangles = shape.outline(np.zeros(3), np.array([every.min(axis=0), every.max(axis=0)]))
        for triangle in triangles:
            axes.fill(points[triangle, across] / mm, points[triangle, upward] / mm, color=QUIET, alpha=0.3, lw=0)
    for number, (name, line) in enumerate(lines.items()):
        color = COLORS[number % len(COLORS)]
        axes.plot(line[:, across] / mm, line[:, upward] / mm, "o-", color=color, lw=2.5, ms=4, label=name)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel(f"{'xyz'[across]} [mm]", color=INK)
    axes.set_ylabel(f"{'xyz'[upward]} [mm]", color=INK)
    axes.legend(loc="upper right", frameon=False, fontsize=8, labelcolor=INK)
    style_axes(axes)
