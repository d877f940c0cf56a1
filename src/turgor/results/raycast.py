"""Parallel rays cast at a skin: what is seen in each sample of a picture, and how open the surface is to the sky.

Embree does it on any machine; VTK would need a graphics library that a bare machine does not have.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from turgor.results.skin import Skin

Array = NDArray[np.float64]

#: Side of the tiles, in samples, that are skipped where no triangle comes near.
TILE = 16

#: Rays a point sends out to see how much of the sky is hidden from it.
SKY_RAYS = 48


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Camera:
    """Parallel projection.

    Parameters
    ----------
    right, up, forward : (3,) arrays
        Unit vectors of the picture, in space; ``forward`` points away from the eye.
    """

    right: Array
    up: Array
    forward: Array

    def project(self, points: Array) -> Array:
        """Picture coordinates and depth of points, (p, 3) [m]."""
        return points @ np.stack([self.right, self.up, self.forward], axis=1)


def camera(azimuth: float, elevation: float) -> Camera:
    """Camera that looks along +y, turned by ``azimuth`` to the right of the actuator and raised by ``elevation`` [rad]."""
    ca, sa, ce, se = np.cos(azimuth), np.sin(azimuth), np.cos(elevation), np.sin(elevation)
    right = np.array([ca, sa, 0.0])
    forward = np.array([-sa * ce, ca * ce, -se])
    return Camera(right=right, up=np.cross(right, forward), forward=forward)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Hits:
    """What the samples of a picture see; rows count downwards.

    Parameters
    ----------
    triangle : (h, w) int array
        Triangle seen, -1 where there is none.
    depth : (h, w) array [m]
        Distance along the view, infinite where nothing is seen.
    u, v : (h, w) arrays
        Barycentric coordinates of the second and third corner.
    """

    triangle: NDArray[np.int32]
    depth: NDArray[np.float32]
    u: NDArray[np.float32]
    v: NDArray[np.float32]


class Scene:
    """A skin that rays can be cast at; lengths are scaled to about one, since Embree computes in single precision."""

    def __init__(self, skin: Skin) -> None:
        self._center = (skin.points.min(axis=0) + skin.points.max(axis=0)) / 2
        self._size = float(np.ptp(skin.points, axis=0).max()) or 1.0
        self._scene: Any = EmbreeScene()
        self._skin = skin
        TriangleMesh(self._scene, self._scaled(skin.points), np.ascontiguousarray(skin.triangles, dtype=np.int32))

    def _scaled(self, points: Array) -> NDArray[np.float32]:
        return np.ascontiguousarray((points - self._center) / self._size, dtype=np.float32)

    def look(self, eye: Camera, window: tuple[float, float, float, float], shape: tuple[int, int]) -> Hits:
        """Cast one ray through the middle of each sample.

        Parameters
        ----------
        eye : Camera
        window : (left, right, bottom, top) [m]
            Part of the picture plane that is seen.
        shape : (int, int)
            Rows and columns of samples.
        """
        left, right, bottom, top = window
        rows, columns = np.nonzero(self._near(eye, window, shape))
        across = left + (columns + 0.5) * (right - left) / shape[1]
        upward = top - (rows + 0.5) * (top - bottom) / shape[0]
        start = float((self._center @ eye.forward) - 2 * self._size)
        origins = across[:, None] * eye.right + upward[:, None] * eye.up + start * eye.forward
        directions = np.tile(eye.forward.astype(np.float32), (len(origins), 1))
        found = self._scene.run(self._scaled(origins), directions, query="INTERSECT", output=True)
        seen = found["primID"] >= 0
        place = (rows[seen], columns[seen])
        hits = Hits(
            triangle=np.full(shape, -1, dtype=np.int32), depth=np.full(shape, np.inf, dtype=np.float32),
            u=np.zeros(shape, dtype=np.float32), v=np.zeros(shape, dtype=np.float32),
        )  # fmt: skip
        hits.triangle[place] = found["primID"][seen]
        hits.depth[place] = found["tfar"][seen] * self._size
        hits.u[place] = found["u"][seen]
        hits.v[place] = found["v"][seen]
        return hits

    def _near(self, eye: Camera, window: tuple[float, float, float, float], shape: tuple[int, int]) -> NDArray[np.bool_]:
        """Samples in tiles that a triangle may cover; the others see nothing and need no ray."""
        left, right, bottom, top = window
        flat = eye.project(self._skin.points)[:, :2][self._skin.triangles]
        scale = np.array([shape[1] / (right - left), shape[0] / (top - bottom)])
        tile = max(TILE, int(np.ceil((np.ptp(flat, axis=1) * scale).max())))
        counts = (-(-shape[1] // tile), -(-shape[0] // tile))
        corners = flat.reshape(-1, 2)
        column = np.floor((corners[:, 0] - left) * scale[0] / tile).astype(int)
        row = np.floor((top - corners[:, 1]) * scale[1] / tile).astype(int)
        near = np.zeros((counts[1] + 2, counts[0] + 2), dtype=bool)
        for down in (-1, 0, 1):  # a triangle is no larger than a tile: it ends in a neighbor of its corners' tiles
            for aside in (-1, 0, 1):
                r, c = np.clip(row + down, -1, counts[1]), np.clip(column + aside, -1, counts[0])
                near[r + 1, c + 1] = True
        return np.repeat(np.repeat(near[1:-1, 1:-1], tile, axis=0), tile, axis=1)[: shape[0], : shape[1]]

    def openness(self, reach: float) -> Array:
        """Share of the sky above each point of the skin that nothing hides within ``reach`` [m], (p,)."""
        normals, count = self._skin.normals, len(self._skin.points)
        tangent = np.cross(normals, np.where(np.abs(normals[:, :1]) < 0.7, [[1.0, 0, 0]], [[0, 1.0, 0]]))
        tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
        second = np.cross(normals, tangent)
        origins = self._scaled(self._skin.points + 1e-3 * reach * normals)
        limit = np.full(count, reach / self._size, dtype=np.float32)
        hidden = np.zeros(count)
        for x, y, z in _cosine_directions(SKY_RAYS):
            direction = (x * tangent + y * second + z * normals).astype(np.float32)
            hidden += self._scene.run(origins, direction, dists=limit, query="OCCLUDED") >= 0
        return 1 - hidden / SKY_RAYS


def _cosine_directions(count: int) -> Array:
    """Directions over a hemisphere, as dense as the cosine to its pole: a golden spiral, (count, 3)."""
    k = np.arange(count) + 0.5
    radius, angle = np.sqrt(k / count), np.pi * (3 - np.sqrt(5)) * k
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), np.sqrt(1 - radius**2)], axis=1)
