"""Rendering of a view: the skin of an actuator with threads, obstacles and contact patches."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from matplotlib.colors import Colormap
from numpy.typing import NDArray

from turgor.foundation.display import brief
from turgor.units import deg
from turgor.views.pictures.colors import (
    CONTACT_PRESSURE,
    DIVERGING,
    FIBER_TENSION,
    VON_MISES,
    Field,
    color_map,
    field_of,
    plain_rubber,
)
from turgor.views.pictures.overlays.contact_patches import draw_patches, laid_over, visible_values
from turgor.views.pictures.overlays.fiber_lines import Thread, draw_threads, visible_threads
from turgor.views.pictures.overlays.obstacle_skin import draw_obstacles
from turgor.views.pictures.raycast import Camera, Hits, Raster, Scene, camera
from turgor.views.pictures.settings import FRAMING, LOOK, RENDERING
from turgor.views.pictures.shading import (
    GHOST,
    INK,
    Bytes,
    Look,
    Mask,
    draw_lines,
    find_lines,
    paint,
    reduced,
)
from turgor.views.pictures.skin import Skin
from turgor.views.plots.settings import PLOT

Array = NDArray[np.float64]

#: Samples along each side of a pixel.
SAMPLES = RENDERING.samples


@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """Direction, scale and colors that several pictures share, so that they can be compared.

    Parameters
    ----------
    azimuth, elevation : float [rad]
        Direction of the camera: angle about z, zero for a view along +y, and angle above the horizon.
    left, right : float [m]
        Horizontal limits of all pictures; top and bottom follow the actuator.
    limit : float [SI]
        Value at the upper end of the colors.
    width : int
        Width of the pictures in pixels; less where the actuator is taller than wide.
    height : float [m]
        Height of the tallest picture; no picture is taller than ``width``.
    color_by : str or Field
        ``"von_mises"``, another one of `turgor.views.pictures.colors.FIELDS`, or ``"contact_pressure"``, which is
        visible through the actuator.
    extents : mapping of str to (2, 3) array [m]
        Smallest and largest coordinates of the actuator, and of faces that obstacles are meant for. Infinite obstacles
        end a little beyond these.
    """

    azimuth: float = FRAMING.front
    elevation: float = 18 * deg
    left: float
    right: float
    limit: float
    width: int = 1600
    height: float = 0.0
    color_by: str | Field = VON_MISES
    extents: Mapping[str, Array] = field(default_factory=dict, compare=False)

    __repr__ = brief

    @property
    def eye(self) -> Camera:
        """The camera."""
        return camera(self.azimuth, self.elevation)

    @property
    def pixel(self) -> float:
        """Side length of a pixel [m]."""
        return max(self.right - self.left, self.height) / (self.width - 2 * FRAMING.margin)

    @property
    def columns(self) -> int:
        """Width of every picture in pixels: as wide as what it shows, with a margin."""
        needed = round((self.right - self.left) / self.pixel) + 2 * FRAMING.margin
        return min(max(needed, round(FRAMING.narrowest * self.width)), self.width)

    @property
    def edge(self) -> float:
        """Horizontal coordinate of the left edge of every picture [m]."""
        return (self.left + self.right) / 2 - self.columns / 2 * self.pixel

    @property
    def field(self) -> Field:
        """The field that the colors show."""
        return field_of(self.color_by)

    @property
    def floor(self) -> float:
        """Value at the lower end of the colors [SI]."""
        shown = self.field
        return 2 * shown.floor - self.limit if shown.colors == DIVERGING else shown.floor


def frame(skins: Sequence[Skin], obstacles: Skin | None, eye: Camera) -> tuple[Array, Array]:
    """Return the lower left and upper right corner of a picture that shows all skins and the obstacles near them."""
    flat = np.concatenate([eye.project(skin.points)[:, :2] for skin in skins])
    low, high = flat.min(axis=0), flat.max(axis=0)
    if obstacles is not None:
        around = FRAMING.around * float((high - low).max())
        projected = eye.project(obstacles.points)[:, :2]
        low = np.minimum(low, np.maximum(projected.min(axis=0), low - around))
        high = np.maximum(high, np.minimum(projected.max(axis=0), high + around))
    return low, high


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Overlays:
    """Threads, obstacles and contact patches that a picture shows besides the actuator, and what is seen through it.

    Parameters
    ----------
    threads : sequence of ((k, 3) array [m], (k,) array)
        Points along each thread, and the value that its color shows.
    obstacles : Skin or None
        Gray bodies.
    patches : tuple of Skin
        Parts of the surface in contact, visible through the actuator; see
        `turgor.views.pictures.overlays.contact_patches`.
    inside : Skin or None
        Walls of cavities, visible through the actuator.
    edges : bool
        Whether the edges of cells are drawn on the actuator.
    """

    threads: Sequence[Thread] = ()
    obstacles: Skin | None = None
    patches: tuple[Skin, ...] = ()
    inside: Skin | None = None
    edges: bool = False


def render(
    skins: list[Skin], view: View, colors: Colormap | None = None, overlays: Overlays | None = None
) -> NDArray[np.uint8]:
    """Render a view as an image, (h, w, 3): the first skin, outlines of the others behind it, threads and obstacles.

    Parameters
    ----------
    skins : list of Skin
        The actuator, then the states whose outlines are drawn behind the actuator.
    view : View
        Direction, scale and colors.
    colors : Colormap, optional
        Colors of the first skin, which then mean no value; by default those of the field of the view.
    overlays : Overlays, optional
        Threads, obstacles and contact patches.
    """
    overlays = overlays or Overlays()
    low, high = frame(skins, overlays.obstacles, view.eye)
    rows = int(np.ceil((high[1] - low[1]) / view.pixel)) + FRAMING.margin
    raster = Raster(
        left=view.edge, top=float(high[1] + low[1] + rows * view.pixel) / 2,
        step=view.pixel / SAMPLES, rows=rows * SAMPLES, columns=view.columns * SAMPLES,
    )  # fmt: skip
    layers = _Layers(skins, view, colors, overlays)
    image = np.empty((rows, view.columns, 3), dtype=np.uint8)
    for start in range(0, rows, RENDERING.rows):  # rendered in bands to save memory; lines need the rows next to a band
        first, last = max(start - 2, 0), min(start + RENDERING.rows + 2, rows)
        drawn = reduced(layers.draw(raster.band(first * SAMPLES, last * SAMPLES)), SAMPLES)
        image[start : start + RENDERING.rows] = drawn[start - first : start - first + RENDERING.rows]
    return image


class _Layer(NamedTuple):
    """A skin in front of the camera, and its light."""

    scene: Scene
    look: Look | None = None


class _Layers:
    """All that a picture shows, in front of the camera of a view."""

    def __init__(self, skins: list[Skin], view: View, colors: Colormap | None, overlays: Overlays) -> None:
        reach = RENDERING.sky_reach * float(np.ptp(skins[0].points, axis=0).max())

        def layer(skin: Skin, lit: Colormap | None = None, shadow: float = LOOK.shadow) -> _Layer:
            scene = Scene(skin, view.eye)
            sky = None if lit is None else scene.openness(reach)
            look = None if lit is None or sky is None else Look(lit, view.limit, sky, view.floor, shadow)
            return _Layer(scene, look)

        self._view, self._overlays = view, overlays
        plain = colors or (plain_rubber() if overlays.inside is not None else None)
        self._front = layer(
            skins[0], plain or view.field.color_map(), LOOK.shadow if plain is None else LOOK.deep_shadow
        )
        self._ghosts = [layer(skin) for skin in skins[1:]]
        self._inside = None if overlays.inside is None else layer(overlays.inside, view.field.color_map())
        self._obstacles = None if overlays.obstacles is None else layer(overlays.obstacles)
        self._patches = [layer(skin) for skin in overlays.patches]
        side = skins[0].side
        self._cells = replace(skins[0], patch=side) if overlays.edges and side is not None else None

    def draw(self, band: Raster) -> Bytes:
        """Draw a band of the picture, (h, w, 3)."""
        front, hits = self._front.scene, self._front.scene.look(band)
        image, lines = self._painted(hits, band)
        free = hits.triangle < 0
        for scene, _ in self._ghosts:
            coarse = find_lines(scene.skin, scene.look(band.coarser(SAMPLES)))
            outline, inner = (mask.repeat(SAMPLES, axis=0).repeat(SAMPLES, axis=1) & free for mask in coarse)
            draw_lines(image, (outline, inner), GHOST, 0.0)  # one pixel wide already
        draw_lines(image, lines, INK, 0.9 * SAMPLES)
        tense = self._view.color_by == FIBER_TENSION
        threads = visible_threads(front, hits, band, self._overlays.threads)
        draw_threads(image, threads, (2.4 if tense else 1.6) * SAMPLES, self._of_tension if tense else None)
        distance = np.where(free, np.inf, front.distance(hits))
        if self._obstacles is not None:
            scene, obstacle = self._obstacles.scene, self._obstacles.scene.look(band)
            nearer = (obstacle.triangle >= 0) & (scene.distance(obstacle) < distance)
            draw_obstacles(image, scene.skin, obstacle, nearer, self._view.eye, 0.8 * SAMPLES)
        if self._patches:
            self._draw_patches(image, band, distance)
        return image

    def _painted(self, hits: Hits, band: Raster) -> tuple[Bytes, tuple[Mask, Mask]]:
        """The actuator, with what is seen through it, and its lines."""
        front, look = self._front.scene, self._front.look
        assert look is not None
        image, lines = paint(front.skin, hits, front.eye, look), find_lines(front.skin, hits)
        if self._cells is not None:
            draw_lines(image, (lines[0], find_lines(self._cells, hits)[1]), INK, 0.45 * SAMPLES, 0.45)
        if self._inside is None or self._inside.look is None:
            return image, lines
        scene, inside = self._inside.scene, self._inside.scene.look(band)
        within = paint(scene.skin, inside, scene.eye, self._inside.look)
        draw_lines(within, find_lines(scene.skin, inside), INK, 0.6 * SAMPLES, 0.5)
        veil = np.where(hits.triangle >= 0, np.where(inside.triangle >= 0, PLOT.pale, 1.0), 0.0)[..., None]
        return (within * (1 - veil) + image * veil + 0.5).astype(np.uint8), lines

    def _of_tension(self, values: Array) -> Array:
        return np.asarray(self._view.field.color_map()(0.15 + 0.85 * values / self._view.limit)[:, :3] * 255)

    def _draw_patches(self, image: Bytes, band: Raster, distance: Array) -> None:
        """Blend patches into a band; ``distance`` (h, w) [m] is that of the actuator, infinite where there is none."""
        value, place = np.zeros(distance.shape), np.full(distance.shape, np.inf)
        size = self._patches[0].scene.size
        for scene, _ in self._patches:
            hits = scene.look(band)
            inner = visible_values(scene.skin, hits, self._view.limit)
            value, place = laid_over((value, place), (inner, scene.distance(hits)), RENDERING.depth_jump * size)
        behind = place > distance + RENDERING.depth_jump * size
        draw_patches(image, value, behind, color_map(CONTACT_PRESSURE), self._view.limit)
