"""Settings of compilation: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CompilationSettings:
    """Settings of the compilation of kernels, tested in `tests/unit/core/engine/compiled`.

    Parameters
    ----------
    announced_after : float [s]
        A compilation that takes longer is announced.
    longest : float [s]
        No group takes longer; a process that has waited so long for another one compiles the group itself.
    niceness : int
        By how much the background compiler lowers its priority once all that a first step needs is compiled.
    """

    announced_after: float = 1.5
    longest: float = 120.0
    niceness: int = 15


COMPILATION = CompilationSettings()
