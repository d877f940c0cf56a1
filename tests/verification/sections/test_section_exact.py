"""V08: a section alone bends, twists and inflates as closed forms say.

Problems: Rivlin's flexure of a block of 10 mm in plane strain (a strip of the section between two mirror planes) by up
to 270° of 40 mm; torsion of a solid bar of radius 10 mm at its length (V09); the tube of V20 with closed ends, wound
with one family of smeared threads; a closed tube whose outside keeps its radius.
A closed tube without fibers (V06) by its volume, past the limit point of the pressure.
Reference: closed forms, and quadrature.
Tolerance: errors fall with the fourth power of the size, as those of the energy of quadratic elements do; a tenth of a
permille at the finest. Tubes: 1e-5, what parabolas miss of circles.
"""

import numpy as np
import pytest

import exact
import problems
import slices
import turgor as tg
from turgor.units import deg, kPa, mm

HEIGHT, LENGTH = 10 * mm, 40 * mm
TURNS = np.pi * np.array([1 / 6, 1 / 2, 1.0, 1.5])
MOMENTS = np.array([1.0418634, 3.0071765, 5.3974376, 7.0778784])  # N·mm/mm
LAWS = {"neo-Hooke": problems.NEO_HOOKE, "Mooney–Rivlin": tg.laws.MooneyRivlin(C10=0.10e6, C01=0.02e6)}


def flexure(law, size):
    """Moments per width [N] of a strip whose two sides are mirror planes."""
    strip = tg.sections.Sketch(
        areas={"body": tg.sections.rectangle((0.0, size), (0.0, HEIGHT))},
        lines={"symmetry_far": ("y", size)},
        mirrors="y",
    )
    section = tg.Section(strip, {"body": problems.rubber(law)}, size=size)
    solution = section.solve(prescribed={"curvature_y": TURNS / LENGTH})
    assert all(solution.stable)
    return solution.response["moment_y"] / (4 * size)  # a mirror plane doubles what is modeled


@pytest.mark.parametrize("name", LAWS)
def test_flexure(record_verification, name):
    errors = [flexure(LAWS[name], HEIGHT / cells) / MOMENTS - 1 for cells in (2, 4, 8)]
    got = MOMENTS * (1 + errors[-1])
    record_verification(
        claim=f"section of a block bent by 30°, 90°, 180°, 270°, {name}: moment [N·mm/mm]",
        source="V08, exact",
        expected=MOMENTS,
        got=got,
        tolerance="1e-4",
    )
    rates = np.log2(np.abs(errors[1] / errors[2])[:2])
    record_verification(
        claim=f"section of a block bent by 30° and 90°, {name}: rate of convergence of the moment",
        source="theory",
        expected=[4, 4],
        got=rates,
        tolerance="at least 3.5",
    )
    assert got == pytest.approx(MOMENTS, rel=1e-4)
    assert rates.min() > 3.5


def test_torsion(record_verification):
    """T = π τ A⁴ (C10 + C01), N = −½ π A⁴ τ² (C10 + 2 C01) at constant length."""
    A, twist = 10 * mm, 50.0
    bar = tg.sections.Sketch(areas={"body": tg.sections.disc(A)})
    result, expected = [], []
    for law in LAWS.values():
        C10, C01 = law.C10, getattr(law, "C01", 0.0)
        section = tg.Section(bar, {"body": problems.rubber(law)}, size=2 * mm)
        response = section.solve(prescribed={"twist": twist, "stretch": 1.0}).response
        result += [response["torque"][0] * 1e3, response["axial_force"][0]]
        expected += [np.pi * twist * A**4 * (C10 + C01) * 1e3, -0.5 * np.pi * A**4 * twist**2 * (C10 + 2 * C01)]
    record_verification(
        claim="section of a round bar twisted by 0.5/A: torque [N mm], force [N]; neo-Hooke, Mooney–Rivlin",
        source="V09, exact",
        expected=expected,
        got=result,
        tolerance="2e-5",
    )
    assert result == pytest.approx(expected, rel=2e-5)


