"""Goals that take several runs or contact: the workspace of a design, and the force of a blocked tip."""

import pytest

import optimization_cases as cases
import turgor as tg
from turgor.units import kPa, mL, mm

studies = tg.studies


def test_the_largest_workspace_under_limits_of_stress_and_rubber():
    """The stress gives the wall, 160 kPa mm / 80 kPa = 2 mm, the rubber the length, 8 mL / 50 mm / 2 mm = 80 mm."""
    ranges = [
        studies.Factor(name="length", low=40 * mm, high=120 * mm, unit="mm"),
        studies.Factor(name="wall", low=1 * mm, high=4 * mm, unit="mm"),
    ]
    goals = [
        studies.Maximize("workspace_area"), studies.Limit("stress", most=80 * kPa), studies.Limit("rubber", most=8 * mL)
    ]  # fmt: skip
    found = tg.optimize(cases.reach_of_two_cavities, ranges, goals, search=studies.Search(most_solves=40))
    assert found.converged, found.summary()
    assert found.values == pytest.approx({"length": 80 * mm, "wall": 2 * mm}, rel=0.01)
    corner = 20e3 * 1e-8 * found.values["length"] ** 2 / (60 * mm) / found.values["wall"]
    assert found.reads()[0].value == pytest.approx(2 * corner**2)  # a square with diagonals of twice the corner
    assert "workspace area: " in found.summary()
    assert "mm² (as large as possible)" in found.summary()
