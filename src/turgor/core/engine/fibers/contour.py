"""Contour: the cross-section of a face that runs along an axis, with the length along it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.settings import FIBERS
from turgor.core.meshing.bodies.groups import groups_of
from turgor.core.meshing.cells import side_type
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Contour:
    """Cross-section of a face, counterclockwise around the axis.

    Parameters
    ----------
    points : (k, 3) array [m]
        Points on it, without their axial coordinate; on a closed contour the first is repeated at the end.
    lengths : (k,) array [m]
        Length along it up to each point.
    closed : bool
        Whether it goes all around.
    axis : (3,) array
        Direction of the axis, a unit vector.
    """

    points: Array
    lengths: Array
    closed: bool
    axis: Array

    @property
    def length(self) -> float:
        """Length of the contour [m]."""
        return float(self.lengths[-1])

    def project(self, points: Array) -> tuple[Array, Array]:
        """Length along the contour next to each point (k, 3), and the distance from it, (k,) [m] each."""
        from scipy.spatial import cKDTree  # slow to load, and few models have threads

        points = points - np.outer(points @ self.axis, self.axis)
        nearest = cKDTree(self.points).query(points)[1]
        last = len(self.points) - 2
        length, distance = np.zeros(len(points)), np.full(len(points), np.inf)
        for first in (nearest - 1, nearest):
            if self.closed:
                first = first % (last + 1)
            first = np.clip(first, 0, last)
            a, b = self.points[first], self.points[first + 1]
            share = np.einsum("ki,ki->k", points - a, b - a) / np.einsum("ki,ki->k", b - a, b - a)
            share = np.clip(share, 0, 1)
            away = np.linalg.norm(a + share[:, None] * (b - a) - points, axis=1)
            closer = away < distance
            here = self.lengths[first] + share * (self.lengths[first + 1] - self.lengths[first])
            length, distance = np.where(closer, here, length), np.where(closer, away, distance)
        return length, distance


def contour_of(points: Array, sides: Ints, axis: Array, name: str) -> Contour:
    """Follow the edge at the start of a face around its axis.

    Raises
    ------
    TurgorError
        If the face does not begin with one line of edges.
    """
    edges = _border(sides)
    along = points @ axis
    ends = points[edges[:, 1]] - points[edges[:, 0]]
    across = np.abs(ends @ axis) < 0.7 * np.linalg.norm(ends, axis=1)
    edges = edges[across]
    if len(edges):
        part = groups_of(len(points), edges[:, 0], edges[:, 1])[edges[:, 0]]
        lowest = min(np.unique(part), key=lambda p: along[edges[part == p]].mean())
        chain = _chain(edges[part == lowest])
    if not len(edges) or chain is None:
        raise TurgorError(
            f"fibers on '{name}': this face does not begin with a contour around the axis; threads can be wound on a "
            "face that runs along the axis, such as the outside of a tube."
        )
    dense = _dense(points, chain)
    dense -= np.outer(dense @ axis, axis)
    closed = bool(chain[0, 0] == chain[-1, 1])
    arm = dense - dense.mean(axis=0)
    if np.cross(arm, np.roll(arm, -1, axis=0)).sum(axis=0) @ axis < 0:
        dense = dense[::-1]
    if closed:
        dense = _from_the_top(dense, axis)
    lengths = np.concatenate([[0.0], np.linalg.norm(np.diff(dense, axis=0), axis=1).cumsum()])
    return Contour(dense, lengths, closed, axis)


def _border(sides: Ints) -> Ints:
    """Edges that only one side has: end, end, middle, (e, 3)."""
    kind = side_type(sides.shape[1])
    edges = np.concatenate([sides[:, [a, b, kind.corners + i]] for i, (a, b) in enumerate(kind.edges)])
    _, first, count = np.unique(np.sort(edges[:, :2], axis=1), axis=0, return_index=True, return_counts=True)
    return np.asarray(edges[first[count == 1]])


def _chain(edges: Ints) -> Ints | None:
    """Edges in order, each beginning where the one before ends; None if they branch."""
    touching: dict[int, list[int]] = {}
    for number, (a, b, _) in enumerate(edges.tolist()):
        touching.setdefault(a, []).append(number)
        touching.setdefault(b, []).append(number)
    if any(len(numbers) > 2 for numbers in touching.values()):
        return None
    loose = sorted(node for node, numbers in touching.items() if len(numbers) == 1)
    at = loose[0] if loose else int(edges[0, 0])
    out: list[tuple[int, int, int]] = []
    used: set[int] = set()
    while True:
        onward = [number for number in touching[at] if number not in used]
        if not onward:
            return np.array(out)
        used.add(onward[0])
        a, b, middle = edges[onward[0]].tolist()
        out.append((at, b if a == at else a, middle))
        at = out[-1][1]


def _dense(points: Array, chain: Ints) -> Array:
    """Points on a chain of quadratic edges, its last one included."""
    t = np.arange(FIBERS.parts_of_edge)[:, None] / FIBERS.parts_of_edge
    a, b, middle = (points[chain[:, k]][:, None] for k in range(3))
    inner = (1 - t) * (1 - 2 * t) * a + t * (2 * t - 1) * b + 4 * t * (1 - t) * middle
    return np.asarray(np.concatenate([inner.reshape(-1, 3), points[chain[-1:, 1]]]))


def _from_the_top(dense: Array, axis: Array) -> Array:
    """A closed contour that begins at the middle of its top, so that mirror images begin at the same point."""
    up = np.eye(3)[2 if abs(axis[2]) < 0.9 else 0]
    height = dense[:-1] @ up
    top = np.flatnonzero(height > height.max() - 1e-9 * np.ptp(height))
    middle = (dense[top].min(axis=0) + dense[top].max(axis=0)) / 2
    first = top[np.linalg.norm(dense[top] - middle, axis=1).argmin()]
    turned = np.roll(dense[:-1], -first, axis=0)
    return np.concatenate([turned, turned[:1]])
