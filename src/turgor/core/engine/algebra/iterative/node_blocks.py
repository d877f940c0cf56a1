"""Node blocks: the displacement part of the tangent as 3 by 3 blocks, and Gauss-Seidel's sweeps over its nodes.

The blocks are in single precision, because they only precondition. That halves the memory that each sweep reads, which
is what a sweep costs.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.algebra.pattern import Pattern
from turgor.core.engine.algebra.singular import SingularTangentError
from turgor.core.engine.compiled import INNER, LOOP

Singles = NDArray[np.float32]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class NodeBlocks:
    """All blocks of a symmetric matrix by rows of nodes, and the inverses of those on the diagonal.

    Parameters
    ----------
    indptr : (n + 1,) int array
    indices : (k,) int array
        Nodes of each row, rising; its own node is always there.
    values : (k, 3, 3) array
    inverses : (n, 3, 3) array
    """

    indptr: Ints
    indices: NDArray[np.int32]
    values: Singles
    inverses: Singles

    def presmooth(self, right: Singles) -> tuple[Singles, Singles]:
        """One forward sweep from zero: the solution and the residual that it leaves, for the price of one product."""
        solution, residual = np.empty_like(right), np.empty_like(right)
        _forward(self.indptr, self.indices, self.values, self.inverses, right, solution, residual)
        return solution, residual

    def postsmooth(self, right: Singles, solution: Singles) -> None:
        """One backward sweep, in place."""
        _backward(self.indptr, self.indices, self.values, self.inverses, right, solution)


def block_structure(pattern: Pattern, nodes: int) -> tuple[Ints, NDArray[np.int32]]:
    """Rows of nodes (n + 1,) and (k,), of the first 3 n unknowns of a pattern."""
    count = _row_lengths(pattern.indptr, pattern.indices, nodes)
    indptr = np.concatenate([[0], np.cumsum(count)]).astype(np.int64)
    indices = np.empty(indptr[-1], dtype=np.int32)
    _fill_rows(pattern.indptr, pattern.indices, indptr, indices)
    return indptr, indices


def node_blocks(pattern: Pattern, data: NDArray[np.float64], rows: tuple[Ints, NDArray[np.int32]]) -> NodeBlocks:
    """Blocks of the values of a lower triangle; raise `SingularTangentError` where one on the diagonal is singular."""
    indptr, indices = rows
    values = np.zeros((len(indices), 3, 3), dtype=np.float32)
    own = np.empty(len(indptr) - 1, dtype=np.int64)
    _fill_blocks(pattern.indptr, pattern.indices, data, (indptr, indices), values, own)
    try:
        inverses = np.linalg.inv(values[own])
    except np.linalg.LinAlgError as error:
        raise SingularTangentError("the stiffness of a node is singular") from error
    return NodeBlocks(indptr, indices, values, inverses)


@njit(**LOOP)
def _row_lengths(indptr, indices, nodes):
    """Blocks in each row of nodes."""
    count = np.zeros(nodes, dtype=np.int64)
    last = np.full(nodes, -1, dtype=np.int64)
    for column in range(nodes):
        for k in range(indptr[3 * column], indptr[3 * column + 3]):
            row = indices[k] // 3
            if row < nodes and last[row] != column:
                last[row] = column
                count[column] += 1
                count[row] += row != column
    return count


@njit(**LOOP)
def _fill_rows(indptr, indices, block_indptr, block_indices):
    """Nodes of each row, rising: first those below it, which earlier columns have put there."""
    nodes = len(block_indptr) - 1
    free = block_indptr[:-1].copy()
    last = np.full(nodes, -1, dtype=np.int64)
    for column in range(nodes):
        first = free[column]
        for k in range(indptr[3 * column], indptr[3 * column + 3]):
            row = indices[k] // 3
            if row < nodes and last[row] != column:
                last[row] = column
                block_indices[free[column]] = row
                free[column] += 1
                if row != column:
                    block_indices[free[row]] = column
                    free[row] += 1
        block_indices[first : free[column]].sort()


@njit(**LOOP)
def _fill_blocks(indptr, indices, data, rows, values, own):
    """Blocks from the lower triangle, on both sides of the diagonal; ``own`` are the places of those on it."""
    block_indptr, block_indices = rows
    nodes = len(block_indptr) - 1
    below = block_indptr[:-1].copy()  # where the next column stands in each row below it
    spot = np.empty(nodes, dtype=np.int64)
    for column in range(nodes):
        own[column] = below[column]
        for k in range(own[column], block_indptr[column + 1]):
            spot[block_indices[k]] = k
        for a in range(3):
            for k in range(indptr[3 * column + a], indptr[3 * column + a + 1]):
                row = indices[k] // 3
                if row >= nodes:
                    break
                b = indices[k] - 3 * row
                values[spot[row], a, b] = data[k]
                values[below[row], b, a] = data[k]
        for k in range(own[column] + 1, block_indptr[column + 1]):
            below[block_indices[k]] += 1


@njit(**INNER)
def _take(block, x, at, s):
    """Subtract the product of a block with the three values at a node."""
    x0, x1, x2 = x[at], x[at + 1], x[at + 2]
    return (
        s[0] - (block[0, 0] * x0 + block[0, 1] * x1 + block[0, 2] * x2),
        s[1] - (block[1, 0] * x0 + block[1, 1] * x1 + block[1, 2] * x2),
        s[2] - (block[2, 0] * x0 + block[2, 1] * x1 + block[2, 2] * x2),
    )


@njit(**INNER)
def _add(block, x, at, s):
    """Add the product of a block with three sums to the values at a node."""
    for a in range(3):
        x[at + a] += block[a, 0] * s[0] + block[a, 1] * s[1] + block[a, 2] * s[2]


@njit(**LOOP)
def _forward(indptr, indices, values, inverses, right, solution, residual):
    """Solve with the lower triangle of blocks; what is left are the products of the upper one."""
    nodes = len(indptr) - 1
    solution[:] = 0
    for node in range(nodes):
        s = (right[3 * node], right[3 * node + 1], right[3 * node + 2])
        k = indptr[node]
        while indices[k] < node:
            s = _take(values[k], solution, 3 * indices[k], s)
            k += 1
        _add(inverses[node], solution, 3 * node, s)
    for node in range(nodes):
        s = (np.float32(0), np.float32(0), np.float32(0))
        k = indptr[node + 1] - 1
        while indices[k] > node:
            s = _take(values[k], solution, 3 * indices[k], s)
            k -= 1
        residual[3 * node], residual[3 * node + 1], residual[3 * node + 2] = s


@njit(**LOOP)
def _backward(indptr, indices, values, inverses, right, solution):
    """Gauss-Seidel from the last node to the first."""
    for node in range(len(indptr) - 2, -1, -1):
        s = (right[3 * node], right[3 * node + 1], right[3 * node + 2])
        for k in range(indptr[node], indptr[node + 1]):
            s = _take(values[k], solution, 3 * indices[k], s)
        _add(inverses[node], solution, 3 * node, s)
