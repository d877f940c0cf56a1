"""Frames of nodes: local directions for nodes that are fixed along other directions than the coordinate axes.

The displacement of such a node is counted along three unit vectors, of which the fixed ones are prescribed as any other
component; its rows and columns of the tangent are turned with it. No penalty and no multiplier is needed, and the
sparsity stays as it is.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.algebra.pattern import Pattern
from turgor.core.engine.compiled import LOOP

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class NodeFrames:
    """Nodes with directions of their own; all others keep x, y and z.

    Parameters
    ----------
    nodes : (k,) int array
    axes : (k, 3, 3) array
        Three unit vectors of each, in rows.
    """

    nodes: Ints
    axes: Array

    def to_local(self, vectors: Array) -> Array:
        """Components of nodal vectors (n, 3) along the directions of their nodes."""
        return self._turned(vectors, self.axes)

    def to_global(self, components: Array) -> Array:
        """Nodal vectors (n, 3) from their components along the directions of their nodes."""
        return self._turned(components, self.axes.transpose(0, 2, 1))

    def _turned(self, values: Array, axes: Array) -> Array:
        if not len(self.nodes):
            return values
        out = values.copy()
        out[self.nodes] = np.einsum("kij,kj->ki", axes, values[self.nodes])
        return out

    def turn_tangent(self, pattern: Pattern, data: Array, node_count: int) -> None:
        """Turn the rows and columns of a lower triangle, in place."""
        if len(self.nodes):
            place = np.full(node_count, -1)
            place[self.nodes] = np.arange(len(self.nodes))
            turn_lower(data, pattern.indptr, pattern.indices, place, self.axes)

    def turn_matrix(self, matrix: sp.csc_matrix) -> sp.csc_matrix:
        """Turn the rows and columns of a matrix of all unknowns."""
        if not len(self.nodes):
            return matrix
        own = 3 * self.nodes[:, None] + np.arange(3)
        rest = np.setdiff1d(np.arange(matrix.shape[0]), own)
        rows = np.concatenate([np.repeat(own, 3, axis=1).ravel(), rest])
        columns = np.concatenate([np.tile(own, (1, 3)).ravel(), rest])
        values = np.concatenate([self.axes.ravel(), np.ones(len(rest))])
        turn = sp.csc_matrix((values, (rows, columns)), shape=matrix.shape)
        return (turn @ matrix @ turn.T).tocsc()


@njit(**LOOP)
def turn_lower(data: Array, indptr: Ints, indices: NDArray[np.int32], place: Ints, axes: Array) -> None:
    """Turn K into A K Aᵀ with a block A of each node, in the lower triangle of K; ``place`` is −1 where A is one."""
    block, half = np.empty((3, 3)), np.empty((3, 3))
    for b in range(len(place)):
        if place[b] >= 0:
            A = axes[place[b]]
            for j in range(3):
                for i in range(j, 3):
                    block[i, j] = data[indptr[3 * b + j] + i - j]
                    block[j, i] = block[i, j]
            for i in range(3):
                for j in range(3):
                    half[i, j] = A[i, 0] * block[0, j] + A[i, 1] * block[1, j] + A[i, 2] * block[2, j]
            for j in range(3):
                for i in range(j, 3):
                    turned = half[i, 0] * A[j, 0] + half[i, 1] * A[j, 1] + half[i, 2] * A[j, 2]
                    data[indptr[3 * b + j] + i - j] = turned
            for r in range(indptr[3 * b + 1] - indptr[3 * b] - 3):
                p0, p1, p2 = indptr[3 * b] + 3 + r, indptr[3 * b + 1] + 2 + r, indptr[3 * b + 2] + 1 + r
                d0, d1, d2 = data[p0], data[p1], data[p2]
                data[p0] = A[0, 0] * d0 + A[0, 1] * d1 + A[0, 2] * d2
                data[p1] = A[1, 0] * d0 + A[1, 1] * d1 + A[1, 2] * d2
                data[p2] = A[2, 0] * d0 + A[2, 1] * d1 + A[2, 2] * d2
        for j in range(3):
            p = indptr[3 * b + j] + 3 - j
            while p < indptr[3 * b + j + 1]:
                a = indices[p] // 3
                if a >= len(place):
                    break
                if place[a] >= 0:
                    A = axes[place[a]]
                    d0, d1, d2 = data[p], data[p + 1], data[p + 2]
                    data[p] = A[0, 0] * d0 + A[0, 1] * d1 + A[0, 2] * d2
                    data[p + 1] = A[1, 0] * d0 + A[1, 1] * d1 + A[1, 2] * d2
                    data[p + 2] = A[2, 0] * d0 + A[2, 1] * d1 + A[2, 2] * d2
                p += 3


def across_fixed(nodes: Ints, normals: Array, mask: NDArray[np.bool_]) -> tuple[Ints, Array]:
    """Find what normals add to the components that are fixed: unit vectors, at right angles to each other at a node.

    Parameters
    ----------
    nodes : (k,) int array
        A node stands there once for each of its normals.
    normals : (k, 3) array
    mask : (n, 3) bool array
        Fixed components along x, y and z of all nodes.

    Returns
    -------
    nodes : (m,) int array
        Sorted; without normals that add nothing.
    directions : (m, 3) array

    Examples
    --------
    >>> mask = np.array([[True, False, False]])
    >>> across_fixed(np.array([0, 0]), np.array([[0.6, 0.8, 0], [0, 0.6, 0.8]]), mask)[1] + 0.0
    array([[0., 1., 0.],
           [0., 0., 1.]])
    """
    order = np.argsort(nodes, kind="stable")
    nodes, rest = nodes[order], np.where(mask[nodes[order]], 0.0, normals[order])
    rank = np.arange(len(nodes)) - np.searchsorted(nodes, nodes)
    for number in range(rank.max(initial=-1) + 1):
        rows = np.flatnonzero(rank == number)
        for other in range(1, number + 1):
            before = rest[rows - other]
            rest[rows] -= np.einsum("ki,ki->k", before, rest[rows])[:, None] * before
        length = np.linalg.norm(rest[rows], axis=1)[:, None]
        rest[rows] = np.where(length > 1e-6, rest[rows] / np.maximum(length, 1e-6), 0.0)
    adds = rest.any(axis=1)
    return nodes[adds], rest[adds]
