"""V19, V20: the formulas of wound tubes and McKibben muscles meet the tables, their limits, and a finite element slice.

Problem: the tube of V20 with Kevlar at any angle, one hand or both, 30 and 62.5 kPa; the muscle of V19.
Exact: the table of V20 (two independent routes), Chou and Hannaford's force, the magic angle arctan √2 from the axis.
Limits: a soft tube in threads that do not stretch goes to the magic angle like 1/P; `mckibben` of a soft bladder is the
ideal muscle, its difference proportional to the modulus; threads that get stiffer go to those that do not stretch, like
1/k; a membrane on the threads' radius is what a wall becomes, with an error of its thickness.
Tolerance: the digits of the table (2e-6 of stretch and of degrees per mm); rates 1 within 0.05.
Finite elements: a quarter of a slice with a braid at 25° (`slices`), held at two lengths; 0.5 % of the force.
"""

import numpy as np
import pytest

import problems
import slices
import turgor as tg
from turgor.units import deg, kPa, mm

F = tg.formulas
TUBE = tg.actuators.TwistingTube(length=1010 * mm)  # 1 m between its caps
RUBBER = tg.Material(name="test rubber", law=problems.NEO_HOOKE)
MAGIC = float(np.degrees(np.arctan(np.sqrt(2))))
SINGLE = {  # from the circumference: a/A, λz, twist [°/mm] at 62.5 kPa
    0: (1.054115, 1.172636, 0.0),
    10: (1.097292, 1.153776, -1.303677),
    30: (1.332728, 1.080373, -2.173138),
    54.7356: (1.735836, 1.032816, -1.763168),
}
DOUBLE = {20: 1.057194, 30: 1.026930, 35.2644: 1.000110, 45: 0.950523, 54.7356: 0.943456}  # λz at 30 kPa


def threads(angle, hand="right", stiffness=None):
    """Kevlar at an angle from the circumference [deg], or threads of a stiffness per width [N/m]."""
    modulus = 31067e6 if stiffness is None else stiffness * 2 * mm / (np.pi * (0.1778 * mm) ** 2 / 4)
    material = tg.Material(name="thread", law=tg.laws.Hooke(E=modulus, nu=0.36))
    winding = tg.Winding(angle_from_circumference=angle * deg, spacing=2 * mm, hand=hand)
    return tg.Fibers(face="outside", material=material, diameter=0.1778 * mm, winding=winding)


@pytest.mark.parametrize("angle", SINGLE)
def test_one_helix(angle, record_verification):
    result = F.wound_tube(TUBE, RUBBER, threads(angle), [30 * kPa, 62.5 * kPa])
    got = [result["inner_stretch"][-1], result["axial_stretch"][-1], result["twist_angle_deg"][-1] / 1000]
    record_verification(
        claim=f"wound tube by formula, one helix {angle}° from the circumference: a/A, λz, twist [°/mm] at 62.5 kPa",
        source="V20, exact",
        expected=SINGLE[angle],
        got=got,
        tolerance="2e-6",
    )
    assert got == pytest.approx(SINGLE[angle], abs=2e-6)


def test_both_hands(record_verification):
    got = [F.wound_tube(TUBE, RUBBER, threads(a, "both"), [30 * kPa])["axial_stretch"][-1] for a in DOUBLE]
    record_verification(
        claim=f"wound tube by formula, both hands, {', '.join(map(str, DOUBLE))}° from the circumference: λz at 30 kPa",
        source="V20, exact",
        expected=list(DOUBLE.values()),
        got=got,
        tolerance="1e-6",
    )
    assert got == pytest.approx(list(DOUBLE.values()), abs=1e-6)


def test_the_magic_angle_comes_like_one_over_the_pressure(record_verification):
    off, ends = [], []
    for angle in (30, 45, 60):
        result = F.wound_tube(TUBE, RUBBER, threads(angle, "both"), [1e6, 8e6, 16e6], wall="thin", inextensible=True)
        ends.append(result["fiber_angle_deg"][-1])
        off.append(np.abs(result["fiber_angle_deg"][1:] - MAGIC))
        assert result["axial_stretch"][-1] ** 2 * np.sin(angle * deg) ** 2 + (
            np.sin(result["fiber_angle"][-1]) ** 2
        ) == pytest.approx(1.0, abs=1e-9)  # the threads have kept their length
    rates = [float(np.log2(a / b)) for a, b in off]
    record_verification(
        claim="threads that do not stretch, 60°, 45°, 30° from the axis: angle at 16 MPa [°], order in 1/P",
        source="theory",
        expected=[MAGIC, 1.0],
        got=[float(np.mean(ends)), float(np.mean(rates))],
        tolerance="0.3°, 0.1",
    )
    assert ends == pytest.approx([MAGIC] * 3, abs=0.3)
    assert rates == pytest.approx([1.0] * 3, abs=0.1)


