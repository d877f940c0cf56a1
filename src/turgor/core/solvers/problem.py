"""Problem: the input of every procedure, and the lists that it fills."""

from dataclasses import dataclass, field, replace

from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.cells.internal_variables import History, Memory
from turgor.core.engine.system import System
from turgor.core.solvers.checkpoints.checkpoint_data import Record
from turgor.core.solvers.guide import Guide
from turgor.core.solvers.listeners import Listeners
from turgor.core.solvers.restart import Restart
from turgor.core.solvers.solution import LimitPoint, State, Step


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
    guide : Guide or None
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
    guide: Guide | None = None
    states: list[State] = field(default_factory=list)
    steps: list[Step] = field(default_factory=list)
    limits: list[LimitPoint] = field(default_factory=list)

    def take_over(self) -> None:
        """Begin the lists with the path with which it goes on."""
        path = None if self.restart is None else self.restart.path
        if path is not None:
            self.states[:] = [replace(state, model=self.system.model) for state in path.states]
            self.steps[:], self.limits[:] = path.steps, path.limits

    @property
    def start(self) -> State | None:
        """The state at which it begins; None at rest."""
        return None if self.restart is None else self.restart.state

    @property
    def first(self) -> State | None:
        """The state at load factor 0 of its procedure; None at rest."""
        path = None if self.restart is None else self.restart.path
        return self.start if path is None else path.states[0]

    @property
    def goes_on(self) -> bool:
        """Whether it goes on with the path of its own procedure, on other cells."""
        return self.restart is not None and self.restart.path is not None

    @property
    def load_factor(self) -> float:
        """Load factor at which it begins."""
        return self.restart.state.load_factor if self.restart is not None and self.goes_on else 0.0

    @property
    def memory(self) -> Memory | None:
        """Internal variables at the start; None where there are none."""
        return None if self.history is None else self.history.memory
