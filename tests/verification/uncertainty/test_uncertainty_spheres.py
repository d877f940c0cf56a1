"""Bands of an inflated sphere are those of exact derivatives and of Monte Carlo draws of its formula.

Problem: thick sphere (inner radius 10 mm, wall 5 mm, neo-Hookean, C10 0.12 MPa) under 10 to 60 kPa; stiffness 5 %, wall
2 %.
Exact: the pressure is proportional to the stiffness, so ∂λ/∂C10 = −(P/C10) ∂λ/∂P along the same curve, to first order;
4000 draws of the closed form for the mean, the standard deviation and the 95 % range.
Tolerance: central differences over 0.5 % of the stiffness are exact to their square. The standard deviation of 4000
draws is known to 1.1 %, percentiles to 3 % of it; three of these bounds. The linear method lacks what is curved, 5 %.
"""

import numpy as np
import pytest

import calibration_cases as cases
from turgor.studies.uncertainty.propagate import propagate
from turgor.studies.uncertainty.spread import Spread
from turgor.units import mm

RUBBER = Spread(name="C10", mean=0.12e6, deviation=6e3, label="rubber")
WALL = Spread(name="wall", mean=5 * mm, deviation=0.1 * mm)
DRAWS = 4000


def test_the_part_of_the_stiffness_is_the_slope_of_the_curve(record_verification):
    small = Spread(name="C10", mean=0.12e6, deviation=600.0)
    band = propagate(cases.thick_sphere, [small]).band("inner_stretch")
    pressure = np.linspace(10e3, 60e3, 6)
    step = 1e-3
    above, below = (cases.thick_sphere(0.12e6 / (1 + s), 5 * mm)["inner_stretch"] for s in (step, -step))
    slope = (above - below) / (2 * step * pressure)  # ∂λ/∂P, because λ depends on P/C10 alone
    expected = pressure / 0.12e6 * slope * 600.0
    record_verification(
        claim="uncertainty of a thick sphere: standard deviation of the stretch, from that of the stiffness [1e-4]",
        source="slope of the exact curve",
        expected=np.round(1e4 * expected, 4),
        got=np.round(1e4 * band.deviation, 4),
        tolerance="0.1 %",
    )
    assert band.deviation == pytest.approx(expected, rel=1e-3)


def test_bands_are_those_of_many_draws(record_verification):
    draw = np.random.default_rng(5).standard_normal((DRAWS, 2))
    ends = []
    for a, b in draw:
        # two numbers suffice: the stretch is needed at the last pressure only
        ends.append(_stretch(0.12e6 + 6e3 * float(a), 5 * mm + 0.1 * mm * float(b)))
    expected = [np.mean(ends), np.std(ends), *np.percentile(ends, [2.5, 97.5])]
    band = propagate(cases.thick_sphere, [RUBBER, WALL], method="interactions").band("inner_stretch")
    got = [float(each[-1]) for each in (band.mean, band.deviation, band.low, band.high)]
    linear = float(propagate(cases.thick_sphere, [RUBBER, WALL]).band("inner_stretch").deviation[-1])
    record_verification(
        claim="uncertainty of a thick sphere at 60 kPa: mean, standard deviation and 95 % range of the stretch",
        source="4000 draws",
        expected=np.round(expected, 5),
        got=np.round(got, 5),
        tolerance="3 % of the range",
    )
    assert got[0] == pytest.approx(expected[0], abs=0.05 * expected[1])
    assert got[1] == pytest.approx(expected[1], rel=0.033)
    assert linear == pytest.approx(expected[1], rel=0.05)
    assert got[2:] == pytest.approx(expected[2:], abs=0.1 * expected[1])


def _stretch(C10, wall, inner=10 * mm, pressure=60e3):
    """Stretch of the inner wall of a neo-Hookean sphere, by Newton's method on the closed form of its pressure."""
    outer = inner + wall

    def of(x):
        y = (1 + (x**3 - 1) * (inner / outer) ** 3) ** (1 / 3)
        return C10 * (4 / y + 1 / y**4 - 4 / x - 1 / x**4)

    x = 1.1
    for _ in range(30):
        x -= (of(x) - pressure) * 2e-6 / (of(x + 1e-6) - of(x - 1e-6))
    return x
