"""Slow against fast PneuNets, their walls, and their number of chambers (review, guidelines 7.4).

The PneuNets are those of tests/validation/pneunets.py, with self-contact switched on automatically and the default
procedure. The claims are those of other geometries, which are not at hand: the tests assert signs, and report sizes and
accepted ranges.
"""

import numpy as np
import pytest
from pneunets import ENVELOPE, FAST, SLOW, Curve, bend, demo, model_of, push

import turgor as tg
from turgor.units import mm

#: The reference geometry cut short.
SHORT = {"chambers": 3, "length": 35 * mm}
WHAT = "slow over fast PneuNet"
RATIOS = "pressure, volume let in, their product"
CLAIMED = "3 (2 to 4.5), 8 (5 to 12), 25"
MOSADEGH = "review 7.4-2; Mosadegh et al. 2014"
ELSEWHERE = "more; the ranges are those of another geometry"


def ratios(fast: Curve, slow: Curve, angle: float) -> tuple[float, float, float]:
    """Pressure, volume let in, and their product of the slow one over those of the fast one, at an angle [°]."""
    (p, v), (q, w) = slow.at_angle(angle), fast.at_angle(angle)
    return p / q, v / w, p * v / (q * w)


def test_a_slow_pneunet_needs_more_pressure_and_more_air(record_validation):
    """Three chambers, a tenth of the whole turn: cheap enough to run always."""
    fast = bend(model_of(tg.FastPneuNet(**FAST | SHORT), size=6, pressure=10))
    slow = bend(model_of(tg.actuators.SlowPneuNet(**SLOW | SHORT), size=6, pressure=85))
    got = ratios(fast, slow, 25)
    record_validation(
        claim=f"{WHAT} of three chambers, 25°: {RATIOS}",
        source=MOSADEGH,
        expected="more",
        got=got,
        tolerance="order",
    )
    assert min(got) > 2


@pytest.mark.slow
def test_full_bending(record_validation):
    fast = bend(model_of(tg.FastPneuNet(**FAST), size=6, pressure=40), until=285)
    slow = bend(model_of(tg.actuators.SlowPneuNet(**SLOW), size=6, pressure=150))
    full = [fast.at_angle(angle)[0] for angle in (180, 270)]
    record_validation(
        claim="fast PneuNet of eight chambers, pressures at 180° and 270° [kPa]; slow one, angle at 150 kPa [°]",
        source=MOSADEGH,
        expected="reported",
        got=[*full, slow.angle[-1]],
        tolerance="both run through unattended",
    )
    assert np.isfinite(full).all()
    assert slow.solution.converged
    for angle in (90, 150):
        got = ratios(fast, slow, angle)
        record_validation(
            claim=f"{WHAT} of eight chambers, {angle}°: {RATIOS}",
            source=MOSADEGH,
            expected=CLAIMED,
            got=", ".join(f"{ratio:.3g}" for ratio in got),
            tolerance=ELSEWHERE,
        )
        assert min(got) > 2


@pytest.mark.slow
def test_without_contact_it_bends_less(record_validation):
    """Eleven chambers with walls of 1 mm, the demo: pushing each other apart takes a part in the bending."""
    touching = bend(demo(size=4, pressure=24), until=285)
    through = bend(demo(size=4, pressure=24, contact=tg.Contact(self_contact=False)), until=285)
    slow = bend(model_of(tg.actuators.SlowPneuNet(), size=6, pressure=100))
    got = [curve.at_angle(angle)[0] for angle in (180, 270) for curve in (touching, through)]
    record_validation(
        claim="fast PneuNet of eleven chambers with and without contact: pressures at 180° and at 270° [kPa]",
        source=MOSADEGH,
        expected="differ",
        got=got,
        tolerance="without contact 1 % more at 180°, more at 270°",
    )
    assert got[1] > 1.01 * got[0]
    assert got[3] > got[2]
    assert [finding.code for finding in through.solution.findings] == ["B02"]
    factors = ratios(touching, slow, 90)
    record_validation(
        claim=f"{WHAT} of eleven chambers, 90°: {RATIOS}",
        source=MOSADEGH,
        expected=CLAIMED,
        got=", ".join(f"{ratio:.3g}" for ratio in factors),
        tolerance=ELSEWHERE,
    )
    assert min(factors) > 2


