"""V07: an extender whose outer radius is held, by a support or by stiff hoops, follows the exact curve.

Problem: tube of inner radius 6.35 mm, outer 8.35 mm with closed ends that are free to move, wound densely with hoops
that do not give way: the outer radius stays, the length grows. A quarter of a slice, its outside held (the trick of the
review's appendix C), or with smeared hoops of 1e5 N/mm, which give way by 1.7e-5 at the largest pressure; neo-Hookean
(C10 = 0.12 MPa) and Yeoh (0.11, 0.02 MPa).
Exact: with a² = B² − (B² − A²)/λz the energy depends on λz alone, and P = W′(λz) / (π B²): the piston is the area
within the hoops. Source: `hoops.py`, whose neo-Hookean pressures `fiber_tube` must give to seven digits.
Tolerance: 0.2 % of the elongation λz − 1 at each tabulated pressure, of the inner radius, and of the pressure between
rubber and winding. Two cells through the wall.
"""

import numpy as np
import pytest
from hoops import CONTACT, PRESSURE, STRETCH, model_of

import problems
import slices
from fiber_tube import FiberTube

#: Inner radius [mm], the same for both laws: it follows from the volume alone.
RADIUS = (6.395230, 6.459296, 6.557075, 6.724768, 6.863462, 7.079725, 7.417715)
#: Wall thickness at 0.05 MPa: inner radius [mm], stretch.
THICKNESS = {5.35: 1.076743, 5.85: 1.097851, 6.35: 1.130179, 6.85: 1.188006, 7.35: 1.324264}


def test_exact_curve_reproduces_the_table():
    tube = FiberTube(inner=6.35, outer=8.35, shear_modulus=0.24)
    for stretch, pressure, radius in zip(STRETCH, PRESSURE["neo-Hookean"], RADIUS, strict=True):
        a = np.sqrt(tube.outer**2 - (tube.outer**2 - tube.inner**2) / stretch)
        assert a == pytest.approx(radius, rel=5e-7)
        by_radius, by_stretch, _ = tube.slopes(a, stretch, 0.0)
        slope = by_stretch + by_radius * (tube.outer**2 - tube.inner**2) / (2 * a * stretch**2)
        assert slope / (np.pi * tube.outer**2) == pytest.approx(pressure, rel=5e-7)


@pytest.mark.parametrize("way", ["held", "hoops"])
@pytest.mark.parametrize("name", PRESSURE)
def test_elongation(name, way, record_verification):
    near = [(p * problems.MPA, stretch) for p, stretch in zip(PRESSURE[name], STRETCH, strict=True)]
    result = slices.free(model_of(name, way), near)
    got = [each.stretch for each in result]
    radius = [each.inner / problems.MM for each in result]
    record_verification(
        claim=f"extender, {name}, outer radius {'held' if way == 'held' else 'kept by smeared hoops'}: λz",
        source="V07, exact",
        expected=STRETCH,
        got=got,
        tolerance="0.2 % of λz − 1",
    )
    record_verification(
        claim=f"extender, {name}, {way}: current inner radius [mm]",
        source="V07, exact",
        expected=RADIUS,
        got=radius,
        tolerance="0.2 %",
    )
    assert np.array(got) - 1 == pytest.approx(np.array(STRETCH) - 1, rel=2e-3)
    assert radius == pytest.approx(RADIUS, rel=2e-3)


def test_pressure_on_the_winding(record_verification):
    near = [(p * problems.MPA, stretch) for p, stretch in zip(PRESSURE["neo-Hookean"], STRETCH, strict=True)]
    got = [each.held / problems.MPA for each in slices.free(model_of("neo-Hookean", "held"), near)]
    record_verification(
        claim="extender, neo-Hookean, outer radius held: pressure between rubber and winding [MPa]",
        source="V07, exact",
        expected=CONTACT,
        got=got,
        tolerance="0.2 %",
    )
    assert got == pytest.approx(CONTACT, rel=2e-3)


def test_thinner_walls_extend_more(record_verification):
    got = []
    for inner, stretch in THICKNESS.items():
        model = model_of("neo-Hookean", "hoops", inner * problems.MM)
        got.append(slices.free(model, [(0.05 * problems.MPA, stretch)])[0].stretch)
    record_verification(
        claim="extender at 50 kPa, smeared hoops, inner radius 5.35 … 7.35 mm: λz",
        source="V07, exact",
        expected=list(THICKNESS.values()),
        got=got,
        tolerance="0.2 % of λz − 1",
    )
    assert np.array(got) - 1 == pytest.approx(np.array(list(THICKNESS.values())) - 1, rel=2e-3)
