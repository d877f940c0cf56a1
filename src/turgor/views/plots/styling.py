"""Styling of plots: colors of text and lines, and axes without a frame."""

from matplotlib.axes import Axes

#: Colors of text and of lines that stay in the background.
INK, QUIET = "#262b34", "#8a93a0"


def style_axes(axes: Axes) -> Axes:
    """Leave out the upper and the right side of the frame, and draw a light grid behind the curves.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Axes of any plot.

    Returns
    -------
    matplotlib.axes.Axes
        The axes that were given.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> style_axes(Figure().add_subplot()).spines["top"].get_visible()
    False
    """
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set_color(QUIET)
    axes.tick_params(colors=INK, color=QUIET)
    axes.grid(True, color=QUIET, alpha=0.25, lw=0.6)
    axes.set_axisbelow(True)
    return axes
