"""Factors in single precision: refined, counted again, given up where they do not do; by every library there is."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp

from refused import refused
from turgor.core.engine.algebra import linear
from turgor.core.engine.algebra.linear import (
    MixedPrecision,
    Rslab,
    SingularTangentError,
    available_solvers,
    linear_solver,
)
from turgor.core.engine.algebra.pattern import Pattern
from turgor.core.engine.algebra.settings import LINEAR_SOLVER

SIDE = 30


def saddle(softest: float = 1.0) -> tuple[Pattern, np.ndarray, int]:
    """A stiff grid with a row of multipliers, as a lower triangle: pattern, values, negative pivots.

    The last of the free unknowns is as soft as given and tied to nothing.
    """
    line = sp.diags([np.full(SIDE - 1, -1.0), np.full(SIDE, 2.01)], [-1, 0])
    lower = sp.kron(sp.identity(SIDE), line) + sp.kron(line, sp.identity(SIDE))
    size = SIDE * SIDE
    rows = sp.csr_matrix((np.ones(SIDE), (np.arange(SIDE), np.arange(SIDE) * SIDE)), shape=(SIDE, size))
    whole = sp.bmat([[sp.tril(lower), None], [rows, -1e-3 * sp.identity(SIDE)]]).tocsc()
    whole = sp.block_diag([whole, sp.csc_matrix([[softest]])]).tocsc()
    whole.sort_indices()
    return Pattern(whole.shape[0], whole.indptr.astype(np.int64), whole.indices.astype(np.int32)), whole.data, SIDE


class Watched:
    """The factors of a library, and what was asked of them."""

    name = "watched"

    def __init__(self, inner: Rslab) -> None:
        self.inner, self.solves, self.singles = inner, 0, []

    def factor(self, data: np.ndarray, single: bool) -> None:
        self.singles.append(single)
        self.inner.factor(data, single)

    def solve(self, right: np.ndarray) -> np.ndarray:
        self.solves += 1
        return self.inner.solve(right)

    def negative_pivots(self) -> int:
        return self.inner.negative_pivots()


@pytest.fixture
def large(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every matrix counts as a large one."""
    monkeypatch.setattr(linear, "LINEAR_SOLVER", replace(LINEAR_SOLVER, small=1))


@pytest.mark.usefixtures("large")
@pytest.mark.parametrize("name", available_solvers())
@pytest.mark.parametrize("threads", [1, 2])
def test_refined_solution_and_pivots_of_every_library(name: str, threads: int) -> None:
    pattern, data, negative = saddle()
    solver, exact = linear_solver(name, pattern, threads), np.sin(np.arange(pattern.size))
    solver.factor(data)
    solution = solver.solve(pattern.product(data, exact))
    assert solution.dtype == np.float64
    assert not solver.double
    assert np.linalg.norm(solution - exact) < 1e-4 * np.linalg.norm(exact)
    assert solver.negative_pivots(negative) == negative


@pytest.mark.usefixtures("large")
def test_an_unexpected_count_is_settled_in_double_precision() -> None:
    pattern, data, negative = saddle()
    factors = Watched(Rslab(pattern, 1))
    solver = MixedPrecision(factors, pattern)
    solver.factor(data)
    assert solver.negative_pivots(negative) == negative
    assert factors.singles == [True]
    assert solver.negative_pivots(negative - 1) == negative
    assert factors.singles == [True, False]
    assert not solver.double  # the next factors are single again


@pytest.mark.usefixtures("large")
def test_refinement_that_does_not_settle_turns_to_double_precision_for_good(monkeypatch: pytest.MonkeyPatch) -> None:
    pattern, data, _ = saddle()
    factors = Watched(Rslab(pattern, 1))
    solver = MixedPrecision(factors, pattern)
    exact = np.cos(np.arange(pattern.size))
    right = pattern.product(data, exact)
    solver.factor(data)
    share = {True: 0.5, False: 1.0}  # single precision solves badly
    monkeypatch.setattr(Watched, "solve", lambda self, right: share[self.singles[-1]] * self.inner.solve(right))
    np.testing.assert_allclose(solver.solve(right), exact, rtol=1e-8, atol=1e-8)
    assert solver.double
    solver.factor(data)
    assert factors.singles == [True, False, False]


