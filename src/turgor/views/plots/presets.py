"""Presets for publications: figures of a printed width, with letters of a printed size, and text that stays text."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import cycle
from pathlib import Path
from types import MappingProxyType
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from turgor.core.results.drive import drive_of
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Response
from turgor.units import inch, mm
from turgor.views.plots.figures import METADATA, PlotFigure
from turgor.views.plots.response_plots import COLORS, plot_response
from turgor.views.plots.styling import INK

#: Endings of files of curves.
ENDINGS = (".svg", ".pdf", ".png")


@dataclass(frozen=True, slots=True, kw_only=True)
class Preset:
    """Size of a printed figure and of its letters.

    Parameters
    ----------
    width : float [mm]
        Width on paper.
    height : float [mm]
        Height on paper of a panel of curves.
    font : float [pt]
        Size of the letters on paper.
    line : float [pt]
        Width of curves.
    dpi : float
        Dots per inch of PNG files and of pictures.

    Examples
    --------
    >>> preset("single").pixels  # for tg.picture(..., width=...)
    1004
    """

    width: float
    height: float
    font: float = 8.0
    line: float = 1.0
    dpi: float = 300.0

    def __post_init__(self) -> None:
        for name, low, high in (("width", 20, 1000), ("height", 15, 1000), ("font", 3, 60), ("dpi", 50, 2400)):
            if not low <= getattr(self, name) <= high:
                raise TurgorError(f"{name} of a preset is {getattr(self, name)}; allowed is {low} to {high}.")

    @property
    def pixels(self) -> int:
        """Width of a picture in pixels."""
        return round(self.width * mm / inch * self.dpi)


#: Presets by name: one and both columns of a journal, and a slide.
PRESETS: Mapping[str, Preset] = MappingProxyType(
    {
        "single": Preset(width=85, height=60),
        "double": Preset(width=170, height=70),
        "slide": Preset(width=250, height=130, font=18, line=2.5, dpi=150),
    }
)


def preset(name: str) -> Preset:
    """Return a preset by its name.

    Parameters
    ----------
    name : str
        ``"single"`` (85 mm, 8 pt), ``"double"`` (170 mm, 8 pt) or ``"slide"`` (250 mm, 18 pt).

    Examples
    --------
    >>> preset("double").width
    170
    """
    if name not in PRESETS:
        raise unknown("preset", name, PRESETS)
    return PRESETS[name]


def write_curves(
    path: str | Path,
    responses: Response | Mapping[str, Response],
    y: str,
    *,
    x: str | None = None,
    size: str | Preset = "single",
) -> Path:
    """Write one column of some responses against another as a figure for print: SVG, PDF or PNG.

    Letters in SVG and PDF are text, which can be searched and edited. Bands show mesh errors where they are known.

    Parameters
    ----------
    path : str or Path
        File to write.
    responses : Response or mapping of str to Response
        What to draw, by its name in the legend.
    y : str
        Name of the column.
    x : str, optional
        Name of the column across; what drives the first response by default.
    size : str or Preset
        Width and letters.

    Returns
    -------
    Path

    Raises
    ------
    TurgorError
        If the ending, a column or the preset is unknown.
    """
    path = Path(path)
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        raise unknown("ending of a figure", ending or str(path), ENDINGS)
    chosen = preset(size) if isinstance(size, str) else size
    named = {"": responses} if isinstance(responses, Response) else dict(responses)
    if not named:
        raise TurgorError("there is no response to draw.")
    with matplotlib.rc_context(_style(chosen)):
        figure = _figure(named, x, y, chosen)
        kind = ending.removeprefix(".")
        figure.savefig(path, format=kind, dpi=chosen.dpi, metadata=METADATA[kind])
    return path


def _figure(responses: Mapping[str, Response], x: str | None, y: str, size: Preset) -> Figure:
    figure = PlotFigure(figsize=(size.width * mm / inch, size.height * mm / inch))
    axes = figure.add_subplot()
    across = x or drive_of(next(iter(responses.values())))
    for (label, response), color in zip(responses.items(), cycle(COLORS), strict=False):
        plot_response(axes, response, across, y, color=color, label=label)
    for line in axes.lines:
        line.set_linewidth(size.line)
        line.set_markersize(2.2 * size.line)
    if any(responses):
        axes.legend(frameon=False, labelcolor=INK)
    return figure


def _style(size: Preset) -> Any:
    """Settings of Matplotlib while a figure is drawn and written."""
    return {
        "font.size": size.font,
        "axes.labelsize": size.font,
        "legend.fontsize": size.font,
        "xtick.labelsize": 0.9 * size.font,
        "ytick.labelsize": 0.9 * size.font,
        "axes.linewidth": 0.6 * size.line,
        "xtick.major.width": 0.6 * size.line,
        "ytick.major.width": 0.6 * size.line,
        "svg.fonttype": "none",
        "svg.hashsalt": "turgor",
        "pdf.fonttype": 42,
    }
