"""Step acceptance: reject an equilibrium that may lie on another path, and shorten steps of turning supports."""

from collections.abc import Sequence
from math import inf

import numpy as np

from turgor.engine.system import System
from turgor.solvers.continuation.branch_jump import move_ratio
from turgor.solvers.continuation.path_points import Point
from turgor.solvers.continuation.tangent_response import exceeds_tangent
from turgor.solvers.continuation.thresholds import JUMP_RATIO, STILL_SHARE, SUPPORT_ASIDE
from turgor.solvers.newton.newton import NewtonResult
from turgor.solvers.reasons import Cause, Reason
from turgor.solvers.solution import State


def turns_aside(system: System, before: float, after: float) -> bool:
    """Whether supports go a round way between two load factors, which a single step would cut short.

    A face turned by 300° in one step would go back by 60°.
    """
    start, middle, end = (system.prescribed(factor) for factor in (before, 0.5 * (before + after), after))
    aside = np.linalg.norm(middle - 0.5 * (start + end))
    return bool(aside > SUPPORT_ASIDE * np.linalg.norm(end - start))


def why_rejected(
    system: System,
    states: Sequence[State],
    history: Sequence[Point],
    result: NewtonResult,
    rates: tuple[float, float] = (inf, inf),
) -> Reason | None:
    """Say why an equilibrium may be another than the next one of a path; None where it is not in doubt.

    ``rates`` say how far the nodes move with the load factor before the step and at its end. A shorter step dispels the
    doubt or shows what is the matter: a body that buckles bends before it is unstable, and one that jumps has no
    equilibrium on the way.
    """
    at = result.evaluation
    assert at is not None
    if result.unstable_modes and not states[-1].unstable_modes:
        return Reason(Cause.STABILITY_LOST)
    moved = 3 * system.node_count
    points = [(point.parameter, point.unknowns[:moved]) for point in history[-2:]]
    ratio = move_ratio([*points, (at.load_factor, at.unknowns[:moved])])
    if ratio > JUMP_RATIO:
        return Reason(Cause.LONG_MOVE, ratio)
    change = at.unknowns - history[-1].unknowns
    still = np.linalg.norm(change[:moved]) <= STILL_SHARE * np.linalg.norm(at.unknowns[:moved])
    jumped = not still and exceeds_tangent(system, change, at.load_factor - history[-1].parameter, rates)
    return Reason(Cause.BRANCH_JUMP) if jumped else None
