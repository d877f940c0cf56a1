"""Limit points: find the maxima and minima of a scalar between two points of a path, and make them states."""

from turgor.core.solvers.continuation.extrema import turning_points
from turgor.core.solvers.continuation.path_points import between, point_at, solve_at
from turgor.core.solvers.continuation.path_run import Ending, Point, Run
from turgor.core.solvers.continuation.settings import LIMIT_POINTS
from turgor.core.solvers.listeners import silent
from turgor.core.solvers.solution import LimitPoint


def insert_limit_points(run: Run, last: Point, now: Point) -> tuple[Point, Ending | None]:
    """Find the maxima and minima of each scalar between two points, and make them states of the path.

    Where all volumes are constant there are no limit points: the pressure has extrema because other loads do.

    Returns
    -------
    (Point, Ending or None)
        The last of them, or the first point; and how the path ends, if it does before or at one of them.
    """
    if not run.task.limit_points:
        return last, None
    turns = []
    for index in range(len(now.scalars)):
        for before, after in _brackets(run, last, now, index):
            turn = _turning_point(run, before, after, index)
            if turn is not None and before.slope is not None:
                turns.append((turn, "maximum" if before.slope[index] > 0 else "minimum", index))
    for turn, kind, index in sorted(turns, key=lambda each: each[0].parameter):
        ending = run.task.finished(last, turn, run)
        if ending is not None:
            return turn, ending
        run.states.append(turn.state)
        run.limits.append(_limit_point(run, kind, turn, index))
        last = turn
    return last, None


def _brackets(run: Run, last: Point, now: Point, index: int) -> list[tuple[Point, Point]]:
    """Pieces of the path between two points on which the slope of a scalar changes its sign once."""
    if last.slope is None or now.slope is None:
        return []
    if last.slope[index] * now.slope[index] < 0:
        return [(last, now)]
    turns = turning_points(_ends(last, index), _ends(now, index))
    if len(turns) < 2:
        return []
    middle = _solved(run, last, now, turns[0])
    if middle is None or middle.slope is None or middle.slope[index] * last.slope[index] >= 0:
        return []
    return [(last, middle), (middle, now)]


def _turning_point(run: Run, before: Point, after: Point, index: int) -> Point | None:
    """Close in on the point where a scalar turns."""
    width = after.parameter - before.parameter
    nearest = None
    for _ in range(LIMIT_POINTS.solves):
        turns = turning_points(_ends(before, index), _ends(after, index))
        middle = 0.5 * (before.parameter + after.parameter)
        nearer = _solved(run, before, after, turns[0] if turns else middle)
        if nearer is None or nearer.slope is None:
            return nearest
        nearest = nearer
        assert before.slope is not None
        if abs(nearer.slope[index]) * width <= LIMIT_POINTS.flat_slope * max(abs(nearer.scalars[index]), 1e-12):
            return nearest
        if nearer.slope[index] * before.slope[index] > 0:
            before = nearer
        else:
            after = nearer
    return nearest


def _solved(run: Run, before: Point, after: Point, parameter: float) -> Point | None:
    """The point of the path at a parameter between two others."""
    result = solve_at(run, parameter, between([before, after], parameter), silent)
    if not result.converged or result.evaluation is None:
        return None
    return point_at(run, result.evaluation, parameter, result.scalars)


def _ends(point: Point, index: int) -> tuple[float, float, float]:
    assert point.slope is not None
    return point.parameter, float(point.scalars[index]), float(point.slope[index])


def _limit_point(run: Run, kind: str, point: Point, index: int) -> LimitPoint:
    names = run.task.system.controlled
    face, pressure = "", float("nan")
    if names:
        face, pressure = names[index], point.state.pressures[names[index]]
    elif len({load.pressure for load in run.task.system.model.pressures}) == 1:
        pressure = run.task.system.model.pressures[0].at(point.state.load_factor)
    return LimitPoint(
        kind=kind, load_factor=point.state.load_factor, pressure=pressure, face=face, state=len(run.states) - 1
    )
