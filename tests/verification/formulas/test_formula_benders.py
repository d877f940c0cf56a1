"""V21: what formulas of benders miss: bending without fibers begins with P², and a wound section changes its shape.

Problem: (1) the eccentric bender, neo-Hookean, without fibers, 60 mm long, under 5 and 10 kPa, hexahedra; its bending
between sections at 30 % and 70 % of the length, away from the ends, which bend it in proportion to the pressure.
(2) The section of V21, of which the formula takes the shape as rigid.
Derived: to first order θ = (1 − 2ν) P S L/(E I) for any section of one Poisson's ratio: nothing at ν = ½.
Exact for (2): the torque balance by another quadrature, and its limit, P S L/(4 μ I) with the moments about the layer.
Tolerance: the order 2 within 0.1; the middle bends by less than a tenth of what Euler–Bernoulli says. The distance of
the formula from V21 is recorded: too little at 2 kPa, three times too much at 100 kPa.
"""

import numpy as np
import pytest
from scipy.integrate import quad

import problems
import turgor as tg
from turgor.units import deg, kPa, mm

F = tg.formulas
RUBBER = tg.Material(name="test rubber", law=problems.NEO_HOOKE)
PRESSURES = (2, 5, 10, 20, 50, 100)  # kPa
V21 = (3.57, 7.08, 10.42, 15.06, 28.09, 53.61)  # degrees for 160 mm


def turn(state, low, high):
    """Turn between the sections nearest to two shares of the length, over their distance [rad/m]."""
    points, x = state.model.mesh.points, problems.current(state)
    planes = np.unique(np.round(points[:, 0], 8))
    at = [planes[np.abs(planes - share * planes[-1]).argmin()] for share in (low, high)]
    turns = []
    for plane in at:
        nodes = np.flatnonzero(np.abs(points[:, 0] - plane) < 1e-7)
        turns.append(np.arctan(np.polyfit(x[nodes, 2], x[nodes, 0], 1)[0]))
    return float((turns[1] - turns[0]) / (at[1] - at[0]))


@pytest.mark.slow
def test_bending_without_fibers_begins_with_the_square(record_verification):
    bender = tg.actuators.EccentricBender(length=60 * mm)
    mesh = tg.mesh(bender.build(), size=4 * mm, cells="hexahedra")
    model = tg.Model(mesh, {"body": RUBBER}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 10 * kPa)])
    solution = tg.solve(model, tg.Static(at=(0.5,), tolerance=1e-9))
    half, whole = (turn(problems.state_at(solution, share), 0.3, 0.7) * 50 * mm for share in (0.5, 1.0))
    beam = F.euler_bernoulli(bender, RUBBER, [5 * kPa, 10 * kPa])
    rate = float(np.log2(whole / half))
    record_verification(
        claim="eccentric bender without fibers, finite elements: order of its bending in P; angle at 10 kPa [°]",
        source=f"first order: none; Euler–Bernoulli says {beam['bending_angle_deg'][1]:.3g}°",
        expected=[2.0, 0.0],
        got=[rate, whole / deg],
        tolerance="0.1; a tenth of Euler–Bernoulli",
    )
    assert rate == pytest.approx(2.0, abs=0.1)
    assert 0 < whole < 0.1 * beam["bending_angle"][1]
    assert beam["first_order_bending_angle"] == pytest.approx([0.0, 0.0], abs=1e-12)
    assert beam.findings[0].code == "F02"


