"""Tangent: assemble it, apply the supports, factor it and solve, with the time that each takes."""

from dataclasses import dataclass
from functools import partial
from time import perf_counter

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.algebra.free_solver import solver_of
from turgor.core.engine.algebra.linear import (
    AUTO,
    ITERATIVE,
    REFINED,
    LinearSolver,
    UnsymmetricSolver,
    factors_fit,
    linear_solver,
)
from turgor.core.engine.algebra.pattern import Pattern
from turgor.core.engine.algebra.settings import LINEAR_SOLVER
from turgor.core.engine.evaluation import Evaluation, Stresses
from turgor.core.engine.runtime import MIXED, PLAIN
from turgor.core.engine.system import System

Array = NDArray[np.float64]
Columns = tuple[Array, NDArray[np.int32], NDArray[np.int32]]


@dataclass(slots=True)
class Clock:
    """Wall time spent [s] and how often.

    Parameters
    ----------
    assembly : float
        Forming tangents.
    residual : float
        Evaluating residuals and linearized stresses, predictions included.
    factorization, solve : float
        Factoring tangents and solving with the factors.
    factorizations : int
        Tangents formed and factored.
    """

    assembly: float = 0.0
    residual: float = 0.0
    factorization: float = 0.0
    solve: float = 0.0
    factorizations: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Factored:
    """Factors of a step that the next one may use.

    Parameters
    ----------
    double : bool
        Whether the linear solver has turned to double precision for good.
    data : (nnz,) array
        Values of the lower triangle that was factored last, supports applied; empty where no step uses it again.
    whole, rubbing : (data, indices, indptr) or None
        The unsymmetric matrix, and the unsymmetric part of friction besides a symmetric one.
    """

    double: bool
    data: Array
    whole: Columns | None = None
    rubbing: Columns | None = None


