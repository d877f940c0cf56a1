"""Rendering of a view: the skin of an actuator with threads, obstacles and contact patches."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from matplotlib.colors import Colormap
from numpy.typing import NDArray

from turgor.results.pictures.colors import CONTACT_PRESSURE, VON_MISES, color_map
from turgor.results.pictures.contact_patches import draw_patches, laid_over, values_seen
from turgor.results.pictures.fiber_lines import draw_threads, visible_threads
from turgor.results.pictures.obstacle_skin import draw_obstacles
from turgor.results.pictures.raycast import Camera, Hits, Raster, Scene, camera
from turgor.results.pictures.shading import DEPTH_JUMP, GHOST, INK, Look, draw_lines, find_lines, paint, reduced
from turgor.results.pictures.skin import Skin
from turgor.shown import brief
from turgor.units import deg

Array = NDArray[np.float64]

#: Samples along each side of a pixel (supersampling).
SAMPLES = 2

#: Rows of pixels that are rendered together.
BAND = 96

#: Azimuth of the camera, and azimuth for contact pressure: the walls between chambers are visible more from the side.
FRONT, ASIDE = 20 * deg, 40 * deg

#: Margin around the actuator in pixels.
MARGIN = 50

#: Walls closer to each other than this share of the size of the actuator count as touching in pictures.
THIN = 0.02

#: Reach of the ambient occlusion, as a share of the size of the actuator.
SKY_REACH = 0.12

#: Margin around the actuator in which obstacles are shown, as a share of its size.
AROUND = 0.3


@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """Direction, scale and colors that several pictures share, so that they can be compared.

    Parameters
    ----------
    azimuth, elevation : float [rad]
        Direction of the camera: angle about z, zero for a view along +y, and angle above the horizon.
    left, right : float [m]
        Horizontal limits of all pictures; top and bottom follow the actuator.
    limit : float [Pa]
        Value at the upper end of the colors.
    width : int
        Width of the pictures in pixels.
    color_by : str
        ``"von_mises"``, or ``"contact_pressure"``, which is visible through the actuator.
    extents : mapping of str to (2, 3) array [m]
        Smallest and largest coordinates of the actuator, and of faces that obstacles are meant for. Infinite obstacles
        end a little beyond these.
    """

    azimuth: float = FRONT
    elevation: float = 18 * deg
    left: float
    right: float
    limit: float
    width: int = 1600
    color_by: str = VON_MISES
    extents: Mapping[str, Array] = field(default_factory=dict, compare=False)

    __repr__ = brief

    @property
    def eye(self) -> Camera:
        """The camera."""
        return camera(self.azimuth, self.elevation)

    @property
    def pixel(self) -> float:
        """Side length of a pixel [m]."""
        return (self.right - self.left) / (self.width - 2 * MARGIN)


def frame(skins: Sequence[Skin], obstacles: Skin | None, eye: Camera) -> tuple[Array, Array]:
    """Return the lower left and upper right corner of a picture that shows all skins and the obstacles near them."""
    flat = np.concatenate([eye.project(skin.points)[:, :2] for skin in skins])
    low, high = flat.min(axis=0), flat.max(axis=0)
    if obstacles is not None:
        around = AROUND * float((high - low).max())
        beside = eye.project(obstacles.points)[:, :2]
        low = np.minimum(low, np.maximum(beside.min(axis=0), low - around))
        high = np.maximum(high, np.minimum(beside.max(axis=0), high + around))
    return low, high


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Beside:
    """Threads, obstacles and contact patches that a picture shows besides the actuator.

    Parameters
    ----------
    threads : sequence of (k, 3) arrays [m]
        Points along each thread.
    obstacles : Skin or None
        Gray bodies.
    patches : tuple of Skin
        Parts of the surface in contact, visible through the actuator; see
        `turgor.results.pictures.contact_patches`.
    """

    threads: Sequence[Array] = ()
    obstacles: Skin | None = None
    patches: tuple[Skin, ...] = ()


def render(
    skins: list[Skin], view: View, colors: Colormap | None = None, beside: Beside | None = None
) -> NDArray[np.uint8]:
    """Render a view as an image, (h, w, 3): the first skin, outlines of the others behind it, threads and obstacles.

    Parameters
    ----------
    skins : list of Skin
        The actuator, then the states whose outlines are drawn behind the actuator.
    view : View
        Direction, scale and colors.
    colors : Colormap, optional
        Colors of the first skin; by default the colors of the field of the view.
    beside : Beside, optional
        Threads, obstacles and contact patches.
    """
    beside = beside or Beside()
    low, high = frame(skins, beside.obstacles, view.eye)
    rows = int(np.ceil((high[1] - low[1]) / view.pixel)) + MARGIN
    raster = Raster(
        left=view.left - MARGIN * view.pixel, top=float(high[1] + low[1] + rows * view.pixel) / 2,
        step=view.pixel / SAMPLES, rows=rows * SAMPLES, columns=view.width * SAMPLES,
    )  # fmt: skip
    scenes, others = [Scene(skin, view.eye) for skin in skins], _Others(beside, view, raster)
    near = [scene.near(raster) for scene in scenes]
    sky = scenes[0].openness(SKY_REACH * float(np.ptp(skins[0].points, axis=0).max()))
    look = Look(colors=colors or color_map(view.color_by), limit=view.limit, openness=sky)
    image = np.empty((rows, view.width, 3), dtype=np.uint8)
    for start in range(0, rows, BAND):  # rendered in bands to save memory; lines need the rows next to a band
        first, last = max(start - 2, 0), min(start + BAND + 2, rows)
        samples = slice(first * SAMPLES, last * SAMPLES)
        band = raster.band(samples.start, samples.stop)
        hits = [scene.look(band, where[samples]) for scene, where in zip(scenes, near, strict=True)]
        fine = _draw(scenes, hits, look)
        draw_threads(fine, visible_threads(scenes[0], hits[0], band, beside.threads), 1.6 * SAMPLES)
        others.draw(fine, band, samples, np.where(hits[0].triangle < 0, np.inf, scenes[0].distance(hits[0])))
        drawn = reduced(fine, SAMPLES)
        image[start : start + BAND] = drawn[start - first : start - first + BAND]
    return image


class _Others:
    """Obstacles and patches in front of the camera of a view."""

    def __init__(self, beside: Beside, view: View, raster: Raster) -> None:
        def scene(skin: Skin) -> tuple[Scene, NDArray[np.bool_]]:
            made = Scene(skin, view.eye)
            return made, made.near(raster)

        self._view = view
        self._obstacles = None if beside.obstacles is None else scene(beside.obstacles)
        self._patches = [scene(skin) for skin in beside.patches]

    def draw(self, image: NDArray[np.uint8], band: Raster, rows: slice, distance: Array) -> None:
        """Blend obstacles and patches into a band of the image.

        ``distance`` is the position of the actuator along the view, (h, w) [m], infinite where there is no actuator.
        """
        if self._obstacles is not None:
            scene, near = self._obstacles
            hits = scene.look(band, near[rows])
            nearer = (hits.triangle >= 0) & (scene.distance(hits) < distance)
            draw_obstacles(image, scene.skin, hits, nearer, self._view.eye, 0.8 * SAMPLES)
        if not self._patches:
            return
        value, place, size = np.zeros(distance.shape), np.full(distance.shape, np.inf), self._patches[0][0].size
        for scene, near in self._patches:
            hits = scene.look(band, near[rows])
            seen = values_seen(scene.skin, hits, self._view.limit)
            value, place = laid_over((value, place), (seen, scene.distance(hits)), THIN * size)
        behind = place > distance + DEPTH_JUMP * size
        draw_patches(image, value, behind, color_map(CONTACT_PRESSURE), self._view.limit)


def _draw(scenes: list[Scene], hits: list[Hits], look: Look) -> NDArray[np.uint8]:
    """Paint the first skin with its lines, and the visible lines of the others."""
    front = scenes[0]
    image = paint(front.skin, hits[0], front.eye, look)
    free = hits[0].triangle < 0
    for scene, seen in zip(scenes[1:], hits[1:], strict=True):
        outline, inner = find_lines(scene.skin, seen)
        draw_lines(image, (outline & free, inner & free), GHOST, 0.8 * SAMPLES)
    draw_lines(image, find_lines(front.skin, hits[0]), INK, 0.9 * SAMPLES)
    return image
