"""Figures that a notebook shows without further ado."""

from io import BytesIO

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure


class PlotFigure(Figure):
    """A white figure that draws itself; no list of open figures keeps it alive.

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
        Dots per inch; by default those of the figure.
    """
    stream = BytesIO()
    figure.savefig(stream, format="png", dpi=dpi or figure.dpi, metadata={"Software": None})
    return stream.getvalue()
