"""Rods say what is wrong with what they are given, and what came out."""

import numpy as np
import pytest
from turgor.rods import (
    ChamberPressure,
    HalfRound,
    LineLoad,
    Place,
    Plate,
    PlateForce,
    PressureTable,
    Rectangle,
    RodChamber,
    RodModel,
    RodSection,
    Round,
    Tube,
)

import turgor as tg
from refused import refused
from turgor import rods

SECTION = RodSection.from_moduli(EA=100.0, GA=30.0, EI=1e-3, GJ=1e-3)
ROD = rods.Rod(section=SECTION, length=0.1)


@pytest.mark.parametrize(
    ("make", "facts"),
    [
        (lambda: RodSection(stiffness=np.eye(5)), ["stiffness", "(5, 5)", "6 x 6"]),
        (lambda: RodSection(stiffness=np.triu(np.ones((6, 6)))), ["stiffness", "symmetric", "[0, 1] is 1", "[1, 0] 0"]),
        (lambda: RodSection.from_moduli(EA=100, GA=30, EI=-1, GJ=1), ["stiffness", "-1.0", "positive definite"]),
        (lambda: RodSection.from_moduli(EA=100, GA=(1, 2, 3), EI=1, GJ=1), ["GA", "(1, 2, 3)", "two"]),
        (lambda: RodSection(stiffness=np.eye(6), mass_per_length=0), ["mass_per_length", "0 kg/m"]),
        (lambda: RodSection(stiffness=np.eye(6), damping_time=-1), ["damping_time", "-1 s", "0 or more"]),
        (lambda: RodSection(stiffness=np.eye(6), rotary_inertia=(1, 2)), ["rotary_inertia", "(1, 2)", "three"]),
        (lambda: RodSection.from_uniform(np.eye(3), 1.0), ["stiffness", "(3, 3)", "4 x 4"]),
        (lambda: RodChamber(), ["'cavity'", "area", "0 m²", "table"]),
        (lambda: RodChamber(area=-1), ["'cavity'", "area", "-1 m²"]),
        (lambda: PressureTable(pressure=[1, 2], strain=np.zeros((2, 6))), ["pressure", "[1, 2]", "rising", 0]),
        (lambda: PressureTable(pressure=[0, 2], strain=np.ones((2, 6))), ["strain", "pressure 0", "[1.0, 1.0,"]),
        (lambda: PressureTable(pressure=[0, 2], strain=np.zeros((3, 6))), ["strain", "(3, 6)", "2 x 6"]),
        (lambda: PressureTable(pressure=[0, 2], strain=np.zeros((2, 6))).strain_at(3), ["3 Pa", "0 to 2 Pa"]),
        (lambda: Round(radius=0), ["radius", "0 m"]),
        (lambda: Tube(outer_radius=1, inner_radius=2), ["inner_radius", "2 m", "1 m"]),
        (lambda: rods.Rod(section=SECTION, length=-1), ["'rod'", "length", "-1 m", 0]),
        (lambda: rods.Rod(section=SECTION, length=1, elements=0), ["'rod'", "elements", 0, "1 to 10000"]),
        (lambda: rods.Rod(section=SECTION, length=1, end="base"), ["'rod'", "start", "end", "'base'"]),
        (lambda: rods.Rod(section=SECTION, length=1, rest_strain=(1, 2)), ["'rod'", "rest_strain", "(1, 2)", "six"]),
        (lambda: Place(turn=(1, 2)), ["turn", "(1, 2)", "three"]),
        (lambda: Plate(name="tip", support="pined"), ["'tip'", "'pined'", "'pinned'"]),
        (lambda: Plate(name="tip", mass=-1), ["'tip'", "mass", "-1 kg"]),
        (lambda: RodModel(rods=[]), ["rods", "none"]),
        (lambda: RodModel(rods=[ROD, ROD]), ["rods", "rod, rod", "unique"]),
        (lambda: RodModel(rods=[ROD], plates=[Plate(name="tipp")]), ["'tipp'", "'tip'", "base, tip"]),
        (lambda: RodModel(rods=[ROD], plates=[Plate(name="base")]), ["plate", "base, tip", "'fixed'"]),
        (lambda: RodModel(rods=[ROD], loads=[LineLoad(force=(0, 0, 1), rod="rodd")]), ["'rodd'", "'rod'"]),
        (lambda: RodModel(rods=[ROD], loads=[ChamberPressure(pressure=1)]), ["'cavity'", "RodChamber"]),
        (lambda: RodModel(rods=[ROD], loads=[tg.Gravity()]), ["gravity", "'rod'", "mass_per_length"]),
        (lambda: RodModel(rods=[ROD], loads=[tg.Pressure("cavity", 1.0)]), ["Pressure", "ChamberPressure"]),
        (lambda: rods.static(RodModel(rods=[ROD]), at=0), ["at", 0, 1]),
        (lambda: rods.static(RodModel(rods=[ROD]), at=[0.5, 0.5]), ["at", "[0.5, 0.5]"]),
        (lambda: rods.dynamic(RodModel(rods=[ROD]), duration=1, step=0.1), ["motion", "'rod'", "mass_per_length"]),
        (lambda: rods.dynamic(RodModel(rods=[ROD]), duration=1, step=2), ["step", "2 s", "duration", "1 s"]),
        (lambda: rods.natural_frequencies(RodModel(rods=[ROD]), count=0), ["count", 0, 1]),
        (lambda: rods.plot_rods(rods.static(RodModel(rods=[ROD])), view="xx"), ["view", "'xx'", "'xz'"]),
    ],
)  # fmt: skip
def test_bad_input_is_told(make, facts):
    with refused(*facts):
        make()


