"""Multi-point constraints: forces and matrices of what follows are added to those of the leader."""

import numpy as np
import pytest
import scipy.sparse as sp

from turgor.core.engine.algebra.multipoint import UNTIED, MultiPoint
from turgor.core.engine.algebra.pattern import build_pattern
from turgor.core.engine.contact.couplings import Layout

#: Six nodes in a row, cells of two; the z components of the last two follow those of the first two.
CELLS = np.array([np.arange(3 * i, 3 * i + 6) for i in range(5)])
SIZE = 18
TIES = MultiPoint(np.array([14, 17, 17]), np.array([2, 2, 5]), np.array([1.0, 0.5, -2.0]))


def _layout():
    held = np.isin(np.arange(SIZE), TIES.followers)
    return Layout(build_pattern(CELLS, SIZE, TIES.extended(CELLS)), held, TIES)


def _spread():
    """Every unknown of those that stay: the matrix T of u = T q."""
    out = np.eye(SIZE)
    out[TIES.followers] = 0.0
    out[TIES.followers, TIES.leaders] = TIES.weights
    return out


def _random(layout, rows):
    """Values of a symmetric matrix that couples what some rows of unknowns couple."""
    matrix = np.zeros((SIZE, SIZE))
    rng = np.random.default_rng(1)
    for row in rows:
        local = rng.standard_normal((len(row), len(row)))
        matrix[np.ix_(row, row)] += local + local.T
    pattern = layout.pattern
    columns = np.repeat(np.arange(SIZE), np.diff(pattern.indptr))
    return matrix, matrix[pattern.indices, columns]


@pytest.mark.parametrize("far", [[], [[6, 7, 8, 15, 16, 17]]], ids=["cells", "contact"])
def test_the_stiffness_goes_to_the_leader(far):
    layout = _layout()
    if far:  # as contact couples nodes that share no cell
        layout.renew(np.array([5]), [np.array(far)])
    matrix, data = _random(layout, [*CELLS, *far])
    layout.reduce(data)
    expected = _spread().T @ matrix @ _spread()
    assert np.abs(expected[2, 8]) > 0.01 or not far
    assert layout.pattern.full(data).toarray() == pytest.approx(expected, abs=1e-12)


def test_any_matrix_and_forces_are_reduced():
    rng = np.random.default_rng(2)
    matrix, forces = rng.standard_normal((SIZE, SIZE)), rng.standard_normal(SIZE)
    assert TIES.reduce(sp.csc_matrix(matrix)).toarray() == pytest.approx(_spread().T @ matrix @ _spread())
    assert TIES.gather(forces) == pytest.approx(_spread().T @ forces)
    filled = TIES.fill(forces)
    assert filled[[14, 17]] == pytest.approx([forces[2], 0.5 * forces[2] - 2.0 * forces[5]])
    assert np.delete(filled, [14, 17]) == pytest.approx(np.delete(forces, [14, 17]))


def test_the_mass_is_reduced_in_the_pattern_of_the_cells():
    layout = _layout()
    matrix, data = _random(layout, CELLS)
    layout.reduce_base(data)
    assert layout.base.full(data).toarray() == pytest.approx(_spread().T @ matrix @ _spread(), abs=1e-12)


def test_without_constraints_nothing_changes():
    values = np.arange(5.0)
    assert UNTIED.fill(values) is values
    assert UNTIED.gather(values) is values