def test_stiff_threads_and_thin_walls_have_their_limits(record_verification):
    rigid = F.wound_tube(TUBE, RUBBER, threads(30, "both"), [30 * kPa], inextensible=True)["axial_stretch"][0]
    off = [
        F.wound_tube(TUBE, RUBBER, threads(30, "both", k), [30 * kPa])["axial_stretch"][0] - rigid for k in (4e5, 8e5)
    ]
    thin = []
    for wall in (0.2 * mm, 0.1 * mm):
        tube = tg.actuators.TwistingTube(inner_radius=10 * mm - wall, wall=wall, length=1010 * mm)
        push = [10 * kPa * wall / mm]
        walls = [F.wound_tube(tube, RUBBER, threads(30), push, wall=w)["axial_stretch"][0] for w in ("thick", "thin")]
        thin.append(abs(walls[0] - walls[1]))
    rates = [float(np.log2(a / b)) for a, b in (off, thin)]
    record_verification(
        claim="wound tube: orders at which stiffer threads go to rigid ones, and a thinner wall to a membrane",
        source="theory",
        expected=1.0,
        got=rates,
        tolerance="0.1",
    )
    assert rates == pytest.approx([1.0, 1.0], abs=0.1)


def braid(angle):
    return threads(90 - angle, "both")


def test_muscles(record_verification):
    muscle = tg.actuators.ContractingTube(inner_radius=9 * mm, wall=1 * mm)
    unit = np.pi * (10 * mm) ** 2 * 100 * kPa
    blocked = [F.ideal_mckibben(muscle, braid(a), [100 * kPa])["pull_force"][0] / unit for a in (20, 25, 30)]
    tenth = F.ideal_mckibben(muscle, braid(25), [100 * kPa], 0.1)["pull_force"][0] / unit
    off = []
    for C10 in (20.0, 10.0):
        soft = tg.Material(name="soft", law=tg.laws.NeoHooke(C10=C10))
        pull = F.mckibben(muscle, soft, braid(25), [100 * kPa], 0.1)["pull_force"][0] / unit
        off.append(abs(pull - tenth))
        free = F.mckibben(muscle, soft, braid(25), [100 * kPa])
        left = F.mckibben(muscle, soft, braid(25), [100 * kPa], free["contraction"])["pull_force"]
        assert left == pytest.approx([0.0], abs=1e-8 * unit)
    expected = [14.097264, 8.197820, 5.0, 5.576441, 0.362964, 2.0]
    got = [*blocked, tenth, free["contraction"][0], off[0] / off[1]]
    record_verification(
        claim="McKibben by formula: blocked at 20°, 25°, 30°, F(0.1) at 25°, ε of a soft bladder, halving of its share",
        source="V19, exact",
        expected=expected,
        got=got,
        tolerance="1e-6, 1e-4, 1e-6",
    )
    assert got[:4] == pytest.approx(expected[:4], rel=1e-6)
    assert got[4] == pytest.approx(expected[4], abs=1e-3)
    assert got[5] == pytest.approx(2.0, rel=1e-6)


def test_a_slice_of_finite_elements_pulls_as_the_formula_says(record_verification):
    inner, outer, angle = 9 * mm, 10 * mm, 25 * deg
    fibers = [slices.family(1e7, np.pi / 2 - angle)]
    rubber = tg.laws.NeoHooke(C10=0.12e6)
    model = slices.wound(slices.quarter(inner, outer, (1, 4, 1)), rubber, fibers)
    shortened = (0.0, 0.15)
    got = [each.pull for each in slices.follow(model, [(100 * kPa, 1 - each) for each in shortened])]
    muscle = tg.actuators.ContractingTube(inner_radius=inner, wall=outer - inner)
    material = tg.Material(name="test rubber", law=rubber)
    formula = F.mckibben(muscle, material, braid(25), [100 * kPa] * 2, shortened)["pull_force"]
    ideal = F.ideal_mckibben(muscle, braid(25), [100 * kPa] * 2, shortened)["pull_force"]
    record_verification(
        claim="muscle at 100 kPa, ε = 0 and 0.15, finite elements of a slice: pull [N]",
        source=f"formula with the wall; without: {', '.join(f'{x:.4g}' for x in ideal)}",
        expected=formula,
        got=got,
        tolerance="0.5 %",
    )
    assert got == pytest.approx(formula, rel=5e-3)
    assert abs(got[1] / ideal[1] - 1) > 0.05  # the wall counts
