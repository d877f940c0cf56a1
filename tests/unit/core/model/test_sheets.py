"""Sheets on faces: what a shell is made of, its bending stiffness, and what is refused."""

from functools import partial

import pytest
import results_cases as cases

import meshes
import turgor as tg
from refused import refused
from turgor.core.engine.faces.membrane_term import MembraneTerm
from turgor.core.engine.faces.plate_terms import PlateTerm
from turgor.core.engine.system import System
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


def test_a_shell_that_wrinkles_has_a_tension_field_and_its_bending():
    mesh = cases.body()
    terms = {}
    for share in (1.0, 0.0):
        materials = dict.fromkeys(mesh.regions, cases.RUBBER) | {"outside": tg.Shell(PAPER, 0.1 * mm, share)}
        terms[share] = System(tg.Model(mesh, materials, [tg.Fixed("fixed")], [])).terms.all
    for share, made in terms.items():
        (layer,) = [term for term in made if isinstance(term, MembraneTerm)]
        assert (layer.field is not None) == (share == 0.0)
        assert any(isinstance(term, PlateTerm) for term in made)


def test_what_no_woven_sheet_can_be_is_refused():
    law = tg.laws.Woven(E=400e6, E_weft=150e6, G=12e6, nu=0.2)
    with refused("shell", "woven", "warp", "missing"):
        tg.Shell(tg.Material(name="woven", law=law), 0.1 * mm)
    with refused("membrane", "compression", "0", "woven"):
        tg.Membrane(law, 0.1 * mm, 0.0, (1, 0, 0))
    with refused("zero vector", "warp"):
        tg.Membrane(law, 0.1 * mm, warp=(0, 0, 0))
    with refused("shell", "compression", "2", "0 (it wrinkles) to 1"):
        tg.Shell(PAPER, 0.1 * mm, 2.0)
    with refused("G", "-1 Pa", "positive"):
        tg.laws.Woven(E=400e6, E_weft=150e6, G=-1, nu=0.2)
    with refused("nu", "0.9", "0.612", "E / E_weft"):
        tg.laws.Woven(E=150e6, E_weft=400e6, G=1e6, nu=0.9)
    mesh = cases.body()
    sheet = tg.Shell(tg.Material(name="cloth", law=law), 0.1 * mm, warp=(0, 0, 1))
    materials = dict.fromkeys(mesh.regions, cases.RUBBER) | {"outside": sheet}
    with refused("warp", "cloth", "across"):
        System(tg.Model(mesh, materials, [tg.Fixed("fixed")], []))


@pytest.mark.parametrize(
    ("warp", "weft", "fits"),
    [((1, 0, 0), 150e6, True), ((0, 1, 0), 150e6, True), ((1, 1, 0), 400e6, True), ((1, 1, 0), 150e6, False)],
)
def test_a_woven_sheet_is_its_own_mirror_image(warp, weft, fits):
    mesh = meshes.box((10 * mm, 10 * mm, 5 * mm), (1, 1, 1))
    half = meshes.with_faces(mesh, symmetry_low=mesh.faces["y0"])
    sheet = tg.Membrane(tg.laws.Woven(E=400e6, E_weft=weft, G=12e6, nu=0.2), 0.1 * mm, warp=warp)
    materials = {"body": cases.RUBBER, "z0": sheet}
    model = partial(tg.Model, materials=materials, supports=[tg.Fixed("x0")], loads=[])
    assert model(mesh)
    if fits:
        assert model(half)
    else:
        with refused("materials.z0", "warp", "mirror", "symmetric = false"):
            model(half)
