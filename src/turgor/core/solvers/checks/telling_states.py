"""States of a path that tell most about it: checks that cost too much for all states look at these."""

from collections.abc import Sequence

import numpy as np

from turgor.core.model.drive import kinks
from turgor.core.model.model import Model
from turgor.core.solvers.solution import State


def telling_states(model: Model, states: Sequence[State]) -> tuple[State, ...]:
    """Return the states at the turns of the loads, the one with the largest displacement, and the last one, each once.

    Parameters
    ----------
    model : Model
    states : sequence of State
    """
    if not states:
        return ()
    farthest = max(states, key=lambda state: float(np.abs(state.displacement).max()))
    turns = kinks(model)
    chosen = (*(state for state in states if state.load_factor in turns), farthest, states[-1])
    return tuple({id(state): state for state in chosen}.values())
