"""Multi-point constraints: degrees of freedom that are weighted sums of others, by elimination.

Each follower has the value that its leaders give it. The forces and the stiffness of the followers are added to those
of the leaders, and the followers leave the equations: their unknowns are zero and count as prescribed. No penalty and
no multiplier is needed, and the tangent stays symmetric where it was.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.algebra.pattern import Pattern, scatter_add, spread_entries

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class MultiPoint:
    """Followers, their leaders, and the weights with which they follow.

    Parameters
    ----------
    followers : (k,) int array
        Degrees of freedom of displacements, along the directions of their nodes; one that follows several leaders
        stands there once for each.
    leaders : (k,) int array
        The degree of freedom that each follows; no leader follows.
    weights : (k,) array
        A follower is the sum of its leaders times their weights.
    """

    followers: Ints
    leaders: Ints
    weights: Array

    def fill(self, unknowns: Array) -> Array:
        """Unknowns in which every follower has the value that its leaders give it."""
        if not len(self.followers):
            return unknowns
        out = unknowns.copy()
        sums = np.bincount(self.followers, self.weights * unknowns[self.leaders], minlength=len(out))
        out[self.followers] = sums[self.followers]
        return out

    def gather(self, forces: Array) -> Array:
        """Forces in which each leader has those of its followers besides its own, and the followers have none."""
        if not len(self.followers):
            return forces
        out = forces + np.bincount(self.leaders, self.weights * forces[self.followers], minlength=len(forces))
        out[self.followers] = 0.0
        return out

    def reduce(self, matrix: sp.csc_matrix) -> sp.csc_matrix:
        """Rows and columns of the followers added to those of their leaders."""
        if not len(self.followers):
            return matrix
        spread = self.spread(matrix.shape[0])
        return (spread.T @ matrix @ spread).tocsc()

    def spread(self, size: int) -> sp.csr_matrix:
        """All unknowns (size, size) from those that do not follow."""
        free = np.setdiff1d(np.arange(size), self.followers)
        rows, columns = np.concatenate([free, self.followers]), np.concatenate([free, self.leaders])
        values = np.concatenate([np.ones(len(free)), self.weights])
        return sp.csr_matrix((values, (rows, columns)), shape=(size, size))

    def extended(self, rows: Ints) -> Ints:
        """Rows (m, n) of unknowns that something couples, −1 for none, with the leaders of the followers among them.

        The whole nodes of the leaders are added, because directions are turned node by node. Rows without a follower
        are left out. A row may name an unknown several times.
        """
        size = int(max(rows.max(initial=0), self.followers.max())) + 1
        used = np.zeros(size + 1, dtype=bool)
        used[rows.ravel()] = True
        there = used[self.followers] & (self.followers < size)
        if not there.any():
            return rows[:0]
        pairs = np.unique(np.stack([self.followers[there], self.leaders[there] // 3], axis=1), axis=0)
        count = np.bincount(pairs[:, 0])[pairs[:, 0]]
        first = np.searchsorted(pairs[:, 0], pairs[:, 0])
        of = np.full((size + 1, int(count.max())), -1)
        of[pairs[:, 0], np.arange(len(pairs)) - first] = pairs[:, 1]
        followed = of[rows]  # -1 in a row means none, and finds the last entry, which is -1
        has = (followed >= 0).any(axis=(1, 2))
        rows, followed = rows[has], followed[has]
        nodes = followed[:, (followed >= 0).any(axis=(0, 2))]
        nodes = nodes.reshape(len(rows), nodes.shape[1] * nodes.shape[2])
        return np.concatenate([rows, *(np.where(nodes >= 0, 3 * nodes + i, -1) for i in range(3))], axis=1)

    def places(self, pattern: Pattern) -> "Places":
        """Where the entries of the followers go in a pattern that has room for them."""
        follows = np.zeros(pattern.size, dtype=bool)
        follows[self.followers] = True
        entries = np.bincount(pattern.indices, minlength=pattern.size) + np.diff(pattern.indptr)
        follows &= entries > 2  # the stiffness of the others is zero
        return Places(*spread_entries(pattern, self.spread(pattern.size), follows))


@dataclass(frozen=True, slots=True, eq=False)
class Places:
    """Entries of the lower triangle of a matrix that are added to others.

    Parameters
    ----------
    sources, targets : (k,) int array
        Positions in the values of the lower triangle.
    weights : (k,) array
    """

    sources: Ints
    targets: NDArray[np.int32]
    weights: Array

    def add(self, data: Array) -> None:
        """Move the stiffness of the followers to their leaders, in place."""
        scatter_add(data, self.targets, self.weights * data[self.sources])
        data[self.sources] = 0.0


#: Where nothing is tied.
UNTIED = MultiPoint(np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64), np.zeros(0))
