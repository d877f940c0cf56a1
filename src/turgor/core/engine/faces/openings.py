"""Openings: caps over the inlets of a surface, so that it encloses a volume."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.bodies.groups import groups_of
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Points and weights of Gauss with two points on (0, 1): exact for the cubic c × c' of a quadratic edge.
_GAUSS = ((0.5 - 0.5 / 3**0.5, 0.5), (0.5 + 0.5 / 3**0.5, 0.5))

#: Where there is no wedge.
NO_AXIS = -1


def mirror_point(mesh: Mesh) -> Array:
    """Return a point on all mirror planes of a mesh or the axis of its wedge, (3,) [m]; other components are zero."""
    out = np.zeros(3)
    if mesh.wedge is not None:
        out[list(mesh.wedge.across)] = np.array(mesh.wedge.center)[list(mesh.wedge.across)]
    for axis, position in mesh.mirror_planes:
        out[axis] = position
    return out


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
    label = groups_of(len(nodes), ends[:, 0], ends[:, 1])[ends[:, 0]]
    return [edges[label == i] for i in range(int(label.max()) + 1)]


def cap_volume(points: Array, edges: Ints, axis: int = NO_AXIS) -> float:
    """Compute what the caps on all loops of a rim add to ⅓ ∮ x·n da.

    A cap is the fan of straight lines from an apex, the mean of the loop's nodes, to every point of the loop; around
    a plane opening it is the plane itself. Edges in a coordinate plane through the origin, where a mirror plane cuts
    the body, need no cap; of a loop that ends in such planes the apex is moved into them: the part of the fan in the
    planes then adds nothing, and the rest is the cap of the modeled part of the opening. So it is with a loop that ends
    in the cut faces of a wedge, whose apex is moved onto the axis.

    Parameters
    ----------
    points : (n, 3) array [m]
    edges : (e, 3) int array
        Edges of the rim, each in the direction in which its triangle has it.
    axis : int
        Number of the axis of a wedge through the origin; −1 where there is none.

    Returns
    -------
    float [m³]

    Examples
    --------
    >>> corners = np.array([[0, 0, 1.0], [1, 0, 1], [1, 1, 1], [0, 1, 1]]) + [2, 3, 4]
    >>> points = np.vstack([corners, (corners + np.roll(corners, -1, axis=0)) / 2])
    >>> rim = np.array([[0, 1, 4], [1, 2, 5], [2, 3, 6], [3, 0, 7]])
    >>> round(cap_volume(points, rim[:, [1, 0, 2]]), 12)  # a third of the area times its height, 5
    1.666666666667
    """
    total = 0.0
    for loop in open_loops(points, edges):
        apex, _ = _apex(points, loop, axis)
        turning = np.zeros(3)
        for position, tangent, weight, _ in _along(points, loop):
            turning += weight * np.cross(position, tangent).sum(axis=0)
        total -= float(apex @ turning) / 6  # the cap's rim runs the other way around
    return total


def cap_gradient(points: Array, edges: Ints, axis: int = NO_AXIS) -> Array:
    """Derivative of `cap_volume` by the nodal positions, as long as what lies in a coordinate plane stays there.

    Parameters
    ----------
    points : (n, 3) array [m]
    edges : (e, 3) int array
    axis : int
        As for `cap_volume`.

    Returns
    -------
    (n, 3) array [m²]
    """
    out = np.zeros_like(points)
    for loop in open_loops(points, edges):
        apex, weights = _apex(points, loop, axis)
        turning = np.zeros(3)
        for position, tangent, weight, (along, across) in _along(points, loop):
            turning += weight * np.cross(position, tangent).sum(axis=0)
            by_position, by_tangent = np.cross(tangent, apex), np.cross(apex, position)
            for k in range(3):
                np.add.at(out, loop[:, k], -weight / 6 * (along[k] * by_position + across[k] * by_tangent))
        out[np.unique(loop)] -= weights * turning / 6
    return out


def open_loops(points: Array, edges: Ints) -> list[Ints]:
    """Sort the edges of a rim that lie in no coordinate plane through the origin into loops."""
    if not len(edges):
        return []
    in_plane = np.abs(points[edges]).max(axis=1) <= _tolerance(points)  # (e, 3)
    return rim_loops(edges[~in_plane.any(axis=1)])


def _along(points: Array, loop: Ints) -> list[tuple[Array, Array, float, tuple[Array, Array]]]:
    """Positions and tangents of all edges at the points of Gauss, weights, and the shape functions of both."""
    a, b, m = (points[loop[:, i]] for i in range(3))
    quadrature = []
    for t, weight in _GAUSS:
        along = np.array([(1 - t) * (1 - 2 * t), t * (2 * t - 1), 4 * t * (1 - t)])
        across = np.array([4 * t - 3, 4 * t - 1, 4 - 8 * t])
        position = along[0] * a + along[1] * b + along[2] * m
        quadrature.append((position, across[0] * a + across[1] * b + across[2] * m, weight, (along, across)))
    return quadrature


def _apex(points: Array, loop: Ints, axis: int) -> tuple[Array, Array]:
    """The apex, and what each component of it takes of every node of the loop."""
    nodes, count = np.unique(loop[:, :2], return_counts=True)
    ends = points[nodes[count == 1]]  # those of a loop that runs from mirror plane to mirror plane
    cutting = (np.abs(ends) <= _tolerance(points)).any(axis=0) if len(ends) else np.zeros(3, dtype=bool)
    if len(ends) and axis != NO_AXIS:
        cutting = np.arange(3) != axis
    every = points[np.unique(loop)]
    weights = np.where(cutting, 0.0, 1 / len(every))
    return weights * every.sum(axis=0), weights


def _tolerance(points: Array) -> float:
    return ROUND_OFF.mesh_digits * float(np.ptp(points, axis=0).max())
