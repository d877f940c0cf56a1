"""Sparsity: the lower triangle of the tangent by columns, and where each cell's entries go in it."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numba import njit
from numpy.typing import NDArray

from turgor.engine.compiled import LOOP


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


def build_pattern(cell_unknowns: NDArray[np.int64], size: int, *more: NDArray[np.int64]) -> Pattern:
    """Build the lower triangle from the (c, n) unknowns of the cells, and of what else ties unknowns, −1 for none."""
    incidence = sp.vstack([_incidence(unknowns, size) for unknowns in (cell_unknowns, *more)], format="csr")
    graph = sp.tril(incidence.T @ incidence + sp.identity(size, dtype=np.int32), format="csc")
    graph.sort_indices()
    return Pattern(size, graph.indptr.astype(np.int64), graph.indices.astype(np.int32))


def _incidence(unknowns: NDArray[np.int64], size: int) -> sp.csr_matrix:
    rows, places = np.nonzero(unknowns >= 0)
    return sp.csr_matrix(
        (np.ones(rows.size, dtype=np.int32), (rows, unknowns[rows, places])), shape=(len(unknowns), size)
    )


@njit(**LOOP)
def locate(indptr, indices, rows, columns):
    """Positions of entries (row, column), swapped into the lower triangle where needed, (k,) int32; -1 if absent."""
    out = np.empty(len(rows), dtype=np.int32)
    for k in range(len(rows)):
        row = max(rows[k], columns[k])
        column = min(rows[k], columns[k])
        low, high = indptr[column], indptr[column + 1]
        while low < high:
            middle = (low + high) // 2
            if indices[middle] < row:
                low = middle + 1
            else:
                high = middle
        out[k] = low if low < indptr[column + 1] and indices[low] == row else -1
    return out


@njit(**LOOP)
def scatter_add(data, positions, values):
    """Add values at positions, in order, so that the sum does not depend on the number of threads."""
    for k in range(len(positions)):
        data[positions[k]] += values[k]
