"""Linear solvers for the symmetric indefinite tangent: analyze once, factor, solve, count negative pivots."""

import os
from collections.abc import Callable
from typing import Protocol

import numpy as np
import rslab
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.algebra.iterative.krylov import gmres
from turgor.core.engine.algebra.pardiso import Pardiso, load_mkl
from turgor.core.engine.algebra.pattern import Pattern
from turgor.core.engine.algebra.result_cache import last_results
from turgor.core.engine.algebra.settings import LINEAR_SOLVER
from turgor.core.engine.algebra.singular import SingularTangentError as SingularTangentError
from turgor.foundation.errors import unknown

Array = NDArray[np.float64]

#: Name that leaves the choice, and the one that asks for GMRES, of the equations that it is for; others are factored.
AUTO, ITERATIVE = "auto", "iterative"

#: Relative residual that may be left: by new factors, and by those of an earlier iterate, which leave more than that of
#: the residual anyway.
REFINED, ROUGH = 1e-5, 1e-3


class LinearSolver(Protocol):
    """Factor the tangent and solve with it."""

    double: bool
    """Whether all factors are in double precision from now on."""

    @property
    def name(self) -> str:
        """Name of what solves."""

    @property
    def iterative(self) -> bool:
        """Whether each digit of a solution costs iterations, and a new matrix costs little."""

    def factor(self, data: Array) -> None:
        """Factor the values of the analyzed lower triangle."""

    def solve(self, right: Array, reduction: float = REFINED) -> Array:
        """Solve with the last factors, up to a relative residual of ``reduction``."""

    def negative_pivots(self, expected: int) -> int | None:
        """Negative pivots of the last factors, None where the solver does not count them; ``expected`` if stable."""


class Factors(Protocol):
    """Interface of a library: LDLᵀ factors of one analyzed pattern, in single or double precision."""

    name: str

    def factor(self, data: Array, single: bool) -> None:
        """Factor new values; raise `SingularTangentError` where that fails."""

    def solve(self, right: Array) -> Array:
        """Solve with the last factors, as well as they do it."""

    def negative_pivots(self) -> int:
        """Negative pivots of the last factors."""


class MixedPrecision:
    """A linear solver whose factors are in single precision, a third faster and half as large, where that will do.

    The solution is refined against the matrix, that of a large one by GMRES where this settles slowly. A doubtful count
    of pivots is settled in double precision, and from the first solution on that refinement does not settle (a nearly
    singular tangent, a very stiff membrane) all factors are double.

    Parameters
    ----------
    factors : Factors
    pattern : Pattern
        The one that they were analyzed for.
    """

    iterative = False

    def __init__(self, factors: Factors, pattern: Pattern) -> None:
        self.name = factors.name
        self._factors, self._pattern = factors, pattern
        self._data = np.empty(0)
        self.double = pattern.size < LINEAR_SOLVER.small
        self._single = not self.double

    def factor(self, data: Array) -> None:
        """Factor new values on the analyzed pattern."""
        self._data = data
        self._single = not self.double
        if not self._single:
            return self._factors.factor(data, False)
        try:
            self._factors.factor(data, True)
        except SingularTangentError:
            self._factor_in_double()

    def _factor_in_double(self) -> None:
        self._single = False
        self._factors.factor(self._data, False)

    def solve(self, right: Array, reduction: float = REFINED) -> Array:
        """Solve; Newton's next residual corrects the rest."""
        solution = self._factors.solve(right)
        if not self._single:
            return solution
        size = last = float(np.linalg.norm(right))
        for _ in range(LINEAR_SOLVER.refinements + 1):
            residual = right - self._product(solution)
            norm = float(np.linalg.norm(residual))
            if norm <= reduction * size:
                return solution
            if not norm <= LINEAR_SOLVER.settling * last:
                break
            last = norm
            solution = solution + self._factors.solve(residual)
        return self._accelerated(right, reduction)

    def _accelerated(self, right: Array, reduction: float) -> Array:
        """Refine a large system by GMRES; small ones, and where that does not do, need double precision from now on."""
        if self._pattern.size >= LINEAR_SOLVER.accelerated_from:
            solution, _ = gmres(self._product, self._factors.solve, right, reduction, LINEAR_SOLVER.accelerated)
            if solution is not None:
                return solution
        self.double = True
        self._factor_in_double()
        return self._factors.solve(right)

    def _product(self, vector: Array) -> Array:
        return self._pattern.product(self._data, vector)

    def negative_pivots(self, expected: int) -> int | None:
        """Negative pivots from the inertia of D; an unexpected number is counted again in double precision."""
        negative = self._factors.negative_pivots()
        if negative != expected and self._single:
            self._factor_in_double()
            negative = self._factors.negative_pivots()
        return negative


