"""Numbering of free motions, and a banded solver for the tangent of rods."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dgbtrf, dgbtrs
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import reverse_cuthill_mckee

from turgor.fast_models.rod.layout import Layout

Array = NDArray[np.float64]


class Band:
    """Numbering of the free motions and a banded solver for their tangent."""

    def __init__(self, layout: Layout) -> None:
        count, ends = len(layout.free), layout.ends
        both = np.concatenate([ends, ends[:, ::-1]])
        graph = csr_matrix((np.ones(len(both)), (both[:, 0], both[:, 1])), shape=(count, count))
        order = reverse_cuthill_mckee(graph, symmetric_mode=True)
        free = layout.free[order].ravel()
        number = np.full(6 * count, -1)
        number.reshape(count, 6)[order] = np.where(free, np.cumsum(free) - 1, -1).reshape(count, 6)
        self.number = number
        self.size = int(free.sum())
        self.of_node = np.flatnonzero(number >= 0)
        at = number.reshape(count, 6)
        row = np.concatenate([_spread(at[ends], 1), _spread_own(at, 1)])
        column = np.concatenate([_spread(at[ends], 2), _spread_own(at, 2)])
        self._in_system = (row >= 0) & (column >= 0)
        row, column = row[self._in_system], column[self._in_system]
        self.width = int(np.abs(row - column).max(initial=0))
        self._place = (2 * self.width + row - column) * self.size + column

    def factor(self, blocks: Array, own: Array) -> "Factors":
        """Factor the tangent of elements (e, 2, 2, 6, 6) and nodes (n, 6, 6).

        Raises
        ------
        FloatingPointError
            If it is singular.
        """
        values = np.concatenate([blocks.ravel(), own.ravel()])[self._in_system]
        rows = 3 * self.width + 1
        band = np.bincount(self._place, values, rows * self.size).reshape(rows, self.size)
        lu, pivots, info = dgbtrf(band, self.width, self.width, overwrite_ab=True)
        if info != 0:
            raise FloatingPointError("singular tangent")
        return Factors(self, lu, pivots)

    def dense(self, blocks: Array, own: Array) -> Array:
        """Return the tangent as a full matrix."""
        values = np.concatenate([blocks.ravel(), own.ravel()])[self._in_system]
        line, column = np.divmod(self._place, self.size)
        matrix = np.zeros((self.size, self.size))
        np.add.at(matrix, (line - 2 * self.width + column, column), values)
        return matrix


@dataclass(frozen=True, slots=True, eq=False)
class Factors:
    """A factored tangent."""

    band: Band
    lu: Array
    pivots: NDArray[np.intc]

    def solve(self, *sides: Array) -> list[Array]:
        """Return the motions (n, 6) that belong to wrenches (n, 6) on the nodes."""
        band = self.band
        right = np.zeros((band.size, len(sides)))
        for k, side in enumerate(sides):
            right[band.number[band.of_node], k] = side.ravel()[band.of_node]
        solutions, _ = dgbtrs(self.lu, band.width, band.width, right, self.pivots)
        answers = []
        for k, side in enumerate(sides):
            answer = np.zeros(side.size)
            answer[band.of_node] = solutions[band.number[band.of_node], k]
            answers.append(answer.reshape(side.shape))
        return answers


def _spread(at: NDArray[np.intp], axis: int) -> NDArray[np.intp]:
    """Numbers of rows (axis 1) or columns (axis 2) of every entry of the element blocks (e, 2, 2, 6, 6)."""
    by_row = at[:, :, None, :, None] if axis == 1 else at[:, None, :, None, :]
    return np.broadcast_to(by_row, (len(at), 2, 2, 6, 6)).ravel()


def _spread_own(at: NDArray[np.intp], axis: int) -> NDArray[np.intp]:
    by_row = at[:, :, None] if axis == 1 else at[:, None, :]
    return np.broadcast_to(by_row, (len(at), 6, 6)).ravel()
