"""Sections of rods from solved sections: free bending, a moment on top of it, and what is refused."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor import rods
from turgor.units import N, kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))
LENGTH = 100 * mm


@pytest.fixture(scope="module")
def solution():
    section = tg.Section(tg.actuators.EccentricBender(), {"body": RUBBER}, size=3 * mm)
    return section.solve(np.array([0, 15, 30]) * kPa)


def rod_of(solution, loads=()):
    section = tg.sections.rod_section(solution)
    model = rods.RodModel(
        rods=[rods.Rod(section=section, length=LENGTH)],
        loads=[rods.ChamberPressure(pressure=30 * kPa), *loads],
    )
    return rods.static(model)


def test_a_free_rod_bends_as_the_section(solution):
    strain = solution.response["curvature_y"][-1]
    tip = rod_of(solution).tip[-1]
    stretched = solution.response["stretch"][-1] * LENGTH
    angle = strain * LENGTH
    arc = stretched / angle * np.array([np.sin(angle), 0.0, np.cos(angle) - 1])
    np.testing.assert_allclose(tip, arc, rtol=1e-6, atol=1e-9)


def test_a_force_across_bends_it_by_the_stiffness_under_pressure(solution):
    """Small deflection of a straight part: the rod is compared with itself without the force."""
    force = 1e-5 * N
    free, pushed = rod_of(solution), rod_of(solution, [rods.PlateForce(force=(0.0, 0.0, force))])
    moved = pushed.tip[-1] - free.tip[-1]
    bending = solution.stiffness(-1).bending[0]
    assert moved[2] == pytest.approx(force * LENGTH**3 / (3 * bending), rel=0.08)  # shear and the arc add to it


def test_pressures_from_zero_and_nothing_else(solution):
    section = tg.Section(tg.actuators.EccentricBender(), {"body": RUBBER}, size=4 * mm)
    with refused("2 states", "10000 Pa"):
        tg.sections.rod_section(section.solve(np.array([10, 20]) * kPa))
    with refused("axial_force", 0.1):
        tg.sections.rod_section(section.solve(np.array([0, 10]) * kPa, forces={"axial_force": [0.0, 0.1]}))


def test_strains_that_a_mirror_plane_holds_are_estimated(solution):
    stiffness = np.asarray(tg.sections.rod_section(solution, shear=(7.0, 8.0)).stiffness)
    assert (np.linalg.eigvalsh(stiffness) > 0).all()
    assert (stiffness[1, 1], stiffness[2, 2]) == (7.0, 8.0)
    assert stiffness[3, 3] == pytest.approx((stiffness[4, 4] + stiffness[5, 5]) / 3)


def test_a_quarter_of_a_tube_has_nearly_the_stiffness_of_a_tube():
    """E I and G J of a round tube of incompressible rubber at rest; what is estimated is near."""
    tube = tg.Section(tg.actuators.ExtendingCylinder(), {"body": RUBBER})
    stiffness = np.asarray(tg.sections.rod_section(tube.solve(np.array([0, 5]) * kPa)).stiffness)
    inner, outer = 6.35 * mm, 8.35 * mm
    moment = np.pi / 4 * (outer**4 - inner**4)
    expected = [3 * 0.24e6 * moment] * 2
    assert stiffness.diagonal()[4:] == pytest.approx(expected, rel=0.05)
    assert stiffness[3, 3] == pytest.approx(0.24e6 * 2 * moment, rel=0.05)
