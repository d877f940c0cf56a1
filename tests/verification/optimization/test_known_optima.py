"""Optimizations end where the optimum is known: bowls, limits, inverse formulas and fronts.

Problems: a quadratic bowl with its bottom at (0.3, 0.6); the same with a + b ≤ 0.5, whose lowest point is that of the
Lagrange conditions a − 0.3 = 2 (b − 0.6); a thick sphere whose radius and wall are found from two points of its curve;
two distances that are made small at the same time, whose front is √f₁ + √f₂ = 1 (f are their squares).
Tolerance: a bowl is flat: a step of 1 % of the range at its bottom changes it by 10⁻⁴. Targets are met within the
1 % that they state; the inverse of the sphere is as well conditioned as its curve is bent. The front is computed where
surfaces promise it, and the search ends where these are right within 2 % of its range.
"""

import numpy as np
import pytest

import optimization_cases as cases
import turgor as tg
from turgor.units import kPa, mm

studies = tg.studies
BEGIN = {"a": -0.5, "b": -0.5}


def test_the_bottom_of_a_bowl_is_found(record_verification):
    result = tg.optimize(
        cases.bowl, cases.factors("a", "b"), [studies.Minimize("height")], start=BEGIN,
        search=studies.Search(most_solves=40),
    )  # fmt: skip
    got = [*result.values.values(), result.reads()[0].value]
    record_verification(
        claim="optimization: bottom of a quadratic bowl, its place and height",
        source="closed form",
        expected=[0.3, 0.6, 3.0],
        got=np.round(got, 4),
        tolerance="1 % of the range; 10⁻⁴ of the height",
    )
    assert result.converged
    assert got[:2] == pytest.approx([0.3, 0.6], abs=0.02)
    assert got[2] == pytest.approx(3.0, rel=1e-4)


def test_a_limit_holds_the_bottom_back(record_verification):
    goals = [studies.Minimize("height"), studies.Limit("total", most=0.5)]
    result = tg.optimize(cases.bowl, cases.factors("a", "b"), goals, start=BEGIN, search=studies.Search(most_solves=40))
    exact = [0.3 - 0.8 / 3, 0.6 - 0.4 / 3]
    got = list(result.values.values())
    record_verification(
        claim="optimization: lowest point of a quadratic bowl under a + b ≤ 0.5",
        source="Lagrange conditions",
        expected=np.round(exact, 4),
        got=np.round(got, 4),
        tolerance="1 % of the range",
    )
    assert result.converged
    assert got == pytest.approx(exact, abs=0.02)
    assert result.study.column("total")[result.best] <= 0.5 * 1.002


def test_radius_and_wall_of_a_sphere_are_found_from_its_curve(record_verification):
    true = cases.sphere(12 * mm, 1.6 * mm)
    goals = [
        studies.Target(name, float(np.interp(at, true["pressure"], true[name])), at=("pressure", at), tolerance=1e-3)
        for name, at in (("inner_stretch", 6 * kPa), ("inner_stretch", 12 * kPa), ("cavity_volume", 6 * kPa))
    ]
    result = tg.optimize(cases.sphere, [cases.RADIUS, cases.WALL], goals)
    got = np.array(list(result.values.values())) / mm
    record_verification(
        claim="optimization: radius and wall of a sphere from three points of its curve [mm]",
        source="closed form inverted",
        expected=[12.0, 1.6],
        got=np.round(got, 3),
        tolerance="1 %",
    )
    assert result.converged and result.solves <= 25
    assert got == pytest.approx([12.0, 1.6], rel=0.01)


def check_front(found, most):
    left, right = found.objectives()[list(found.pareto)].T
    assert right == pytest.approx((1 - np.sqrt(left)) ** 2, abs=most)
    assert np.sqrt(left).min() < 0.05 and np.sqrt(left).max() > 0.95, "the front reaches from end to end"
    assert np.max(np.diff(np.sqrt(np.sort(left)))) < 0.25, "without a hole"
    return left, right


def test_the_front_of_two_distances(record_verification):
    goals = [studies.Minimize("left"), studies.Minimize("right")]
    ranges = cases.factors("x", "y", low=-1.5, high=1.5)
    result = tg.optimize(cases.two_hills, ranges, goals, search=studies.Search(most_solves=40))
    left, right = check_front(result, 0.02)
    record_verification(
        claim="optimization: front of two squared distances, largest distance of f₂ from (1 − √f₁)²",
        source="closed form",
        expected=0.0,
        got=round(float(np.max(np.abs(right - (1 - np.sqrt(left)) ** 2))), 5),
        tolerance="2 %",
    )
    assert result.ending is studies.Ending.CONVERGED
    assert 0.3 < result.values["x"] < 0.7, "the best one lies between the ends"


def test_the_front_of_a_cheap_function_by_evolution():
    goals = [studies.Minimize("left"), studies.Minimize("right")]
    ranges = cases.factors("x", "y", low=-1.5, high=1.5)
    search = studies.Search(most_solves=600, method="evolution")
    result = tg.optimize(cases.two_hills, ranges, goals, search=search)
    check_front(result, 0.05)
