"""Triangles of a rigid body: cut to the size of the sides that meet it, with six nodes each."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.settings import CONTACT_SEARCH

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def refined(points: Array, triangles: Ints, size: float) -> tuple[Array, Ints]:
    """Halve edges longer than a size until there are none, the same way in both triangles of an edge."""
    while True:
        edges = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2)
        marked = np.linalg.norm(points[edges[..., 0]] - points[edges[..., 1]], axis=2) > size
        if not marked.any() or len(triangles) > CONTACT_SEARCH.most_triangles:
            return points, triangles
        unique, index = np.unique(np.sort(edges[marked], axis=1), axis=0, return_inverse=True)
        middle = np.full(triangles.shape, -1)
        middle[marked] = len(points) + index.ravel()
        points = np.vstack([points, (points[unique[:, 0]] + points[unique[:, 1]]) / 2])
        triangles = np.concatenate([_cut(triangles, marked, middle, count) for count in range(4)])


def _cut(triangles: Ints, marked: NDArray[np.bool_], middle: Ints, count: int) -> Ints:
    """The pieces of the triangles with ``count`` marked edges; edge i runs from corner i to the next."""
    chosen = marked.sum(axis=1) == count
    triangles, marked, middle = triangles[chosen], marked[chosen], middle[chosen]
    if count == 0:
        return triangles
    first = marked.argmax(axis=1) if count != 2 else (1 + (~marked).argmax(axis=1)) % 3
    turn = (first[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(triangles, turn, axis=1).T
    p, q, r = np.take_along_axis(middle, turn, axis=1).T
    pieces = {
        1: [(a, p, c), (p, b, c)],
        2: [(p, b, q), (a, p, q), (a, q, c)],
        3: [(a, p, r), (p, b, q), (r, q, c), (p, q, r)],
    }
    return np.concatenate([np.stack(piece, axis=1) for piece in pieces[count]])


def six_nodes(points: Array, triangles: Ints) -> tuple[Ints, Array]:
    """Straight six-node triangles (t, 6) and their nodes."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    unique, index = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
    middles = len(points) + index.ravel().reshape(3, -1).T
    nodes = np.vstack([points, (points[unique[:, 0]] + points[unique[:, 1]]) / 2])
    return np.ascontiguousarray(np.hstack([triangles, middles])), nodes
