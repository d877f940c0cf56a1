"""Hidden surfaces in a parallel projection: the visible triangle in each sample of a picture, and ambient occlusion.

All rays of a picture are parallel, so triangles are drawn one after another into a buffer of depths; that takes a
tenth of the time of rays. Embree casts those of the sky. Both run on any machine; VTK would need a graphics library,
which servers and containers often lack.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.compiled import INNER, LOOP
from turgor.views.pictures.settings import RENDERING
from turgor.views.pictures.skin import Skin

Array = NDArray[np.float64]

#: Share of a triangle by which it reaches beyond its edges, so that round-off leaves no gap between two of them.
EDGE = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Camera:
    """Camera of a parallel projection.

    Parameters
    ----------
    right, up, forward : (3,) arrays
        Unit vectors along the sides of the picture and along the view; ``forward`` points away from the viewer.
    """

    right: Array
    up: Array
    forward: Array

    def project(self, points: Array) -> Array:
        """Return picture coordinates and depth of points, (p, 3) [m]."""
        return points @ np.stack([self.right, self.up, self.forward], axis=1)


def camera(azimuth: float, elevation: float) -> Camera:
    """Return a camera that looks along +y, turned by ``azimuth`` towards the tip and raised by ``elevation`` [rad]."""
    ca, sa, ce, se = np.cos(azimuth), np.sin(azimuth), np.cos(elevation), np.sin(elevation)
    right = np.array([ca, sa, 0.0])
    forward = np.array([-sa * ce, ca * ce, -se])
    return Camera(right=right, up=np.cross(right, forward), forward=forward)


@dataclass(frozen=True, slots=True, kw_only=True)
class Raster:
    """Rectangle of the picture plane, divided into samples; rows count downwards.

    Parameters
    ----------
    left, top : float [m]
        Upper left corner.
    step : float [m]
        Distance between samples.
    rows, columns : int
        Number of samples.
    """

    left: float
    top: float
    step: float
    rows: int
    columns: int

    def band(self, start: int, stop: int) -> "Raster":
        """Return the rows from ``start`` up to ``stop``."""
        return Raster(
            left=self.left, top=self.top - start * self.step, step=self.step, rows=stop - start, columns=self.columns
        )

    def coarser(self, samples: int) -> "Raster":
        """Return the same rectangle with one sample for ``samples`` x ``samples`` of them."""
        return Raster(
            left=self.left, top=self.top, step=self.step * samples, rows=self.rows // samples,
            columns=self.columns // samples,
        )  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Hits:
    """First triangle behind the center of each sample.

    Parameters
    ----------
    triangle : (h, w) int array
        Triangle that is hit, -1 for none.
    depth : (h, w) array [m]
        Distance along the ray, zero where there is no hit.
    u, v : (k,) arrays
        Barycentric coordinates of the second and third corner, for the k samples that hit a triangle, in order.
    """

    triangle: NDArray[np.int32]
    depth: NDArray[np.float32]
    u: NDArray[np.float32]
    v: NDArray[np.float32]


class Scene:
    """A skin in front of a camera, scaled to a size of about one because Embree computes in single precision."""

    def __init__(self, skin: Skin, eye: Camera) -> None:
        self.skin, self.eye = skin, eye
        self._center = (skin.points.min(axis=0) + skin.points.max(axis=0)) / 2
        self._size = float(np.ptp(skin.points, axis=0).max()) or 1.0
        self._flat = eye.project(skin.points)
        self._flat[:, 2] += 2 * self._size - self._center @ eye.forward
        self._triangles = np.ascontiguousarray(skin.triangles, dtype=np.int64)
        self._scene: Any = EmbreeScene()
        TriangleMesh(self._scene, self._scaled(skin.points), np.ascontiguousarray(skin.triangles, dtype=np.int32))

    def _scaled(self, points: Array) -> NDArray[np.float32]:
        return np.ascontiguousarray((points - self._center) / self._size, dtype=np.float32)

    def look(self, raster: Raster) -> Hits:
        """Find the first triangle behind the center of each sample."""
        places = self._flat.copy()
        places[:, 0] = (places[:, 0] - raster.left) / raster.step - 0.5
        places[:, 1] = (raster.top - places[:, 1]) / raster.step - 0.5
        triangle = np.full((raster.rows, raster.columns), -1, dtype=np.int32)
        depth = np.full(triangle.shape, np.inf)
        shares = np.empty((*triangle.shape, 2), dtype=np.float32)
        _draw(places, self._triangles, triangle, depth, shares)
        hit = triangle >= 0
        u, v = shares[hit].T
        return Hits(triangle=triangle, depth=np.where(hit, depth, 0).astype(np.float32), u=u, v=v)

    def depth(self, points: Array) -> Array:
        """Return the distance of points along the view, (p,) [m], to compare with ``depth`` of `Hits`."""
        return np.asarray((points - self._center) @ self.eye.forward + 2 * self._size)

    def distance(self, hits: Hits) -> Array:
        """Return the position of the hits along the view, (h, w) [m], which can be compared between scenes."""
        return np.asarray(hits.depth + self._center @ self.eye.forward - 2 * self._size)

    @property
    def size(self) -> float:
        """Longest side of the bounding box of the skin [m]."""
        return self._size

    def openness(self, reach: float) -> Array:
        """Return the ambient occlusion: the free share of the sky above each point within ``reach`` [m], (p,).

        Rays start at the nodes of the sides of cells, once where sides share one; points between take the mean.
        """
        skin = self.skin
        if skin.blocks is None:
            return self._open(skin.points, skin.normals, reach)
        shares, nodes = skin.blocks
        points, normals = (each.reshape(-1, len(shares), 3)[:, nodes].reshape(-1, 3) for each in _both(skin))
        chosen, place = _distinct(points / self._size, normals)
        there = self._open(points[chosen], normals[chosen], reach)[place]
        return np.asarray((there.reshape(-1, len(nodes)) @ shares.T).ravel())

    def _open(self, points: Array, normals: Array, reach: float) -> Array:
        """Free share of the sky above points (k, 3) with normals (k, 3), (k,)."""
        tangent = np.cross(normals, np.where(np.abs(normals[:, :1]) < 0.7, [[1.0, 0, 0]], [[0, 1.0, 0]]))
        tangent /= np.maximum(np.linalg.norm(tangent, axis=1, keepdims=True), np.finfo(float).tiny)
        second = np.cross(normals, tangent)
        origins = self._scaled(points + 1e-3 * reach * normals)
        limit = np.full(len(points), reach / self._size, dtype=np.float32)
        hidden = np.zeros(len(points))
        for x, y, z in _cosine_directions(RENDERING.sky_rays):
            direction = (x * tangent + y * second + z * normals).astype(np.float32)
            hidden += self._scene.run(origins, direction, dists=limit, query="OCCLUDED") >= 0
        return 1 - hidden / RENDERING.sky_rays


@njit(**LOOP)
def _draw(places, triangles, triangle, depth, shares):  # type: ignore[no-untyped-def]
    """Draw triangles with corners at ``places`` (column, row, depth) of samples, the nearest in front."""
    rows, columns = triangle.shape
    for t in range(len(triangles)):
        first, second, third = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        ax, ay, az = places[first, 0], places[first, 1], places[first, 2]
        bx, by, bz = places[second, 0] - ax, places[second, 1] - ay, places[second, 2] - az
        cx, cy, cz = places[third, 0] - ax, places[third, 1] - ay, places[third, 2] - az
        area = bx * cy - by * cx
        if area == 0:
            continue
        top, bottom = _limits(ay, by, cy, rows)
        left, right = _limits(ax, bx, cx, columns)
        for row in range(top, bottom):
            for column in range(left, right):
                x, y = column - ax, row - ay
                u, v = (x * cy - y * cx) / area, (bx * y - by * x) / area
                z = az + u * bz + v * cz
                if u >= -EDGE and v >= -EDGE and u + v <= 1 + EDGE and z < depth[row, column]:
                    depth[row, column], triangle[row, column] = z, t
                    shares[row, column, 0], shares[row, column, 1] = u, v


@njit(**INNER)
def _limits(first, second, third, count):  # type: ignore[no-untyped-def]
    """Numbers of the samples from the smallest to the largest of three corners, relative to the first one."""
    low, high = min(0.0, min(second, third)), max(0.0, max(second, third))
    return int(min(max(first + low, 0.0), count)), int(min(max(first + high + 1.0, 0.0), count))


def _both(skin: Skin) -> tuple[Array, Array]:
    return skin.points, skin.normals


def _distinct(points: Array, normals: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Numbers of one point of each place with one normal, and which of them every point is."""
    rounded = np.round(np.concatenate([points * 1e6, normals * 1e3], axis=1)).astype(np.int64)
    weights = np.random.default_rng(1).integers(1, 2**40, size=6)
    _, first, place = np.unique(rounded @ weights, return_index=True, return_inverse=True)
    return first, place


def _cosine_directions(count: int) -> Array:
    """Directions over a hemisphere with cosine-weighted density, on a golden spiral, (count, 3)."""
    k = np.arange(count) + 0.5
    radius, angle = np.sqrt(k / count), np.pi * (3 - np.sqrt(5)) * k
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), np.sqrt(1 - radius**2)], axis=1)
