"""Tangent response: compare how far a step moves a body with what the tangents at its ends predict.

A step along a path moves a body about as far as the rates at its ends say. A step that has jumped to another branch,
past a limit point, moves it much farther.
"""

from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import ROUGH, SingularTangentError
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.constraints.constraint import NUDGE, Constraint
from turgor.core.solvers.constraints.load_factor import load_change
from turgor.core.solvers.continuation.settings import BRANCH_JUMP
from turgor.core.solvers.newton.border import push

Array = NDArray[np.float64]


def load_response(system: System, tangent: Tangent, unknowns: Array, before: float = 0.0, after: float = 1.0) -> Array:
    """Change (size,) of the unknowns with the load factor, for loads from one to another, by the last factors."""
    force = load_change(system, unknowns, before, after) / (after - before)
    return tangent.solve(np.where(system.prescribed, 0.0, force), ROUGH)


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


def response_in_step(constraint: Constraint, tangent: Tangent, at: Evaluation, before: float) -> Array | None:
    """Change (size,) of the unknowns with the load factor up to a state of load control, by the last factors.

    Of loads alone it is that of the whole step. Where supports or obstacles move too, it is that at its end, because a
    point that an obstacle has not reached does not resist it yet. None where the rubber remembers, so that more than
    these moves the body.
    """
    system = constraint.scalar_unknowns.system
    if system.remembers:
        return None
    if not others_move(system, before, at.load_factor):
        return load_response(system, tangent, at.unknowns, before, at.load_factor)
    moved, force = push(constraint, at, at.load_factor, np.empty(0), NUDGE)
    return None if force is None else tangent.solve(np.where(system.prescribed, moved, force), ROUGH)


def others_move(system: System, before: float, after: float) -> bool:
    """Whether supports or obstacles move between two load factors, or states of bodies change."""
    if system.has_states:
        return True
    obstacles = system.model.contact.obstacles
    return bool((system.prescribed_values(before) != system.prescribed_values(after)).any()) or any(
        each.moves(before, after) for each in obstacles
    )


def exceeds_tangent(system: System, change: Array, rise: float, rates: tuple[float, float]) -> bool:
    """Whether a change of the unknowns is too far for a rise of the load factor and the rates before and after it."""
    moved = float(np.linalg.norm(change[system.moving]))
    return moved > BRANCH_JUMP.farther_than_rates * max(rates) * rise
