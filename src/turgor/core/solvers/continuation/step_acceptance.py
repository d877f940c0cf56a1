"""Step acceptance: reject an equilibrium that may lie on another path, and shorten steps of rotating supports."""

from collections.abc import Sequence
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.continuation.branch_jump import move_ratio
from turgor.core.solvers.continuation.path_run import Point
from turgor.core.solvers.continuation.settings import BRANCH_JUMP, STEP_ACCEPTANCE
from turgor.core.solvers.continuation.tangent_response import exceeds_tangent, others_move
from turgor.core.solvers.newton.newton_values import NewtonResult
from turgor.core.solvers.solution import State
from turgor.core.solvers.step_reasons import Cause, Reason

Array = NDArray[np.float64]


def turns_aside(system: System, before: float, after: float) -> bool:
    """Whether supports move on a curve between two load factors, so that one step is too long.

    A face that turns by 300° ends at the same place as one that turns back by 60°; one step would take the shorter way.
    """
    start, middle, end = (system.prescribed_values(factor) for factor in (before, 0.5 * (before + after), after))
    aside = np.linalg.norm(middle - 0.5 * (start + end))
    return bool(aside > STEP_ACCEPTANCE.support_aside * np.linalg.norm(end - start))


def why_rejected(
    system: System,
    states: Sequence[State],
    history: Sequence[Point],
    result: NewtonResult,
    rates: tuple[float, float] = (inf, inf),
) -> Reason | None:
    """Say why an equilibrium may not be the next one of the path; None where nothing speaks against it.

    ``rates`` say how far the nodes move with the load factor before the step and at its end. A shorter step either
    confirms the state or shows what happens: a body that buckles bends before it is unstable, and one that jumps has no
    equilibrium in between.
    """
    at = result.evaluation
    assert at is not None
    if result.unstable_modes and not states[-1].unstable_modes:
        return Reason(Cause.STABILITY_LOST)
    moved = system.moving
    points = [(point.parameter, point.unknowns[moved]) for point in history[-2:]]
    ratio = move_ratio([*points, (at.load_factor, at.unknowns[moved])])
    change = at.unknowns - history[-1].unknowns
    if ratio > BRANCH_JUMP.jump_ratio and not _pushed(system, history[-1], at, change):
        return Reason(Cause.LONG_MOVE, ratio)
    still = np.linalg.norm(change[moved]) <= BRANCH_JUMP.still_share * np.linalg.norm(at.unknowns[moved])
    jumped = not still and exceeds_tangent(system, change, at.load_factor - history[-1].parameter, rates)
    return Reason(Cause.BRANCH_JUMP) if jumped else None


def _pushed(system: System, last: Point, at: Evaluation, change: Array) -> bool:
    """Whether supports or obstacles move a body no farther than the tangent at the last state foresees.

    An obstacle that reaches the body in one step moves it many times as far in the next one.
    """
    if last.change is None or not others_move(system, last.parameter, at.load_factor):
        return False
    rate = float(np.linalg.norm(last.change[system.moving]))
    return not exceeds_tangent(system, change, at.load_factor - last.parameter, (rate, rate))
