"""Optimizations: what they are asked, how they end, what they keep, and what they say."""

import re
from pathlib import Path

import numpy as np
import pytest

import optimization_cases as cases
import turgor as tg
from refused import refused
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.executors.run_outcome import Ended
from turgor.studies.runs.run import Computed
from turgor.studies.runs.study import Row
from turgor.units import mm

studies = tg.studies
AB = cases.factors("a", "b")
BEGIN = {"a": -0.5, "b": -0.5}


def search(most, **more):
    return studies.Search(most_solves=most, **more)


def test_every_candidate_is_a_row_of_a_study():
    result = tg.optimize(cases.bowl, AB, [studies.Minimize("height")], start=BEGIN, search=search(40))
    assert result.converged and result.ending is studies.Ending.CONVERGED
    assert len(result.study) == result.solves == len(result.scores) <= 40
    assert dict(result.study.rows[result.start].values) == BEGIN
    heights = result.study.column("height")
    assert result.best == int(np.argmin(heights))
    assert result.values == pytest.approx({"a": 0.3, "b": 0.6}, abs=0.02)
    assert "height: 3 (as small as possible), at the start 6.06" in result.summary()


def test_a_target_alone_ends_as_soon_as_it_is_met():
    result = tg.optimize(cases.bowl, AB, [studies.Target("height", 3.5)], start=BEGIN)
    assert result.converged and result.solves <= 8
    assert result.reads()[0].value == pytest.approx(3.5, rel=0.01)
    assert result.message == f"All targets are met, after {result.solves} runs."


def test_a_target_beside_an_objective_is_a_condition():
    goals = [studies.Target("height", 3.5), studies.Maximize("total")]
    result = tg.optimize(cases.bowl, AB, goals, start=BEGIN, search=search(60))
    height, total = (each.value for each in result.reads())
    assert result.converged and height == pytest.approx(3.5, rel=0.011)
    # a − 0.3 = 2 (b − 0.6) at the largest sum, with (a − 0.3)² + 2 (b − 0.6)² = 0.5
    assert total == pytest.approx(0.9 + 3 * np.sqrt(0.5 / 6), abs=0.03)


def test_what_cannot_be_met_is_said_with_how_near_it_came():
    result = tg.optimize(cases.bowl, AB, [studies.Target("height", 2.5)], start=BEGIN, search=search(60))
    assert result.ending is studies.Ending.INFEASIBLE and not result.converged
    assert "Nearest: height: 3 (wanted 2.5)" in result.message
    assert "relax a goal" in result.advice
    assert result.values == pytest.approx({"a": 0.3, "b": 0.6}, abs=0.05)


def test_an_end_of_a_range_is_named_where_it_is_in_the_way():
    result = tg.optimize(cases.bowl, AB, [studies.Target("total", 3.0)], start=BEGIN, search=search(60))
    assert result.ending is studies.Ending.INFEASIBLE
    assert "total: 2 (wanted 3)" in result.message
    assert result.advice.startswith("The nearest design has a at its highest, b at its highest.")
    assert "a: -0.5 → 1 (at the upper end of its range)" in result.summary()


def test_it_ends_with_what_it_found_where_the_runs_end():
    result = tg.optimize(cases.bowl, AB, [studies.Minimize("height")], start=BEGIN, search=search(6))
    assert result.ending is studies.Ending.BUDGET and result.solves == 6
    assert result.best == int(np.argmin(result.study.column("height")))
    assert result.message.startswith("The budget of 6 runs ended before the search.")


def test_killed_and_called_again_it_goes_on(tmp_path):
    log = tmp_path / "log"
    computation = studies.Computation(function=cases.bowl, values={"log": str(log)})

    def asked(most):
        runs = studies.saved_in(tmp_path / "runs")
        goals = [studies.Minimize("height"), studies.Limit("total", most=0.5)]
        return tg.optimize(computation, AB, goals, start=BEGIN, search=search(most), evaluations=runs)

    first = asked(5)
    assert len(log.read_text().splitlines()) == first.solves == 5
    second = asked(40)
    assert second.converged
    assert len(log.read_text().splitlines()) == second.solves, "nothing is computed twice"
    assert [dict(row.values) for row in second.study.rows[:5]] == [dict(row.values) for row in first.study.rows]


