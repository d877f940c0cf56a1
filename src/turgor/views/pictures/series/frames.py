"""Frames: the states of a path and shapes between them, evenly spaced along the motion."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError
from turgor.views.pictures.colors import CONTACT_PRESSURE, FIBER_TENSION, Field

Array = NDArray[np.float64]


def frame_times(solution: Solution, count: int) -> tuple[Array, Array]:
    """Places of the states along the motion, (n,), and of frames between them, (count,): times, or ways of the nodes.

    Parameters
    ----------
    solution : Solution
    count : int
        2 or more.
    """
    states = solution.states
    if len(states) < 2:
        raise TurgorError("the path has one state, which does not move.")
    timed = all(state.time is not None for state in states)
    if timed:
        place = np.array([state.time for state in states], dtype=np.float64)
    else:
        ways = [float(np.linalg.norm(b.displacement - a.displacement)) for a, b in pairwise(states)]
        place = np.concatenate([[0.0], np.cumsum(ways)])
    if not place[-1] > 0:
        raise TurgorError(f"nothing moves along the {len(states)} states of the path.")
    return place, np.linspace(0.0, place[-1], count)


def frames(solution: Solution, field: Field, count: int) -> Iterator[StateFields]:
    """Give the shapes of a path at evenly spaced places, with the values of a field.

    Between states, displacements and values follow monotone cubic curves. They are not in
    equilibrium there. Contact pressures and tensions are those of the nearest state.

    Parameters
    ----------
    solution : Solution
    field : Field
    count : int
        How many, 2 or more.

    Yields
    ------
    StateFields
    """
    place, times = frame_times(solution, count)
    distinct = np.concatenate([[True], np.diff(place) > 1e-9 * place[-1]])
    states = [state for state, is_new in zip(solution.states, distinct, strict=True) if is_new]
    place, facts = place[distinct], MeshFacts(solution.model.mesh)
    moved = PchipInterpolator(place, np.array([state.displacement for state in states]))
    steady = field.name in (CONTACT_PRESSURE, FIBER_TENSION)
    values = None if steady else PchipInterpolator(place, np.array([field.read(StateFields(s, facts)) for s in states]))
    for at in times:
        nearest = states[int(np.abs(place - at).argmin())]
        shape = StateFields(replace(nearest, displacement=np.asarray(moved(at))), facts)
        if values is not None:
            shape.once(("field", field), lambda at=at: np.asarray(values(at)))  # type: ignore[misc]
        yield shape
