"""Loop: the checkpoints of one loop of steps, and how the loop goes on from the last of them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from turgor.core.solvers.checkpoints.changes import Baseline, baseline, changes, restore
from turgor.core.solvers.checkpoints.checkpoint_data import LoopSoFar, PathSoFar
from turgor.core.solvers.outcomes import Outcome
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.solution import Status


@dataclass(slots=True, eq=False)
class Loop:
    """One loop of steps whose accepted states are saved.

    Parameters
    ----------
    problem : Problem
        Whose lists the steps fill.
    parts : sequence of dataclass
        What else the steps change.
    keeps_factors : bool
        Whether a step may begin with the factors of the one before.
    """

    problem: Problem
    parts: Sequence[Any]
    keeps_factors: bool = False
    _before: Baseline = field(default_factory=list)

    def follow(self, steps: Callable[[Callable[[], None]], Outcome]) -> Outcome:
        """Go on from the last checkpoint, if there is one; ``steps(keep)`` attempts the steps.

        A loop that had ended is not followed again. One that the user interrupts has not ended.
        """
        record = self.problem.record
        if record is None:
            return steps(_nothing)
        self.parts = [part for part in self.parts if part is not None]
        self._before = baseline(self.parts)
        known = record.begun()
        if known is not None:
            self._restore(*known)
            if known[1].outcome is not None:
                return known[1].outcome
        outcome = steps(self._keep)
        if outcome.status is not Status.INTERRUPTED:
            self._keep(outcome)
        return outcome

    def _keep(self, outcome: Outcome | None = None) -> None:
        problem = self.problem
        assert problem.record is not None
        path = PathSoFar(states=tuple(problem.states), steps=tuple(problem.steps), limits=tuple(problem.limits))
        loop = LoopSoFar(
            parts=changes(self.parts, self._before),
            contact=problem.system.contact_memory(),
            factored=problem.tangent.factored(self.keeps_factors),
            outcome=outcome,
        )
        problem.record.keep(path, loop)

    def _restore(self, path: PathSoFar, loop: LoopSoFar) -> None:
        problem, system = self.problem, self.problem.system
        problem.states[:], problem.steps[:], problem.limits[:] = path.states, path.steps, path.limits
        system.restore_contact(loop.contact)
        restore(self.parts, loop.parts, system)
        problem.tangent.restore(loop.factored)


def _nothing() -> None:
    """Save nothing."""
