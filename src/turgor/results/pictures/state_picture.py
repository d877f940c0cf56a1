"""Pictures of states: the whole actuator at true scale, colored by von Mises stress or contact pressure, as PNG."""

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.image import imsave
from matplotlib.lines import Line2D
from matplotlib.transforms import IdentityTransform
from numpy.typing import NDArray

from turgor.engine.percentiles import PERCENTILE, volume_percentile, weighted_percentile
from turgor.errors import TurgorError, unknown
from turgor.response import Response
from turgor.results.drive import face_of, pressures_in
from turgor.results.fields.contact import extents_of
from turgor.results.fields.fibers import drawn_threads
from turgor.results.fields.state_fields import StateFields
from turgor.results.pictures.colors import CONTACT_PRESSURE, FIELDS, VON_MISES, color_map, plain_rubber
from turgor.results.pictures.contact_patches import pressed
from turgor.results.pictures.obstacle_skin import obstacle_skin
from turgor.results.pictures.rendering import ASIDE, FRONT, MARGIN, Beside, View, frame, render
from turgor.results.pictures.shading import INK
from turgor.results.pictures.skin import Skin, visible_skin
from turgor.results.plots.figures import check_ending, write_figure
from turgor.solvers.solution import State
from turgor.units import deg, kPa, mm

Array = NDArray[np.float64]

#: Pixels above the actuator for the title, and below it for the color bar, in a picture of full width [pixels].
HEAD, FOOT = 90, 140
FULL_WIDTH = 1600

#: Smallest scale of letters in narrow pictures.
SMALLEST_SCALE = 0.45


def shared_view(states: Sequence[State | StateFields], width: int = 1600, color_by: str = VON_MISES) -> View:
    """Choose a view that shows all states completely, at the same scale and with the same colors.

    The color bar ends at the largest `von_mises_p99` of the states (99 % of the volume have a smaller stress), or at
    the 99th percentile of the contact pressure over the contact area. Larger values have the last color.

    Parameters
    ----------
    states : sequence of State or StateFields
        States of the pictures, usually the undeformed and the last one.
    width : int
        Width of the pictures in pixels, 400 or more.
    color_by : str
        ``"von_mises"`` or ``"contact_pressure"``.
    """
    if width < 400:
        raise TurgorError(f"picture width is {width} pixels; allowed is 400 or more.")
    if color_by not in FIELDS:
        raise unknown("field to color pictures by", color_by, FIELDS)
    if not states:
        raise TurgorError("a view needs at least one state to show.")
    shown = [_fields(state) for state in states]
    extents = extents_of(shown)
    touching = color_by == CONTACT_PRESSURE
    azimuth = ASIDE if touching else FRONT
    plain = View(azimuth=azimuth, left=0.0, right=1.0, limit=1.0)
    low, high, limit = np.full(2, np.inf), np.full(2, -np.inf), 0.0
    for at in shown:
        skin = visible_skin(at, getattr(at, color_by))
        least, greatest = frame([skin], obstacle_skin(at, extents), plain.eye)
        low, high = np.minimum(low, least), np.maximum(high, greatest)
        limit = max(limit, _pressed(skin) if touching else volume_percentile(at.cells, at.cells.von_mises))
    left, right = float(low[0]), float(max(high[0], low[0] + high[1] - low[1]))  # no picture is taller than it is wide
    return View(
        azimuth=azimuth, left=left, right=right, limit=limit if limit > 0 else 1 * kPa, width=width, color_by=color_by,
        extents=extents,
    )  # fmt: skip


def write_picture(
    path: str | Path,
    state: State | StateFields,
    view: View | None = None,
    *,
    title: str = "",
    ghost: State | StateFields | None = None,
) -> None:
    """Draw a state of the whole actuator as `state_figure` does, and write it.

    Parameters
    ----------
    path : str or Path
        PNG file to write.
    state, view, title, ghost
        See `state_figure`.
    """
    check_ending(path, "picture")
    write_figure(path, state_figure(state, view, title=title, ghost=ghost), kind="picture")


def state_figure(
    state: State | StateFields,
    view: View | None = None,
    *,
    title: str = "",
    ghost: State | StateFields | None = None,
) -> Figure:
    """Draw a state of the whole actuator at true scale, colored by von Mises stress or by contact pressure.

    Obstacles are drawn as translucent gray bodies.

    Parameters
    ----------
    state : State or StateFields
        What to draw; a half or quarter model is mirrored.
    view : View
        Direction, scale and colors; by default a view of this state and the ghost. A view made by
        ``shared_view(states, color_by="contact_pressure")`` gives a picture of the contact pressure.
    title : str
        Line above the actuator, see `picture_title`.
    ghost : State or StateFields
        State whose outline is drawn behind the actuator, usually the undeformed one.

    Returns
    -------
    matplotlib.figure.Figure
    """
    shown = [_fields(state)] if ghost is None else [_fields(state), _fields(ghost)]
    view = view or shared_view(shown)
    return _compose(_rendered(shown, view), view, title)


def bare_picture(state: State | StateFields, view: View) -> bytes:
    """Draw a state as `state_figure` does, but the actuator alone, without title, color bar and axes.

    Parameters
    ----------
    state : State or StateFields
        What to draw.
    view : View
        Direction, scale and colors, see `shared_view`.

    Returns
    -------
    bytes
        A PNG file.
    """
    stream = BytesIO()
    imsave(stream, _rendered([_fields(state)], view), format="png")
    return stream.getvalue()


