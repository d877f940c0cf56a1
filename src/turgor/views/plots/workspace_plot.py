"""Plot of a workspace: the places of the tip and their convex hull, seen along one axis."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from scipy.spatial import ConvexHull

from turgor.core.results.measures.shape.workspaces import Workspace
from turgor.foundation.errors import TurgorError
from turgor.units import mm
from turgor.views.plots.response_plots import BLUE
from turgor.views.plots.styling import INK, style_axes


def plot_workspace(axes: Axes, reached: Workspace, across: str = "x", upward: str = "z", *, color: str = BLUE) -> Axes:
    """Plot the places of the tip and the hull around them, projected onto a plane, both axes at one scale.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw; several workspaces may share it.
    reached : Workspace
        From `turgor.measures.workspace`.
    across, upward : str
        Axes of the plane, ``"x"``, ``"y"`` or ``"z"``.
    color : str

    Returns
    -------
    matplotlib.axes.Axes
        The axes that were given.

    Raises
    ------
    TurgorError
        If the axes are not two of x, y and z.
    """
    if {across, upward} - set("xyz") or across == upward:
        raise TurgorError(f"the axes of the plot are '{across}' and '{upward}'; two of x, y and z are needed.")
    places = reached.points[:, ["xyz".index(across), "xyz".index(upward)]] / mm
    spread = np.linalg.svd(places - places.mean(axis=0), compute_uv=False)
    if spread[1] > 1e-6 * spread[0]:  # seen from the side, a flat workspace is a line
        corners = places[ConvexHull(places).vertices]
        axes.add_patch(Polygon(corners, facecolor=color, alpha=0.15, lw=0))
        axes.add_patch(Polygon(corners, facecolor="none", edgecolor=color, lw=1.2))
    axes.plot(*places.T, "o", color=color, ms=3)
    axes.set_xlabel(f"tip displacement {across} [mm]", color=INK)
    axes.set_ylabel(f"tip displacement {upward} [mm]", color=INK)
    axes.set_aspect("equal")
    return style_axes(axes)
