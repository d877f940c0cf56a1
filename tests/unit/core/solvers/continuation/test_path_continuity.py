"""Whether steps along an arc are pieces of one path: turns, jumps, bifurcations, limit points; and the way back."""

from types import SimpleNamespace

import numpy as np
import pytest

from turgor.core.solvers.constraints.arc import Arc
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.constraints.load_factor import ArcTarget
from turgor.core.solvers.continuation import continuity
from turgor.core.solvers.continuation.continuity import judged, orientation, straightness
from turgor.core.solvers.continuation.path_run import Point
from turgor.core.solvers.continuation.scalar_control.arc_scaling import next_conditions
from turgor.core.solvers.continuation.scalar_control.path_reversal import reverses
from turgor.core.solvers.continuation.settings import CONTINUITY
from turgor.core.solvers.step_reasons import Cause


def point(parameter, place, direction, modes):
    """A point of a plane path: one displacement and the load factor, the direction of the path, its unstable modes."""
    state = SimpleNamespace(
        unstable_modes=modes, load_factor=place[1], displacement=np.array([[place[0], 0.0, 0.0]]), pressures={}
    )
    return Point(
        parameter=parameter,
        unknowns=np.array([place[0], 0.0, 0.0]),
        scalars=np.array([place[1]]),
        stresses=None,
        change=np.array([direction[0], 0.0, 0.0]),
        slope=np.array([direction[1]]),
        state=state,
    )


def run(states=(), size=1.0):
    system = SimpleNamespace(moving=np.ones(3, dtype=bool), length=1.0)
    return SimpleNamespace(size=size, steps=[], states=list(states), task=SimpleNamespace(system=system))


@pytest.fixture
def path(monkeypatch):
    """Let points be found on a path that a test gives as a function of the parameter."""
    known = {}

    def solve_at(_run, parameter, _start, _report):
        return SimpleNamespace(converged=True, evaluation=parameter, scalars=None)

    monkeypatch.setattr(continuity, "solve_at", solve_at)
    monkeypatch.setattr(continuity, "between", lambda points, parameter: None)
    monkeypatch.setattr(continuity, "point_at", lambda _run, at, parameter, scalars: known["path"](parameter))
    return lambda function: known.__setitem__("path", function)


def verdict(path, function, start=0.0, end=1.0):
    path(function)
    return judged(run(), function(start), function(end))


def test_a_step_along_a_smooth_path_is_one():
    assert judged(run(), point(0, (0, 0), (1, 1), 0), point(1, (1, 0.9), (1, 0.8), 0)).reason is None


def test_where_modes_come_while_the_load_rises_is_a_bifurcation(path):
    result = verdict(path, lambda p: point(p, (p, p), (1, 1), int(p > 0.37)))
    (passed,) = result.passed
    assert result.reason is None
    assert passed.load_factor == pytest.approx(0.37, abs=1e-3)
    assert passed.modes == 1


def test_two_bifurcations_in_a_step_are_two(path):
    result = verdict(path, lambda p: point(p, (p, p), (1, 1), int(p > 0.2) + int(p > 0.7)))
    assert [round(each.load_factor, 2) for each in result.passed] == [0.2, 0.7]
    assert [each.modes for each in result.passed] == [1, 1]


def test_a_double_bifurcation_counts_both_modes(path):
    (passed,) = verdict(path, lambda p: point(p, (p, p), (1, 1), 2 * int(p > 0.6))).passed
    assert passed.load_factor == pytest.approx(0.6, abs=1e-3)
    assert passed.modes == 2


def test_a_limit_point_is_none(path):
    result = verdict(path, lambda p: point(p, (p, p - p * p), (1, 1 - 2 * p), int(p > 0.5)), 0.3, 0.7)
    assert result.reason is None
    assert not result.passed


def test_a_maximum_and_a_minimum_in_a_step_are_none(path):
    """A path that goes back in its displacement between them is unstable twice beyond."""

    def snap(p):
        modes = 0 if p < 0.4 else 1 if p < 0.6 else 2
        return point(p, (p, 0.5), (1, 0.2 if modes != 1 else -0.1), modes)

    result = verdict(path, snap)
    assert result.reason is None
    assert not result.passed


