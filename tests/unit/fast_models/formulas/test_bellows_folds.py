"""Castigliano's fold: the closed form of a flat ring, the strip and the plate in their limits, three bellows."""

import numpy as np
import pytest

import turgor as tg
from turgor.fast_models.formulas.bellows import Fold, fold_of
from turgor.units import mm

F = tg.formulas
RUBBER = tg.Material(name="test rubber", law=tg.laws.NeoHooke(C10=0.12e6))


@pytest.mark.parametrize("ratio", [1.1, 1.6, 3.0])
def test_the_flat_ring_is_the_closed_form(ratio):
    a, b, D = 1.0, ratio, 0.7
    fold = Fold(a, b, D)
    closed = ((b**2 - a**2) / 2 - (b - a) ** 2 / np.log(b / a)) / (2 * np.pi * D)
    assert fold.compliance == pytest.approx(closed, rel=1e-10)
    mean = (b - a) / np.log(b / a)
    work = np.pi / 3 * ((b**4 - a**4) / 4 - mean * (b**3 - a**3) / 3)
    assert fold.area == pytest.approx(work / (2 * np.pi * D * closed), rel=1e-9)


def test_a_narrow_ring_is_a_clamped_strip_and_a_plate():
    off = []
    for width in (0.02, 0.01):
        fold = Fold(1.0, 1 + width, 2.0)
        strip = width**3 / (12 * 2.0 * 2 * np.pi * (1 + width / 2))
        off.append(fold.compliance / strip - 1)
        assert fold.area == pytest.approx(np.pi * (1 + width / 2) ** 2, rel=width**2)
        assert fold.compliance > fold.plate_compliance > 0.999 * fold.compliance
    assert np.log2(off[0] / off[1]) == pytest.approx(2.0, abs=0.1)


def test_the_plate_solves_the_equation_of_a_ring():
    """Largest and smallest deflection by shooting: φ'' + φ'/r − φ/r² = −1/(2 π r D), φ = 0 at both radii."""
    a, b, D = 1.0, 2.0, 0.3
    r = np.linspace(a, b, 4001)
    h = r[1] - r[0]
    inner = r[1:-1]
    A = np.zeros((3, len(inner)))
    A[0, 1:] = (1 / h**2 + 1 / (2 * h * inner))[:-1]
    A[1] = -2 / h**2 - 1 / inner**2
    A[2, :-1] = (1 / h**2 - 1 / (2 * h * inner))[1:]
    from scipy.linalg import solve_banded

    slope = solve_banded((1, 1), A, -1 / (2 * np.pi * inner * D))
    assert Fold(a, b, D).plate_compliance == pytest.approx(float(slope.sum() * h), rel=1e-5)


def test_roundings_make_a_fold_softer_and_the_wall_cubed_stiffer():
    part = tg.actuators.BellowsOfRevolution()
    thick, thin = (fold_of(tg.actuators.BellowsOfRevolution(wall=w), RUBBER) for w in (1.5 * mm, 0.75 * mm))
    flat = Fold(thick.inner, thick.outer, thick.bending)
    assert 1.5 < thick.compliance / flat.compliance < 2.5
    assert thick.bending / thin.bending == pytest.approx(8.0)
    moved = [F.castigliano_bellows(part, RUBBER, [p])["tip_displacement_x"][0] for p in (10.0, 20.0)]
    assert moved[1] == pytest.approx(2 * moved[0], rel=1e-12)


def test_three_bellows_push_and_turn():
    part = tg.actuators.ParallelBellows()
    even = F.castigliano_bellows(part, RUBBER, [1e3], shares=(1, 1, 1))
    one = F.castigliano_bellows(part, RUBBER, [1e3])
    assert even["blocked_force"] == pytest.approx(3 * one["blocked_force"])
    assert even["bending_angle"] == pytest.approx([0.0], abs=1e-12)
    assert even["tip_displacement_x"] == pytest.approx(3 * one["tip_displacement_x"])
    arm = part.side / np.sqrt(3)
    assert one["blocked_moment"] == pytest.approx(arm * one["blocked_force"])
    for turned in ((0, 1, 0), (0, 0, 1)):
        other = F.castigliano_bellows(part, RUBBER, [1e3], shares=turned)
        assert other["bending_angle"] == pytest.approx(one["bending_angle"])
