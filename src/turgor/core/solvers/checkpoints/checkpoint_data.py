"""Content of a checkpoint: the path so far, and the loop."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from turgor.core.engine.algebra.tangent import Factored
from turgor.core.engine.contact.terms import ContactMemory
from turgor.core.solvers.outcomes import Outcome
from turgor.core.solvers.solution import LimitPoint, State, Step


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PathSoFar:
    """Results of a run: states, attempted steps and limit points."""

    states: tuple[State, ...]
    steps: tuple[Step, ...]
    limits: tuple[LimitPoint, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoopSoFar:
    """State of a loop of steps.

    Parameters
    ----------
    parts : tuple of dict
        What its steps have changed.
    contact : ContactMemory
        Partners, penalty scales and couplings of the last state.
    factored : Factored
        What the next step may need of the factors.
    outcome : Outcome or None
        How the loop ended; None while it has not.
    """

    parts: tuple[Mapping[str, Any], ...]
    contact: ContactMemory
    factored: Factored
    outcome: Outcome | None


class Record(Protocol):
    """Where the checkpoints of a procedure are saved."""

    @property
    def goes_on(self) -> bool:
        """Whether the next loop has a checkpoint."""

    def begun(self) -> "tuple[PathSoFar, LoopSoFar] | None":
        """Count a loop, and return its last checkpoint; None where it has none."""

    def keep(self, path: PathSoFar, loop: LoopSoFar) -> None:
        """Save a checkpoint of the loop that was begun last."""