def test_a_jump_to_another_branch_is_no_step(path):
    """However short the step, the point beyond lies as far away; the chord itself is straight."""
    result = verdict(path, lambda p: point(p, (p + 0.1 * (p > 0.5), p), (1, 1), int(p > 0.5)))
    assert result.reason.cause is Cause.OTHER_BRANCH


def test_a_step_that_leads_back_is_none(path):
    """Unloading without an unstable mode: the way it came, or another that no limit point leads to."""
    result = verdict(path, lambda p: point(p, (p, 0.1 * p), (1, 0.1 if p < 0.5 else -0.1), 0))
    assert result.reason.cause is Cause.OTHER_BRANCH


def test_a_sharp_turn_is_cut_and_a_corner_taken_in_the_end():
    last, now = point(0, (0, 0), (1, 0), 0), point(1, (1, 1), (0, 1), 0)
    going = run()
    assert straightness(going, last, now) == pytest.approx(np.sqrt(0.5))
    for _ in range(CONTINUITY.corner_cuts):
        assert judged(going, last, now).reason.cause is Cause.SHARP_TURN
        going.steps.append(SimpleNamespace(cause=Cause.SHARP_TURN))
    assert judged(going, last, now).reason is None
    back = point(1, (0.1, 1), (0, 1), 0)  # far from where the path was going
    assert judged(going, last, back).reason.cause is Cause.SHARP_TURN


def test_displacements_count_by_their_size():
    last, now = point(0, (0, 0), (1, 0), 0), point(1, (1, 1), (1, 1), 0)
    assert straightness(run(size=100.0), last, now) < 0.1 < straightness(run(size=0.1), last, now)


def test_paths_without_a_sought_load_factor_are_not_judged():
    assert judged(run(size=0.0), point(0, (0, 0), (1, 1), 0), point(1, (1, 1), (-1, -1), 0)).reason is None


def test_orientation_is_unknown_without_a_count_of_modes():
    assert orientation(point(0, (0, 0), (1, 1), None)) is None
    assert orientation(point(0, (0, 0), (1, -1), 1)) == orientation(point(0, (0, 0), (1, 1), 0)) == 1


@pytest.mark.parametrize(("moved", "load", "back"), [(0.42, 0.4, True), (1.7, 0.4, False), (0.97, 0.97, False)])
def test_a_path_that_goes_back_the_way_it_came_is_noticed(moved, load, back):
    """Up in proportion to a load of 1; beyond, the body goes on or back. Close to the top nothing can be said."""
    way = [point(p, (p, p), (1, 1), 0).state for p in (0.0, 0.3, 0.7, 1.0)]
    assert reverses(run(way), point(2.0, (moved, load), (1, -1), 1)) is back


def test_the_scale_of_arcs_grows_with_the_body_and_the_history_with_it():
    """Ten times as far as the load at a size of 1: the next arcs count a displacement by 2.5, and rates fit them."""
    places = [point(p, (10 * p, p), (10, 1), 0) for p in (0.0, 0.5, 1.0)]
    going = run([place.state for place in places])
    target = ArcTarget(going.task.system, 1.0, 0.5, np.zeros(3), np.zeros(1), Arc(np.zeros(3), 1.0))
    going.constraint, going.history = Constraint(None, target), list(places)
    next_conditions(going, places[1], places[2])
    target = going.constraint.target
    assert going.size == target.size == pytest.approx(2.5)
    assert np.hypot(target.arc.row[0] * 2.5, target.arc.rise) == pytest.approx(1.0)
    for place in going.history:
        assert target.arc.length(place.change, place.slope[0]) == pytest.approx(1.0)
        lengths = target.conditions(place.unknowns, place.parameter, place.scalars).errors
        assert lengths == pytest.approx([0.0], abs=1e-12)
    next_conditions(going, places[1], places[2])
    assert going.size == pytest.approx(2.5)
