"""What hoops, axial fibers and double windings do to a tube (review 7.2 and 8.1).

Tube of inner radius 6.35 mm, outer 8.35 mm, neo-Hookean (C10 = 0.12 MPa), closed free ends, fibers smeared on its
outside; Kevlar of 0.1778 mm every 2 mm is 385.676 N/mm. A quarter of a slice far from the ends, two cells through it.
Expected numbers: case V20 of tests/verification and the semi-analytic tube of tests/verification/fiber_tube.py.
Tolerance: 2 % where a number is expected, the sign or the order where that is expected.
"""

import numpy as np
import pytest

import slices
import turgor as tg
from fiber_tube import FiberTube
from turgor.units import MPa, deg, kPa, mm

INNER, OUTER, RUBBER = 6.35 * mm, 8.35 * mm, tg.laws.NeoHooke(C10=0.12 * MPa)
#: Axial stiffness of one Kevlar thread [N].
THREAD = 31067 * MPa * np.pi * (0.1778 * mm) ** 2 / 4
KEVLAR = THREAD / (2 * mm)
NEUTRAL = 35.2644  # from the circumference


def tube(*fibers):
    return slices.wound(slices.quarter(INNER, OUTER), RUBBER, fibers)


def twin(*families):
    """The same tube without a mesh: stretch at a pressure."""
    made = FiberTube(inner=INNER, outer=OUTER, shear_modulus=RUBBER.shear_modulus, families=families)
    return lambda pressure: made.free(pressure, steps=60)[1]


def volume(found):
    return found.inner**2 * found.stretch / INNER**2


def test_without_hoops_it_balloons(record_validation):
    axial, hoop = (  # more than 0.0015 shorter, axial fibers go slack
        slices.free(tube(slices.family(KEVLAR, angle)), [(62.5 * kPa, near)], within=0.001)[0]
        for angle, near in ((90 * deg, 1.0015), (0.0, 1.1726))
    )
    expected = [1.942, 5.80, 1.001, 1.30, 4.80 / 0.303]
    less = (volume(axial) - 1) / (volume(hoop) - 1)
    got = [axial.outer / OUTER, volume(axial), hoop.outer / OUTER, volume(hoop), less]
    record_validation(
        claim="tube at 62.5 kPa, outer radius and volume over the first ones, axial fibers and hoops; "
        "injected volume, times less with hoops",
        source="review 7.2-1, 7.2-2; V20",
        expected=expected,
        got=got,
        tolerance="2 %",
    )
    assert got == pytest.approx(expected, rel=0.02)


def test_denser_hoops_extend_more_and_bulge_less(record_validation):
    shares = np.array([0.01, 0.03, 0.1, 0.3, 1.0])
    pitches = np.array([8, 4, 2, 1]) * mm
    result, near = [], []
    for stiffness in (*(shares * KEVLAR), *(THREAD / pitches)):
        near.append(twin((stiffness, 0.0))(50 * kPa))
        result += slices.free(tube(slices.family(stiffness, 0.0)), [(50 * kPa, near[-1])])
    radius = [each.outer / OUTER for each in result]
    stretch = [each.stretch for each in result]
    record_validation(
        claim="hoops of 1, 3, 10, 30, 100 % of the stiffness, then every 8, 4, 2, 1 mm, 50 kPa: λz rises",
        source="review 7.2-4, 7.2-5; semi-analytic",
        expected=near,
        got=stretch,
        tolerance="order; 2 % of λz − 1",
    )
    record_validation(
        claim="the same, outer radius over the first one falls",
        source="review 7.2-4, 7.2-5",
        expected="falls",
        got=", ".join(f"{r:.5f}" for r in radius),
        tolerance="order",
    )
    for part in (slice(0, len(shares)), slice(len(shares), None)):
        assert (np.diff(radius[part]) < 0).all()
        assert (np.diff(stretch[part]) > 0).all()
    assert np.array(stretch) - 1 == pytest.approx(np.array(near) - 1, rel=0.02)


@pytest.mark.parametrize("pressure", [30.0, 62.5])
def test_double_winding_neither_grows_nor_shrinks_at_the_neutral_angle(pressure, record_validation):
    angles = NEUTRAL + np.array([-0.5, 0.5])
    got, near = [], []
    for angle in angles * deg:
        near.append(twin((KEVLAR, angle), (KEVLAR, -angle))(pressure * kPa))
        got.append(slices.free(tube(slices.family(KEVLAR, angle)), [(pressure * kPa, near[-1])])[0].stretch)
    neutral = angles[0] + (got[0] - 1) / (got[0] - got[1])
    record_validation(
        claim=f"double winding at {pressure:g} kPa, 0.5° below and above the neutral angle "
        "(from the circumference): λz, neutral angle [°]",
        source="review 7.2-8; V20",
        expected=[*near, NEUTRAL],
        got=[*got, neutral],
        tolerance="sign of λz − 1, ±0.5°",
    )
    assert got[0] > 1 > got[1]
    assert neutral == pytest.approx(NEUTRAL, abs=0.5)


def test_double_winding_extends_less(record_validation):
    stretch = slices.free(tube(slices.family(KEVLAR, 30 * deg)), [(62.5 * kPa, 1.0488)])[0].stretch
    record_validation(
        claim="double winding, 30°, 62.5 kPa: λz (1.0804 with one hand)",
        source="review 7.2-7; V20",
        expected=1.0488,
        got=stretch,
        tolerance="2 % of λz − 1",
    )
    assert stretch - 1 == pytest.approx(0.0488, rel=0.02)


def test_the_stiffness_in_compression_does_not_matter_for_hoops_in_tension(record_validation):
    near = [(30 * kPa, 1.070961), (62.5 * kPa, 1.172636)]
    threads, rods = (
        np.array([s.stretch for s in slices.free(tube(slices.family(KEVLAR, 0.0, compression=share)), near)])
        for share in (0.0, 1.0)
    )
    record_validation(
        claim="tube with hoops, 30 and 62.5 kPa: λz with threads that go slack, relative to rods",
        source="review 8.1",
        expected=[0.0, 0.0],
        got=threads / rods - 1,
        tolerance="0.5 %",
    )
    assert threads - 1 == pytest.approx(rods - 1, rel=5e-3)
