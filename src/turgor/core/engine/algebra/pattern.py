"""Sparsity: the lower triangle of the tangent by columns, and where each cell's entries go in it."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.compiled import INNER, LOOP, over

Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Pattern:
    """Lower triangle in compressed columns, with the diagonal always present.

    Parameters
    ----------
    size : int
        Number of unknowns.
    indptr : (size + 1,) int array
    indices : (nnz,) int array
        Rows of each column, rising.
    """

    size: int
    indptr: NDArray[np.int64]
    indices: NDArray[np.int32]

    @property
    def diagonal(self) -> NDArray[np.int64]:
        """Positions of the diagonal entries: the first of each column."""
        return self.indptr[:-1]

    def matrix(self, data: NDArray[np.float64]) -> sp.csc_matrix:
        """The lower triangle as a SciPy matrix."""
        return sp.csc_matrix((data, self.indices, self.indptr), shape=(self.size, self.size))

    def product(self, data: NDArray[np.float64], vector: NDArray[np.float64]) -> NDArray[np.float64]:
        """Product of the full symmetric matrix with a vector."""
        lower = self.matrix(data)
        return np.asarray(lower @ vector + lower.T @ vector - data[self.diagonal] * vector)

    def full(self, data: NDArray[np.float64]) -> sp.csc_matrix:
        """The full symmetric matrix."""
        lower = self.matrix(data)
        return (lower + sp.tril(lower, -1).T).tocsc()


def build_pattern(cell_unknowns: Ints, size: int, *more: Ints) -> Pattern:
    """Build the lower triangle from the (c, n) unknowns of the cells, and of what else ties unknowns, −1 for none."""
    groups = [unknowns for unknowns in (cell_unknowns, *more) if unknowns.size]
    none = np.zeros(0, dtype=np.int64)
    members = np.concatenate([none, *(unknowns.ravel() for unknowns in groups)])
    widths = np.concatenate([none, *(np.full(len(unknowns), unknowns.shape[1]) for unknowns in groups)])
    first = np.concatenate([[0], np.cumsum(widths)]).astype(np.int64)
    of_first, of = _transposed(members, size)
    piece = np.repeat(np.arange(len(first) - 1), np.diff(first))[of]  # pieces of each unknown
    indptr = np.zeros(size + 1, dtype=np.int64)
    over(size, _fill_column, indptr, np.empty(0, dtype=np.int32), (first, members), (of_first, piece))
    np.cumsum(indptr, out=indptr)
    indices = np.empty(int(indptr[-1]), dtype=np.int32)
    over(size, _fill_column, indptr, indices, (first, members), (of_first, piece))
    return Pattern(size, indptr, indices)


def cell_places(pattern: Pattern, unknowns: Ints) -> NDArray[np.int32]:
    """Where the entries of all cells stand in a pattern that has them, lower triangles packed row by row.

    Each column is laid open once, and every entry of it read off: no search.
    """
    width = unknowns.shape[1]
    out = np.empty((len(unknowns), width * (width + 1) // 2), dtype=np.int32)
    of_first, of = _transposed(unknowns.ravel(), pattern.size)
    over(pattern.size, _place_column, out, pattern.indptr, pattern.indices, (of_first, of), unknowns)
    return out


@njit(**LOOP)
def _transposed(members, size):
    """Places of every unknown in a flat list, (size + 1,) and (k,); −1 in the list is no unknown."""
    first, free = np.empty(size + 1, dtype=np.int64), np.empty(size + 1, dtype=np.int64)
    for unknown in range(size + 1):
        first[unknown] = 0
    for k in range(len(members)):
        if members[k] >= 0:
            first[members[k] + 1] += 1
    free[0] = 0
    for unknown in range(size):
        first[unknown + 1] += first[unknown]
        free[unknown + 1] = first[unknown + 1]
    places = np.empty(first[size], dtype=np.int64)
    for k in range(len(members)):
        if members[k] >= 0:
            places[free[members[k]]] = k
            free[members[k]] += 1
    return first, places


@njit(**LOOP)
def _fill_column(begin, end, indptr, indices, pieces, of):
    """Rows of each column, rising: the unknowns on and below the diagonal that share a piece with it.

    Where ``indices`` has no place, it only counts them, into the place in ``indptr`` after that of the column.
    """
    (first, members), (of_first, piece) = pieces, of
    counts = len(indices) == 0
    last = np.empty(len(indptr) - 1, dtype=np.int64)
    for column in range(len(last)):
        last[column] = -1
    for column in range(begin, end):
        last[column] = column
        start = 0 if counts else indptr[column]
        free = start + 1
        for e in range(of_first[column], of_first[column + 1]):
            for k in range(first[piece[e]], first[piece[e] + 1]):
                row = members[k]
                if row > column and last[row] != column:
                    last[row] = column
                    if not counts:
                        indices[free] = row
                    free += 1
        if counts:
            indptr[column + 1] = free
        else:
            indices[start] = column
            _sort(indices, start, free)


@njit(**INNER)
def _sort(values, begin, end):
    """Sort a part of a list in place (Shell 1959, gaps of Ciura 2001): numba's own sort takes long to compile."""
    for gap in (701, 301, 132, 57, 23, 10, 4, 1):
        for k in range(begin + gap, end):
            value, free = values[k], k
            while free >= begin + gap and values[free - gap] > value:
                values[free] = values[free - gap]
                free -= gap
            values[free] = value


