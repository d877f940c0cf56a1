"""Iterative: GMRES for large tangents, preconditioned with two levels for displacement and a mass for mean stress.

The time of factors grows with the power 1.8 of the unknowns beyond 100,000. That of a cycle and the memory of what is
here grow in proportion, and the iterations grow slowly. So it is for models whose factors do not fit into the memory;
up to a million unknowns it is not faster (`docs/architecture.md`).

The tangent is [A Bᵀ; B −C]. Its preconditioner is the upper triangle of blocks [A' Bᵀ; 0 −S'], with one cycle of two
levels for A and S' = 2 M/μ + C for the Schur complement, where M/μ is the mass of mean stress over the shear modulus
(Elman, Silvester and Wathen 2014, chapter 4).
"""

from collections.abc import Callable

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.algebra.iterative.krylov import gmres
from turgor.core.engine.algebra.iterative.levels import Levels
from turgor.core.engine.algebra.iterative.two_level import TwoLevels
from turgor.core.engine.algebra.linear import REFINED, LinearSolver, Rslab
from turgor.core.engine.algebra.pattern import Pattern
from turgor.core.engine.algebra.settings import ITERATIVE_SOLVER
from turgor.core.engine.algebra.singular import SingularTangentError

Array = NDArray[np.float64]


class IterativeSolver:
    """Solve by GMRES; turn to the factors of a direct solver where it does not converge, from then on.

    Parameters
    ----------
    levels : Levels
    pattern : Pattern
    threads : int
    direct : callable
        Makes the direct solver, when one is first needed.

    Attributes
    ----------
    iterations : int
        Of all solutions up to now.
    """

    def __init__(self, levels: Levels, pattern: Pattern, threads: int, direct: Callable[[], LinearSolver]) -> None:
        self._pattern, self._levels, self._threads, self._make = pattern, levels, threads, direct
        self._direct: LinearSolver | None = None
        self._direct_holds = False  # the present tangent
        self._direct_only = False
        self._nodes = 3 * levels.nodes
        self._inverse = TwoLevels(levels, pattern, threads)
        self._blocks = _Blocks(pattern, self._nodes)
        self._data, self._coupling = np.empty(0), sp.csr_matrix((0, 0))
        self._schur: Rslab | None = None
        self.iterations = 0

    @property
    def name(self) -> str:
        """Name of what solves the present tangent."""
        return self._direct_solver().name if self._direct_only else "gmres, two levels"

    @property
    def iterative(self) -> bool:
        """Whether it still iterates."""
        return not self._direct_only

    @property
    def double(self) -> bool:
        """Whether it factors from now on, in double precision: many accurate solutions are cheaper then."""
        return self._direct_only

    @double.setter
    def double(self, value: bool) -> None:
        if value:
            self._direct_only = True
            self._direct_solver().double = True

    def _direct_solver(self) -> LinearSolver:
        if self._direct is None:
            self._direct = self._make()
        return self._direct

    def factor(self, data: Array) -> None:
        """Take new values, and make the preconditioner."""
        self._data, self._direct_holds = data, False
        if self._direct_only:
            return self._factor_directly()
        try:
            self._inverse.factor(data)
            self._coupling = self._blocks.coupling(data)
            schur = (ITERATIVE_SOLVER.schur_weight * self._levels.mass - self._blocks.corner(data)).tocsc()
            schur.sort_indices()
            if self._schur is None:
                self._schur = Rslab(
                    Pattern(schur.shape[0], schur.indptr.astype(np.int64), schur.indices), self._threads
                )
            self._schur.factor(schur.data, False)
        except SingularTangentError:
            self._give_up()

    def _give_up(self) -> None:
        """Factor from now on."""
        self._direct_only = True
        self._factor_directly()

    def _factor_directly(self) -> None:
        self._direct_holds = True
        self._direct_solver().factor(self._data)

    def solve(self, right: Array, reduction: float = REFINED) -> Array:
        """Solve to a relative residual; with factors where these are there."""
        if not self._direct_holds:
            solution, used = gmres(self._product, self._precondition, right, reduction, ITERATIVE_SOLVER.iterations)
            self.iterations += used
            if solution is not None:
                return solution
            self._give_up()
        return self._direct_solver().solve(right, reduction)

    def _product(self, vector: Array) -> Array:
        return self._pattern.product(self._data, vector)

    def _precondition(self, right: Array) -> Array:
        """Solve with the upper triangle of blocks."""
        assert self._schur is not None
        split = self._nodes
        mean = -self._schur.solve(right[split:])
        return np.concatenate([self._inverse.solve(right[:split] - self._coupling @ mean), mean])

    def negative_pivots(self, expected: int) -> int | None:
        """Negative pivots of the factors that are there, else None: GMRES has none."""
        return self._direct_solver().negative_pivots(expected) if self._direct_holds else None


class _Blocks:
    """Where the blocks besides that of the displacements stand in the lower triangle."""

    def __init__(self, pattern: Pattern, split: int) -> None:
        columns = np.repeat(np.arange(pattern.size), np.diff(pattern.indptr))
        below = pattern.indices >= split
        self._coupled = np.flatnonzero(below & (columns < split))
        self._shape = (split, pattern.size - split)
        count = np.bincount(columns[self._coupled], minlength=split)
        self._indptr = np.concatenate([[0], np.cumsum(count)])
        self._indices = pattern.indices[self._coupled] - split
        first = int(pattern.indptr[split])
        self._corner = slice(first, len(pattern.indices))
        self._corner_rows = pattern.indices[first:] - split, pattern.indptr[split:] - first

    def coupling(self, data: Array) -> sp.csr_matrix:
        """The block Bᵀ (displacements, mean stresses)."""
        return sp.csr_matrix((data[self._coupled], self._indices, self._indptr), shape=self._shape)

    def corner(self, data: Array) -> sp.csc_matrix:
        """The block −C, its lower triangle."""
        size = self._shape[1]
        return sp.csc_matrix((data[self._corner], *self._corner_rows), shape=(size, size))
