"""FreeSolver: a linear solver for the free unknowns alone, where many are prescribed or follow others."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import REFINED, LinearSolver
from turgor.core.engine.algebra.pattern import Pattern
from turgor.core.engine.algebra.settings import LINEAR_SOLVER

Array = NDArray[np.float64]


class FreeSolver:
    """Factor the block of the free unknowns; the equations of prescribed ones are identities.

    Parameters
    ----------
    make : callable
        Makes a solver of a pattern.
    pattern : Pattern
        Of all unknowns.
    prescribed : (size,) bool array
    """

    def __init__(
        self, make: Callable[[Pattern], LinearSolver], pattern: Pattern, prescribed: NDArray[np.bool_]
    ) -> None:
        free = ~prescribed
        columns = np.repeat(np.arange(pattern.size), np.diff(pattern.indptr))
        number = np.cumsum(free) - 1
        self._entries = np.flatnonzero(free[pattern.indices] & free[columns])
        self._free = np.flatnonzero(free)
        count = np.bincount(number[columns[self._entries]], minlength=len(self._free))
        rows = number[pattern.indices[self._entries]].astype(np.int32)
        indptr = np.concatenate([[0], np.cumsum(count)]).astype(np.int64)
        self._inner = make(Pattern(len(self._free), indptr, rows))
        self.name = self._inner.name

    @property
    def iterative(self) -> bool:
        """Whether each digit of a solution costs iterations."""
        return self._inner.iterative

    @property
    def double(self) -> bool:
        """Whether all factors are in double precision from now on."""
        return self._inner.double

    @double.setter
    def double(self, value: bool) -> None:
        self._inner.double = value

    def factor(self, data: Array) -> None:
        """Factor the values of the analyzed lower triangle."""
        self._inner.factor(data[self._entries])

    def solve(self, right: Array, reduction: float = REFINED) -> Array:
        """Solve with the last factors."""
        out = np.array(right)
        out[self._free] = self._inner.solve(right[self._free], reduction)
        return out

    def negative_pivots(self, expected: int) -> int | None:
        """Negative pivots of the last factors."""
        return self._inner.negative_pivots(expected)


def solver_of(make: Callable[[Pattern], LinearSolver], pattern: Pattern, prescribed: NDArray[np.bool_]) -> LinearSolver:
    """Make a solver of all unknowns, or of the free ones where many are prescribed."""
    return FreeSolver(make, pattern, prescribed) if prescribed.mean() > LINEAR_SOLVER.many_prescribed else make(pattern)