@njit(**LOOP)
def _place_column(begin, end, out, indptr, indices, of, unknowns):
    """Places of the cells' entries in each column."""
    of_first, places = of
    width = unknowns.shape[1]
    spot = np.empty(len(indptr) - 1, dtype=np.int32)
    for column in range(begin, end):
        for k in range(indptr[column], indptr[column + 1]):
            spot[indices[k]] = k
        for e in range(of_first[column], of_first[column + 1]):
            cell, own = places[e] // width, places[e] % width
            for other in range(width):
                row = unknowns[cell, other]
                if row >= column:
                    high, low = (own, other) if own > other else (other, own)
                    out[cell, high * (high + 1) // 2 + low] = spot[row]


@njit(**LOOP)
def locate(indptr, indices, rows, columns):
    """Positions of entries (row, column), swapped into the lower triangle where needed, (k,) int32; -1 if absent."""
    out = np.empty(len(rows), dtype=np.int32)
    for k in range(len(rows)):
        out[k] = _position(indptr, indices, rows[k], columns[k])
    return out


@njit(**INNER)
def _position(indptr, indices, one, other):
    row, column = max(one, other), min(one, other)
    low, high = indptr[column], indptr[column + 1]
    while low < high:
        middle = (low + high) // 2
        if indices[middle] < row:
            low = middle + 1
        else:
            high = middle
    return low if low < indptr[column + 1] and indices[low] == row else -1


def spread_entries(
    pattern: Pattern, spread: sp.csr_matrix, follows: NDArray[np.bool_]
) -> tuple[Ints, NDArray[np.int32], NDArray[np.float64]]:
    """Where entries in rows and columns of unknowns that follow go: from, to, and with which weights, (k,) each.

    Row i of ``spread`` has the weights of the unknowns that unknown i stands for. An entry off the diagonal stands for
    its mirror image too: each pair of leaders has it once, one leader twice.
    """
    ends = np.zeros(pattern.size + 1, dtype=np.int64)
    none = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int32), np.empty(0)
    lower, rows = (pattern.indptr, pattern.indices), (spread.indptr, spread.indices, spread.data)
    over(pattern.size, _spread_column, ends, none, lower, rows, follows)
    np.cumsum(ends, out=ends)
    count = int(ends[-1])
    out = np.empty(count, dtype=np.int64), np.empty(count, dtype=np.int32), np.empty(count)
    over(pattern.size, _spread_column, ends, out, lower, rows, follows)
    return out


@njit(**LOOP)
def _spread_column(begin, end, ends, out, lower, spread, follows):
    """Entries of each column; where there is no place for them, they are counted into the place after the column."""
    (sources, targets, weights), (indptr, indices), (first, leaders, shares) = out, lower, spread
    counts = len(sources) == 0
    for column in range(begin, end):
        free = 0 if counts else ends[column]
        for k in range(indptr[column], indptr[column + 1]):
            row = indices[k]
            if not (follows[row] or follows[column]):
                continue
            for i in range(first[row], first[row + 1]):
                for j in range(first[column], first[column + 1]):
                    weight, one, other = shares[i] * shares[j], leaders[i], leaders[j]
                    if weight == 0 or (row == column and one < other):
                        continue
                    if not counts:
                        sources[free], targets[free] = k, _position(indptr, indices, one, other)
                        weights[free] = 2 * weight if row != column and one == other else weight
                    free += 1
        if counts:
            ends[column + 1] = free


@njit(**LOOP)
def scatter_add(data, positions, values):
    """Add values at positions, in order, so that the sum does not depend on the number of threads."""
    for k in range(len(positions)):
        data[positions[k]] += values[k]
