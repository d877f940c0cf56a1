"""Multi-point constraints: degrees of freedom that are equal to another one, by elimination.

Each follower has the value of its leader. The forces and the stiffness of the followers are added to those of the
leader, and the followers leave the equations: their unknowns are zero and count as prescribed. No penalty and no
multiplier is needed, and the tangent stays symmetric where it was.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.engine.algebra.pattern import Pattern, locate, scatter_add

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class MultiPoint:
    """Followers and their leaders.

    Parameters
    ----------
    followers : (k,) int array
        Degrees of freedom of displacements, along the directions of their nodes.
    leaders : (k,) int array
        The degree of freedom that each follows; no leader follows.
    """

    followers: Ints
    leaders: Ints

    def fill(self, unknowns: Array) -> Array:
        """Unknowns in which every follower has the value of its leader."""
        if not len(self.followers):
            return unknowns
        out = unknowns.copy()
        out[self.followers] = unknowns[self.leaders]
        return out

    def gather(self, forces: Array) -> Array:
        """Forces in which each leader has those of its followers besides its own, and the followers have none."""
        if not len(self.followers):
            return forces
        out = forces.copy()
        np.add.at(out, self.leaders, forces[self.followers])
        out[self.followers] = 0.0
        return out

    def reduce(self, matrix: sp.csc_matrix) -> sp.csc_matrix:
        """Rows and columns of the followers added to those of their leaders."""
        if not len(self.followers):
            return matrix
        size = matrix.shape[0]
        column = np.arange(size)
        column[self.followers] = self.leaders
        spread = sp.csc_matrix((np.ones(size), (np.arange(size), column)), shape=(size, size))
        return (spread.T @ matrix @ spread).tocsc()

    def extended(self, rows: Ints) -> Ints:
        """Rows (m, n) of unknowns that something couples, −1 for none, with the leaders of the followers among them.

        The whole nodes of the leaders are added, because directions are turned node by node. Rows without a follower
        are left out. A row may name an unknown several times.
        """
        size = int(max(rows.max(initial=0), self.followers.max())) + 1
        leader = np.full(size + 1, -1)
        leader[self.followers] = self.leaders
        of = leader[rows]  # -1 in a row means none, and finds the last entry, which is -1
        has = (of >= 0).any(axis=1)
        rows, of = rows[has], of[has]
        columns = np.flatnonzero((of >= 0).any(axis=0))
        nodes = np.where(of[:, columns] >= 0, 3 * (of[:, columns] // 3), -1)
        whole = [np.where(nodes >= 0, nodes + i, -1) for i in range(3)]
        return np.concatenate([rows, *whole], axis=1)

    def places(self, pattern: Pattern) -> "Places":
        """Where the entries of the followers go in a pattern that has room for them."""
        leader = np.arange(pattern.size)
        leader[self.followers] = self.leaders
        columns = np.repeat(np.arange(pattern.size), np.diff(pattern.indptr))
        rows = pattern.indices.astype(np.int64)
        sources = np.flatnonzero((leader[rows] != rows) | (leader[columns] != columns))
        to_row, to_column = leader[rows[sources]], leader[columns[sources]]
        targets = locate(pattern.indptr, pattern.indices, to_row, to_column)
        both = (to_row == to_column) & (rows[sources] != columns[sources])  # this entry and its mirror image
        return Places(sources, targets, np.where(both, 2.0, 1.0))


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
UNTIED = MultiPoint(np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64))
