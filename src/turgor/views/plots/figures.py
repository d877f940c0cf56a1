"""Figures that a notebook shows, and figures as files and text: PNG and SVG."""

from collections.abc import Mapping
from io import BytesIO, StringIO
from pathlib import Path
from typing import Any, Literal

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from turgor.foundation.errors import TurgorError

Kind = Literal["plot", "picture"]

#: Endings of the files that plots and pictures are written to.
ENDINGS: Mapping[Kind, tuple[str, ...]] = {"plot": (".png", ".svg"), "picture": (".png",)}

#: Metadata of files by format, without the version of matplotlib and the date: equal figures give equal files.
METADATA: Mapping[str, Any] = {
    "png": {"Software": "turgor"},
    "svg": {"Creator": "turgor", "Date": None},
    "pdf": {"Creator": "turgor", "Producer": None, "CreationDate": None},
}


#: Key of the note in a PNG file.
NOTE = "Comment"


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


def check_ending(path: str | Path, kind: Kind) -> None:
    """Raise an error unless the ending of a path is one of `ENDINGS`; called before anything is drawn.

    Parameters
    ----------
    path : str or Path
        File to write.
    kind : {"plot", "picture"}
        What the file will show.

    Examples
    --------
    >>> check_ending("finger.png", "picture")
    >>> check_ending("finger", "picture")
    Traceback (most recent call last):
    turgor.TurgorError: picture 'finger' has no ending; allowed is .png.
    """
    ending = Path(path).suffix
    if ending.lower() not in ENDINGS[kind]:
        has = f"ends in '{ending}'" if ending else "has no ending"
        raise TurgorError(f"{kind} '{path}' {has}; allowed is {' or '.join(ENDINGS[kind])}.")


def write_figure(
    path: str | Path, figure: Figure, *, kind: Kind = "plot", dpi: float | None = None, note: str = ""
) -> None:
    """Write a figure in the format that the ending of the path names; equal figures give equal files.

    Parameters
    ----------
    path : str or Path
        File to write.
    figure : matplotlib.figure.Figure
    kind : {"plot", "picture"}
        What the figure shows.
    dpi : float, optional
        Dots per inch; by default the resolution of the figure.
    note : str
        What a PNG file says about itself; `note_in` reads it.

    Raises
    ------
    TurgorError
        If the ending is not one of `ENDINGS`.
    """
    check_ending(path, kind)
    _save(figure, Path(path), Path(path).suffix.lower().removeprefix("."), dpi, note)


def note_in(file: Path) -> str:
    """Return what a PNG file says about itself; nothing if there is no such file, or it is none."""
    from PIL import Image, UnidentifiedImageError

    try:
        with Image.open(file) as image:
            return str(image.info.get(NOTE, ""))
    except (OSError, UnidentifiedImageError):
        return ""


def png_of(figure: Figure, dpi: float | None = None) -> bytes:
    """Return a figure as PNG; equal figures give equal bytes.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    dpi : float, optional
        Dots per inch; by default the resolution of the figure.
    """
    stream = BytesIO()
    _save(figure, stream, "png", dpi)
    return stream.getvalue()


def svg_of(figure: Figure) -> str:
    """Return a figure as SVG text that can stand inside a web page; equal figures give equal text."""
    stream = StringIO()
    _save(figure, stream, "svg", None)
    text = stream.getvalue()
    return text[text.index("<svg") :]


def _save(figure: Figure, to: Path | BytesIO | StringIO, form: str, dpi: float | None, note: str = "") -> None:
    texts = {NOTE: note} if note and form == "png" else {}
    with matplotlib.rc_context({"svg.hashsalt": "turgor"}):
        figure.savefig(to, format=form, dpi=dpi or figure.dpi, metadata=METADATA[form] | texts)
