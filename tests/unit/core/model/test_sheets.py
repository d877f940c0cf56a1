"""Sheets on faces: what a shell is made of, its bending stiffness, and what is refused."""

import pytest
import results_cases as cases

import turgor as tg
from refused import refused
from turgor.units import GPa, mm

PAPER = tg.from_library("paper", record="hooke-polygerinos-2020")


def test_paper_bends_like_a_plate_and_a_fabric_as_it_states():
    assert tg.Shell(PAPER, 0.1 * mm).bending_stiffness == pytest.approx(6.5e9 * 1e-12 / 12 / 0.96)
    fabric = tg.Material(name="fabric", law=tg.laws.Hooke(E=1 * GPa, nu=0.3), bending_stiffness=1e-5)
    sheet = tg.Shell(fabric, 0.3 * mm)
    assert sheet.bending_stiffness == pytest.approx(1e-5)
    assert sheet.second_moment < 0.01 * tg.Shell(PAPER, 0.3 * mm).second_moment
    assert "bending stiffness 1e-05 N m" in repr(fabric)


def test_what_no_sheet_can_be_is_refused():
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=1e5))
    with refused("rubber", "NeoHooke", "Hooke"):
        tg.Shell(rubber, 0.1 * mm)
    with refused("thickness", "20 mm", "more than 0 up to 10 mm"):
        tg.Shell(PAPER, 20 * mm)
    with refused("rubber", "bending_stiffness", "Hooke"):
        tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=1e5), bending_stiffness=1e-5)
    with refused("fabric", "bending_stiffness", "-1 N m", "positive"):
        tg.Material(name="fabric", law=tg.laws.Hooke(E=1 * GPa, nu=0.3), bending_stiffness=-1.0)


def test_a_material_for_a_face_says_that_a_sheet_needs_a_thickness():
    mesh = cases.body()
    materials = dict.fromkeys(mesh.regions, cases.RUBBER) | {"outside": PAPER}
    with refused("materials.outside", "'outside'", "'Paper'", "thickness"):
        tg.Model(mesh, materials, [tg.Fixed("fixed")], [])
