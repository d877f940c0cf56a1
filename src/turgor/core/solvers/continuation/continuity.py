"""Continuity: decide whether both ends of an arc-length step lie on the same path.

Newton's method may converge to a point of another path. If the path turns by more than a right angle within a step, the
direction found beyond the turn leads back; near a bifurcation the step may end on another branch.

Three tests decide. The chord of a short step is nearly parallel to the tangents of the path at both ends. The sign of
the determinant of the bordered tangent is constant along a path except at bifurcations (Allgower and Georg 2003,
chapter 8, doi 10.1137/1.9780898719154); it is that of the slope of the load factor if an even number of modes is
unstable. And if the step is halved again and again, a bifurcation stays at its place, while a jump keeps its length.
"""

from dataclasses import dataclass

import numpy as np

from turgor.core.solvers.continuation.path_points import between, point_at, solve_at
from turgor.core.solvers.continuation.path_run import Bifurcation, Point, Run
from turgor.core.solvers.continuation.settings import CONTINUITY, LIMIT_POINTS
from turgor.core.solvers.listeners import silent
from turgor.core.solvers.step_reasons import Cause, Reason


@dataclass(frozen=True, slots=True)
class Verdict:
    """Why a step leaves the path, None where it does not; and the bifurcations that it passes."""

    reason: Reason | None = None
    passed: tuple[Bifurcation, ...] = ()


def judged(run: Run, last: Point, now: Point) -> Verdict:
    """Judge a step along a path whose load factor is unknown; on other paths the parameter always rises."""
    if not run.size:
        return Verdict()
    straight = straightness(run, last, now)
    if straight < CONTINUITY.straight_chord and (
        straight < 0.5 * CONTINUITY.straight_chord or _cuts(run) < CONTINUITY.corner_cuts
    ):
        return Verdict(Reason(Cause.SHARP_TURN))
    passed: list[Bifurcation] = []
    while _differ(last, now):
        bifurcation = _bifurcation(run, last, now)
        if bifurcation is None:
            return Verdict(Reason(Cause.OTHER_BRANCH))
        before, beyond = bifurcation
        if before is beyond:  # two limit points after all
            break
        passed.append(_passed(before, beyond))
        last = beyond
    return Verdict(None, tuple(passed))


def straightness(run: Run, last: Point, now: Point) -> float:
    """Smaller cosine of the chord between two points with the directions of the path there."""
    chord = _vector(run, now.unknowns - last.unknowns, now.scalars - last.scalars)
    cosines = [1.0]
    for point in (last, now):
        if point.change is not None and point.slope is not None:
            along = _vector(run, point.change, point.slope)
            cosines.append(float(chord @ along) / float(np.linalg.norm(chord) * np.linalg.norm(along)))
    return min(cosines)


def orientation(point: Point) -> int | None:
    """Sign of the determinant of the bordered tangent, up to a constant one; None where modes were not counted."""
    if point.slope is None or point.state.unstable_modes is None:
        return None
    return (1 if point.slope[0] >= 0 else -1) * (-1) ** point.state.unstable_modes


def _vector(run: Run, unknowns: np.ndarray, scalars: np.ndarray) -> np.ndarray:
    """A piece of the path, with displacements and load factor as the arc counts them."""
    return np.append(unknowns[run.task.system.moving] / run.size, scalars)


def _cuts(run: Run) -> int:
    """How often the step was cut in a row because the path turned."""
    count = 0
    for step in reversed(run.steps):
        if step.cause is not Cause.SHARP_TURN:
            break
        count += 1
    return count


def _differ(last: Point, now: Point) -> bool:
    """Whether two points differ by more than one limit point between them can explain."""
    first, second = orientation(last), orientation(now)
    if first is None or second is None or last.slope is None or now.slope is None:
        return False
    more = last.state.unstable_modes != now.state.unstable_modes
    return first != second or (more and last.slope[0] * now.slope[0] > 0)


def _bifurcation(run: Run, last: Point, now: Point) -> tuple[Point, Point] | None:
    """Points close to the first bifurcation between two, one point twice if there is none; None at a jump."""
    allowed = _chord(run, last, now)
    for _ in range(LIMIT_POINTS.solves):
        parameter = 0.5 * (last.parameter + now.parameter)
        result = solve_at(run, parameter, between([last, now], parameter), silent)
        if not result.converged or result.evaluation is None:
            return None
        middle = point_at(run, result.evaluation, parameter, result.scalars)
        if _differ(last, middle):
            now = middle
        elif _differ(middle, now):
            last = middle
        else:
            return now, now
        allowed *= 0.5
    smooth = (
        _chord(run, last, now) <= CONTINUITY.bifurcation_jump * allowed
        and last.state.unstable_modes != now.state.unstable_modes
    )
    return (last, now) if smooth else None


def _chord(run: Run, last: Point, now: Point) -> float:
    """Distance of two points, as the arc counts it."""
    return float(np.linalg.norm(_vector(run, now.unknowns - last.unknowns, now.scalars - last.scalars)))


def _passed(before: Point, beyond: Point) -> Bifurcation:
    modes = before.state.unstable_modes, beyond.state.unstable_modes
    assert modes[0] is not None and modes[1] is not None
    return Bifurcation(float(0.5 * (before.scalars[0] + beyond.scalars[0])), beyond.state, modes[1] - modes[0])
