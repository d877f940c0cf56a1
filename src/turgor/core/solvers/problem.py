"""Problem: the input of every procedure, and the lists that it fills."""

from dataclasses import dataclass, field

from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.cells.internal_variables import History, Memory
from turgor.core.engine.system import System
from turgor.core.solvers.checkpoints.checkpoint_data import Record
from turgor.core.solvers.listeners import Listeners
from turgor.core.solvers.restart import Restart
from turgor.core.solvers.solution import LimitPoint, Solution, State, Step


@dataclass(frozen=True, slots=True, kw_only=True)
class Problem:
    """Input of every procedure; the caller owns the lists.

    Parameters
    ----------
    system : System
    tangent : Tangent
    listeners : Listeners
    restart : Restart or None
        What the former stage left; None where it begins at rest.
    history : History or None
        What the start brings into the first step.
    record : Record or None
        Where checkpoints are saved.
    guide : Solution or None
        The path of a similar model.
    states, steps, limits : list
        What is found.
    """

    system: System
    tangent: Tangent
    listeners: Listeners = field(default_factory=Listeners)
    restart: Restart | None = None
    history: History | None = None
    record: Record | None = None
    guide: Solution | None = None
    states: list[State] = field(default_factory=list)
    steps: list[Step] = field(default_factory=list)
    limits: list[LimitPoint] = field(default_factory=list)

    @property
    def start(self) -> State | None:
        """The state at which it begins; None at rest."""
        return None if self.restart is None else self.restart.state

    @property
    def memory(self) -> Memory | None:
        """Internal variables at the start; None where there are none."""
        return None if self.history is None else self.history.memory
