"""Between: the shape between the states that the viewer shows, as cubics of the drive through the nearest four."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.solvers.solution import Solution
from turgor.views.viewer.settings import VIEWER

Array = NDArray[np.float64]


def weights_at(places: Array, at: float) -> Array:
    """Weights (k,) of states at rising places (k,), four at least, whose sum is the cubic through the nearest four.

    Examples
    --------
    >>> places = np.array([0.0, 0.1, 0.3, 0.6, 1.0])
    >>> bool(np.isclose(weights_at(places, 0.2) @ places**3, 0.2**3))
    True
    """
    first = int(np.clip(np.searchsorted(places, at) - 2, 0, len(places) - 4))
    near, out = places[first : first + 4], np.zeros(len(places))
    for k in range(4):
        others = np.delete(near, k)
        out[first + k] = np.prod((at - others) / (near[k] - others))
    return out


def error_between(places: Array, displacements: Array) -> float:
    """Largest error of a displacement with every other state left out, over the largest displacement.

    Parameters
    ----------
    places : (k,) array
        Rising, seven at least.
    displacements : (k, n, 3) array [m]
    """
    chosen = np.unique([*range(0, len(places), 2), len(places) - 1])
    errors = [
        np.abs(np.tensordot(weights_at(places[chosen], places[k]), displacements[chosen], 1) - displacements[k]).max()
        for k in np.setdiff1d(np.arange(len(places)), chosen)
    ]
    return float(max(errors) / max(np.abs(displacements).max(), 1e-300))


def places_between(solution: Solution, steps: Sequence[int]) -> tuple[list[float] | None, float]:
    """Places of the shown states along the path where the page may go on between them, and the error there.

    Parameters
    ----------
    solution : Solution
    steps : sequence of int
        States that are shown.

    Returns
    -------
    (list of float or None, float)
        None where there are few states, where load factors do not rise, or where a state is far from what its neighbors
        say: the path jumps.
    """
    states = [solution.states[k] for k in steps]
    places = np.array([state.load_factor for state in states])
    if len(states) < VIEWER.least or np.any(np.diff(places) <= 0) or len({id(state.model) for state in states}) > 1:
        return None, 0.0
    error = error_between(places, np.stack([state.displacement for state in states]))
    return (places.tolist() if error <= VIEWER.jump else None), error
