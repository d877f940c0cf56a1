"""Verify: the full model solved from an answer of a reduced one, and so the error of this answer."""

from dataclasses import dataclass

from turgor.accuracy.gradients.equilibrium import equilibrium_of
from turgor.core.engine.runtime import EngineOptions
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.solution import State
from turgor.core.solvers.states import state_of
from turgor.foundation.display import Shown
from turgor.foundation.errors import NotSolved, TurgorError
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.training.compare import errors_of


@dataclass(frozen=True, slots=True, eq=False)
class Verified(Shown):
    """An equilibrium of the full model next to an answer of a reduced one, and the errors of this answer.

    Parameters
    ----------
    state : State
        The equilibrium of the full model.
    displacement, tip : float [-]
        Largest error of a node, and that of the tip, over the largest displacement and travel of training.
    volume : float [-]
        Largest relative error of the volumes.
    """

    state: State
    displacement: float
    tip: float
    volume: float

    def __repr__(self) -> str:
        return f"Verified(displacement {self.displacement:.1e}, tip {self.tip:.1e}, volume {self.volume:.1e})"


def verified(answer: ReducedState, options: EngineOptions | None = None) -> Verified:
    """Solve the full model with an answer of a reduced one as its start: a few updates instead of a path.

    Parameters
    ----------
    answer : ReducedState
    options : EngineOptions, optional
        Linear solver and threads.

    Returns
    -------
    Verified

    Raises
    ------
    NotSolved
        If Newton's method finds no equilibrium from there: the answer is far from one, or the model is about to buckle.
    """
    try:
        full = equilibrium_of(answer.state(), Static(), options or EngineOptions())
    except NotSolved:
        raise
    except TurgorError as error:
        raise NotSolved(f"the full model finds no equilibrium next to {answer!r}: {error}") from None
    state = state_of(full.system, full.at, None)
    return Verified(state, *errors_of(answer, state.displacement / full.system.length))
