"""V19: a soft tube in a stiff double winding pulls like the ideal McKibben muscle, and stops at 54.7356°.

Problem: tube of outer radius 10 mm with a wall of 1 mm, wound with both hands at θ₀ from the axis, under 100 kPa, held
at its length or let contract. A quarter of a slice; smeared fibers; five cells around the quarter.
Ideal: F = π r₀² P [a (1 − ε)² − b], a = 3/tan²θ₀, b = 1/sin²θ₀; no force at ε = 1 − √(b/a), where tan²θ = 2 for any θ₀.
Source: virtual work of inextensible fibers (Schulte; Chou and Hannaford).
Limit: the law leaves out the wall (µ t / (P r₀) = 0.02 and 0.01 here: its radius is that of the fibers, only its
elasticity counts) and the give of the fibers (P r₀ / k = 1e-4 and 5e-5). Both are halved together and the two answers
extended linearly to none. At the finite values the slice is compared with `fiber_tube`, which reproduces case V20.
Tolerance: 0.05 % of the blocked force against `fiber_tube` (five curved quadratic edges miss a quarter circle by 2e-6
of its radius), 0.1 % of the blocked force and 1e-4 of contraction against the ideal law, 0.01° at the end.
"""

import numpy as np
import pytest

import problems
import slices
import turgor as tg
from fiber_tube import FiberTube
from turgor.units import deg

RADIUS, WALL, PRESSURE = 10 * problems.MM, 1 * problems.MM, 0.1 * problems.MPA
IDEAL = {  # blocked force over π r₀² P, largest contraction
    20: (14.097264, 0.385597),
    25: (8.197820, 0.362964),
    30: (5.0, 0.333333),
}
AT_A_TENTH = 5.576441  # force at ε = 0.1, θ₀ = 25°
END = 54.735610
#: Shear modulus of the wall [Pa] and stiffness of each hand [N/m]; each half as far from the ideal as the one before.
SOFTENED = ((20e3, 1e7), (10e3, 2e7))
UNIT = np.pi * RADIUS**2 * PRESSURE


def muscle(angle, shear_modulus, stiffness):
    """A slice and its semi-analytic twin; the angle [rad] is from the axis."""
    rubber = tg.laws.NeoHooke(C10=shear_modulus / 2)
    around = np.pi / 2 - angle
    model = slices.wound(slices.quarter(RADIUS - WALL, RADIUS, (1, 5, 1)), rubber, [slices.family(stiffness, around)])
    families = [(stiffness, around), (stiffness, -around)]
    return model, FiberTube(inner=RADIUS - WALL, outer=RADIUS, shear_modulus=shear_modulus, families=families)


def contract(angle, stop, shear_modulus, stiffness):
    """Blocked force, force at ε = 0.1, contraction without force, angle there [deg]; the first two of the twin."""
    model, twin = muscle(angle * deg, shear_modulus, stiffness)
    shortened = (0.0, 0.1, stop - 0.008, stop + 0.004)
    result = slices.follow(model, [(PRESSURE, 1 - each) for each in shortened])
    end = slices.unforced(*result[2:])
    turned = np.degrees(np.arctan(np.tan(angle * deg) * end.outer / RADIUS / end.stretch))
    pulls = [each.pull / UNIT for each in result[:2]]
    return [*pulls, 1 - end.stretch, turned], [twin.inflated(PRESSURE, 1 - each)[1] / UNIT for each in (0.0, 0.1)]


@pytest.mark.parametrize("angle", IDEAL)
def test_contraction(angle, record_verification):
    blocked, stop = IDEAL[angle]
    rows, twins = zip(*(contract(angle, stop, *soft) for soft in SOFTENED), strict=True)
    for row, twin in zip(rows, twins, strict=True):
        assert row[:2] == pytest.approx(twin, abs=5e-4 * blocked)
    far, near = np.array(rows)
    ideal = 2 * near - far
    law = 3 / np.tan(angle * deg) ** 2 * 0.81 - 1 / np.sin(angle * deg) ** 2
    if angle == 25:
        assert law == pytest.approx(AT_A_TENTH, rel=1e-6)
    record_verification(
        claim=f"McKibben, {angle}°: F/(πr₀²P) blocked and at ε = 0.1, ε without force, angle there [°]; "
        f"ideal limit of {', '.join(f'{v:.5g}' for v in far)} and {', '.join(f'{v:.5g}' for v in near)}",
        source="V19, exact",
        expected=[blocked, law, stop, END],
        got=ideal,
        tolerance="0.1 % of the blocked force, 1e-4, 0.01°",
    )
    assert ideal[:2] == pytest.approx([blocked, law], abs=1e-3 * blocked)
    assert ideal[2] == pytest.approx(stop, abs=1e-4)
    assert ideal[3] == pytest.approx(END, abs=0.01)
    assert abs(near[2] - stop) < abs(far[2] - stop) < 0.01  # and that is how the limit is approached


def test_force_changes_sign_at_the_neutral_angle(record_verification):
    """Held at its length, the tube pulls where θ is below 54.7356° and pushes above."""
    angles = END + np.array([-0.5, 0.5])
    got, law = [], []
    for angle in angles:
        model, _ = muscle(angle * deg, *SOFTENED[-1])
        got.append(slices.follow(model, [(PRESSURE, 1.0)])[0].pull / UNIT)
        law.append(2 / np.tan(angle * deg) ** 2 - 1)
    share = got[0] / (got[0] - got[1])
    neutral = angles[0] + share * (angles[1] - angles[0])
    record_verification(
        claim="McKibben: blocked force 0.5° below and above the neutral angle, neutral angle [°]",
        source="V19, exact",
        expected=[*law, END],
        got=[*got, neutral],
        tolerance="sign, 0.02°",
    )
    assert got[0] > 0 > got[1]
    assert neutral == pytest.approx(END, abs=0.02)
