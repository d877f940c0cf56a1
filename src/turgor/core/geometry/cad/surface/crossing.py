"""Which triangles cross each other, and which points lie within a surface."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def winding(point: Array, triangles: Array) -> float:
    """Return the winding number of a closed surface about a point, 1 inside, 0 outside (van Oosterom, Strackee 1983).

    Examples
    --------
    >>> corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    >>> tetrahedron = corners[np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])]
    >>> round(winding(np.full(3, 0.2), tetrahedron), 12)
    1.0
    """
    a, b, c = (triangles[:, i] - point for i in range(3))
    la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
    volume = np.einsum("ti,ti->t", a, np.cross(b, c))
    dots = [np.einsum("ti,ti->t", u, v) * w for u, v, w in ((a, b, lc), (b, c, la), (c, a, lb))]
    return float(np.arctan2(volume, la * lb * lc + sum(dots)).sum() / (2 * np.pi))


def crossings(points: Array, triangles: Ints) -> Ints:
    """Find pairs of triangles without a common corner of which an edge of one pierces the other, (p, 2)."""
    low, high = points[triangles].min(axis=1), points[triangles].max(axis=1)
    order = np.argsort(low[:, 0], kind="stable")
    ends = np.searchsorted(low[order, 0], high[order, 0], side="right")
    crossing = []
    for i in range(len(order)):
        one, others = order[i], order[i + 1 : ends[i]]
        near = ((low[others] <= high[one]) & (high[others] >= low[one])).all(axis=1)
        others = others[near]
        apart = ~np.isin(triangles[others], triangles[one]).any(axis=1)
        crossing += [(one, other) for other in others[apart]]
    pairs = np.array(crossing, dtype=np.int64).reshape(-1, 2)
    pierced = np.zeros(len(pairs), dtype=bool)
    for edges_of, walls in ((0, 1), (1, 0)):
        a, b, c = (points[triangles[pairs[:, walls], i]] for i in range(3))
        for i in range(3):
            p = points[triangles[pairs[:, edges_of], i]]
            q = points[triangles[pairs[:, edges_of], (i + 1) % 3]]
            pierced |= _pierces(p, q, a, b, c)
    return pairs[pierced]


def _pierces(p: Array, q: Array, a: Array, b: Array, c: Array) -> NDArray[np.bool_]:
    """Whether each segment from p to q intersects the interior of its triangle."""

    def side(u: Array, v: Array, w: Array, x: Array) -> Array:
        return np.asarray(np.einsum("pi,pi->p", np.cross(v - u, w - u), x - u))

    size = np.linalg.norm(b - a, axis=1) * np.linalg.norm(c - a, axis=1) * np.linalg.norm(q - p, axis=1)
    slack = 1e-9 * size
    s, t = side(a, b, c, p), side(a, b, c, q)
    through = (np.minimum(s, t) < -slack) & (np.maximum(s, t) > slack)
    u, v, w = side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)
    inside = (np.minimum(np.minimum(u, v), w) > slack) | (np.maximum(np.maximum(u, v), w) < -slack)
    return through & inside
