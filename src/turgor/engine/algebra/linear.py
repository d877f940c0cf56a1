"""Linear solvers for the symmetric indefinite tangent: analyze once, factor, solve, count negative pivots."""

import ctypes
import sys
import weakref
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np
import rslab
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.engine.algebra.kept import kept
from turgor.engine.algebra.pattern import Pattern
from turgor.errors import TurgorError, unknown

Array = NDArray[np.float64]

#: Unknowns from which single precision factors pay; below, there is nothing to gain.
SINGLE_FROM = 10_000

#: Unknowns from which two threads or more factor faster in the order of nested dissection, by a quarter at 35,000, than
#: in the one with the fewest entries, whose tree of fronts is too narrow to share.
DISSECTED_FROM = 10_000

#: Refinements at most of a solution from single precision factors, and the relative residual that may be left.
REFINEMENTS = 4
REFINED = 1e-5


class SingularTangentError(RuntimeError):
    """The tangent could not be factored."""


class LinearSolver(Protocol):
    """Factor the tangent and solve with it."""

    name: str
    double: bool
    """Whether all factors are in double precision from now on."""

    def factor(self, data: Array) -> None:
        """Factor the values of the analyzed lower triangle."""

    def solve(self, right: Array) -> Array:
        """Solve with the last factors."""

    def negative_pivots(self, expected: int) -> int | None:
        """Negative pivots of the last factors, None where the solver does not count them; ``expected`` if stable."""


class RslabSolver:
    """LDLᵀ by rslab (pure Rust, MIT, wheels for all systems).

    Factors are single precision, a third faster and half as large, and the solution is refined against the matrix. A
    doubtful count of pivots is settled in double precision, and from the first solution on that refinement does not
    settle (a nearly singular tangent, a very stiff membrane) all factors are double.
    """

    name = "rslab"

    def __init__(self, pattern: Pattern, threads: int) -> None:
        self._pattern = pattern
        self._settings = {"threads": threads, "scaling": "identity"}
        ordering = "metis" if threads > 1 and pattern.size >= DISSECTED_FROM else "auto"
        self._symbolic = _analyzed(pattern.indptr, pattern.indices, threads, ordering)
        self._data = np.empty(0)
        self._factor: rslab.Ldlt | None = None
        self.double = pattern.size < SINGLE_FROM
        self._single = not self.double

    def factor(self, data: Array) -> None:
        """Factor new values on the analyzed pattern."""
        self._data = data
        self._factor = None  # frees the old factors before the new ones are made
        self._single = not self.double
        if not self._single:
            return self._factor_in_double()
        try:
            self._factor = self._symbolic.factor(data, factor_dtype="float32", **self._settings)
        except RuntimeError:
            self._factor_in_double()

    def _factor_in_double(self) -> None:
        self._factor, self._single = None, False
        try:
            self._factor = self._symbolic.factor(self._data, **self._settings)
        except RuntimeError as error:
            raise SingularTangentError(str(error)) from error

    def solve(self, right: Array) -> Array:
        """Solve; Newton's next residual corrects the rest."""
        assert self._factor is not None
        solution = np.asarray(self._factor.solve(right))
        if not self._single:
            return solution
        for _ in range(REFINEMENTS + 1):
            left_over = right - self._pattern.product(self._data, solution)
            if float(np.linalg.norm(left_over)) <= REFINED * float(np.linalg.norm(right)):
                return solution
            solution = solution + np.asarray(self._factor.solve(left_over))
        self.double = True
        self._factor_in_double()
        return np.asarray(self._factor.solve(right))

    def negative_pivots(self, expected: int) -> int | None:
        """Negative pivots from the inertia of D; an unexpected number is counted again in double precision."""
        negative = self._count()
        if negative != expected and self._single:
            self._factor_in_double()
            negative = self._count()
        return negative

    def _count(self) -> int:
        assert self._factor is not None
        _positive, negative, _zero = self._factor.diagnostics()["numeric"]["inertia"]
        return int(negative)


@kept(2)  # a run often has the mesh of the last one; two, because the mesh error is found on a second mesh
def _analyzed(indptr: NDArray[np.int64], indices: NDArray[np.int32], threads: int, ordering: str) -> rslab.LdltSymbolic:
    """Order of elimination and structure of the factors of a lower triangle; its values do not matter."""
    pattern = Pattern(len(indptr) - 1, indptr, indices)
    return rslab.analyze(pattern.matrix(np.ones(len(indices))), path="ldlt", threads=threads, ordering=ordering)


@dataclass(slots=True, eq=False)
class _PardisoArrays:
    """What Pardiso keeps between calls: its handle and settings, the matrix in its one-based form."""

    handle: NDArray[np.int64]
    settings: NDArray[np.int32]
    data: Array
    indptr: NDArray[np.int32]
    indices: NDArray[np.int32]