@pytest.mark.slow
def test_blocked_force(record_validation):
    """Walls that push each other apart give the force, so it is that of the slow one or less before they meet.

    A long fast PneuNet arches away from the plate between its ends instead of pushing.
    """
    got = []
    for cut, pressure in ((SHORT, 30), (SHORT, 1.5), ({}, 5)):
        fast, slow = tg.FastPneuNet(**FAST | cut), tg.actuators.SlowPneuNet(**SLOW | cut)
        force = [push(model_of(each, size=6, pressure=pressure)) for each in (fast, slow)]
        got.append(force[0] / force[1])
    record_validation(
        claim="force on a plate, fast over slow PneuNet: three chambers at 30 kPa and 1.5 kPa, eight at 5 kPa",
        source=MOSADEGH,
        expected="1.4 (1.1 to 1.8), -, -",
        got=", ".join(f"{ratio:.3g}" for ratio in got),
        tolerance="the range at 30 kPa",
    )
    assert 1.1 < got[0] < 1.8


@pytest.mark.slow
def test_more_chambers_bend_further(record_validation):
    """At 20 kPa, not at the 55 kPa of the paper: ten chambers have curled up to three quarters of a turn there."""
    counts = (4, 6, 8, 10)
    curves = [bend(model_of(tg.FastPneuNet(**FAST | {"chambers": n}), size=6, pressure=20)) for n in counts]
    record_validation(
        claim="4, 6, 8, 10 chambers on 95 mm, angle at 20 kPa [°]",
        source="review 7.4-5; Hwang et al. 2015",
        expected="rises",
        got=", ".join(f"{curve.angle[-1]:.1f}" for curve in curves),
        tolerance="order",
    )
    record_validation(
        claim="the same, R² of a straight line through the angles up to 20 kPa",
        source="review 7.4-5; Hwang et al. 2015",
        expected="rises",
        got=", ".join(f"{curve.r_squared():.4f}" for curve in curves),
        tolerance="reported: it falls, those that bend further leave the straight line sooner",
    )
    assert all(curve.solution.converged for curve in curves)
    assert (np.diff([curve.angle[-1] for curve in curves]) > 0).all()


@pytest.mark.slow
def test_thick_walls_bend_less(record_validation):
    """The height grows with the bottom and the length with the gap; thicker walls take from the chambers.

    The gap makes no difference worth a sign here, where walls touch late.
    """
    thicker = {
        "bottom": {"base": 2.25 * mm, "floor": 2.25 * mm, "height": 20.5 * mm},
        "wall": {"wall": 2.25 * mm},
        "gap": {"gap": 1.5 * mm, "length": 36 * mm},
    }
    rest, *others = (
        bend(model_of(tg.FastPneuNet(**FAST | SHORT | change), size=6, pressure=20))
        for change in ({}, *thicker.values())
    )
    change = [curve.angle[-1] / rest.angle[-1] - 1 for curve in others]
    record_validation(
        claim="three chambers, bottom, wall between chambers, gap half as much again: angle at 20 kPa",
        source="review 7.4-3; Hu et al. 2018",
        expected="less, less, less",
        got=", ".join(f"{part:+.1%}" for part in change),
        tolerance="signs of bottom and wall, and the order of the three; the gap reported",
    )
    assert change[0] < change[1] < -0.05
    assert abs(change[2]) < 0.01
    void = bend(model_of(tg.actuators.SlowPneuNet(**ENVELOPE | SHORT | {"chambers": 1}), size=6, pressure=20))
    record_validation(
        claim="R² of a straight line through the angles up to 20 kPa, three chambers and a single void",
        source="review 7.4-1",
        expected="falls",
        got=f"{rest.r_squared():.4f}, {void.r_squared():.4f}",
        tolerance="order",
    )
    assert rest.r_squared() > void.r_squared()
    walls = [tg.FastPneuNet(**FAST | SHORT | change) for change in ({}, thicker["wall"])]
    force = [push(model_of(each, size=6, pressure=15)) for each in walls]
    record_validation(
        claim="walls between chambers half as thick again, three chambers: force on a plate at 15 kPa, relative",
        source="review 7.4-6",
        expected="less",
        got=f"{force[1] / force[0] - 1:+.1%}",
        tolerance="sign",
    )
    assert force[1] < force[0]
