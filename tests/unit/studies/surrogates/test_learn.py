"""Next designs and the loop that asks for them."""

from dataclasses import replace

import numpy as np
import pytest

import surrogate_cases as cases
from refused import refused
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.surrogates.fit import surrogate
from turgor.studies.surrogates.learn import Goal, learn
from turgor.studies.surrogates.next_design import next_design
from turgor.units import deg, kPa, mm

#: Designs on one side of the range, so that the other side is unknown.
ONE_SIDE = [{"wall": wall * mm, "C10": C10 * kPa} for wall in (1.0, 1.15, 1.3) for C10 in (50.0, 66.0, 83.0, 100.0)] + [
    {"wall": 2.0 * mm, "C10": 50 * kPa}
]


@pytest.fixture(scope="module")
def one_sided():
    study = cases.study_of(cases.finger, [cases.WALL, cases.C10], designs=ONE_SIDE)
    return surrogate(study, ["bending_angle"])


def test_it_asks_where_nothing_is_known(one_sided):
    (design,) = next_design(one_sided)
    assert design["wall"] > 1.6 * mm
    assert design["C10"] > 70 * kPa  # away from the one row with a thick wall


def test_a_batch_is_spread_out(one_sided):
    shares = np.array([[each["wall"] / mm - 1, (each["C10"] / kPa - 50) / 50] for each in next_design(one_sided, 4)])
    apart = np.linalg.norm(shares[:, None] - shares[None], axis=2)[~np.eye(4, dtype=bool)]
    assert apart.min() > 0.2


def test_failed_designs_are_avoided(one_sided):
    first, second = next_design(one_sided), next_design(one_sided, avoid=next_design(one_sided))
    assert abs(first[0]["wall"] - second[0]["wall"]) + abs(first[0]["C10"] - second[0]["C10"]) * 2e-8 > 0.05 * mm


def test_with_a_target_it_asks_near_it(one_sided):
    """40° lies between 50 kPa (45°) and 66 kPa (37°) at the wall of 1.5 mm, among others; no row is within 1°."""
    (design,) = next_design(one_sided, target={"bending_angle": 40 * deg})
    exact = cases.finger(**design)["bending_angle_deg"][-1]
    assert exact == pytest.approx(40, abs=1.5)
    two = next_design(one_sided, 2, target={"bending_angle": 40 * deg})
    assert two[0] == design
    assert two[1] != design


def test_without_the_drive(one_sided):
    study = cases.study_of(cases.finger, [cases.WALL, cases.C10], 8)
    curves = surrogate(study, ["bending_angle"], along="pressure")
    assert set(next_design(curves)[0]) == {"wall", "C10"}
    assert set(next_design(curves, target={"bending_angle": 0.3})[0]) == {"wall", "C10"}


def test_the_loop_ends_at_its_error(tmp_path):
    goal = Goal(measures=("bending_angle",), error=0.004, runs=40, at=("pressure", 40 * kPa))
    where = Evaluations(folder=tmp_path)
    result = learn(Computation(function=cases.finger), [cases.WALL, cases.C10], goal, evaluations=where)
    assert result.reached
    assert result.errors[-1][1] <= 0.004 < result.errors[0][1]
    assert result.errors[0][0] == 6
    assert "reached." in result.sentence()
    again = Evaluations(folder=tmp_path)
    learn(Computation(function=cases.finger), [cases.WALL, cases.C10], goal, evaluations=again)
    assert all(each.again for each in again.ended.values())
    assert list(again.ended) == list(where.ended)


def test_the_loop_ends_at_its_budget_and_passes_failures():
    thin = replace(cases.WALL, low=0.8 * mm)
    goal = Goal(measures=("bending_angle",), error=1e-9, runs=14, batch=4)
    seen = []
    result = learn(Computation(function=cases.finger), [thin, cases.C10], goal, progress=seen.append)
    assert [each.errors[-1][0] for each in seen] == [6, 10, 14] == [count for count, _ in result.errors]
    assert not result.reached
    assert "not reached" in result.sentence()
    failed = [row.values["wall"] for row in result.study.rows if row.response is None]
    assert failed
    assert len(result.study) > len(failed) + 8


def test_goals_are_checked(one_sided):
    with refused("goal", "measure"):
        Goal(measures=())
    with refused("error", 0, "above 0"):
        Goal(measures=("a",), error=0.0)
    with refused("runs", 4, "batch", 5):
        Goal(measures=("a",), runs=4)
    with refused("count", 0, "1 to 256"):
        next_design(one_sided, 0)
    with refused("'bending_angel'", "'bending_angle'"):
        next_design(one_sided, target={"bending_angel": 1.0})
    rubber = replace(cases.WALL, name="rubber", low=None, high=None, levels=tuple("abcdefghijk"), unit="")
    with refused("'rubber'", 11, 10):
        learn(cases.finger, [rubber], Goal(measures=("bending_angle",)))
