"""Common part of all contacts: the gaps at one position, and the assembly of forces and tangents."""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.pattern import Pattern, locate, scatter_add
from turgor.core.engine.contact.friction import FrictionHistory
from turgor.core.model.obstacles.pose import Pose
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


class SearchMode(Enum):
    """How partners of contact are found: unchanged, followed from side to side, or searched for globally."""

    KEEP = "keep"
    FOLLOW = "follow"
    GLOBAL = "global"


@dataclass(frozen=True, slots=True, eq=False)
class Gaps:
    """How near the points of a surface are to what they may touch, at one position.

    Parameters
    ----------
    x, normal : (s, q, 3) array
        Positions and unit normals of the quadrature points.
    growth : (s, q) array
        Deformed area over the area of the reference side.
    partner : (s, q) int array
        Side that is nearest, −1 for none; zeros for obstacles without sides.
    at : (s, q, 2) array
        Place of the nearest point on it.
    gap : (s, q) array
        Distance, negative inside, inf where nothing is near.
    pose : Pose
        Where the obstacle is, scaled.
    covered : (s, q) array
        Share of each point that what it touches covers: less than 1 where a sharp rim passes it.
    friction : FrictionHistory or None
        With which the points slip; None where there is no friction.
    """

    x: Array
    normal: Array
    growth: Array
    partner: Ints
    at: Array
    gap: Array
    pose: Pose
    covered: Array
    friction: FrictionHistory | None = None

    @property
    def touching(self) -> Ints:
        """Side and quadrature point (k, 2) of the points inside."""
        return np.argwhere(self.inside)

    def also(self, other: "Gaps") -> Ints:
        """Side and quadrature point (k, 2) of the points inside here and there."""
        return np.argwhere(self.inside & other.inside)

    @property
    def inside(self) -> NDArray[np.bool_]:
        """Which points (s, q) are inside; round-off does not count."""
        return np.asarray((self.gap < -ROUND_OFF.zero) & (self.covered > 0))

    @property
    def pressed(self) -> Array:
        """Signed gap (s, q), less deep as far as a point is not covered."""
        return np.where(self.gap < 0, self.covered * self.gap, self.gap)


@dataclass(frozen=True, slots=True, eq=False)
class Ties:
    """Tangents of tied unknowns: a row of unknowns for each, −1 for none, and the lower triangles' source."""

    unknowns: Ints
    local: Array

    def add_to(self, data: Array, pattern: Pattern) -> None:
        """Add to the lower triangle of the tangent; an unknown may be listed twice in a row."""
        rows, columns = np.tril_indices(self.unknowns.shape[1])
        row, column = self.unknowns[:, rows], self.unknowns[:, columns]
        twice = (row == column) & (rows != columns)
        values = self.local[:, rows, columns] * (1.0 + twice)
        there = (row >= 0) & (column >= 0)
        positions = locate(pattern.indptr, pattern.indices, row[there], column[there])
        scatter_add(data, positions, values[there])


def groups(keys: Ints) -> tuple[Ints, Ints, Ints]:
    """Order that brings equal keys together, where each group starts (and ends), and the keys of the groups."""
    order = np.argsort(keys, kind="stable")
    unique, start = np.unique(keys[order], return_index=True)
    return order, np.append(start, len(keys)).astype(np.int64), unique


def nodal(nodes: Ints, local: Array, count: int) -> Array:
    """Sum forces (k, m, 3) on nodes (k, m) into (count, 3)."""
    flat = nodes.ravel()
    columns = [np.bincount(flat, local[..., i].ravel(), minlength=count) for i in range(3)]
    return np.stack(columns, axis=1)


def dofs(nodes: Ints) -> Ints:
    """Unknowns (g, 3 m) of nodes (g, m), −1 where there is no node."""
    out = np.where(nodes[:, :, None] >= 0, 3 * nodes[:, :, None] + np.arange(3), -1)
    return np.asarray(out.reshape(len(nodes), 3 * nodes.shape[1]))
