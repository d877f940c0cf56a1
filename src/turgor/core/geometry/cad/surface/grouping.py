"""Facets grouped into faces: planes first, then what continues smoothly."""

from collections import deque

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array

from turgor.core.geometry.cad.facets import edge_pairs
from turgor.core.geometry.cad.surface.settings import SURFACE

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def grouped(points: Array, triangles: Ints) -> Ints:
    """Number the faces of a surface of triangles.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (t, 3) int array

    Returns
    -------
    (t,) int array
        Face of each triangle, from zero, the largest first.
    """
    areas = vector_areas(points, triangles)
    area = np.linalg.norm(areas, axis=1)
    normal = areas / np.where(area > 0, area, 1.0)[:, None]
    pairs, _, _ = edge_pairs(triangles)
    planes = _grown(points, triangles, normal, area, pairs)
    flat = _truly_plane(planes, normal, area, pairs)
    label = np.where(flat, planes, -1)
    smooth = np.einsum("pi,pi->p", normal[pairs[:, 0]], normal[pairs[:, 1]]) > SURFACE.smooth_cosine
    smooth |= (area[pairs] == 0).any(axis=1)  # a sliver has no normal
    both = (label[pairs] == -1).all(axis=1) & smooth
    same = both | ((label[pairs[:, 0]] == label[pairs[:, 1]]) & (label[pairs[:, 0]] >= 0))
    label = _components(len(triangles), pairs[same])
    return _by_area(label, area)


def vector_areas(points: Array, triangles: Ints) -> Array:
    """Vector area of each triangle, (t, 3)."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.asarray(np.cross(b - a, c - a) / 2)


def _grown(points: Array, triangles: Ints, normal: Array, area: Array, pairs: Ints) -> Ints:
    """Number of the flat region of each triangle: each grows from its largest triangle."""
    count = len(triangles)
    neighbors: list[list[int]] = [[] for _ in range(count)]
    for a, b in pairs.tolist():
        neighbors[a].append(b)
        neighbors[b].append(a)
    reach, cosine = SURFACE.plane_distance * float(np.ptp(points, axis=0).max()), SURFACE.plane_cosine
    corners, sliver = points[triangles], area == 0
    label = np.full(count, -1, dtype=np.int64)
    for number, seed in enumerate(np.argsort(-area, kind="stable").tolist()):
        if label[seed] >= 0:
            continue
        label[seed] = number
        waiting, along, height = deque([seed]), normal[seed], float(corners[seed, 0] @ normal[seed])
        while waiting:
            for other in neighbors[waiting.popleft()]:
                if (
                    label[other] < 0
                    and (sliver[other] or normal[other] @ along > cosine)
                    and np.abs(corners[other] @ along - height).max() < reach
                ):
                    label[other] = number
                    waiting.append(other)
    return np.asarray(np.unique(label, return_inverse=True)[1]).ravel().astype(np.int64)


def _truly_plane(region: Ints, normal: Array, area: Array, pairs: Ints) -> NDArray[np.bool_]:
    """Whether the flat region of each triangle is a plane face, and no strip of a curved one."""
    total = np.bincount(region, weights=area)
    a, b = region[pairs].T
    smooth = (a != b) & (np.einsum("pi,pi->p", normal[pairs[:, 0]], normal[pairs[:, 1]]) > SURFACE.smooth_cosine)
    adjacent = np.unique(np.concatenate([np.stack([a, b], axis=1)[smooth], np.stack([b, a], axis=1)[smooth]]), axis=0)
    one, other = adjacent.T
    together = np.bincount(one, weights=total[other], minlength=len(total))
    return np.asarray((total >= SURFACE.larger * together)[region])


def _components(count: int, links: Ints) -> Ints:
    from scipy.sparse.csgraph import connected_components  # slow to load, and every job loads this file

    graph = coo_array((np.ones(len(links)), (links[:, 0], links[:, 1])), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1]).astype(np.int64)


def _by_area(label: Ints, area: Array) -> Ints:
    total = np.bincount(label, weights=area)
    rank = np.empty(len(total), dtype=np.int64)
    rank[np.argsort(-total, kind="stable")] = np.arange(len(total))
    return np.asarray(rank[label])
