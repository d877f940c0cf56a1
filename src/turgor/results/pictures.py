"""Pictures: the whole actuator at true scale, colored by von Mises stress, as PNG."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, LinearSegmentedColormap, Normalize, to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.transforms import IdentityTransform
from numpy.typing import NDArray

from turgor.errors import TurgorError
from turgor.response import Response
from turgor.results.drive import face_of, pressures_in
from turgor.results.fibers import drawn_threads
from turgor.results.fields import StateFields
from turgor.results.raycast import Camera, Hits, Raster, Scene, camera
from turgor.results.shading import GHOST, INK, Look, draw_lines, find_lines, paint, reduced
from turgor.results.skin import Skin, visible_skin
from turgor.results.thread_lines import draw_threads, visible_threads
from turgor.solvers.solution import State
from turgor.units import deg, kPa, mm

Array = NDArray[np.float64]

#: Color of the unstressed actuator.
RUBBER = "#f1efec"

#: Samples along each side of a pixel.
SAMPLES = 2

#: Rows of pixels that are drawn at a time.
BAND = 96

#: Pixels around the actuator, above it for the title, below it for the colors.
MARGIN, HEAD, FOOT = 50, 90, 140

#: Points hide each other's sky within this share of the size of the actuator.
SKY_REACH = 0.12

#: This share of the surface is colored within the bar; stress at corners grows with every refinement.
PERCENTILE = 99.0


@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """What several pictures share, so that they can be compared: direction, scale and colors.

    Parameters
    ----------
    azimuth, elevation : float [rad]
        Direction of the eye: turned around z from looking along +y, raised above the horizon.
    left, right : float [m]
        Part of the picture plane that all pictures show, from side to side; top and bottom follow the actuator.
    limit : float [Pa]
        Von Mises stress at the upper end of the colors.
    width : int
        Width of the pictures in pixels.
    """

    azimuth: float = 20 * deg
    elevation: float = 18 * deg
    left: float
    right: float
    limit: float
    width: int = 1600

    @property
    def eye(self) -> Camera:
        """The camera."""
        return camera(self.azimuth, self.elevation)

    @property
    def pixel(self) -> float:
        """Length that a pixel shows [m]."""
        return (self.right - self.left) / (self.width - 2 * MARGIN)


def shared_view(states: Sequence[State | StateFields], width: int = 1600) -> View:
    """Choose a view that shows all states whole, at the same scale and with the same colors.

    Parameters
    ----------
    states : sequence of State or StateFields
        What will be shown; usually the undeformed and the last state.
    width : int
        Width of the pictures in pixels, 400 or more.
    """
    if width < 400:
        raise TurgorError(f"picture width is {width} pixels; allowed is 400 or more.")
    if not states:
        raise TurgorError("a view needs at least one state to show.")
    plain = View(left=0.0, right=1.0, limit=1.0)
    left, right, height, limit = np.inf, -np.inf, 0.0, 0.0
    for state in states:
        at = _fields(state)
        skin = visible_skin(at, at.von_mises)
        across, upward, _ = plain.eye.project(skin.points).T
        left, right = min(left, float(across.min())), max(right, float(across.max()))
        height = max(height, float(np.ptp(upward)))
        limit = max(limit, _surface_percentile(skin, PERCENTILE))
    right = max(right, left + height)  # no picture gets taller than it is wide
    return View(left=left, right=right, limit=limit if limit > 0 else 1 * kPa, width=width)


def write_picture(
    path: str | Path,
    state: State | StateFields,
    view: View | None = None,
    *,
    title: str = "",
    ghost: State | StateFields | None = None,
) -> None:
    """Draw a state of the whole actuator at true scale, colored by von Mises stress.

    Parameters
    ----------
    path : str or Path
        PNG file to write.
    state : State or StateFields
        What to draw; a half or quarter model is mirrored.
    view : View
        Direction, scale and colors; made for this state (and the ghost) if it is not given.
    title : str
        Line above the actuator, see `picture_title`.
    ghost : State or StateFields
        A state whose outline is drawn behind it, usually the undeformed one.
    """
    at = _fields(state)
    shown = [at] if ghost is None else [at, _fields(ghost)]
    view = view or shared_view(shown)
    skins = [visible_skin(each, each.von_mises) for each in shown]
    figure = _compose(render(skins, view, threads=drawn_threads(at)), view, title)
    figure.savefig(path, metadata={"Software": None})


def picture_title(response: Response, row: int = -1, name: str = "") -> str:
    """Title of a picture from a row of the response: name, pressure and bending angle where they are known.

    Examples
    --------
    >>> from turgor.response import Column
    >>> from turgor.source import Source
    >>> columns = (Column("pressure", "kPa", [0, 50e3]), Column("bending_angle", "deg", [0, 1.5]))
    >>> picture_title(Response(columns=columns, source=Source(text="a ruler")), name="finger")
    'finger · 50 kPa · bending angle 85.9°'
    """
    parts = [name] if name else []
    pressures = [f"{face_of(column)} {column.values[row] / kPa:.4g} kPa".strip() for column in pressures_in(response)]
    if pressures:
        parts.append(", ".join(pressures))
    elif "load_factor" in response.names:
        parts.append(f"load factor {response.column('load_factor')[row]:.4g}")
    if "bending_angle" in response.names:
        parts.append(f"bending angle {response.column('bending_angle')[row] / deg:.1f}°")
    return " · ".join(parts)


def _fields(state: State | StateFields) -> StateFields:
    return state if isinstance(state, StateFields) else StateFields(state)


def _surface_percentile(skin: Skin, percent: float) -> float:
    """Value below which this share of the surface lies."""
    values = skin.values[skin.triangles].mean(axis=1)
    order = np.argsort(values)
    share = np.cumsum(skin.areas[order])
    return float(values[order][np.searchsorted(share, share[-1] * percent / 100)])


def _color_map() -> Colormap:
    """Matplotlib's perceptual ``magma``, light to dark without its ends; it begins with the gray of rubber at rest."""
    place = np.linspace(0, 1, 256)
    colors = matplotlib.colormaps["magma_r"](0.02 + 0.75 * place)
    share = np.clip(place / 0.3, 0, 1)[:, None]
    return LinearSegmentedColormap.from_list("stress", (1 - share) * to_rgba(RUBBER) + share * colors)


