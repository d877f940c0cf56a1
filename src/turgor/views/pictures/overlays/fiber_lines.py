"""Threads in pictures: thin lines on the visible part of the skin."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.views.pictures.raycast import Hits, Raster, Scene
from turgor.views.pictures.settings import LOOK, RENDERING
from turgor.views.pictures.shading import INK, Bytes, thickened

Array = NDArray[np.float64]

#: Points along a thread (k, 3) [m], and a value at each of them.
Thread = tuple[Array, Array]


def visible_threads(scene: Scene, hits: Hits, raster: Raster, threads: Sequence[Thread]) -> Array:
    """Return the value of the thread that is visible in each sample, (h, w), nan where there is none.

    A thread is visible on the skin or a little below it.

    Parameters
    ----------
    scene : Scene
        Scene of the skin.
    hits : Hits
        First hit of each ray.
    raster : Raster
        The samples.
    threads : sequence of ((k, 3) array [m], (k,) array)
        Points along each thread, and a value at each of them, such as its tension.
    """
    painted = np.full(hits.triangle.shape, np.nan)
    if not len(threads):
        return painted
    begin = np.concatenate([line[:-1] for line, _ in threads])
    end = np.concatenate([line[1:] for line, _ in threads])
    values = np.concatenate([(each[1:] + each[:-1]) / 2 for _, each in threads])
    parts = np.maximum(1, np.ceil(np.linalg.norm(end - begin, axis=1) / (0.7 * raster.step)).astype(np.int64))
    row = np.repeat(np.arange(len(parts)), parts)
    share = (np.arange(len(row)) - np.repeat(np.cumsum(parts) - parts, parts)) / parts[row]
    points = begin[row] + share[:, None] * (end - begin)[row]
    across, upward, _ = scene.eye.project(points).T
    column = np.floor((across - raster.left) / raster.step).astype(np.int64)
    line = np.floor((raster.top - upward) / raster.step).astype(np.int64)
    inside = (column >= 0) & (column < raster.columns) & (line >= 0) & (line < raster.rows)
    column, line, depth, row = column[inside], line[inside], scene.depth(points[inside]), row[inside]
    below = RENDERING.depth_jump * float(np.ptp(scene.skin.points, axis=0).max())
    visible = (hits.triangle[line, column] >= 0) & (depth <= hits.depth[line, column] + below)
    painted[line[visible], column[visible]] = values[row[visible]]
    return painted


def draw_threads(image: Bytes, painted: Array, width: float, colors: Callable[[Array], Array] | None = None) -> None:
    """Draw threads into an image, ``width`` samples wide: in ink, or in the color of their values.

    Parameters
    ----------
    image : (h, w, 3) array
        Changed in place.
    painted : (h, w) array
        What `visible_threads` returns.
    width : float
        In samples.
    colors : callable, optional
        ``colors(values) -> (k, 3)`` from 0 to 255.
    """
    if colors is None:
        place = thickened(np.isfinite(painted), width / 2)
        image[place] = (image[place] * (1 - LOOK.overlay) + np.array(INK) * LOOK.overlay).astype(np.uint8)
        return
    wide, reach = painted.copy(), int(np.ceil(width / 2))
    rows, columns = np.nonzero(np.isfinite(painted))
    for down in range(-reach, reach + 1):
        for aside in range(-reach, reach + 1):
            if down**2 + aside**2 <= (width / 2) ** 2:
                at = np.clip(rows + down, 0, len(wide) - 1), np.clip(columns + aside, 0, wide.shape[1] - 1)
                wide[at] = np.fmax(wide[at], painted[rows, columns])
    drawn = np.isfinite(wide)
    image[drawn] = colors(wide[drawn]).astype(np.uint8)