class Tangent:
    """The factored tangent of a system, supports applied.

    Parameters
    ----------
    system : System
    solver : str
        ``"auto"``, ``"iterative"``, ``"rslab"`` or ``"mkl-pardiso"``.
    threads : int
    iteration : str
        Which tangents Newton's method asks for, and how often; see `EngineOptions`.
    """

    def __init__(self, system: System, solver: str, threads: int, iteration: str = MIXED) -> None:
        self._system = system
        self._solver, self._threads = solver, threads
        self.mixed_points, self.plain = iteration == MIXED, iteration == PLAIN
        self.clock = Clock()
        self._symmetric: LinearSolver | None = None
        self._general: UnsymmetricSolver | None = None
        self._analyzed = system.pattern
        self._rubbing: sp.csc_matrix | None = None
        self._data: Array = np.empty(0)
        self._unknowns: Array | None = None
        self._whole: sp.csc_matrix | None = None
        if system.terms.symmetric:
            self._symmetric = self._new_solver(system.pattern)
        else:
            self._general = UnsymmetricSolver(threads)

    @property
    def name(self) -> str:
        """Name of the linear solver."""
        return self._active.name

    @property
    def iterative(self) -> bool:
        """Whether each digit of a solution costs iterations, and a new tangent costs little."""
        return self._active.iterative

    @property
    def _active(self) -> LinearSolver | UnsymmetricSolver:
        active = self._symmetric or self._general
        assert active is not None
        return active

    def factor(
        self, at: Evaluation, geometric: Stresses | None = None, jump: Array | None = None, shift: float = 0.0
    ) -> Array:
        """Form and factor the tangent; return the forces that belong to the right side besides the residual.

        These are the forces that moving the prescribed unknowns by ``jump`` would cause, and the correction of stresses
        that the tangent is linearized about.

        ``shift`` is added to the diagonal of the free displacements, to make it positive where it is not.
        """
        self._unknowns = None
        coupling = self._formed(at, geometric, jump, shift)
        start = perf_counter()
        self._factor()
        self._unknowns = at.unknowns
        self.clock.factorization += perf_counter() - start
        self.clock.factorizations += 1
        return coupling

    def has_factors_of(self, unknowns: Array) -> bool:
        """Whether the last factors are those at these unknowns, the same array."""
        return self._unknowns is unknowns

    def renew(self, at: Evaluation) -> None:
        """Form the exact tangent at a state close to that of the factors, and keep these: `product` has the new matrix.

        A solution is refined then. Where other walls touch, the factors are new as well.
        """
        self._system.lay_out(at)
        if self._general is None and self._analyzed is not self._system.pattern:
            self.factor(at)
        self._unknowns = None
        self._formed(at, None, None, 0.0, exact=True)

    def _formed(
        self, at: Evaluation, geometric: Stresses | None, jump: Array | None, shift: float, exact: bool = False
    ) -> Array:
        """Form the tangent; `factor` says what it returns."""
        start = perf_counter()
        system = self._system
        data = system.tangent_data(at, geometric, exact)
        skew = system.skew_matrix(at)
        coupling = np.zeros(system.size)
        if jump is not None and jump.any():
            moved = np.zeros(system.size)
            moved[system.prescribed] = jump
            coupling = system.pattern.product(data, moved)
            if skew is not None:
                coupling += skew @ moved
        correction = None if geometric is None else system.correction(at, geometric)
        if correction is not None:
            coupling += correction
        rubbing = system.rubbing(at)
        self._rubbing = None if rubbing is None else sp.diags((~system.prescribed).astype(np.float64)) @ rubbing
        if rubbing is not None and self.iterative:
            self.use_double()  # GMRES for friction wants the symmetric part inverted
        system.apply_supports(data)
        system.make_definite(data)
        if shift:
            free = np.flatnonzero(system.moving & ~system.prescribed)
            data[system.pattern.diagonal[free]] += shift
        self._data, self._whole = data, None
        if self._symmetric is None:
            assert skew is not None
            free = sp.diags((~system.prescribed).astype(np.float64))
            self._whole = (system.pattern.full(data) + free @ skew @ free).tocsc()
        self.clock.assembly += perf_counter() - start
        return coupling

    def _factor(self) -> None:
        """Factor the present matrix."""
        if self._general is not None:
            self._general.factor_matrix(self._whole)
            return
        self._analyze()
        assert self._symmetric is not None
        self._symmetric.factor(self._data)

    def _analyze(self) -> None:
        """Analyze the present pattern, if it is another one than before."""
        pattern = self._system.pattern
        if self._general is None and self._analyzed is not pattern:  # walls touch that did not before
            double = self._symmetric is not None and self._symmetric.double
            self._symmetric, self._analyzed = None, pattern
            self._symmetric = self._new_solver(pattern)
            self._symmetric.double = self._symmetric.double or double

    def _new_solver(self, pattern: Pattern) -> LinearSolver:
        system, name = self._system, self._solver
        make = partial(linear_solver, name, threads=self._threads)
        direct = partial(solver_of, make, pattern, system.prescribed)
        iterative = name == ITERATIVE or (name == AUTO and not factors_fit(pattern, self._threads))
        if not iterative:
            return direct()
        from turgor.core.engine.algebra.iterative.levels import levels_of  # here: factors serve most models
        from turgor.core.engine.algebra.iterative.solver import IterativeSolver

        levels = levels_of(system)
        return direct() if levels is None else IterativeSolver(levels, pattern, self._threads, direct)

    def use_double(self) -> None:
        """Factor in double precision from now on: many accurate solutions with one tangent need no refinement then."""
        if self._symmetric is not None:
            self._symmetric.double = True

    def factored(self, again: bool) -> Factored:
        """Return the factors for the next step, with the matrix if it uses them ``again``."""
        double = self._symmetric is not None and self._symmetric.double
        if not again:
            return Factored(double, np.empty(0))
        return Factored(double, self._data, _columns(self._whole), _columns(self._rubbing))

    def restore(self, last: Factored) -> None:
        """Go on as after the last step, with its factors where the next one uses them; contact must be restored."""
        self._data, self._whole, self._rubbing = last.data, self._matrix(last.whole), self._matrix(last.rubbing)
        self._analyze()
        if self._symmetric is not None:
            self._symmetric.double = last.double
        if len(self._data):
            self._factor()

    def _matrix(self, columns: Columns | None) -> sp.csc_matrix | None:
        size = self._system.size
        return None if columns is None else sp.csc_matrix(columns, shape=(size, size))

    def solve(self, right: Array, reduction: float = REFINED) -> Array:
        """Solve with the last factors, up to a relative residual of ``reduction``."""
        start, rubbing = perf_counter(), self._rubbing
        out = self._active.solve(right, reduction) if rubbing is None else self._with_rubbing(rubbing, right)
        self.clock.solve += perf_counter() - start
        return out

    def product(self, vector: Array) -> Array:
        """Product of the last factored matrix, in which the equations of prescribed unknowns are identities."""
        whole = self._system.pattern.product(self._data, vector) if self._whole is None else self._whole @ vector
        return np.asarray(whole if self._rubbing is None else whole + self._rubbing @ vector)

    def _with_rubbing(self, rubbing: sp.csc_matrix, right: Array) -> Array:
        """Solve with the unsymmetric part of friction, by GMRES preconditioned with the symmetric factors."""
        from scipy.sparse.linalg import LinearOperator, gmres  # slow to load, and few runs have walls that rub

        size, active = len(right), self._active
        operator = LinearOperator((size, size), matvec=lambda x: x + active.solve(rubbing @ x), dtype=np.float64)
        first = active.solve(right)
        out, _ = gmres(
            operator, first, rtol=LINEAR_SOLVER.rubbing_residual, restart=LINEAR_SOLVER.rubbing_solves, maxiter=1
        )
        return np.asarray(out)

    def unstable_modes(self) -> int | None:
        """Negative pivots beyond one for each multiplier; None where the solver does not count them."""
        expected = self._system.constraint_count
        negative = self._active.negative_pivots(expected)
        return None if negative is None else max(0, negative - expected)


def _columns(matrix: sp.csc_matrix | None) -> Columns | None:
    if matrix is None:
        return None
    whole = matrix.tocsc()
    return whole.data, whole.indices, whole.indptr