def test_wound_section_against_another_quadrature(record_verification):
    """The strip integral of the wall in the height, with the width of the section, by adaptive quadrature."""
    part = tg.actuators.FiberReinforcedBender(skin=0.0, end_wall=0.01 * mm, length=160.02 * mm)
    r, t, b = part.radius, part.wall, part.base
    mu = problems.NEO_HOOKE.shear_modulus
    got = F.fiber_reinforced_bender(part, RUBBER, [p * kPa for p in PRESSURES])

    def moment(curvature):
        def strip(z):
            width = 2 * np.sqrt(max((r + t) ** 2 - max(z - b, 0.0) ** 2, 0.0))
            void = 2 * np.sqrt(max(r**2 - (z - b) ** 2, 0.0)) if z > b else 0.0
            stretch = 1 + curvature * z
            return mu * (stretch - stretch**-3) * z * (width - void)

        return quad(strip, 0, b + r + t, points=(b, b + r), epsabs=0, epsrel=1e-10, limit=400)[0]

    lever = (4 * r**3 + 3 * np.pi * r**2 * b) / 6
    back = [moment(angle / (160 * mm)) / lever / kPa for angle in got["bending_angle"]]
    record_verification(
        claim="semicircular bender by formula: pressures that another quadrature gives for its angles [kPa]",
        source="torque balance",
        expected=PRESSURES,
        got=back,
        tolerance="1e-6",
    )
    assert back == pytest.approx(PRESSURES, rel=1e-6)
    record_verification(
        claim="semicircular bender of 160 mm: angles at 2, 5, 10, 20, 50, 100 kPa [°], by the formula",
        source="V21, converged: a section that changes its shape",
        expected=V21,
        got=got["bending_angle_deg"],
        tolerance="none: the distance",
    )
    ratio = got["bending_angle_deg"] / V21
    assert ratio[0] < 0.85 < 2.5 < ratio[-1] < 3.5  # too little at first, then far too much
    assert "F08" in {finding.code for finding in got.findings}


def test_small_angles_are_those_of_a_beam_in_plane_strain(record_verification):
    """E I becomes 4 μ I, since fibers hold the section across."""
    part = tg.actuators.FiberReinforcedBender()
    ratio = []
    for pressure in (20.0, 10.0):
        plane = F.fiber_reinforced_bender(part, RUBBER, [pressure])["bending_angle"][0]
        ratio.append(plane / F.euler_bernoulli(part, RUBBER, [pressure])["bending_angle"][0])
    off = [each / 0.75 - 1 for each in ratio]
    record_verification(
        claim="semicircular bender by formula at small pressure over Euler–Bernoulli; order of the difference",
        source="theory: 3 μ over 4 μ",
        expected=[0.75, 1.0],
        got=[ratio[1], float(np.log2(off[0] / off[1]))],
        tolerance="1e-4; 0.02",
    )
    assert ratio[1] == pytest.approx(0.75, rel=1e-3)
    assert np.log2(off[0] / off[1]) == pytest.approx(1.0, abs=0.02)


def test_sections_are_those_of_the_solids():
    """Area of walls from the moments is the volume of the modeled solid, for every family."""
    from turgor.fast_models.formulas.bending_beam import area_moments, section_of

    for name in F.about("euler_bernoulli").families:
        part = getattr(tg.actuators, name)()
        unit = tg.Material(name="unit", law=tg.laws.NeoHooke(C10=1 / 6))
        void = sum(area_moments(each.outline)[0] for each in part._layout.air)
        outside = sum(
            area_moments(each.outline)[0] - (area_moments(each.hole)[0] if each.hole else 0)
            for each in part._layout.pieces
        )
        inside = part.length - 2 * part.end_wall
        assert void * inside == pytest.approx(2 * part.cavity_volumes["cavity"], rel=1e-12)
        assert outside * part.length - void * inside == pytest.approx(2 * part.solid_volume, rel=1e-9)
        assert section_of(part, unit).stiffness > 0
    ring = section_of(tg.actuators.EccentricBender(offset=0.01 * mm), unit)
    assert ring.stiffness == pytest.approx(np.pi / 4 * (8**4 - 4.5**4) * mm**4, rel=1e-4)
    with_two = section_of(tg.actuators.TwoMaterialBender(), {"body": unit, "base": unit})
    part = tg.actuators.TwoMaterialBender()
    assert with_two.stiffness == pytest.approx(np.pi / 4 * (part.outer_radius**4 - part.inner_radius**4), rel=1e-9)
