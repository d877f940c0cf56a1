"""Tangent response: compare how far a step moves a body with what the tangents at its ends predict.

A step along a path moves a body about as far as the rates at its ends say. A step that has jumped to another branch,
past a limit point, moves it much farther.
"""

from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.engine.algebra.linear import ROUGH, SingularTangentError
from turgor.engine.algebra.tangent import Tangent
from turgor.engine.system import Evaluation, System
from turgor.solvers.continuation.thresholds import FARTHER_THAN_RATES

Array = NDArray[np.float64]


def load_response(system: System, tangent: Tangent, unknowns: Array, before: float = 0.0, after: float = 1.0) -> Array:
    """Change (size,) of the unknowns with the load factor, for loads from one to another, by the last factors."""
    force = (system.external(unknowns, after) - system.external(unknowns, before)) / (after - before)
    return tangent.solve(np.where(system.held, 0.0, force), ROUGH)


def rate_at(system: System, tangent: Tangent, at: Evaluation) -> tuple[float, int | None]:
    """How far the nodes move with the load factor at a state, infinite at a singular tangent, and its unstable modes.

    The tangent is factored again, because Newton's method may have ended with the factors, and so with the count of
    unstable modes, of the state before.
    """
    try:
        tangent.factor(at)
        response = load_response(system, tangent, at.unknowns)
    except SingularTangentError:
        return inf, None
    return float(np.linalg.norm(response[system.moving])), tangent.unstable_modes()


def response_in_step(system: System, tangent: Tangent, unknowns: Array, before: float, after: float) -> Array | None:
    """Change (size,) of the unknowns with the load factor, for the loads of a step and by the last factors.

    None where supports or obstacles move or the rubber remembers, so that more than loads moves the body.
    """
    obstacles = system.model.contact.obstacles
    if (
        system.materials.remembers
        or (system.prescribed(before) != system.prescribed(after)).any()
        or any((each.displacement(before) != each.displacement(after)).any() for each in obstacles)
    ):
        return None
    return load_response(system, tangent, unknowns, before, after)


def exceeds_tangent(system: System, change: Array, rise: float, rates: tuple[float, float]) -> bool:
    """Whether a change of the unknowns is too far for a rise of the load factor and the rates before and after it."""
    moved = float(np.linalg.norm(change[system.moving]))
    return moved > FARTHER_THAN_RATES * max(rates) * rise
