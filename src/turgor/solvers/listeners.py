"""Listeners: what the caller of a solve hears and decides."""

from collections.abc import Callable
from dataclasses import dataclass

from turgor.solvers.solution import Iteration, State


@dataclass(frozen=True, slots=True)
class Listeners:
    """What the caller listens to and decides; see `turgor.solvers.solve.solve`."""

    progress: Callable[[Iteration, State | None], None] | None = None
    stop: Callable[[State], str | None] | None = None
