"""Marks in pictures: triangles at supports, zigzags for springs, arrows for what pulls or is moved, and levels."""

from collections.abc import Iterable, Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.patheffects import withStroke
from matplotlib.transforms import IdentityTransform
from numpy.typing import NDArray

from turgor.core.results.fields.state_fields import StateFields
from turgor.views.pictures.framing import bands, scale_of
from turgor.views.pictures.marks.listing import FIXED, FORCE, LEVEL, MOMENT, MOVED, ROLLER, SPRING, Mark
from turgor.views.pictures.overlays.obstacle_skin import obstacle_skin
from turgor.views.pictures.raycast import Raster, Scene
from turgor.views.pictures.rendering import View, frame
from turgor.views.pictures.settings import FRAMING, MARKS, RENDERING
from turgor.views.pictures.skin import visible_skin
from turgor.views.plots.styling import INK

Array = NDArray[np.float64]
#: A line through points (k, 2), and whether it is closed, and filled.
Line = tuple[Array, bool, bool]

#: Half a width and a depth of each line of a level, in sizes of a triangle.
LEVEL_LINES = ((1.5, 0.0), (0.9, 0.35), (0.4, 0.7))
#: Color of each kind of mark; supports are green, what moves or pulls is warm.
COLORS = {
    FIXED: "#147a5a", ROLLER: "#147a5a", SPRING: "#147a5a", MOVED: "#7d3cb5", FORCE: "#cc2f2f", MOMENT: "#cc2f2f",
    LEVEL: "#1f6fb4",
}  # fmt: skip


def draw_marks(figure: Figure, at: StateFields, view: View, marks: Sequence[Mark]) -> None:
    """Draw marks into a picture of a state at rest, paler behind the actuator, and a legend of their kinds.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        What `turgor.views.pictures.state_picture.state_figure` returned; changed.
    at : StateFields
        The state of the picture.
    view : View
        Its view.
    marks : sequence of Mark
    """
    if not marks:
        return
    width, height = (round(float(side) * 100) for side in figure.get_size_inches())
    scale, (head, foot) = scale_of(width), bands(width)
    skin, rows = visible_skin(at, np.zeros(len(at.points))), height - head - foot
    low, high = frame([skin], obstacle_skin(at, view.extents), view.eye)
    raster = Raster(
        left=view.edge, top=float(low[1] + high[1] + rows * view.pixel) / 2, step=view.pixel, rows=rows, columns=width
    )
    middle = (skin.points.min(axis=0) + skin.points.max(axis=0)) / 2
    places = np.stack([mark.place for mark in marks])
    flat = (view.eye.project(places)[:, :2] - [raster.left, raster.top]) / view.pixel + [0, foot + rows]
    for mark, place, behind in zip(marks, flat, _hidden(Scene(skin, view.eye), raster, places), strict=True):
        outwards = float(mark.direction @ (mark.place - middle)) >= 0
        shown = glyph(mark.kind, place, view.eye.project(mark.direction)[:2], outwards, scale)
        _draw(figure, mark.kind, shown, scale, MARKS.hidden if behind else 1.0)
    _draw_legend(figure, tuple(dict.fromkeys(mark.kind for mark in marks)), scale)


def _hidden(scene: Scene, raster: Raster, places: Array) -> NDArray[np.bool_]:
    """Whether the actuator lies in front of each of some places."""
    hits = scene.look(raster)
    across, upward, _ = scene.eye.project(places).T
    column = np.clip(((across - raster.left) / raster.step).astype(np.int64), 0, raster.columns - 1)
    row = np.clip(((raster.top - upward) / raster.step).astype(np.int64), 0, raster.rows - 1)
    nearer = scene.depth(places) > hits.depth[row, column] + RENDERING.depth_jump * scene.size
    return np.asarray((hits.triangle[row, column] >= 0) & nearer)


def _draw_legend(figure: Figure, kinds: Sequence[str], scale: float) -> None:
    """A line of the kinds of marks above the color bar."""
    width, height = figure.get_size_inches() * 100
    level = 132 * scale
    for number, kind in enumerate(kinds):
        left = FRAMING.margin + number * 140 * scale
        stands = kind in (FIXED, ROLLER)  # its tip is above
        begin = np.array([left, level]) + stands * MARKS.size * scale * np.array([1.4, 0.5])
        direction = {LEVEL: np.array([0.0, 1.0])}.get(kind, np.array([0.0, -1.0]) if stands else np.array([1.0, 0.0]))
        if kind == LEVEL:
            begin = begin + MARKS.size * scale * np.array([1.4, -0.1])
        _draw(figure, kind, glyph(kind, begin, direction, True, scale), scale, 1.0)
        x = (left + (MARKS.arrow + 14) * scale) / width
        figure.text(x, level / height, kind, fontsize=14 * scale, va="center", color=INK)


