"""Path reversal: find out whether a path returns the way it came beyond a maximum of the load.

If one cell of a coarse mesh collapses, the load has a maximum although the body would bear more. The path then leads
back to rest with that cell inverted. It is an artifact of the mesh.
"""

import numpy as np
from numpy.typing import NDArray

from turgor.core.solvers.continuation.path_run import Point, Run
from turgor.core.solvers.continuation.scalar_control.settings import PATH_REVERSAL
from turgor.core.solvers.solution import State


def reverses(run: Run, now: Point) -> bool:
    """Whether a point beyond the largest load lies on the way to it, or close by.

    Parameters
    ----------
    run : Run
    now : Point
        Not yet among the states of the run.
    """
    load, states = float(now.scalars[0]), run.states
    top = max(range(len(states)), key=lambda number: states[number].load_factor)
    if not 0 < load < PATH_REVERSAL.fallen * states[top].load_factor:
        return False
    before = _on_the_way(states[: top + 1], load)
    return float(np.linalg.norm(now.state.displacement - before)) < PATH_REVERSAL.near * float(
        np.linalg.norm(states[top].displacement - before)
    )


def _on_the_way(states: list[State], load: float) -> NDArray[np.float64]:
    """Displacement (n, 3) at a load before the last state, where the path went last through that load."""
    start = max(number for number, state in enumerate(states) if state.load_factor <= load)
    low, high = states[start], states[start + 1]
    share = (load - low.load_factor) / (high.load_factor - low.load_factor)
    return low.displacement + share * (high.displacement - low.displacement)