class Rough(Watched):
    """Factors whose solutions are wrong in a few directions, so that a refinement makes them worse."""

    def solve(self, right: np.ndarray) -> np.ndarray:
        out = super().solve(right)
        wrong = self.singles[-1]
        out[:WRONG] *= 3.5 if wrong else 1.0
        return out


#: Unknowns in which they are.
WRONG = 4


@pytest.mark.usefixtures("large")
@pytest.mark.parametrize("accelerated", [True, False], ids=["as large ones are", "as small ones are"])
def test_large_systems_whose_refinement_does_not_settle_are_refined_by_gmres(
    accelerated: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    pattern, data, _ = saddle()
    least = 1 if accelerated else pattern.size + 1
    monkeypatch.setattr(linear, "LINEAR_SOLVER", replace(linear.LINEAR_SOLVER, accelerated_from=least))
    factors = Rough(Rslab(pattern, 1))
    solver = MixedPrecision(factors, pattern)
    solver.factor(data)
    right = np.random.default_rng(4).normal(size=pattern.size)
    solution = solver.solve(right)
    assert np.linalg.norm(pattern.product(data, solution) - right) <= linear.REFINED * np.linalg.norm(right)
    assert factors.singles == ([True] if accelerated else [True, False])
    assert solver.double is not accelerated
    if accelerated:
        assert WRONG < factors.solves <= WRONG + 6


@pytest.mark.usefixtures("large")
def test_threads_change_no_digit() -> None:
    """The order of elimination depends on the size alone, and rslab's factors do not depend on threads."""
    pattern, data, _ = saddle()
    solutions = []
    for threads in (1, 2):
        factors = Rslab(pattern, threads)
        factors.factor(data, True)
        solutions.append(factors.solve(np.arange(1.0, pattern.size + 1)))
    np.testing.assert_array_equal(*solutions)


@pytest.mark.usefixtures("large")
def test_a_rough_solution_takes_fewer_solves(monkeypatch: pytest.MonkeyPatch) -> None:
    pattern, data, _ = saddle()
    factors = Watched(Rslab(pattern, 1))
    solver, right = MixedPrecision(factors, pattern), np.ones(pattern.size)
    solver.factor(data)
    plain = Rslab.solve
    monkeypatch.setattr(Rslab, "solve", lambda self, right: (1 - 1e-2) * plain(self, right))
    left = {}
    for share in (linear.ROUGH, linear.REFINED):
        before = factors.solves
        solution = solver.solve(right, share)
        assert np.linalg.norm(pattern.product(data, solution) - right) <= share * np.linalg.norm(right)
        left[share] = factors.solves - before
    assert left[linear.ROUGH] < left[linear.REFINED]


@pytest.mark.usefixtures("large")
def test_a_singular_matrix_is_an_error_in_both_precisions() -> None:
    pattern, data, _ = saddle()
    data[-1] = 0.0
    solver = MixedPrecision(Rslab(pattern, 1), pattern)
    solver.factor(data)  # single precision lifts the pivot, and the solution tells
    with pytest.raises(SingularTangentError):
        solver.solve(np.ones(pattern.size))
    assert solver.double
    with pytest.raises(SingularTangentError):
        solver.factor(data)


@pytest.mark.parametrize("softest", [1e-12, -1e-12])
def test_single_precision_lifts_small_pivots_and_keeps_their_signs(softest: float) -> None:
    pattern, data, negative = saddle(softest)
    factors, right = Rslab(pattern, 1), np.ones(pattern.size)
    for single, pivot in ((True, np.copysign(LINEAR_SOLVER.smallest_pivot, softest)), (False, softest)):
        factors.factor(data, single)
        assert factors.solve(right)[-1] == pytest.approx(1 / pivot, rel=1e-6)
        assert factors.negative_pivots() == negative + (softest < 0)


def test_small_matrices_are_factored_in_double_precision() -> None:
    pattern, data, _ = saddle()
    factors = Watched(Rslab(pattern, 1))
    solver = MixedPrecision(factors, pattern)
    solver.factor(data)
    assert solver.double
    assert factors.singles == [False]


def test_unknown_solver_is_named() -> None:
    with refused("rslb", "rslab"):
        linear_solver("rslb", saddle()[0], 1)