def _rendered(shown: Sequence[StateFields], view: View) -> NDArray[np.uint8]:
    """Image of the first of some states, with the outlines of the others."""
    at = shown[0]
    extents = view.extents or extents_of(shown)
    touching = view.color_by == CONTACT_PRESSURE
    skins = [visible_skin(each, np.zeros(len(each.points)) if touching else each.von_mises) for each in shown]
    beside = Beside(
        threads=drawn_threads(at),
        obstacles=obstacle_skin(at, extents),
        patches=pressed(visible_skin(at, at.contact_pressure), view.limit, view.eye) if touching else (),
    )
    colors = plain_rubber() if touching else None
    return render(skins, view, colors, beside)


def picture_title(response: Response, row: int = -1, name: str = "") -> str:
    """Return the title of a picture from a row of the response: name, stage, pressure and bending angle if known.

    Examples
    --------
    >>> from turgor.response import Column
    >>> from turgor.source import Source
    >>> columns = (Column("pressure", "kPa", [0, 50e3]), Column("bending_angle", "deg", [0, 1.5]))
    >>> picture_title(Response(columns=columns, source=Source(text="a ruler")), name="finger")
    'finger · 50 kPa · bending angle 85.9°'
    """
    parts = [name] if name else []
    if response.stages and row not in (0, -len(response)):
        parts.append(response.stages[row])
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


def _pressed(skin: Skin) -> float:
    """99th percentile of the contact pressure over the contact area; zero without contact."""
    values = skin.values[skin.triangles].mean(axis=1)
    on = values > 0
    return weighted_percentile(values[on], skin.areas[on]) if on.any() else 0.0


def _compose(picture: NDArray[np.uint8], view: View, title: str) -> Figure:
    """Figure with picture, title, color bar and axes, pixel by pixel."""
    colors = ScalarMappable(Normalize(0, view.limit / kPa), color_map(view.color_by))
    note = FIELDS[view.color_by].format(share=f"{PERCENTILE} %")
    return framed(picture, view, (title, note), colors)


def framed(picture: NDArray[np.uint8], view: View, texts: tuple[str, str], colors: ScalarMappable) -> Figure:
    """Put an image of the actuator between its title, its color bar and the axes.

    Parameters
    ----------
    picture : (h, w, 3) array
        The image.
    view : View
        View of the picture; letters are smaller in narrow pictures.
    texts : (str, str)
        Title, and what the colors mean.
    colors : ScalarMappable
        The colors and their range.

    Returns
    -------
    matplotlib.figure.Figure
    """
    scale = scale_of(view.width)
    head, foot = bands(view.width)
    width, height = picture.shape[1], picture.shape[0] + head + foot
    figure = Figure(figsize=(width / 100, height / 100), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    figure.figimage(picture, 0, foot)
    title, note = texts
    figure.text(MARGIN / width, 1 - 0.5 * head / height, title, fontsize=24 * scale, va="center", color=_hex(INK))
    bar = figure.add_axes((MARGIN / width, 62 * scale / height, 0.42, 22 * scale / height))
    colorbar = figure.colorbar(colors, cax=bar, orientation="horizontal", extend="max", extendfrac=0.03)
    colorbar.outline.set_visible(False)
    bar.tick_params(labelsize=16 * scale, colors=_hex(INK), length=5 * scale)
    figure.text(MARGIN / width, 92 * scale / height, note, fontsize=16 * scale, va="bottom", color=_hex(INK))
    draw_axes(figure, view)
    return figure


def scale_of(width: int) -> float:
    """Scale of the letters of a picture of some width [pixels]: 1 at full width, less in narrow pictures."""
    return float(np.clip(width / FULL_WIDTH, SMALLEST_SCALE, 1.0))


def bands(width: int) -> tuple[int, int]:
    """Heights of the bands above and below the actuator in a picture of some width [pixels]."""
    return round(HEAD * scale_of(width)), round(FOOT * scale_of(width))


def draw_axes(figure: Figure, view: View) -> None:
    """Draw the axes x, y and z in the view, each with a round length at the scale of the picture."""
    width, height = figure.get_size_inches() * 100
    scale = scale_of(view.width)
    length = _round_length(72 * scale * view.pixel)
    corner = np.array([width - MARGIN - 1.35 * length / view.pixel, 46.0 * scale])
    directions = view.eye.project(np.eye(3))[:, :2]
    for name, direction in zip("xyz", directions, strict=True):
        end = corner + direction * length / view.pixel
        line = Line2D([corner[0], end[0]], [corner[1], end[1]], color=_hex(INK), lw=2 * scale, solid_capstyle="round")
        line.set_transform(IdentityTransform())
        figure.add_artist(line)
        x, y = (end + direction / np.linalg.norm(direction) * 14 * scale) / [width, height]
        figure.text(x, y, name, fontsize=15 * scale, ha="center", va="center", color=_hex(INK))
    label = f"each axis {length / mm:g} mm"
    x, y = corner[0] / width, 12 * scale / height
    figure.text(x, y, label, fontsize=14 * scale, va="center", ha="center", color=_hex(INK))


def _round_length(about: float) -> float:
    """Largest of 1, 2, 5, 10 … mm that does not exceed a length."""
    power = 10.0 ** np.floor(np.log10(about / mm))
    return float(max(step * power for step in (1, 2, 5) if step * power <= about / mm)) * mm


def _hex(color: tuple[int, int, int]) -> str:
    return "#{:02x}{:02x}{:02x}".format(*color)