def _draw(figure: Figure, kind: str, lines: Iterable[Line], scale: float, opacity: float) -> None:
    for points, closed, filled in lines:
        line = Polygon(points, closed=closed, fill=closed, lw=2 * scale, ec=COLORS[kind], joinstyle="round")
        line.set_facecolor(COLORS[kind] if filled else "white")
        line.set_transform(IdentityTransform())
        line.set_alpha(opacity)
        if opacity == 1:
            line.set_path_effects([withStroke(linewidth=4.5 * scale, foreground="white")])
        figure.add_artist(line)


def glyph(kind: str, place: Array, direction: Array, outwards: bool, scale: float) -> list[Line]:
    """Return the lines of a mark, in pixels.

    Parameters
    ----------
    kind : str
        Kind of the mark.
    place : (2,) array
        Where the tip of a triangle is, where a spring begins, and where an arrow begins or ends.
    direction : (2,) array
        Its direction, at most one long.
    outwards : bool
        Whether it points away from the actuator. A support is drawn on this side, and no arrow crosses the actuator.
    scale : float
        Size of the mark.
    """
    if kind == FIXED:
        return [(_triangle(place, np.array([0.0, -MARKS.size * scale])), True, True)]
    length = float(np.linalg.norm(direction))
    if kind == LEVEL:
        return [] if length < MARKS.head_on else _level(place, direction / length * MARKS.size * scale)
    if length < MARKS.head_on:
        turn = np.linspace(0, 2 * np.pi, 24)[:, None]
        circle = np.concatenate([np.cos(turn), np.sin(turn)], axis=1) * MARKS.size / 2 * scale
        return [(place + circle, True, False), (place + 0.35 * circle, True, True)]
    along = direction / length
    side = along if outwards else -along
    if kind == ROLLER:
        return _roller(place, side * MARKS.size * scale)
    if kind == SPRING:
        return [(_zigzag(place, side * MARKS.arrow * scale), False, False)]
    reach = along * MARKS.arrow * scale * max(length, MARKS.shortest)
    begin = place if kind == MOVED or outwards else place - reach
    return _arrow(begin, reach, scale, heads=2 if kind == MOMENT else 1, filled=kind != MOVED)


def _across(along: Array) -> Array:
    return np.array([-along[1], along[0]])


def _triangle(apex: Array, height: Array) -> Array:
    return np.array([apex, apex + height + 0.6 * _across(height), apex + height - 0.6 * _across(height)])


def _roller(apex: Array, height: Array) -> list[Line]:
    """A hollow triangle on a line along which it rolls."""
    ends = apex + 1.35 * height + np.outer([-0.7, 0.7], _across(height))
    return [(_triangle(apex, height), True, False), (ends, False, False)]


def _level(place: Array, up: Array) -> list[Line]:
    """A hollow triangle that stands on the surface of a liquid, and shorter lines below."""
    lines = [place - drop * up + np.outer([-half, half], _across(up)) for half, drop in LEVEL_LINES]
    return [(_triangle(place, up), True, False), *((line, False, False) for line in lines)]


def _zigzag(begin: Array, reach: Array) -> Array:
    share = np.array([0, 0.15, 0.25, 0.4, 0.55, 0.7, 0.85, 1.0, 1.0, 1.0])
    swing = np.array([0, 0, 1, -1, 1, -1, 0, 0, 1.3, -1.3]) * 0.18
    return begin + np.outer(share, reach) + np.outer(swing, _across(reach))


def _arrow(begin: Array, reach: Array, scale: float, *, heads: int, filled: bool) -> list[Line]:
    back = -reach / np.linalg.norm(reach) * MARKS.size * 0.8 * scale
    end = begin + reach
    tips = [end + number * 0.8 * back for number in range(heads)]
    return [(np.array([begin, end + back]), False, False), *((_triangle(tip, back), True, filled) for tip in tips)]
