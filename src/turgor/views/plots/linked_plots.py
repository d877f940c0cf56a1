"""Linked plots: where the points of the lines of a plot lie, so that a page can mark one of them."""

import numpy as np
from matplotlib.figure import Figure

Place = tuple[float, float] | None


def places_of_points(figure: Figure, rows: int) -> list[list[Place]]:
    """Find the points of all lines of a figure that has been drawn.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Drawn before, so that its panels have their places.
    rows : int
        Points of a line; lines with another number are left out.

    Returns
    -------
    list of lists of (float, float) or None
        For each line the place of each point as shares of the width from the left and of the height from the top; None
        where the point is not known.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> figure = Figure()
    >>> _ = figure.add_axes((0, 0, 1, 1), xlim=(0, 2), ylim=(0, 2)).plot([0, 1], [0, 2])
    >>> places_of_points(figure, 2)
    [[(0.0, 1.0), (0.5, 0.0)]]
    """
    out: list[list[Place]] = []
    for axes in figure.axes:
        for line in axes.get_lines():
            data = np.asarray(line.get_xydata())
            if len(data) == rows:
                shares = figure.transFigure.inverted().transform(axes.transData.transform(data))
                out.append([_place(x, y) for x, y in shares.tolist()])
    return out


def _place(x: float, y: float) -> Place:
    return (round(x, 5), round(1 - y, 5) + 0.0) if x == x and y == y else None