#: Angle from the circumference [°]: a/A, b/B, stretch, twist [° per mm] at 30 and at 62.5 kPa.
WOUND = {
    0: ((1.024645, 1.000459, 1.070961, 0.0), (1.054115, 1.001103, 1.172636, 0.0)),
    25: ((1.103995, 1.055974, 1.027936, -0.860795), (1.264468, 1.144133, 1.097062, -2.127413)),
    54.7356: ((1.193832, 1.117564, 0.992878, -0.447444), (1.735836, 1.466578, 1.032816, -1.763168)),
    90: ((1.211395, 1.127091, 1.000051, 0.0), (2.406897, 1.942001, 1.001539, 0.0)),
}
BALLOONING = ("cavity_ballooning", "outside_ballooning", "stretch")


@pytest.mark.parametrize("angle", WOUND)
def test_wound_tube(record_verification, angle):
    tube = tg.sections.Sketch(areas={"body": tg.sections.disc(8.35 * mm), "cavity": tg.sections.disc(6.35 * mm)})
    threads = slices.family(
        385.676e3, angle * deg, hand="right", axis=(1.0, 0.0, 0.0), compression=1.0
    )  # N/m per width
    section = tg.Section(tube, {"body": problems.rubber(problems.NEO_HOOKE)}, reinforcements=[threads])
    response = section.solve([30 * kPa, 62.5 * kPa]).response
    for row, expected in enumerate(WOUND[angle]):
        got = [*(response[name][row] for name in BALLOONING), response["twist"][row] / deg * mm]
        record_verification(
            claim=f"section of a tube wound at {angle}°, {(30, 62.5)[row]} kPa: a/A, b/B, stretch, twist [°/mm]",
            source="V20, quadrature",
            expected=expected,
            got=got,
            tolerance="2e-5",
        )
        assert got == pytest.approx(expected, rel=2e-5, abs=2e-6)


def test_tube_of_constant_radius(record_verification):
    """Closed ends; the outside keeps its radius, as in hoops that are inextensible: P of the stretch that comes out."""
    tube = tg.sections.Sketch(areas={"body": tg.sections.disc(8 * mm), "cavity": tg.sections.disc(6 * mm)})
    held = [tg.supports.Radial("outside")]
    section = tg.Section(tube, {"body": problems.rubber(problems.NEO_HOOKE)}, supports=held)
    stretches = section.solve([10 * kPa, 50 * kPa]).response["stretch"]
    got = [exact.held_tube(problems.NEO_HOOKE, float(s), 6 * mm, 8 * mm, 8 * mm)[0] / kPa for s in stretches]
    record_verification(
        claim="section of a closed tube whose radius is held, 10 and 50 kPa: pressure of its stretch [kPa]",
        source="V07, quadrature",
        expected=[10, 50],
        got=got,
        tolerance="1e-4",
    )
    assert got == pytest.approx([10, 50], rel=1e-4)


def test_a_tube_past_its_limit_point(record_verification):
    """V06 by its volume: the pressure falls beyond a stretch of 1.738 of the inner wall, and states are unstable."""
    tube = tg.actuators.ExtendingCylinder()
    rubber = problems.rubber(problems.NEO_HOOKE)
    stretches = np.array([1.2, 1.6, 1.73, 1.75, 2.0, 2.5])
    exactly = tg.formulas.thick_tube(tube, rubber, inner_stretch=stretches)
    volumes = np.pi * (tube.inner_radius * stretches) ** 2 * exactly["axial_stretch"]
    errors = {}
    for size in (2, 1, 0.5):
        solution = tg.Section(tube, {"body": rubber}, size=size * mm).solve(volume={"cavity": volumes})
        errors[size] = solution.response["pressure"] / exactly["pressure"] - 1
    (turn,) = tg.formulas.limit_points(tube, rubber)
    assert list(solution.stable) == (stretches < turn.inner_stretch).tolist()
    record_verification(
        claim="section of a bare closed tube at held volumes, past its limit point: pressure [kPa]",
        source="V06, exact",
        expected=exactly["pressure"] / kPa,
        got=solution.response["pressure"] / kPa,
        tolerance="1e-6",
    )
    rate = np.log2(np.abs(errors[1]) / np.abs(errors[0.5]))
    record_verification(
        claim="section of a bare closed tube at held volumes: rate of convergence of the pressure",
        source="theory",
        expected=[4] * len(rate),
        got=rate,
        tolerance="at least 3",
    )
    assert np.abs(errors[0.5]).max() < 1e-6
    assert rate.min() > 3
