"""Pressures that follow a path of a reduced model, under limits."""

import numpy as np
import pytest
from reduced_cases import KEY, PRESSURE, reduced

import turgor as tg
from refused import refused
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.box import aims_of
from turgor.systems.control.least_squares import least_squares
from turgor.systems.control.search import Request, Search
from turgor.systems.control.track import other_starts

PRESSURES = np.linspace(500.0, 11e3, 12)


def tips(pressures=PRESSURES):
    return np.array([reduced().solve(float(pressure)).tip for pressure in pressures])


def test_a_path_that_can_be_reached_gives_the_pressures_that_made_it():
    result = tg.control.track(reduced(), tips())
    assert result.inputs[:, 0] == pytest.approx(PRESSURES, abs=1.0)
    assert result.distance.max() < 1e-8
    assert not any(result.active)
    assert result.response()["pressure_kPa"] == pytest.approx(PRESSURES / 1e3, abs=1e-3)


def test_limits_of_pressure_and_rate_are_fulfilled_to_1e_9_and_named():
    limits = tg.control.Limits(high=6e3, rate={"pressure": 1000.0})
    result = tg.control.track(reduced(), tips(), times=0.9 * np.arange(12), limits=limits)
    pressures = result.inputs[:, 0]
    assert pressures.max() <= 6e3 * (1 + 1e-9)
    assert np.abs(np.diff(pressures)).max() <= 900.0 * (1 + 1e-9)
    assert result.active[2] == (f"{KEY} rate",)
    assert result.active[-1] == (f"{KEY} high",)
    closest = np.linalg.norm(reduced().solve(6e3).tip - result.target[-1])
    assert result.distance[-1] == pytest.approx(closest, rel=1e-4)


@pytest.fixture
def solves(monkeypatch):
    """Iterations of all equilibria that are found."""
    counts: list[int] = []
    under = Reduced.under

    def counted(self, aim, start=None):
        answer = under(self, aim, start)
        counts.append(answer.iterations)
        return answer

    monkeypatch.setattr(Reduced, "under", counted)
    return counts


def test_rows_near_each_other_take_one_equilibrium_each_and_are_met(solves):
    pressures = np.linspace(5e3, 7e3, 20)
    path = tips(pressures)
    solves.clear()
    result = tg.control.track(reduced(), path)
    assert len(solves) <= len(path) + 3  # the first row is far
    assert result.distance.max() < 1e-6
    state = reduced().solve(float(result.inputs[-1, 0]))
    assert result.reached[-1] == pytest.approx(state.tip, abs=1e-9)


def test_rows_that_a_rate_leaves_behind_try_no_far_starts(solves):
    path = tips(np.linspace(5e3, 7e3, 20))
    solves.clear()
    limits = tg.control.Limits(rate={"pressure": 80.0})
    result = tg.control.track(reduced(), path, times=np.arange(20.0), limits=limits)
    assert result.distance[-1] > 1e-4
    assert len(solves) <= len(path) + 3


def test_a_limit_of_volume_is_fulfilled_and_named():
    most = reduced().solve(7e3).volumes["cavity"]
    result = tg.control.track(reduced(), tips(), limits=tg.control.Limits(volume={"cavity": (0.0, most)}))
    assert max(state.volumes["cavity"] for state in result.states) <= most * (1 + 1e-9)
    assert result.inputs[-1, 0] == pytest.approx(7e3, rel=1e-5)
    assert result.active[-1] == ("volume of cavity high",)


def test_a_limit_of_volume_is_fulfilled_where_the_search_ends_early():
    limits = tg.control.Limits(volume={"cavity": (0.0, reduced().solve(7e3).volumes["cavity"])}).of(reduced())
    search = Search(reduced(), tg.control.Tip().of(reduced()), limits, iterations=1)
    state = search.nearest(reduced().solve(11e3), Request(tips()[-1], limits.low, limits.high, np.zeros(1)))
    assert limits.excess(state) <= 1e-9


def test_the_closest_point_of_a_target_far_away_is_where_the_distance_is_least():
    target = tips()[5] + [0.0, 0.0, 0.003]
    result = tg.control.track(reduced(), target[None])
    distances = [np.linalg.norm(tip - target) for tip in tips(np.linspace(0, PRESSURE, 400))]
    assert result.distance[0] == pytest.approx(min(distances), rel=1e-4)


