"""Leaps: steps of load control that may have gone past a limit point without meeting it."""

from collections.abc import Sequence

import numpy as np

from turgor.solvers.solution import State

#: A step in which a body moves this many times as much for its load as in the step before may have jumped. On the way
#: to a limit point steps get shorter, and the factor from one to the next stays at two or three.
LEAP = 5.0


def leap(states: Sequence[State]) -> float:
    """How many times as much a body moved in the last step as in the one before, for the same load.

    Parameters
    ----------
    states : sequence of State

    Returns
    -------
    float
        0 where there are fewer than three states, or the load does not rise.
    """
    if len(states) < 3:
        return 0.0
    before, last, now = states[-3:]
    first, second = last.load_factor - before.load_factor, now.load_factor - last.load_factor
    if not (first > 0 and second > 0):
        return 0.0
    moved, moves = (float(np.linalg.norm(b.displacement - a.displacement)) for a, b in ((before, last), (last, now)))
    return (moves / second) / (moved / first) if moved > 0 else 0.0


def first_leap(states: Sequence[State]) -> int | None:
    """Number of the first state that a leap led to; None where there is none."""
    return next((n for n in range(2, len(states)) if leap(states[n - 2 : n + 1]) > LEAP), None)