def render(
    skins: list[Skin], view: View, colors: Colormap | None = None, threads: Sequence[Array] = ()
) -> NDArray[np.uint8]:
    """Image of the first skin, with threads (k, 3) on it and the lines of the others behind it, (h, w, 3)."""
    heights = np.concatenate([view.eye.project(skin.points)[:, 1] for skin in skins])
    rows = int(np.ceil(np.ptp(heights) / view.pixel)) + MARGIN
    raster = Raster(
        left=view.left - MARGIN * view.pixel, top=float(heights.max() + heights.min() + rows * view.pixel) / 2,
        step=view.pixel / SAMPLES, rows=rows * SAMPLES, columns=view.width * SAMPLES,
    )  # fmt: skip
    scenes = [Scene(skin, view.eye) for skin in skins]
    near = [scene.near(raster) for scene in scenes]
    sky = scenes[0].openness(SKY_REACH * float(np.ptp(skins[0].points, axis=0).max()))
    look = Look(colors=colors or _color_map(), limit=view.limit, openness=sky)
    image = np.empty((rows, view.width, 3), dtype=np.uint8)
    for start in range(0, rows, BAND):  # in bands, so that memory stays small; lines need the rows next to a band
        first, last = max(start - 2, 0), min(start + BAND + 2, rows)
        samples = slice(first * SAMPLES, last * SAMPLES)
        band = raster.band(samples.start, samples.stop)
        hits = [scene.look(band, where[samples]) for scene, where in zip(scenes, near, strict=True)]
        fine = _draw(scenes, hits, look)
        draw_threads(fine, visible_threads(scenes[0], hits[0], band, threads), 1.6 * SAMPLES)
        drawn = reduced(fine, SAMPLES)
        image[start : start + BAND] = drawn[start - first : start - first + BAND]
    return image


def _draw(scenes: list[Scene], hits: list[Hits], look: Look) -> NDArray[np.uint8]:
    """Paint the first skin, and lines: its own, and those of the others where it does not hide them."""
    front = scenes[0]
    image = paint(front.skin, hits[0], front.eye, look)
    free = hits[0].triangle < 0
    for scene, seen in zip(scenes[1:], hits[1:], strict=True):
        outline, inner = find_lines(scene.skin, seen)
        draw_lines(image, (outline & free, inner & free), GHOST, 0.8 * SAMPLES)
    draw_lines(image, find_lines(front.skin, hits[0]), INK, 0.9 * SAMPLES)
    return image


def _compose(picture: NDArray[np.uint8], view: View, title: str) -> Figure:
    """Put picture, title, colors and axes on one page, pixel by pixel."""
    width, height = picture.shape[1], picture.shape[0] + HEAD + FOOT
    figure = Figure(figsize=(width / 100, height / 100), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    figure.figimage(picture, 0, FOOT)
    figure.text(MARGIN / width, 1 - 0.5 * HEAD / height, title, fontsize=24, va="center", color=_hex(INK))
    bar = figure.add_axes((MARGIN / width, 62 / height, 0.42, 22 / height))
    colors = ScalarMappable(Normalize(0, view.limit / kPa), _color_map())
    colorbar = figure.colorbar(colors, cax=bar, orientation="horizontal", extend="max", extendfrac=0.03)
    colorbar.outline.set_visible(False)
    bar.tick_params(labelsize=16, colors=_hex(INK), length=5)
    note = f"von Mises stress [kPa]; {PERCENTILE:g} % of the surface lie within the bar"
    figure.text(MARGIN / width, 92 / height, note, fontsize=16, va="bottom", color=_hex(INK))
    draw_axes(figure, view)
    return figure


def draw_axes(figure: Figure, view: View) -> None:
    """Draw x, y and z as they are seen, each as long as a round length at the scale of the picture."""
    width, height = figure.get_size_inches() * 100
    length = _round_length(72 * view.pixel)
    corner = np.array([width - MARGIN - 1.35 * length / view.pixel, 46.0])
    directions = view.eye.project(np.eye(3))[:, :2]
    for name, direction in zip("xyz", directions, strict=True):
        end = corner + direction * length / view.pixel
        line = Line2D([corner[0], end[0]], [corner[1], end[1]], color=_hex(INK), lw=2, solid_capstyle="round")
        line.set_transform(IdentityTransform())
        figure.add_artist(line)
        x, y = (end + direction / np.linalg.norm(direction) * 14) / [width, height]
        figure.text(x, y, name, fontsize=15, ha="center", va="center", color=_hex(INK))
    label = f"each axis {length / mm:g} mm"
    figure.text(corner[0] / width, 12 / height, label, fontsize=14, va="center", ha="center", color=_hex(INK))


def _round_length(about: float) -> float:
    """The largest of 1, 2, 5, 10 … mm that is not above a length."""
    power = 10.0 ** np.floor(np.log10(about / mm))
    return float(max(step * power for step in (1, 2, 5) if step * power <= about / mm)) * mm


def _hex(color: tuple[int, int, int]) -> str:
    return "#{:02x}{:02x}{:02x}".format(*color)