class PardisoSolver:
    """LDLᵀ by MKL Pardiso, type −2 without matching; faster, proprietary, used where turgor[fast] installed it."""

    name = "mkl-pardiso"

    double = True

    def __init__(self, pattern: Pattern, threads: int) -> None:
        mkl = _load_mkl()
        if mkl is None:
            raise TurgorError("linear solver 'mkl-pardiso' needs the package mkl; install it with turgor[fast].")
        mkl.MKL_Set_Num_Threads(ctypes.c_int(threads))
        self._mkl = mkl
        # the lower triangle by columns is the upper triangle by rows, which is what Pardiso reads
        self._arrays = _PardisoArrays(
            handle=np.zeros(64, dtype=np.int64),
            settings=np.zeros(64, dtype=np.int32),
            data=np.ones(len(pattern.indices)),
            indptr=(pattern.indptr + 1).astype(np.int32),
            indices=(pattern.indices + 1).astype(np.int32),
        )
        # 1: own settings; 2: parallel nested dissection; 8: no refinement; 10: pivot 1e-8; 11, 13: no scaling, no
        # matching (they depend on values and would force a new analysis); 21: 1 × 1 and 2 × 2 pivots; 24: two-level
        for index, value in ((0, 1), (1, 3), (7, 0), (9, 8), (10, 0), (12, 0), (20, 1), (23, 1)):
            self._arrays.settings[index] = value
        _call_pardiso(mkl, self._arrays, 11, None)
        # at interpreter exit the operating system takes the memory back, and NumPy may be gone by then
        weakref.finalize(self, _call_pardiso, mkl, self._arrays, -1, None).atexit = False

    def factor(self, data: Array) -> None:
        """Factor new values on the analyzed pattern."""
        self._arrays.data = np.ascontiguousarray(data)
        _call_pardiso(self._mkl, self._arrays, 22, None)

    def solve(self, right: Array) -> Array:
        """Solve; Newton's next residual corrects what round-off leaves."""
        return _call_pardiso(self._mkl, self._arrays, 33, right)

    def negative_pivots(self, expected: int) -> int | None:
        """Negative pivots, iparm(23)."""
        return int(self._arrays.settings[22])


def _call_pardiso(mkl: ctypes.CDLL, arrays: _PardisoArrays, phase: int, right: Array | None) -> Array:
    size = len(arrays.indptr) - 1
    vector = np.zeros(size) if right is None else np.ascontiguousarray(right)
    result = np.zeros(size)
    permutation = np.zeros(1, dtype=np.int32)
    error = ctypes.c_int(0)

    def integer(value: int) -> object:
        return ctypes.byref(ctypes.c_int(value))

    def pointer(array: NDArray) -> ctypes.c_void_p:
        return array.ctypes.data_as(ctypes.c_void_p)

    mkl.pardiso(
        pointer(arrays.handle),
        integer(1),
        integer(1),
        integer(-2),
        integer(phase),
        integer(size),
        pointer(arrays.data),
        pointer(arrays.indptr),
        pointer(arrays.indices),
        pointer(permutation),
        integer(1),
        pointer(arrays.settings),
        integer(0),
        pointer(vector),
        pointer(result),
        ctypes.byref(error),
    )
    if error.value:
        raise SingularTangentError(f"Pardiso returned {error.value} in phase {phase}")
    return result


def _load_mkl() -> ctypes.CDLL | None:
    """The MKL runtime of the current environment, None where it is not installed."""
    folders = [Path(sys.prefix) / "lib", Path(sys.prefix) / "Library" / "bin"]
    for folder in folders:
        for pattern in ("libmkl_rt.so*", "mkl_rt*.dll"):
            for path in sorted(folder.glob(pattern)):
                try:
                    return ctypes.CDLL(str(path))
                except OSError:
                    continue
    return None


class UnsymmetricSolver:
    """LU by rslab for the full tangent, for pressure on open surfaces whose tangent has a skew part."""

    name = "rslab-lu"

    def __init__(self, threads: int) -> None:
        self._threads = threads
        self._factor: rslab.Lu | None = None

    def factor_matrix(self, matrix: sp.csc_matrix) -> None:
        """Factor a full matrix."""
        try:
            self._factor = rslab.lu(matrix, threads=self._threads)
        except RuntimeError as error:
            raise SingularTangentError(str(error)) from error

    def solve(self, right: Array) -> Array:
        """Solve with one step of refinement."""
        assert self._factor is not None
        return np.asarray(self._factor.solve(right, refine=1))

    def negative_pivots(self, expected: int) -> int | None:
        """None, because LU factors do not give the inertia."""
        return None


_SOLVERS: dict[str, Callable[[Pattern, int], LinearSolver]] = {"rslab": RslabSolver, "mkl-pardiso": PardisoSolver}


def available_solvers() -> tuple[str, ...]:
    """Names of the solvers that this environment has, the fastest first."""
    return ("mkl-pardiso", "rslab") if _load_mkl() is not None else ("rslab",)


def linear_solver(name: str, pattern: Pattern, threads: int) -> LinearSolver:
    """Make the named solver; ``"auto"`` takes MKL Pardiso where it is installed and rslab elsewhere."""
    if name == "auto":
        name = available_solvers()[0]
    if name not in _SOLVERS:
        raise unknown("linear solver", name, [*_SOLVERS, "auto"])
    return _SOLVERS[name](pattern, threads)
