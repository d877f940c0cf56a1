"""Framing of pictures: title, color bar and axes around an image of the actuator, pixel by pixel."""

from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.image import FigureImage
from matplotlib.lines import Line2D
from matplotlib.transforms import IdentityTransform
from numpy.typing import NDArray

from turgor.foundation.response import COLUMN_UNITS
from turgor.units import mm
from turgor.views.pictures.colors import DIVERGING
from turgor.views.pictures.rendering import View
from turgor.views.pictures.settings import FRAMING
from turgor.views.plots.styling import INK


class _Pixels(FigureImage):
    """An image of a figure that is drawn pixel by pixel, without resampling it."""

    def __init__(self, figure: Figure, pixels: NDArray[np.uint8], foot: int) -> None:
        super().__init__(figure, offsetx=0, offsety=foot, origin="upper")
        self.set_data(pixels)
        self._pixels, self._drawn_at = pixels, figure.dpi

    def make_image(self, renderer: Any, magnification: float = 1.0, unsampled: bool = False) -> Any:
        """Return the pixels from the bottom to the top, as Agg requires."""
        pixels, figure = self._pixels, self.figure
        if magnification != 1.0 or figure is None or figure.dpi != self._drawn_at:
            return super().make_image(renderer, magnification, unsampled)
        opaque = np.full((*pixels.shape[:2], 4), 255, dtype=np.uint8)
        opaque[..., :3] = pixels[::-1]
        return opaque, float(self.ox), float(self.oy), None


def bar_of(view: View) -> ScalarMappable:
    """Return the colors of a view and their range, in the unit of the color bar."""
    unit = COLUMN_UNITS[view.field.unit]
    return ScalarMappable(Normalize(view.floor / unit, view.limit / unit), view.field.color_map())


def framed(picture: NDArray[np.uint8], view: View, texts: tuple[str, str], colors: ScalarMappable | None) -> Figure:
    """Put an image of the actuator between its title, its color bar and the axes.

    Parameters
    ----------
    picture : (h, w, 3) array
        The image.
    view : View
        View of the picture; letters are smaller in narrow pictures.
    texts : (str, str)
        Title, and what the colors mean.
    colors : ScalarMappable or None
        The colors and their range; None where the picture shows no values, and needs no color bar.

    Returns
    -------
    matplotlib.figure.Figure
    """
    width = picture.shape[1]
    scale, (head, foot) = scale_of(width), bands(width)
    height = picture.shape[0] + head + foot
    figure = Figure(figsize=(width / 100, height / 100), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    figure.add_artist(_Pixels(figure, picture, foot))
    title, note = texts
    figure.text(FRAMING.margin / width, 1 - 0.5 * head / height, title, fontsize=24 * scale, va="center", color=INK)
    if colors is not None:
        bar = figure.add_axes((FRAMING.margin / width, 62 * scale / height, 0.42, 22 * scale / height))
        extend = "both" if view.field.colors == DIVERGING else "max"
        colorbar = figure.colorbar(colors, cax=bar, orientation="horizontal", extend=extend, extendfrac=0.03)
        colorbar.outline.set_visible(False)
        bar.tick_params(labelsize=16 * scale, colors=INK, length=5 * scale)
        figure.text(FRAMING.margin / width, 92 * scale / height, note, fontsize=16 * scale, va="bottom", color=INK)
    draw_axes(figure, view)
    return figure


def write_text(figure: Figure, place: tuple[float, float], text: str, size: float) -> None:
    """Write a line of text into a figure; ``place`` is its left end, in shares of width and height."""
    figure.text(*place, text, fontsize=size, va="center", color=INK)


def scale_of(width: int) -> float:
    """Scale of the letters of a picture of some width [pixels]: 1 at full width, less in narrow pictures."""
    return float(np.clip(width, FRAMING.design_width, FRAMING.full_width) / FRAMING.full_width)


def bands(width: int) -> tuple[int, int]:
    """Heights of the bands above and below the actuator in a picture of some width [pixels]."""
    return round(2 * FRAMING.margin * scale_of(width)), round(3 * FRAMING.margin * scale_of(width))


def draw_axes(figure: Figure, view: View) -> None:
    """Draw the axes x, y and z in the view, each with a round length at the scale of the picture."""
    width, height = figure.get_size_inches() * 100
    scale = scale_of(round(width))
    length = _round_length(72 * scale * view.pixel)
    corner = np.array([width - FRAMING.margin - 1.35 * length / view.pixel, 46.0 * scale])
    directions = view.eye.project(np.eye(3))[:, :2]
    for name, direction in zip("xyz", directions, strict=True):
        end = corner + direction * length / view.pixel
        line = Line2D([corner[0], end[0]], [corner[1], end[1]], color=INK, lw=2 * scale, solid_capstyle="round")
        line.set_transform(IdentityTransform())
        figure.add_artist(line)
        x, y = (end + direction / np.linalg.norm(direction) * 14 * scale) / [width, height]
        figure.text(x, y, name, fontsize=15 * scale, ha="center", va="center", color=INK)
    label = f"each axis {length / mm:g} mm"
    x, y = corner[0] / width, 12 * scale / height
    figure.text(x, y, label, fontsize=14 * scale, va="center", ha="center", color=INK)


def _round_length(about: float) -> float:
    """Largest of 1, 2, 5, 10 … mm that does not exceed a length."""
    power = 10.0 ** np.floor(np.log10(about / mm))
    return float(max(step * power for step in (1, 2, 5) if step * power <= about / mm)) * mm
