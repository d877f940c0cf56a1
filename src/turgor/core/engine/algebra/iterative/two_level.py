"""Two levels: a Gauss-Seidel sweep on the nodes, the vertices solved directly, and a sweep back.

The vertices carry linear displacements, an eighth of the unknowns. Their stiffness is the fine one between linear
displacements (Galerkin), so that membranes, contact and the stress of a bent state are in it. This is p-multigrid with
two levels (Ronquist and Patera 1987).
"""

import numpy as np
import scipy.sparse as sp
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.algebra.iterative.levels import Levels
from turgor.core.engine.algebra.iterative.node_blocks import NodeBlocks, block_structure, node_blocks
from turgor.core.engine.algebra.linear import Rslab
from turgor.core.engine.algebra.pattern import Pattern
from turgor.core.engine.compiled import LOOP

Singles = NDArray[np.float32]


class TwoLevels:
    """Approximate inverse of the displacement part of a tangent, symmetric and always the same.

    Parameters
    ----------
    levels : Levels
    pattern : Pattern
        Of the whole tangent, whose first unknowns are the displacements.
    threads : int
        Of the coarse factorization.
    """

    def __init__(self, levels: Levels, pattern: Pattern, threads: int) -> None:
        self._levels, self._pattern, self._threads = levels, pattern, threads
        self._rows = block_structure(pattern, levels.nodes)
        self._free = levels.free.astype(np.float32)
        self._vertex_free = self._free[levels.vertices].ravel()
        self._coarse_rows = self._coarse_structure()
        self._children = _children(levels)
        self._blocks: NodeBlocks | None = None
        self._coarse: Rslab | None = None

    def factor(self, data: NDArray[np.float64]) -> None:
        """Take new values of the tangent; raise `SingularTangentError` where that fails."""
        self._blocks = node_blocks(self._pattern, data, self._rows)
        indptr, indices = self._coarse_rows
        values = np.zeros((len(indices), 3, 3), dtype=np.float32)
        fine = self._blocks.indptr, self._blocks.indices, self._blocks.values
        vertex_free = self._vertex_free.reshape(-1, 3)
        _galerkin(self._coarse_rows, values, fine, (self._levels.parents, self._free), self._children, vertex_free)
        size = 3 * (len(indptr) - 1)
        upper = sp.triu(sp.bsr_matrix((values, indices, indptr), shape=(size, size)), format="csr")
        upper.sort_indices()  # rows of the upper triangle are columns of the lower one
        if self._coarse is None:
            self._coarse = Rslab(Pattern(size, upper.indptr.astype(np.int64), upper.indices), self._threads)
        self._coarse.factor(upper.data, True)

    def solve(self, right: NDArray[np.float64]) -> NDArray[np.float64]:
        """One cycle from zero."""
        assert self._blocks is not None and self._coarse is not None
        forces = right.astype(np.float32)
        solution, rest = self._blocks.presmooth(forces)
        parents, free = self._levels.parents, self._free
        coarse = self._coarse.solve(_restricted(rest, parents, free, len(self._levels.vertices)) * self._vertex_free)
        _prolong(solution, coarse.astype(np.float32), parents, free)
        self._blocks.postsmooth(forces, solution)
        return solution.astype(np.float64)

    def _coarse_structure(self) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
        """Upper triangle of the coarse matrix, by rows of vertices."""
        indptr, indices = self._rows
        nodes, vertices = self._levels.nodes, len(self._levels.vertices)
        ones = np.ones(len(indices), dtype=np.float32)
        fine = sp.csr_matrix((ones, indices, indptr), shape=(nodes, nodes))
        to = sp.csr_matrix(
            (np.ones(2 * nodes, np.float32), self._levels.parents.ravel(), np.arange(0, 2 * nodes + 1, 2)),
            shape=(nodes, vertices),
        )
        coarse = sp.triu(to.T @ (fine @ to), format="csr")
        coarse.sort_indices()
        return coarse.indptr.astype(np.int64), coarse.indices.astype(np.int32)


def _children(levels: Levels) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """Nodes that each vertex is a parent of, twice where it is both."""
    flat = levels.parents.ravel()
    order = np.argsort(flat, kind="stable")
    count = np.bincount(flat, minlength=len(levels.vertices))
    return np.concatenate([[0], np.cumsum(count)]).astype(np.int64), (order // 2).astype(np.int32)


@njit(**LOOP)
def _galerkin(coarse, values, fine, down, children, vertex_free):
    """Coarse stiffness: each entry of the fine one goes to both parents of both nodes, half to each."""
    (coarse_indptr, coarse_indices), (indptr, indices, blocks) = coarse, fine
    (parents, free), (child_indptr, child_indices) = down, children
    vertices = len(coarse_indptr) - 1
    spot = np.empty(vertices, dtype=np.int64)
    for vertex in range(vertices):
        for k in range(coarse_indptr[vertex], coarse_indptr[vertex + 1]):
            spot[coarse_indices[k]] = k
        for c in range(child_indptr[vertex], child_indptr[vertex + 1]):
            node = child_indices[c]
            for k in range(indptr[node], indptr[node + 1]):
                other = indices[k]
                for side in range(2):
                    if parents[other, side] >= vertex:
                        at = spot[parents[other, side]]
                        for a in range(3):
                            for b in range(3):
                                share = np.float32(0.25) * free[node, a] * free[other, b]
                                values[at, a, b] += share * blocks[k, a, b]
        for k in range(coarse_indptr[vertex], coarse_indptr[vertex + 1]):
            other = coarse_indices[k]
            for a in range(3):
                for b in range(3):
                    values[k, a, b] *= vertex_free[vertex, a] * vertex_free[other, b]
                if other == vertex and vertex_free[vertex, a] == 0:
                    values[k, a, a] = 1


@njit(**LOOP)
def _restricted(residual, parents, free, vertices):
    """Forces on the vertices, half of those on each node to each parent."""
    out = np.zeros(3 * vertices, dtype=np.float32)
    for node in range(len(parents)):
        for side in range(2):
            at = 3 * parents[node, side]
            for a in range(3):
                out[at + a] += np.float32(0.5) * free[node, a] * residual[3 * node + a]
    return out


@njit(**LOOP)
def _prolong(solution, coarse, parents, free):
    """Add the coarse displacements, the mean of those of both parents."""
    for node in range(len(parents)):
        first, second = 3 * parents[node, 0], 3 * parents[node, 1]
        for a in range(3):
            solution[3 * node + a] += np.float32(0.5) * free[node, a] * (coarse[first + a] + coarse[second + a])
