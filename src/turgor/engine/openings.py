"""Openings: what closes a surface that is open at an inlet, so that it encloses a volume."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: A node lies in a coordinate plane when it is nearer than this share of the size of the surface.
IN_PLANE = 1e-9

#: Points and weights of Gauss with two points on (0, 1): exact for the cubic c × c' of a quadratic edge.
_GAUSS = ((0.5 - 0.5 / 3**0.5, 0.5), (0.5 + 0.5 / 3**0.5, 0.5))


def rim_loops(edges: Ints) -> list[Ints]:
    """Sort the edges of a rim into loops, by the nodes that they share.

    Parameters
    ----------
    edges : (e, 3) int array
        Two corners and the mid-side node of each edge.

    Returns
    -------
    list of (k, 3) int array
        The edges of each loop, in no order.
    """
    if not len(edges):
        return []
    nodes, ends = np.unique(edges[:, :2], return_inverse=True)
    ends = ends.reshape(-1, 2)
    graph = coo_array((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(len(nodes), len(nodes)))
    label = connected_components(graph, directed=False)[1][ends[:, 0]]
    return [edges[label == i] for i in range(int(label.max()) + 1)]


def cap_volume(points: Array, edges: Ints) -> float:
    """Compute what the caps on all loops of a rim add to ⅓ ∮ x·n da.

    A cap is the fan of straight lines from an apex, the mean of the loop's nodes, to every point of the loop; around
    a plane opening it is the plane itself. Where a loop runs partly in a coordinate plane through the origin (a
    mirror plane that cuts the opening), the apex is the mean of the rest, moved into that plane: the part of the fan
    in the plane then adds nothing, and the other part is half of the whole opening's cap.

    Parameters
    ----------
    points : (n, 3) array [m]
    edges : (e, 3) int array
        Edges of the rim, each in the direction in which its triangle has it.

    Returns
    -------
    float [m³]

    Examples
    --------
    >>> corners = np.array([[0, 0, 1.0], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    >>> points = np.vstack([corners, (corners + np.roll(corners, -1, axis=0)) / 2])
    >>> rim = np.array([[0, 1, 4], [1, 2, 5], [2, 3, 6], [3, 0, 7]])
    >>> round(cap_volume(points, rim[:, [1, 0, 2]]), 12)  # the open top of a unit cube: a third of it
    0.333333333333
    """
    if not len(edges):
        return 0.0
    tolerance = IN_PLANE * float(np.ptp(points, axis=0).max())
    total = 0.0
    for loop in rim_loops(edges):
        a, b, m = (points[loop[:, i]] for i in range(3))
        turning = np.zeros(3)
        for t, weight in _GAUSS:
            position = (1 - t) * (1 - 2 * t) * a + t * (2 * t - 1) * b + 4 * t * (1 - t) * m
            tangent = (4 * t - 3) * a + (4 * t - 1) * b + (4 - 8 * t) * m
            turning += weight * np.cross(position, tangent).sum(axis=0)
        total -= float(_apex(points, loop, tolerance) @ turning) / 6  # the cap's rim runs the other way around
    return total


def _apex(points: Array, loop: Ints, tolerance: float) -> Array:
    flat = np.abs(points[loop]).max(axis=1) <= tolerance  # (k, 3): the edge lies in this coordinate plane
    cutting = flat.any(axis=0) & ~flat.all(axis=0)
    free = loop[~flat[:, cutting].any(axis=1)]
    apex = points[np.unique(free if len(free) else loop)].mean(axis=0)
    return np.asarray(np.where(cutting, 0.0, apex))
