"""Cavities of CAD parts are found by themselves, whatever they look like, and measured exactly."""

from math import pi

import cad_cases as cases
import numpy as np
import pytest
from netgen.occ import Box, Cylinder, Pnt, X

import turgor as tg
from turgor.core.geometry.cad.cavities import find_hollows
from turgor.core.geometry.cad.facets import find_facets
from turgor.core.geometry.cad.inspection import inspect_here as inspect_cad
from turgor.core.geometry.cad.read import read_here as read_cad
from turgor.core.geometry.cad.selectors import NearestTo, WithNormal
from turgor.core.meshing.surface import check_surface
from turgor.units import mm

END = cases.FINGER.end_wall / mm
CLOSED = cases.FINGER.cavity_volume / mm**3

#: A shape, the volume of its cavity [mm³], the area [mm²] and the place [mm] of its opening.
CASES = {
    "closed finger": (cases.finger, CLOSED, None, None),
    "finger with axial inlet": (
        lambda: cases.finger_with_inlet(), CLOSED + END * pi * 1.44, pi * 1.44, (0, 0, 10)
    ),
    "tube with radial inlet in y": (
        lambda: cases.tube(inlet="y"), pi * 64 * 40 + cases.radial_inlet_volume(), pi * 4, (25, 9.9, 0)
    ),
    "tube with radial inlet through its seam": (
        lambda: cases.tube(inlet="z"), pi * 64 * 40 + cases.radial_inlet_volume(), pi * 4, (25, 0, 9.9)
    ),
    "tube open at one end": (lambda: cases.tube(bore=(5, 45)), pi * 64 * 45, pi * 64, (50, 0, 0)),
    "cup and plate": (cases.cup_and_plate, cases.CUP_VOLUME, pi * 2.25, (0, 10, 6)),
}  # fmt: skip


def at_rest(mesh):
    """The undeformed state of a model of a mesh."""
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1e6))
    materials = dict.fromkeys(mesh.regions, rubber)
    return tg.solutions.State(
        model=tg.Model(mesh, materials=materials, supports=[tg.Fixed("fixed")], loads=[tg.Pressure("cavity", 1.0)]),
        load_factor=0.0,
        displacement=np.zeros_like(mesh.points),
        mean_stress=np.zeros(mesh.vertex_count),
        nodal_force=np.zeros_like(mesh.points),
    )


@pytest.mark.parametrize("case", CASES)
def test_the_cavity_is_found_and_measured(case, tmp_path):
    shape, volume, area, place = CASES[case]
    (cavity,) = inspect_cad(cases.written(tmp_path, shape())).cavities
    assert cavity.name == "cavity"
    assert cavity.closed == (area is None)
    assert cavity.volume / mm**3 == pytest.approx(volume, rel=1e-6)
    if area is not None:
        ((result, center),) = cavity.openings
        assert result / mm**2 == pytest.approx(area, rel=2e-3)
        assert np.array(center) / mm == pytest.approx(place, abs=0.02)


def test_three_chambers_with_inlets_are_numbered_counterclockwise_from_the_top_as_seen_from_the_tip(tmp_path):
    result = inspect_cad(cases.written(tmp_path, cases.three_chambers())).cavities
    assert [cavity.name for cavity in result] == ["cavity_1", "cavity_2", "cavity_3"]
    assert [cavity.volume / mm**3 for cavity in result] == pytest.approx([cases.CHAMBER_VOLUME] * 3, rel=1e-6)
    centers = np.array([cavity.openings[0][1] for cavity in result]) / mm
    assert centers == pytest.approx(np.array([[0, 0, 5], [0, -4.33, -2.5], [0, 4.33, -2.5]]), abs=0.01)


def test_a_through_hole_is_no_cavity_unless_it_is_named(tmp_path):
    path = cases.written(tmp_path, cases.tube(bore=(0, 50)))
    part = read_cad(path)
    assert part.faces == ("outside",)
    leak = next(finding for finding in part.findings if finding.code == "D03")
    assert "9956 mm³" in leak.message  # measured on the facets: less than the exact 10053 mm³
    assert "(0, 0, 0) mm" in leak.message
    assert "(50, 0, 0) mm" in leak.message
    assert any(finding.code == "D05" and "cavity" in finding.message for finding in part.findings)
    named = read_cad(path, faces={"cavity": NearestTo((25 * mm, 0, 8 * mm))})
    assert named.cavity_volume / mm**3 == pytest.approx(pi * 64 * 50, rel=1e-6)
    assert all(finding.code != "D03" for finding in named.findings)