def test_runs_beside_the_start_are_computed_in_processes(tmp_path):
    runs = studies.saved_in(tmp_path, processes=2)
    result = tg.optimize(cases.bowl, AB, [studies.Target("height", 3.5)], start=BEGIN, evaluations=runs)
    assert result.converged


def test_several_starts_find_the_lower_of_two_valleys(tmp_path):
    """From (0.9, 0) a search ends in the right valley, at 4 x (x² − 1) + 0.3 = 0: x = 0.960; the left one has −1.035.

    Of a Latin hypercube of two further starts, one begins on either side.
    """
    computation = studies.Computation(function=cases.two_valleys, values={"log": str(tmp_path / "log")})
    asked = computation, cases.factors("x", "y", low=-2, high=2), [studies.Minimize("height", scale=1.0)]
    near = tg.optimize(*asked, start={"x": 0.9, "y": 0.0}, search=studies.Search(most_solves=60))
    assert near.converged
    assert near.values["x"] == pytest.approx(0.960, abs=0.02)
    assert near.reads()[0].value == pytest.approx(0.2942, abs=0.002)
    assert len(near.descents) == 1
    (tmp_path / "log").unlink()
    result = tg.optimize(*asked, start={"x": 0.9, "y": 0.0}, search=studies.Search(most_solves=120, starts=3))
    assert result.converged
    assert result.values["x"] == pytest.approx(-1.035, abs=0.02)
    assert result.reads()[0].value == pytest.approx(-0.3054, abs=0.002)
    begun = [result.study.rows[each.start].values["x"] for each in result.descents]
    led = [result.study.rows[each.best].values["x"] for each in result.descents]
    assert begun[0] == 0.9
    assert min(begun[1:]) < 0 < max(begun[1:])
    assert led == [pytest.approx(0.960 if x > 0 else -1.035, abs=0.02) for x in begun]
    assert result.best in [each.best for each in result.descents]
    computed = (tmp_path / "log").read_text(encoding="utf-8").splitlines()
    assert len(computed) == len(set(computed)) == result.solves <= 120
    told = result.summary()
    assert "3 starts; the best design of each:" in told
    assert "  from x 0.9, y 0: x 0.9" in told


def test_starts_end_where_all_targets_are_met_and_share_the_runs():
    goal = [studies.Target("height", -0.3, scale=1.0)]
    asked = cases.two_valleys, cases.factors("x", "y", low=-2, high=2), goal
    result = tg.optimize(*asked, start={"x": -0.8, "y": 0.4}, search=studies.Search(most_solves=60, starts=4))
    assert result.converged
    assert len(result.descents) == 1, "the first one has met the target"
    few = tg.optimize(*asked, start={"x": 0.9, "y": 0.0}, search=studies.Search(most_solves=8, starts=4))
    assert few.solves <= 8
    assert [each.start for each in few.descents][:2] == [0, 2]


@pytest.mark.parametrize(
    ("goals", "search", "facts"),
    [
        (["height"], {"starts": 0}, ["starts", 0, "1 to 12", "most_solves", 25]),
        (["height"], {"starts": 5, "most_solves": 8}, ["starts", 5, "1 to 4", "most_solves", 8]),
        (["height", "x"], {"starts": 2}, ["starts", 2, "front"]),
    ],
)
def test_starts_that_do_not_fit_are_refused(goals, search, facts):
    with refused(*facts):
        tg.optimize(cases.two_valleys, cases.factors("x", "y"), [studies.Minimize(each) for each in goals],
                    search=studies.Search(**search))  # fmt: skip


def test_a_run_that_fails_is_a_row_and_the_search_turns_back():
    computation = studies.Computation(function=cases.bowl, values={"refused_above": 0.1})
    result = tg.optimize(computation, AB, [studies.Minimize("height")], start=BEGIN, search=search(40))
    failed = [row for row in result.study.rows if row.status == "failed"]
    assert failed and "allowed is up to 0.1" in failed[0].problem
    assert f"{len(failed)} of them gave no value" in result.message
    assert 0.0 < result.values["a"] <= 0.1
    assert result.values["b"] == pytest.approx(0.6, abs=0.05)


