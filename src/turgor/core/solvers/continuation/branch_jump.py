"""Branch jump: find steps of load control that may have jumped past a limit point to another branch."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.solvers.continuation.settings import BRANCH_JUMP
from turgor.core.solvers.solution import State
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]


def move_ratio(points: Sequence[tuple[float, Array]]) -> float:
    """Ratio of the motion of a body in the last step to that in the step before, for the same load.

    Parameters
    ----------
    points : sequence of (float, array)
        Load factors, and the displacement at each.

    Returns
    -------
    float
        0 where there are fewer than three points, the load does not rise, or one of the steps is nearly zero: what
        begins to move, as a wire that gets warm enough, has jumped nowhere.

    Examples
    --------
    >>> move_ratio([(0.0, np.zeros(3)), (0.5, np.ones(3)), (0.6, np.full(3, 3.0))])
    10.0
    >>> move_ratio([(0.0, np.zeros(3)), (0.5, np.full(3, 1e-15)), (0.6, np.full(3, 3.0))])
    0.0
    """
    if len(points) < 3:
        return 0.0
    (f0, u0), (f1, u1), (f2, u2) = points[-3:]
    moved, moves = float(np.linalg.norm(u1 - u0)), float(np.linalg.norm(u2 - u1))
    if (
        not f0 < f1 < f2
        or moved <= ROUND_OFF.same * moves
        or moves <= BRANCH_JUMP.still_share * float(np.linalg.norm(u2))
    ):
        return 0.0
    return round((moves / (f2 - f1)) / (moved / (f1 - f0)), 9)


def move_ratio_to(states: Sequence[State], number: int) -> float:
    """Ratio of the motion of a body on the way to a state to that in the step before, for the same load."""
    return move_ratio([(state.load_factor, state.displacement) for state in states[max(0, number - 2) : number + 1]])


def first_branch_jump(states: Sequence[State]) -> int | None:
    """Number of the first state that a branch jump led to; None where there is none."""
    return next((n for n in range(2, len(states)) if move_ratio_to(states, n) > BRANCH_JUMP.jump_ratio), None)
