"""Threads in pictures: thin lines on the visible part of the skin."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.results.pictures.raycast import Hits, Raster, Scene
from turgor.results.pictures.shading import DEPTH_JUMP, INK, Bytes, Mask, thickened

#: Opacity of a thread.
OPACITY = 0.7


def visible_threads(scene: Scene, hits: Hits, raster: Raster, threads: Sequence[NDArray[np.float64]]) -> Mask:
    """Return a mask of the samples in which a thread is visible, (h, w), on the skin or a little below it.

    Parameters
    ----------
    scene : Scene
        Scene of the skin.
    hits : Hits
        First hit of each ray.
    raster : Raster
        The samples.
    threads : sequence of (k, 3) arrays [m]
        Points along each thread.
    """
    mask = np.zeros(hits.triangle.shape, dtype=bool)
    if not len(threads):
        return mask
    begin = np.concatenate([line[:-1] for line in threads])
    end = np.concatenate([line[1:] for line in threads])
    parts = np.maximum(1, np.ceil(np.linalg.norm(end - begin, axis=1) / (0.7 * raster.step)).astype(np.int64))
    row = np.repeat(np.arange(len(parts)), parts)
    share = (np.arange(len(row)) - np.repeat(np.cumsum(parts) - parts, parts)) / parts[row]
    points = begin[row] + share[:, None] * (end - begin)[row]
    across, upward, _ = scene.eye.project(points).T
    column = np.floor((across - raster.left) / raster.step).astype(np.int64)
    line = np.floor((raster.top - upward) / raster.step).astype(np.int64)
    inside = (column >= 0) & (column < raster.columns) & (line >= 0) & (line < raster.rows)
    column, line, depth = column[inside], line[inside], scene.depth(points[inside])
    below = DEPTH_JUMP * float(np.ptp(scene.skin.points, axis=0).max())
    seen = (hits.triangle[line, column] >= 0) & (depth <= hits.depth[line, column] + below)
    mask[line[seen], column[seen]] = True
    return mask


def draw_threads(image: Bytes, mask: Mask, width: float) -> None:
    """Draw threads into an image, ``width`` samples wide."""
    place = thickened(mask, width / 2)
    image[place] = (image[place] * (1 - OPACITY) + np.array(INK) * OPACITY).astype(np.uint8)