@last_results(2)  # a run often has the mesh of the last one; two, because the mesh error needs a second mesh
def _analyzed(indptr: NDArray[np.int64], indices: NDArray[np.int32], threads: int, ordering: str) -> rslab.LdltSymbolic:
    """Order of elimination and structure of the factors of a lower triangle; its values do not matter."""
    pattern = Pattern(len(indptr) - 1, indptr, indices)
    return rslab.analyze(pattern.matrix(np.ones(len(indices))), path="ldlt", threads=threads, ordering=ordering)


def _analysis_of(pattern: Pattern, threads: int) -> rslab.LdltSymbolic:
    """The analysis of a pattern in the order that is best for its size."""
    ordering = "auto" if pattern.size < LINEAR_SOLVER.dissected_from else "metis"
    return _analyzed(pattern.indptr, pattern.indices, threads, ordering)


def factors_fit(pattern: Pattern, threads: int) -> bool:
    """Whether factors in single precision fit into the memory of this machine, as far as it tells how much there is."""
    memory = memory_of_machine()
    if pattern.size < LINEAR_SOLVER.large or memory is None:
        return True
    needed = _analysis_of(pattern, threads).estimate_memory("float32")["transient_peak_bytes"]
    return bool(needed <= LINEAR_SOLVER.share_of_memory * memory)


def memory_of_machine() -> int | None:
    """Memory of this machine [bytes]; None where the system does not tell, as on Windows."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return None


class Rslab:
    """LDLᵀ by rslab: pure Rust, MIT, wheels for all systems."""

    name = "rslab"

    def __init__(self, pattern: Pattern, threads: int) -> None:
        self._settings = {"threads": threads, "scaling": "identity"}
        self._symbolic = _analysis_of(pattern, threads)
        self._factor: rslab.Ldlt | None = None
        self._precision: type = np.float64

    def factor(self, data: Array, single: bool) -> None:
        """Factor new values."""
        self._factor = None  # frees the old factors before the new ones are made
        self._precision = np.float32 if single else np.float64  # of its own copy of the matrix, too
        try:
            floor = {"preconditioner": LINEAR_SOLVER.smallest_pivot} if single else {}
            self._factor = self._symbolic.factor(data.astype(self._precision, copy=False), **self._settings, **floor)
        except RuntimeError as error:
            raise SingularTangentError(str(error)) from error

    def solve(self, right: Array) -> Array:
        """Solve with the last factors."""
        assert self._factor is not None
        return np.asarray(self._factor.solve(right.astype(self._precision, copy=False)), dtype=np.float64)

    def negative_pivots(self) -> int:
        """Negative pivots from the inertia of D."""
        assert self._factor is not None
        _positive, negative, _zero = self._factor.inertia
        return int(negative)


class UnsymmetricSolver:
    """LU by rslab for the full tangent, for pressure on open surfaces whose tangent has a skew part."""

    name = "rslab-lu"
    iterative = False

    def __init__(self, threads: int) -> None:
        self._threads = threads
        self._factor: rslab.Lu | None = None

    def factor_matrix(self, matrix: sp.csc_matrix) -> None:
        """Factor a full matrix."""
        try:
            self._factor = rslab.lu(matrix, threads=self._threads)
        except RuntimeError as error:
            raise SingularTangentError(str(error)) from error

    def solve(self, right: Array, reduction: float = REFINED) -> Array:
        """Solve with one step of refinement."""
        assert self._factor is not None
        return np.asarray(self._factor.solve(right, refine=1))

    def negative_pivots(self, expected: int) -> int | None:
        """None, because LU factors do not give the inertia."""
        return None


_LIBRARIES: dict[str, Callable[[Pattern, int], Factors]] = {"rslab": Rslab, "mkl-pardiso": Pardiso}


def available_solvers() -> tuple[str, ...]:
    """Names of the solvers that this environment has, the fastest first."""
    return ("mkl-pardiso", "rslab") if load_mkl() is not None else ("rslab",)


def linear_solver(name: str, pattern: Pattern, threads: int) -> LinearSolver:
    """Make the named direct solver; others than a library's name take MKL Pardiso where installed, else rslab."""
    if name in (AUTO, ITERATIVE):
        name = available_solvers()[0]
    if name not in _LIBRARIES:
        raise unknown("linear solver", name, [*_LIBRARIES, AUTO, ITERATIVE])
    return MixedPrecision(_LIBRARIES[name](pattern, threads), pattern)