def test_a_cavity_with_two_inlets_leaks(tmp_path):
    shape = cases.finger_with_inlet() - Cylinder(Pnt(30, 0, 10), X, 1.2, 20)
    part = read_cad(cases.written(tmp_path, shape))
    assert part.cavity_volumes == {}
    (leak,) = [finding for finding in part.findings if finding.code == "D03"]
    assert "leak" in leak.message
    assert leak.message.count(" mm with ") == 2


def test_nested_candidates_are_told_and_the_outermost_one_is_taken(tmp_path):
    part = read_cad(cases.written(tmp_path, cases.finger_with_inlet()))
    (nested,) = [finding for finding in part.findings if finding.code == "D02"]
    assert "The outermost is taken" in nested.message
    assert "open at (0, 0, 10) mm" in nested.message
    assert f"end further in, at ({END:g}, " in nested.message
    closed = read_cad(cases.written(tmp_path, cases.finger()))
    assert [finding.code for finding in closed.findings] == ["D05"]


def test_a_blind_hole_for_a_screw_is_no_cavity(tmp_path):
    shape = cases.tube(inlet="y") - Cylinder(Pnt(47, 0, 0), X, 1, 10)
    part = read_cad(cases.written(tmp_path, shape))
    assert set(part.cavity_volumes) == {"cavity"}
    (small,) = [finding for finding in part.findings if finding.code == "D04"]
    assert "1 of them, 9.3" in small.message
    assert "(50, 0, 0) mm" in small.message
    hole = read_cad(cases.written(tmp_path, shape), faces={"cavity": NearestTo((48 * mm, 0, 1 * mm))})
    assert hole.cavity_volume / mm**3 == pytest.approx(3 * pi, rel=1e-5)


def test_a_body_without_any_hollow_has_no_cavity():
    shape = Cylinder(Pnt(0, 0, 0), X, 10, 50)
    hollows, nested, passages = find_hollows(find_facets(shape, list(shape.faces)))
    assert (hollows, nested, passages) == ([], [], [])


def test_half_a_finger_is_measured_at_its_mirror_plane(tmp_path):
    half = tg.FastPneuNet(chambers=2, length=20 * mm)
    shape = half.build().shape
    for face in shape.faces:
        face.name = ""
    path = cases.written(tmp_path, shape)
    part = read_cad(path, faces={"symmetry_y": WithNormal("-y")})
    assert part.cavity_volume == pytest.approx(half.cavity_volume, rel=1e-9)
    assert part.solid_volume == pytest.approx(half.solid_volume, rel=1e-9)
    (cavity,) = inspect_cad(path, faces={"symmetry_y": WithNormal("-y")}).cavities
    assert cavity.closed


def test_half_a_finger_with_half_an_inlet_has_half_the_cavity(tmp_path):
    half = cases.finger_with_inlet() * Box(Pnt(-1, 0, -1), Pnt(40, 20, 20))
    path = cases.written(tmp_path, half)
    faces = {"symmetry_y": WithNormal("-y"), "fixed": WithNormal("-x"), "tip": WithNormal("+x")}
    (cavity,) = inspect_cad(path, faces=faces).cavities
    assert cavity.volume / mm**3 == pytest.approx((CLOSED + END * pi * 1.44) / 2, rel=1e-6)
    ((area, _),) = cavity.openings
    assert area / mm**2 == pytest.approx(pi * 1.44 / 2, rel=2e-3)
    part = read_cad(path, faces=faces)
    mesh = tg.mesh(part, size=4 * mm)
    assert tg.cavity_volume(at_rest(mesh)) == pytest.approx(2 * part.cavity_volume, rel=2e-4)
    assert [finding.code for finding in check_surface(mesh)] == ["D01"]


@pytest.mark.parametrize("case", ["finger with axial inlet", "tube with radial inlet in y", "cup and plate"])
def test_the_mesh_encloses_the_volume_of_the_cad(case, tmp_path):
    shape, volume, _, _ = CASES[case]
    part = read_cad(cases.written(tmp_path, shape()), faces={"fixed": WithNormal("-x"), "tip": WithNormal("+x")})
    mesh = tg.mesh(part, size=4 * mm)
    rest = at_rest(mesh)
    assert tg.cavity_volume(rest) == pytest.approx(part.cavity_volume, rel=2e-4)
    assert part.cavity_volume / mm**3 == pytest.approx(volume, rel=1e-6)
