"""Benchmarks of rods in space and of frames: the 45° bend of Bathe and Bolourchi, the frame of Lee.

Problems: (a) a bend of radius 100 and 45°, square section of side 1, E = 1e7, ν = 0, clamped, with a force of 300 and
600 out of its plane (Bathe and Bolourchi 1979, doi 10.1002/nme.1620140703). (b) two legs of 120 that meet at a right
angle, pinned at both ends, E = 7.2e6, ν = 0.3, section 3 × 2, a force down 24 from the corner (Lee, Manuel and Rossow
1968): it snaps through and back. Lengths and forces have no unit, as published.
Reference: (a) published tips at 600: (15.9, 47.2, 53.4) by Bathe and Bolourchi, (15.79, 47.23, 53.37) by Simo and
Vu-Quoc 1986 with 8 linear elements; beyond, turgor's own on 64 elements. (b) the first maximum of the force, about
18,500 in the literature, and the minimum, about -9,400.
Tolerance: 0.15 from the published tips, which differ by 0.1 among themselves; 1 % of the published forces.
"""

import numpy as np
import pytest
from rod_cases import rates
from turgor.rods import Place, Plate, PlateForce, Rod, RodModel, RodSection, arc_length, static

RADIUS = 100.0
PUBLISHED = (15.79, 47.23, 53.37)


def _bend(elements):
    """Tip of the bend under 600 (published order of axes: along the second leg, along the first, out of the plane)."""
    section = RodSection.from_moduli(EA=1e7, GA=5e6, EI=1e7 / 12, GJ=1e7 / 12)
    rod = Rod(section=section, length=RADIUS * np.pi / 4, elements=elements, rest_strain=(0, 0, 0, 0, 0, 1 / RADIUS))
    tip = static(RodModel(rods=[rod], loads=[PlateForce(force=(0, 0, 600.0))]), at=2).tip
    return tip[:, [1, 0, 2]]


def test_bend_in_space(record_verification):
    tips = {n: _bend(n) for n in (4, 8, 16, 64)}
    assert tips[8][0] == pytest.approx([RADIUS * (1 - np.sqrt(0.5)), RADIUS * np.sqrt(0.5), 0], abs=1e-9)
    record_verification("45° bend under 600, 8 elements: tip", "Simo and Vu-Quoc 1986", PUBLISHED, tips[8][-1], "0.15")
    assert tips[8][-1] == pytest.approx(np.array(PUBLISHED), abs=0.15)
    errors = [float(np.linalg.norm(tips[n][-1] - tips[64][-1])) for n in (4, 8, 16)]
    record_verification("the same, 4, 8, 16 elements, against 64", "the same problem", 0.0, errors, "orders > 3.5")
    assert rates(errors).min() > 3.5


def test_frame_snaps(record_verification):
    young, width, height, leg = 7.2e6, 3.0, 2.0, 120.0
    bending, area = young * width * height**3 / 12, young * width * height
    # stiff out of the plane, so that it does not leave it
    section = RodSection.from_moduli(EA=area, GA=area / 2.6 * 5 / 6, EI=[bending, 100 * bending], GJ=100 * bending)
    corner = Place(turn=(0, np.pi / 2, 0))
    rods = [
        Rod(name="column", section=section, length=leg, elements=8, end="corner"),
        Rod(name="short", section=section, length=24, elements=3, start="corner", end="loaded", start_at=corner),
        Rod(name="beam", section=section, length=96, elements=7, start="loaded", end="right"),
    ]
    plates = [
        Plate(name="base", support="hinge_y", place=Place(turn=(0, -np.pi / 2, 0))),
        Plate(name="right", support="hinge_y"),
    ]
    load = PlateForce(plate="loaded", force=(0, 0, -30_000.0))
    solution = arc_length(RodModel(rods=rods, plates=plates, loads=[load]), step=0.01)
    force = 30_000 * solution.load_factors
    top = int(np.argmax(np.diff(force) < 0))
    bottom = top + int(np.argmax(np.diff(force[top:]) > 0))
    record_verification(
        "Lee's frame: first maximum and following minimum of the force", "literature", (18_500, -9_400),
        (force[top], force[bottom]), "1 %",
    )  # fmt: skip
    assert force[top] == pytest.approx(18_500, rel=0.01)
    assert force[bottom] == pytest.approx(-9_400, rel=0.01)
    assert solution.stable[top - 1] and not solution.stable[top + 2]
    assert solution.load_factors[-1] == pytest.approx(1.0)