def test_second_moments_are_those_of_points():
    """Against a sum over a fine grid of points."""
    grid = (np.arange(1200) + 0.5) / 600 - 1
    y, z = np.meshgrid(12e-3 * grid, 12e-3 * grid)
    cell, radius = (12e-3 / 600) ** 2, np.hypot(y, z)
    half, tube = HalfRound(radius=8e-3, wall=2e-3), Tube(outer_radius=8e-3, inner_radius=5e-3)
    walls = ((radius < 8e-3) & (z > 0) & ~((radius < 6e-3) & (z > 0))) | ((np.abs(y) < 8e-3) & (z < 0) & (z > -2e-3))
    box = Rectangle(width=6e-3, height=4e-3)
    inside = (
        (half, walls), (tube, (radius < 8e-3) & (radius > 5e-3)), (Round(radius=7e-3), radius < 7e-3),
        (box, (np.abs(y) < 3e-3) & (np.abs(z) < 2e-3)),
    )  # fmt: skip
    for shape, solid in inside:
        area, center = solid.sum() * cell, z[solid].mean()
        moments = ((z[solid] - center) ** 2).sum() * cell, (y[solid] ** 2).sum() * cell
        assert shape.area == pytest.approx(area, rel=5e-3)
        assert shape.second_moments == pytest.approx(moments, rel=1e-2)
    assert half.center == pytest.approx(z[walls].mean(), rel=5e-3)


def test_bare_walls_have_no_chamber():
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1e6), density=1000.0)
    tube = Tube(outer_radius=8e-3, inner_radius=5e-3)
    assert RodSection.from_geometry(tube, rubber).chambers == ()
    held = RodSection.from_geometry(tube, rubber, reinforced=True)
    assert held.chambers[0].area == pytest.approx(np.pi * 25e-6)
    assert held.stiffness[0, 0] == pytest.approx(0.6e6 * np.pi * 39e-6)
    assert held.rotary_inertia[1] == pytest.approx(1000 * np.pi * (8e-3**4 - 5e-3**4) / 4)


def test_initial_moduli_of_compressible_and_linear_materials():
    soft = tg.Material(name="soft", law=tg.laws.NeoHooke(C10=0.1e6), bulk_modulus=0.2e6)
    stiff = tg.Material(name="stiff", law=tg.laws.Hooke(E=1e9, nu=0.25))
    sections = [RodSection.from_geometry(Rectangle(width=1e-3, height=1e-3), each) for each in (soft, stiff)]
    assert sections[0].stiffness[0, 0] == pytest.approx(9 * 0.2 * 0.2 / (0.6 + 0.2))  # 9 κ μ / (3 κ + μ)
    assert sections[1].stiffness[0, 0] == pytest.approx(1e3)
    assert sections[1].stiffness[1, 1] == pytest.approx(0.4e3 * 6 / 7)


def test_a_response_is_that_of_any_actuator():
    section = RodSection(stiffness=SECTION.stiffness, chambers=(RodChamber(area=1e-5, offset=(0, 1e-3)),))
    model = RodModel(rods=[rods.Rod(section=section, length=0.1)], loads=[ChamberPressure(pressure=100e3)])
    response = rods.static(model, at=4).response()
    assert response.names[:3] == ("load_factor", "pressure", "tip_displacement")
    assert response["pressure_kPa"] == pytest.approx([0, 25, 50, 75, 100])
    assert response["bending_angle"] == pytest.approx(np.linspace(0, 1, 5) * 100e3 * 1e-8 / 1e-3 * 0.1)
    assert response["strain_energy"][-1] == pytest.approx(0.5 * (1.0**2 / 100 + 1e-3**2 / 1e-3) * 0.1)
    assert response.status == "converged"


def test_a_rod_that_coils_too_much_for_its_elements_is_told():
    coiled = rods.Rod(section=SECTION, length=0.1, elements=2)
    pushed = RodModel(rods=[coiled], loads=[PlateForce(moment=(0, 4 * np.pi * 1e-3 / 0.1, 0))])
    with refused("load factor 0.4137", "arc_length", error=rods.RodError) as caught:
        rods.static(pushed)
    assert caught.value.solution.status == "not_converged"
    assert caught.value.solution.load_factors[-1] > 0.2


def test_a_straight_column_is_unstable_past_its_buckling_load():
    critical = np.pi**2 / 4 * 1e-3 / 0.1**2
    column = RodModel(rods=[ROD], loads=[PlateForce(force=(-1.1 * critical, 0, 0))])
    solution = rods.static(column, at=11)
    assert solution.stable == (True,) * 10 + (False,) * 2
    assert "a state is unstable" in solution.message


def test_rods_between_held_plates_fit():
    """A rod that is too long for its plates is bent or compressed from the beginning."""
    near = Place(position=(0.09, 0, 0))
    plates = [Plate(name="base", support="fixed", place=Place()), Plate(name="tip", support="fixed", place=near)]
    solution = rods.static(RodModel(rods=[ROD], plates=plates))
    assert solution.shape().strain[:, 0] == pytest.approx(np.full(16, 0.9))
    assert solution.reaction("tip")[0] == pytest.approx(-10.0)