def test_other_starts_are_tried_where_a_search_ends_away_from_its_target():
    """One update from rest is not enough; from the nearest training states it is nearly so."""
    of, limits, target = tg.control.Tip().of(reduced()), tg.control.Limits().of(reduced()), tips()[9]
    search = Search(reduced(), of, limits, iterations=1)
    request = Request(target, limits.low, limits.high, np.zeros(1))
    stalled = search.nearest(reduced().solve(0.0), request)
    best = search.best(stalled, other_starts(search, target, limits.low, limits.high), request)
    assert search.error(stalled, target) > 20 * search.error(best, target)


def test_the_angle_is_that_of_the_measure_and_its_derivative_is_exact():
    output = tg.control.Angle().of(reduced())
    state = reduced().solve(9e3)
    value, slopes = output.at(state)
    assert value[0] == pytest.approx(tg.bending_angle(state.state()), abs=1e-7)
    ends = [output.at(reduced().at(state.inputs + step, state))[0] for step in (1.0, -1.0)]
    assert slopes[0] == pytest.approx(0.5 * (ends[0] - ends[1]), rel=1e-5)


@pytest.mark.parametrize("output", [tg.control.Shape((0.5, 1.0)), tg.control.Points([(0.02, 0.0, 0.0)])])
def test_points_and_shapes_are_followed(output):
    of = output.of(reduced())
    path = np.array([of.at(reduced().solve(float(pressure)))[0] for pressure in PRESSURES])
    assert tg.control.track(reduced(), path, output=output).inputs[:, 0] == pytest.approx(PRESSURES, abs=2.0)


def test_least_squares_under_limits_is_the_best_of_all_corners():
    random = np.random.default_rng(1)
    for _ in range(50):
        A, b = random.normal(size=(5, 3)), 3 * random.normal(size=5)
        C, d = np.vstack([np.eye(3), -np.eye(3), random.normal(size=(2, 3))]), np.append(np.ones(6), [0.5, 0.7])
        result = least_squares(A, b, C, d)
        assert (C @ result.x <= d + 1e-9).all()
        gradient = A.T @ (A @ result.x - b)
        tight = C @ result.x >= d - 1e-9  # the gradient is a sum of active limits with factors that are not positive
        factors = np.linalg.lstsq(C[tight].T, gradient, rcond=None)[0] if tight.any() else np.zeros(0)
        assert C[tight].T @ factors == pytest.approx(gradient, abs=1e-7)
        assert (factors <= 1e-7).all()
    assert least_squares(np.eye(1), np.zeros(1), np.array([[1.0], [-1.0]]), np.array([-1.0, 0.5])) is None


@pytest.mark.parametrize(
    ("given", "facts"),
    [
        ({"path": np.zeros((3, 2))}, ("(3, 2)", "(rows, 3)", "tip_x")),
        ({"path": np.full((2, 3), np.nan)}, ("1", "nan")),
        ({"path": np.zeros((2, 3)), "times": [0.0, 0.0]}, ("2", "0 s")),
        ({"path": np.zeros((2, 3)), "times": [0.0]}, (1, 2)),
        ({"path": np.zeros((2, 3)), "limits": tg.control.Limits(rate=1.0)}, ("times",)),
        ({"path": np.zeros((2, 3)), "limits": tg.control.Limits(high={"presure": 1.0})}, ("presure", KEY)),
        ({"path": np.zeros((2, 3)), "limits": tg.control.Limits(high=20e3)}, ("20 kPa", "12 kPa")),
        ({"path": np.zeros((2, 3)), "limits": tg.control.Limits(volume={"cavty": (0, 1)})}, ("cavty", "cavity")),
        ({"path": np.zeros((2, 3)), "smoothness": 0.0}, ("smoothness", 0)),
    ],
)
def test_what_makes_no_sense_is_refused(given, facts):
    with refused(*facts):
        tg.control.track(reduced(), **given)


def test_aims_of_training_are_shares_of_the_ranges():
    box = reduced().inputs
    assert aims_of(box, [(0.25,)]) == [pytest.approx([0.25 * PRESSURE])]
    with refused("(0.5, 0.5)", 1, "0 to 1"):
        aims_of(box, [(0.5, 0.5)])
    with refused("(1.5,)", "0 to 1"):
        aims_of(box, [(1.5,)])
