"""The boundary of tetrahedra, and which face of a surface each of its triangles lies on."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.tetwild.nearest import NearestPlaces

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Corners of the sides of a tetrahedron, normals out of it.
SIDES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])


def boundary_of(points: Array, cells: Ints) -> Ints:
    """Return the sides that belong to one tetrahedron only, normals pointing out, (b, 3)."""
    sides = cells[:, SIDES].reshape(-1, 3)
    _, first, count = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
    return np.asarray(sides[first[count == 1]])


def faces_of(points: Array, sides: Ints, surface: NearestPlaces) -> Ints:
    """Return the face of the surface that each boundary triangle lies on, (b,).

    A triangle with two neighbors on another face, and none on its own, joins them: it lies across an edge.
    """
    a, b, c = (points[sides[:, i]] for i in range(3))
    face = surface.faces((a + b + c) / 3)
    edges = np.sort(sides[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    _, number, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
    number = np.asarray(number).ravel()
    order = np.argsort(number, kind="stable")
    pairs = order[count[number[order]] == 2].reshape(-1, 2)
    other = np.full(len(edges), -1, dtype=np.int64)
    other[pairs[:, 0]], other[pairs[:, 1]] = pairs[:, 1] // 3, pairs[:, 0] // 3
    around = np.where(other.reshape(-1, 3) >= 0, face[other.reshape(-1, 3)], -1)
    lone = (around != face[:, None]).all(axis=1)
    for i, j in ((0, 1), (1, 2), (0, 2)):
        alike = lone & (around[:, i] == around[:, j]) & (around[:, i] >= 0)
        face = np.where(alike, around[:, i], face)
    return face