def test_a_start_that_fails_is_left():
    computation = studies.Computation(function=cases.bowl, values={"refused_above": 0.4})
    result = tg.optimize(computation, AB, [studies.Minimize("height")], start={"a": 0.9, "b": 0.0}, search=search(50))
    assert result.study.rows[result.start].status == "failed"
    assert result.values == pytest.approx({"a": 0.3, "b": 0.6}, abs=0.03)


def test_where_all_runs_fail_the_reason_is_told():
    computation = studies.Computation(function=cases.bowl, values={"refused_above": -2.0})
    result = tg.optimize(computation, AB, [studies.Minimize("height")])
    assert result.ending is studies.Ending.FAILED and result.best is None and result.values == {}
    assert "the first: a is 0; allowed is up to -2" in result.summary()


def test_no_run_is_spent_on_what_breaks_a_rule(tmp_path):
    log = tmp_path / "log"
    computation = studies.Computation(function=cases.bowl, values={"log": str(log)})
    rule = studies.Rule("a and b at most 0.5 together", lambda values: 0.5 - values["a"] - values["b"])
    result = tg.optimize(computation, AB, [studies.Minimize("height"), rule], start=BEGIN, search=search(40))
    asked = np.array([[float(x) for x in line.split()] for line in log.read_text().splitlines()])
    assert asked.sum(axis=1).max() <= 0.5 + 1e-8
    assert result.converged and result.values == pytest.approx({"a": 0.3 - 0.8 / 3, "b": 0.6 - 0.4 / 3}, abs=0.03)


def test_a_start_that_breaks_a_rule_is_refused():
    rule = studies.Rule("b above a", lambda values: values["b"] - values["a"])
    with refused("a 0.5, b 0", "'b above a'"):
        tg.optimize(cases.bowl, AB, [studies.Minimize("height"), rule], start={"a": 0.5, "b": 0.0})


def test_whole_numbers_stay_whole():
    count = studies.Factor(name="count", low=1, high=9, whole=True)
    goals = [studies.Minimize("height")]
    result = tg.optimize(cases.counted, [count, *cases.factors("x", low=0)], goals, start={"count": 8, "x": 0.1},
                        search=search(50))  # fmt: skip
    assert all(isinstance(row.values["count"], int) for row in result.study.rows)
    assert result.values == pytest.approx({"count": 4, "x": 0.4}, abs=0.06)


def test_the_noise_of_a_mesh_does_not_lead_it_away():
    result = tg.optimize(cases.noisy, AB, [studies.Minimize("height")], start=BEGIN, search=search(30, precision=0.02))
    assert cases.bowl(**result.values)["height"][0] == pytest.approx(3.0, rel=5e-3)


def test_rows_say_whether_they_keep_the_limits():
    goals = [studies.Minimize("height"), studies.Limit("total", most=0.5)]
    result = tg.optimize(cases.bowl, AB, goals, start={"a": 0.5, "b": 0.5}, search=search(30))
    total = result.study.column("total")
    assert total[0] == 1.0 and result.converged
    assert [each.feasible for each in result.scores] == (total <= 0.5 * 1.002).tolist()


def test_own_objectives_and_factors_are_measures():
    goals = [studies.Minimize(lambda response: float(response["height"][0] ** 2)), studies.Limit("a", most=0.1)]
    result = tg.optimize(cases.bowl, AB, goals, start=BEGIN, search=search(50))
    assert result.values == pytest.approx({"a": 0.1, "b": 0.6}, abs=0.03)
    assert "own objective: 9.241 (as small as possible)" in result.summary()


