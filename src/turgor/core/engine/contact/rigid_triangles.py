"""Triangles of a rigid body: cut to the size of the sides that meet it, with six nodes each, and their sharp rims.

A sharp rim that slides over the points of a surface would drop one row of them after the other, and the force would
jump each time. Instead it passes each point within a band, in which the pressure of the point fades.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.closest import centers_of
from turgor.core.engine.contact.settings import CONTACT_SEARCH
from turgor.core.engine.contact.surface import joined

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


@dataclass(frozen=True, slots=True, eq=False)
class Rims:
    """Sharp convex edges of triangles.

    Parameters
    ----------
    width : (t, 3) array
        Width of each triangle across each of its edges; inf where the edge is no sharp rim.
    inward : (t, 3, 3) array
        Unit vectors in the triangle, from each edge into it.
    """

    width: Array
    inward: Array

    def beyond(self, band: float) -> Array:
        """How far (t, 3) a foot point may lie beyond each edge, for a band of that length."""
        return np.minimum(band / self.width, CONTACT_SEARCH.beyond)

    def covered(self, partner: Ints, at: Array, band: Array) -> tuple[Array, Array]:
        """Shares (k,) of points that their triangles cover, and the gradients (k, 3) of these in space.

        ``at`` are the places (k, 2) on the ``partner`` triangles, ``band`` (k,) the lengths on both sides of a rim.
        The energy of the penetration that fades is lost: a rim that gained it would push points off.
        """
        r, s = at.T
        width = self.width[partner]
        sharp = np.isfinite(width)
        within = np.where(sharp, np.stack([s, 1 - r - s, r], axis=1) * np.where(sharp, width, 0.0), np.inf)
        edge = within.argmin(axis=1)
        way = np.clip(0.5 + 0.5 * within.min(axis=1) / band, 0, 1)
        step = 0.5 / band[:, None] * self.inward[partner, edge]
        return way**2 * (3 - 2 * way), (6 * way * (1 - way))[:, None] * step


def rims(points: Array, sides: Ints) -> Rims:
    """Find the sharp convex edges of triangles (t, 6)."""
    center, _, normal = centers_of(points, sides, 3)
    _, owner, (first, second) = joined(sides)
    a, b = owner[first], owner[second]
    smooth = np.einsum("ei,ei->e", normal[a], normal[b]) > CONTACT_SEARCH.smooth
    groove = np.einsum("ei,ei->e", center[b] - center[a], normal[a]) > 0
    rim = np.ones(len(owner), dtype=np.bool_)
    rim[first], rim[second] = ~(smooth | groove), ~(smooth | groove)
    corner = points[sides[:, :3]]
    along = np.roll(corner, -1, axis=1) - corner
    inward = np.cross(normal[:, None, :], along)
    inward /= np.linalg.norm(inward, axis=2, keepdims=True)
    width = 3 * np.einsum("tei,tei->te", center[:, None, :] - corner, inward)
    return Rims(np.where(rim.reshape(3, -1).T, width, np.inf), inward)
