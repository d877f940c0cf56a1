"""Figures that a notebook shows, and figures as PNG."""

from io import BytesIO

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure


class PlotFigure(Figure):
    """A white figure that a notebook shows as PNG; unlike a figure of pyplot, it need not be closed.

    Parameters
    ----------
    figsize : (float, float) [inch]
        Width and height.
    """

    def __init__(self, figsize: tuple[float, float]) -> None:
        super().__init__(figsize=figsize, layout="constrained", facecolor="white")
        FigureCanvasAgg(self)

    def _repr_png_(self) -> bytes:
        """Return what a notebook shows."""
        return png_of(self)


def png_of(figure: Figure, dpi: float | None = None) -> bytes:
    """Return a figure as PNG; equal figures give equal bytes.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    dpi : float, optional
        Dots per inch; by default the resolution of the figure.
    """
    stream = BytesIO()
    figure.savefig(stream, format="png", dpi=dpi or figure.dpi, metadata={"Software": None})
    return stream.getvalue()
