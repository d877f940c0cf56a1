"""Runtime: threads, the linear solver's name, and the one-time compilation of the kernels."""

import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from threading import Timer
from time import perf_counter

from threadpoolctl import threadpool_limits

from turgor.engine.cells.kernels_warmup import touch_first_kernel, touch_kernels
from turgor.engine.compiled import THREADS, processors
from turgor.engine.contact.warmup import touch_contact_kernels
from turgor.errors import TurgorError, unknown

#: Ways of Newton's method, for measurements: all that is done; without mixed integration points; and without
#: extrapolation and kept factors too, which is the textbook.
MIXED, NEWTON, PLAIN = "mixed", "newton", "plain"

#: Compilation that lasts longer than this [s] is announced.
QUIET_SECONDS = 1.5


@dataclass(frozen=True, slots=True, kw_only=True)
class EngineOptions:
    """How the engine runs; results do not depend on it beyond round-off.

    Parameters
    ----------
    linear_solver : str
        ``"auto"`` takes MKL Pardiso where it is installed and rslab elsewhere; either can be named.
    threads : int
        Threads of the kernels and the linear solver; all processors by default, or ``NUMBA_NUM_THREADS`` of the
        environment where that is less.
    notify : callable or None
        ``notify(text)``, called when something takes long, such as the first compilation on a machine. Without it that
        is told on the standard error stream.
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


def compile_kernels(
    notify: Callable[[str], None] | None,
    nodes: int = 10,
    mixed: bool = True,
    sides: int = 0,
    more: frozenset[str] = frozenset(),
) -> float:
    """Load the kernels for cells of ``nodes`` nodes, compiled first where this machine has not; return the seconds.

    The kernels of contact are loaded for ``sides`` nodes of a side, and left out for 0; they are compiled by another
    process at the same time. ``more`` are those of `needed_by`.
    """
    start = perf_counter()
    text = "compiling the element kernels (once per machine and kind of cell, up to half a minute)"
    timer = Timer(QUIET_SECONDS, notify or _say, args=(text,))
    timer.daemon = True
    timer.start()
    try:
        beside = _compile_beside(sides) if touch_first_kernel() and sides and processors() > 1 else None
        touch_kernels(nodes, mixed, more)
        if beside is not None:
            beside.wait()
        if sides:
            touch_contact_kernels(sides)
    finally:
        timer.cancel()
    return perf_counter() - start


def _say(text: str) -> None:
    sys.stderr.write(f"turgor: {text}\n")
    sys.stderr.flush()


def _compile_beside(sides: int) -> subprocess.Popen[bytes]:
    """Compile the kernels of contact in another process, which leaves them in the cache on disk."""
    command = f"from turgor.engine.contact.warmup import touch_contact_kernels; touch_contact_kernels({sides})"
    silent = subprocess.DEVNULL
    return subprocess.Popen([sys.executable, "-c", command], stdin=silent, stdout=silent, stderr=silent)
