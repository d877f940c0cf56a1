"""Inverse: the closest inputs, preferences, what is out of reach, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

import surrogate_cases as cases
from refused import refused
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.runs.factor import Factor
from turgor.studies.surrogates.fit import surrogate
from turgor.studies.surrogates.invert import invert
from turgor.units import deg, kPa, mm

THIRD = replace(cases.FIRST, name="third")


@pytest.fixture(scope="module")
def fitted():
    return surrogate(cases.study_of(cases.two_chambers, [cases.FIRST, cases.SECOND], 32))


@pytest.fixture(scope="module")
def redundant():
    return surrogate(cases.study_of(cases.two_chambers, [cases.FIRST, cases.SECOND, THIRD], 32))


def test_what_cannot_be_reached_is_the_closest(fitted):
    top = float(cases.two_chambers(40 * kPa, 0.0)["tip_y"][0])
    result = invert(fitted, {"tip_y": top + 5 * mm, "tip_z": 30 * mm})
    assert not result.reached
    assert result.values["first"] == pytest.approx(40 * kPa, rel=1e-3)
    assert result.prediction["tip_y"] == pytest.approx(top, abs=0.1 * mm)
    assert result.sentence().startswith("Nothing in the range gives that. The closest, first 40 kPa, second ")
    assert "tip y -5" in result.sentence()


def test_redundant_inputs_are_those_nearest_to_the_preferred_ones(redundant):
    wanted = {"tip_y": 30 * mm, "tip_z": 30 * mm}
    none = invert(redundant, wanted, prefer={"third": 0.0})
    much = invert(redundant, wanted, prefer={"third": 30 * kPa})
    assert none.reached
    assert much.reached
    assert much.values["third"] > none.values["third"] + 5 * kPa
    # the nearest on first + third/2 = const is perpendicular to it, in shares of equal ranges
    middle = {"first": 20 * kPa, "second": 20 * kPa, "third": 30 * kPa}
    off = np.array([much.values[name] - value for name, value in middle.items()])
    tangent = np.array([-0.5, 0.1, 1.0])
    assert abs(off @ tangent) < 0.02 * np.linalg.norm(off) * np.linalg.norm(tangent)


def test_held_factors_stay(redundant):
    result = invert(redundant, {"tip_y": 30 * mm, "tip_z": 30 * mm}, fixed={"third": 10 * kPa})
    assert result.values["third"] == pytest.approx(10 * kPa)
    assert set(result.deviations) == {"first", "second"}
    exact = cases.two_chambers(**result.values)
    assert [exact["tip_y_mm"][0], exact["tip_z_mm"][0]] == pytest.approx([30, 30], abs=0.05)


def test_deviations_are_those_of_the_output_over_the_slope():
    fitted = surrogate(cases.study_of(cases.finger, [cases.WALL, cases.C10], 16), ["bending_angle"], along="pressure")
    result = invert(fitted, {"bending_angle": 20 * deg}, fixed={"wall": 1.5 * mm, "C10": 75 * kPa})
    slope = fitted.slopes(result.values)["bending_angle"]["pressure"]
    deviation = result.prediction.deviations["bending_angle"]
    assert result.deviations["pressure"] == pytest.approx(deviation / abs(slope), rel=1e-3)
    assert result.values["pressure"] == pytest.approx(75 * kPa * np.tan(20 * deg), rel=0.02)


def test_names_and_values_are_checked(fitted):
    with refused("'tipy'", "'tip_y'"):
        invert(fitted, {"tipy": 1.0})
    with refused("'third'", "first, second"):
        invert(fitted, {"tip_y": 1 * mm}, fixed={"third": 0.0})
    with refused("first, second", "fixed"):
        invert(fitted, {"tip_y": 1 * mm}, fixed={"first": 0.0, "second": 0.0})
    with refused("first", "50 kPa", "0 kPa to 40 kPa"):
        invert(fitted, {"tip_y": 1 * mm}, fixed={"first": 50 * kPa})
    with refused("measure", "value"):
        invert(fitted, {})
    with refused("'tip_y'", "nan", "finite"):
        invert(fitted, {"tip_y": float("nan")})


def curved(first: float, second: float) -> Response:
    """A value that is the same along a parabola."""
    return Response(columns=(Column("y", "", [first**2 + second]),), source=Source(text="a parabola"))


def test_the_nearest_inputs_on_a_curve():
    """On first² + second = 1 the point nearest to (0.9, 0.9), by a search along the curve."""
    factors = [Factor(name=name, low=0.0, high=1.0) for name in ("first", "second")]
    fitted = surrogate(cases.study_of(curved, factors, 32))
    result = invert(fitted, {"y": 1.0}, prefer={"first": 0.9, "second": 0.9})
    along = np.linspace(0, 1, 100_001)
    nearest = along[np.argmin((along - 0.9) ** 2 + (1 - along**2 - 0.9) ** 2)]
    assert result.reached
    assert [result.values["first"], result.values["second"]] == pytest.approx([nearest, 1 - nearest**2], abs=2e-3)