def test_a_path_of_the_tip_is_met():
    wanted = cases.arc(0.11, 14.0)
    curve = list(zip(wanted["tip_displacement_x"], wanted["tip_displacement_z"], strict=True))
    ranges = [
        studies.Factor(name="length", low=0.08, high=0.13, unit="mm"), studies.Factor(name="curvature", low=5, high=20)
    ]  # fmt: skip
    shape = tg.optimize(cases.arc, ranges, [studies.TipPath(curve, tolerance=0.2 * mm)])
    timed = studies.TipPath(curve[1:], at=("pressure", wanted["pressure"][1:]), tolerance=0.2 * mm)
    for result in (shape, tg.optimize(cases.arc, ranges, [timed])):
        assert result.converged, result.summary()
        assert result.values["length"] == pytest.approx(0.11, rel=0.01)
        assert re.search(r"distance from the path: 0\.\d+ mm \(within 0.2 mm\)", result.summary())


def test_units_of_values_do_not_change_the_search():
    def scaled(factor):
        def height(response):
            return factor * float(response["height"][0])

        goals = [studies.Minimize(height), studies.Limit("total", most=0.5)]
        return tg.optimize(cases.bowl, AB, goals, start=BEGIN, search=search(20)).study.inputs

    assert scaled(1e6) == pytest.approx(scaled(1.0), abs=1e-6)


def test_the_best_design_is_computed_again_for_its_mesh_error():
    computation = studies.Computation(function=with_mesh_error, nominal={"mesh_error": True})
    result = tg.optimize(computation, AB, [studies.Target("height", 3.5)], start=BEGIN)
    assert result.reads()[0].mesh_error == pytest.approx(0.01)
    assert "± 0.01 (mesh)" in result.summary()


def with_mesh_error(a, b, mesh_error=False):
    height = float(cases.bowl(a, b)["height"][0])
    return cases.table(height=height, **({"height_mesh_error": 0.01} if mesh_error else {}))


@pytest.mark.parametrize(
    ("goals", "more", "facts"),
    [
        ([], {}, ["goals", "Target", "TipPath", "Minimize"]),
        ([studies.Minimize("hight")], {}, ["'hight'", "'height'"]),
        ([studies.Minimize("height")], {"start": {"c": 0.0}}, ["start", "'c'", "a, b"]),
        ([studies.Minimize("height")], {"start": {"a": 3.0}}, ["start", "'a'", 3, "-1 to 1"]),
        ([studies.Minimize("height")], {"search": search(9, method="pareto")}, ["pareto", 1, "'trust_region'"]),
        (
            [studies.Minimize("height"), studies.Maximize("total")],
            {"search": search(9, method="trust_region")},
            ["trust_region", 2, "'pareto'"],
        ),
        ([studies.Minimize(lambda response: "much")], {}, ["objective", "'much'", "a number"]),
    ],
)
def test_what_cannot_be_asked_is_said(goals, more, facts):
    with refused(*facts):
        tg.optimize(cases.bowl, AB, goals, **more)


def test_choices_and_unknown_factors_are_refused():
    with refused("'a'", "soft, hard"):
        tg.optimize(cases.bowl, [studies.Factor(name="a", levels=("soft", "hard"))], [studies.Minimize("height")])
    with refused("'heigth'", "a, b, log"):
        tg.optimize(cases.bowl, cases.factors("heigth"), [studies.Minimize("height")])
    with refused("'a'", "one value", 1):
        tg.optimize(cases.bowl, [studies.Factor(name="a", levels=(1.0,))], [studies.Minimize("height")])


@pytest.mark.parametrize(
    ("make", "facts"),
    [
        (lambda: studies.Target("height", 0.0), ["height", 0, "scale"]),
        (lambda: studies.Target("height", 1.0, tolerance=2.0), ["tolerance", "height", 2, "0 and 1"]),
        (lambda: studies.Limit("height"), ["height", "most", "least"]),
        (lambda: studies.Limit("height", most=1.0, least=2.0), ["height", "least 2", "most 1"]),
        (lambda: studies.TipPath([(0.0, 0.0)]), ["two", "(1, 2)", "tip_displacement_x"]),
        (lambda: studies.TipPath([(0, 0), (1, 1)], at=("pressure", [1.0])), ["2 points", "1 values", "'pressure'"]),
        (lambda: studies.Search(method="newton"), ["'newton'", "trust_region"]),
        (lambda: studies.Search(most_solves=1), ["most_solves", 1, "2 or more"]),
        (lambda: studies.Search(precision=0.5), ["precision", 0.5, "0 and 0.1"]),
    ],
)
def test_numbers_out_of_range_are_refused(make, facts):
    with refused(*facts):
        make()


