"""Runtime: threads, the linear solver's name, and ways of Newton's method."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from threadpoolctl import threadpool_limits

from turgor.core.engine.compiled import THREADS
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.processors import processors

#: Ways of Newton's method, for measurements: all that is done; without mixed integration points; and without
#: extrapolation and kept factors too, which is the textbook.
MIXED, NEWTON, PLAIN = "mixed", "newton", "plain"

#: Below this size threads wait for each other longer than they work, and a shorter row does not pay for itself.
FEW_UNKNOWNS = 10_000


@dataclass(frozen=True, slots=True, kw_only=True)
class EngineOptions:
    """How the engine runs; results do not depend on it beyond round-off.

    Parameters
    ----------
    linear_solver : str
        ``"auto"`` factors with MKL Pardiso where it is installed and rslab elsewhere; either can be named.
        ``"iterative"`` does not factor tangents of tetrahedra with mean stress, but solves by GMRES; so does ``"auto"``
        where factors would not fit into the memory. Unstable modes are not counted then.
    threads : int
        Threads of the kernels and the linear solver; all processors by default, or ``NUMBA_NUM_THREADS`` of the
        environment where that is less.
    notify : callable or None
        ``notify(text)``, called when something takes long, such as the first compilation on a machine. Without it that
        is reported on the standard error stream where this is a terminal.
    iteration : str
        How Newton's method iterates, to measure what its refinements save: ``"mixed"`` does all that it can,
        ``"newton"`` leaves out mixed integration points, ``"plain"`` also starts each step at the last state instead
        of extrapolating to it, and factors every tangent.
    """

    linear_solver: str = "auto"
    threads: int = field(default_factory=processors)
    notify: Callable[[str], None] | None = None
    iteration: str = MIXED

    def __post_init__(self) -> None:
        if self.iteration not in (MIXED, NEWTON, PLAIN):
            raise unknown("iteration", self.iteration, (MIXED, NEWTON, PLAIN))
        if self.threads < 1:
            raise TurgorError(f"threads is {self.threads}; allowed is 1 or more.")


@contextmanager
def use_threads(threads: int) -> Iterator[None]:
    """Run the kernels on a number of threads.

    NumPy's own library stays on one: its products are small here, and its waiting threads take time from the solver's.
    """
    before = THREADS.set(threads)
    try:
        with threadpool_limits(1, user_api="blas"):
            yield
    finally:
        THREADS.reset(before)
