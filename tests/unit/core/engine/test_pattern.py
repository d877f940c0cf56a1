"""The pattern of the tangent, and where the entries of cells stand in it."""

import numpy as np
import pytest

from turgor.core.engine.algebra.pattern import build_pattern, cell_places, locate

SIZE = 40
RANDOM = np.random.default_rng(3)
CELLS = np.array([RANDOM.permutation(SIZE - 4)[:7] for _ in range(30)])
TIES = np.array([[0, 37, -1], [38, 5, 5], [-1, -1, -1]])


def expected(*pieces: np.ndarray) -> np.ndarray:
    """Which unknowns stand in a row together, and each with itself."""
    out = np.eye(SIZE, dtype=bool)
    for row in [row for piece in pieces for row in piece.tolist()]:
        there = [unknown for unknown in row if unknown >= 0]
        out[np.ix_(there, there)] = True
    return np.tril(out)


@pytest.mark.parametrize("more", [(), (TIES,)])
def test_pattern_has_the_pairs_of_every_row_and_the_diagonal(more: tuple[np.ndarray, ...]) -> None:
    pattern, there = build_pattern(CELLS, SIZE, *more), expected(CELLS, *more)
    for column in range(SIZE):
        rows = pattern.indices[pattern.indptr[column] : pattern.indptr[column + 1]]
        np.testing.assert_array_equal(rows, np.flatnonzero(there[:, column]))
    np.testing.assert_array_equal(pattern.indices[pattern.diagonal], np.arange(SIZE))


def test_places_of_cells_are_those_that_a_search_finds() -> None:
    pattern = build_pattern(CELLS, SIZE, TIES)
    rows, columns = np.tril_indices(CELLS.shape[1])
    result = locate(pattern.indptr, pattern.indices, CELLS[:, rows].ravel(), CELLS[:, columns].ravel())
    np.testing.assert_array_equal(cell_places(pattern, CELLS).ravel(), result)
    assert result.min() >= 0


def test_a_pattern_without_ties_is_the_diagonal() -> None:
    pattern = build_pattern(np.zeros((0, 4), dtype=np.int64), 3)
    assert pattern.indices.tolist() == [0, 1, 2]
    assert pattern.indptr.tolist() == [0, 1, 2, 3]
