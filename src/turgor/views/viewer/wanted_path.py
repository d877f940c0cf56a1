"""Wanted path: a line in space that an actuator was to follow, with a mark that moves along it, for the viewer."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.views.viewer.packing import pack_index, pack_steps

Array = NDArray[np.float64]

#: Corners of the cross-section of the line, and of each ring of the mark.
CORNERS = 8


def wanted_path(places: Array, steps: Array, size: float) -> dict[str, Any]:
    """Return a line through places, and a ball that is at one of them in each step, as triangles.

    Parameters
    ----------
    places : (n, 3) array [m]
    steps : (s, 3) array [m]
        Place of the mark in each step.
    size : float [m]
        Length of the actuator, from which the thickness follows.

    Returns
    -------
    dict
        What the viewer reads as ``path``.
    """
    line, sides = _tube(places, 0.004 * size)
    ball, faces = _ball(0.014 * size)
    moving = np.stack([np.concatenate([line, ball + step]) for step in steps])
    return {"triangles": pack_index(np.concatenate([sides, faces + len(line)])), "positions": pack_steps(moving)}


def _tube(places: Array, radius: float) -> tuple[Array, NDArray[np.int64]]:
    """Rings of vertices across a line, and the triangles between them."""
    ways = np.gradient(places, axis=0) if len(places) > 1 else np.zeros_like(places)
    length = np.linalg.norm(ways, axis=1, keepdims=True)
    ways = np.where(length > 0, ways / np.where(length > 0, length, 1.0), [1.0, 0.0, 0.0])
    across = np.cross(ways, np.eye(3)[np.abs(ways).argmin(axis=1)])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    other = np.cross(ways, across)
    angles = 2 * np.pi * np.arange(CORNERS) / CORNERS
    rings = np.cos(angles)[:, None] * across[:, None] + np.sin(angles)[:, None] * other[:, None]
    return (places[:, None] + radius * rings).reshape(-1, 3), _between(len(places))


def _ball(radius: float) -> tuple[Array, NDArray[np.int64]]:
    heights = np.linspace(-1.0, 1.0, CORNERS + 1) * np.pi / 2
    angles = 2 * np.pi * np.arange(CORNERS) / CORNERS
    flat = np.cos(heights)[:, None]
    out = np.stack([flat * np.cos(angles), flat * np.sin(angles), np.sin(heights)[:, None] + 0 * angles], axis=2)
    return radius * out.reshape(-1, 3), _between(len(heights))


def _between(rings: int) -> NDArray[np.int64]:
    """Triangles between rings of vertices."""
    here = CORNERS * np.arange(rings - 1)[:, None] + np.arange(CORNERS)
    next_one = CORNERS * np.arange(rings - 1)[:, None] + (np.arange(CORNERS) + 1) % CORNERS
    one = np.stack([here, next_one, here + CORNERS], axis=2)
    two = np.stack([next_one, next_one + CORNERS, here + CORNERS], axis=2)
    return np.concatenate([one.reshape(-1, 3), two.reshape(-1, 3)])