def test_a_value_that_the_path_does_not_reach_is_told():
    result = tg.optimize(
        cases.arc, cases.factors("length", low=0.1, high=0.2) + cases.factors("curvature", low=1, high=5),
        [studies.Target("tip_displacement_z", 0.01, at=("pressure", 50e3))],
    )  # fmt: skip
    assert result.ending is studies.Ending.FAILED
    assert "its path does not reach the value at which the goals are read" in result.message


def test_the_figure_shows_each_goal_and_the_best_run(tmp_path):
    goals = [studies.Minimize("height"), studies.Limit("total", most=0.5)]
    result = tg.optimize(cases.bowl, AB, goals, start=BEGIN)
    figure = studies.optimization_figure(result)
    first, second = figure.axes
    assert (first.get_ylabel(), second.get_ylabel()) == ("height", "total")
    assert 0.5 in second.lines[-1].get_ydata()
    figure.savefig(tmp_path / "optimization.png")
    assert Path(tmp_path / "optimization.png").stat().st_size > 5000


def test_evaluations_without_files_are_enough():
    runs = Evaluations()
    tg.optimize(cases.bowl, AB, [studies.Target("height", 3.5)], start=BEGIN, evaluations=runs)
    solves = len(runs.ended)
    tg.optimize(cases.bowl, AB, [studies.Target("height", 3.5)], start=BEGIN, evaluations=runs)
    assert len(runs.ended) == solves


def test_slopes_spare_runs():
    names = ("a", "b", "c", "d", "e")
    counts = {}
    for function in (cases.long_bowl, cases.half_sloped_bowl, cases.sloped_bowl):
        result = tg.optimize(function, cases.factors(*names), [studies.Target("height", 1.05)], search=search(200))
        assert result.converged, result.summary()
        counts[function.__name__] = result.solves
    assert counts["sloped_bowl"] <= 0.6 * counts["long_bowl"], counts
    assert counts["sloped_bowl"] < counts["half_sloped_bowl"] < counts["long_bowl"], counts
    away = np.array(list(result.values.values())) - np.linspace(-0.5, 0.5, 5)
    assert float(np.geomspace(1, 100, 5) @ away**2) == pytest.approx(0.05, abs=0.011)


def test_slopes_are_left_out_where_nobody_wants_them():
    asked = [studies.Target("height", 1.05)]
    factors = cases.factors("a", "b", "c")
    alone = tg.optimize(cases.long_bowl, factors, asked, search=search(200))
    result = tg.optimize(cases.sloped_bowl, factors, asked, search=search(200, slopes=False))
    assert result.study.inputs == pytest.approx(alone.study.inputs, abs=0)


def test_slopes_at_a_value_of_a_drive_that_moves_as_well():
    """Read at a tip of 2: x = p a and y = p² b give y = b (2/a)² there, whose derivative by a is −8 b / a³."""
    p, a, b = np.linspace(0, 3, 3001), 1.5, 0.7
    columns = tuple(Column(name, "", values) for name, values in (("x", p * a), ("y", p**2 * b)))
    response = studies.with_slopes(
        Response(columns=columns, source=Source(text="two powers")), {"x": {"a": p}, "y": {"a": 0 * p, "b": p**2}}
    )
    row = Row(values={"a": a, "b": b}, ended=Ended(run=studies.Computation(function=cases.bowl).run({}),
              result=Computed(response=response)))  # fmt: skip
    for at in (2.0, 3.0):
        result = studies.Target("y", 1.0, at=("x", at)).slopes(row, ["a", "b"])[0]
        assert result == pytest.approx([-2 * b * at**2 / a**3, at**2 / a**2], rel=1e-3)


def test_slopes_of_the_wrong_length_are_refused():
    with refused("'height'", "'a'", "(2,)", 1):
        studies.with_slopes(cases.bowl(0.0, 0.0), {"height": {"a": [1.0, 2.0]}})
