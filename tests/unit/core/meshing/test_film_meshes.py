"""Meshes of films without a solid: names, normals, cavities, mirror planes; what a model of them refuses."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.engine.contact.closest import points_of
from turgor.core.engine.contact.films import film_surface
from turgor.core.engine.contact.surface import of_face
from turgor.core.engine.faces.membranes import surface_frames
from turgor.core.meshing.openings import check_openings, find_rims
from turgor.core.meshing.surface import corner_keys, rim_edges
from turgor.core.model.fibers import Winding
from turgor.core.solvers.checks.membranes import bears_compression
from turgor.units import GPa, kPa, mm

FILM = tg.Membrane(tg.Material(name="PET", law=tg.laws.Hooke(E=4 * GPa, nu=0.35)), 0.05 * mm, compression=0)


@pytest.fixture(scope="module")
def pouch():
    return tg.mesh(tg.actuators.Pouch(), size=10 * mm)


def test_a_pouch_has_films_seams_and_mirror_planes(pouch):
    assert (len(pouch.cells), len(pouch.regions), pouch.cavities) == (0, 0, ("cavity",))
    assert dict(zip(pouch.symmetry_faces, pouch.mirror_planes, strict=True)) == {
        "symmetry_y": (1, 0.0),
        "symmetry_z": (2, 0.0),
    }
    assert len(pouch.film_sides) == len(pouch.face("film")) + len(pouch.face("seams")) == 35
    assert "nine-node quadrilaterals" in repr(pouch)
    assert np.isclose(pouch.points[pouch.face_nodes("tip"), 0].max(), 55 * mm)


def test_a_row_of_pouches_shares_its_seams():
    mesh = tg.mesh(tg.actuators.Pouch(length=20 * mm, width=10 * mm, seam=4 * mm, count=3), size=5 * mm)
    films, seams = (surface_frames(mesh.points, mesh.face(name)).areas.sum() for name in ("film", "seams"))
    assert (films, seams) == pytest.approx((3 * 20 * 5 * mm**2, 4 * 4 * 5 * mm**2))
    ends = [mesh.points[mesh.face_nodes(name), 0] for name in ("fixed", "tip")]
    assert (ends[0].max(), ends[1].min(), ends[1].max()) == pytest.approx((0, 68 * mm, 72 * mm))
    with refused("count is 0", "1 to 100"):
        tg.actuators.Pouch(count=0)


def test_a_cavity_above_which_the_film_rises_grows(pouch):
    """Normals point into the cavity."""
    lifted = np.zeros_like(pouch.points)
    nodes = np.setdiff1d(pouch.face_nodes("cavity"), pouch.face_nodes("symmetry_z"))
    lifted[nodes, 2] = 1 * mm
    assert 0.7 < cavity_volume(pouch, "cavity", lifted) / (2 * mm * 50 * mm * 100 * mm) < 1


def test_an_arc_lies_on_its_circle():
    half = np.sqrt(0.5) * 10 * mm
    patch = tg.bodies.Patch(
        corners=((5 * mm, 0, 0), (half / 2, half / 2, 0), (half, half, 0), (10 * mm, 0, 0)),
        faces=("cavity",),
        edges=("", "", "symmetry_z", ""),
        arcs=(None, None, (0, 0, 0), None),
    )
    part = tg.bodies.Film(patches=(patch,))
    mesh = tg.mesh(part, size=2 * mm)
    rim = np.linalg.norm(mesh.points[mesh.face_nodes("symmetry_z")], axis=1)
    assert rim == pytest.approx(10 * mm) and len(rim) == 9
    with refused("mesh size", "0.001 mm", "400 sides", "7.071 mm"):
        tg.mesh(part, size=0.001 * mm)


def test_a_beam_is_round_and_open_at_its_clamp_only():
    beam = tg.actuators.InflatableBeam(length=200 * mm, radius=40 * mm)
    mesh = tg.mesh(beam, size=20 * mm)
    for name, area in (("film", np.pi * 40 * 200), ("tip", np.pi * 40**2 / 2)):
        areas = surface_frames(mesh.points, mesh.face(name)).areas
        assert areas.sum() == pytest.approx(area * mm**2, rel=1e-3)
    still = np.zeros_like(mesh.points)
    assert cavity_volume(mesh, "cavity", still) == pytest.approx(2 * beam.cavity_volumes["cavity"], rel=1e-3)
    rims = find_rims(mesh, rim_edges(mesh.face("cavity")))
    assert [(rim.is_opening, rim.center[0]) for rim in rims] == [(True, 0.0)]
    (finding,) = check_openings(mesh, mesh.film_sides, {"cavity": rim_edges(mesh.face("cavity"))})
    assert (finding.code, finding.severity) == ("D01", tg.solutions.Severity.NOTE)


def test_a_plate_that_moves_rigidly_is_not_compressed():
    mesh = tg.mesh(tg.actuators.InflatableBeam(length=100 * mm, radius=40 * mm), size=40 * mm)
    plate = tg.Membrane(tg.Material(name="plate", law=tg.laws.Hooke(E=4 * GPa, nu=0.35)), 2 * mm)
    rim = tg.supports.ReferencePoint("rim", "tip")
    assert bears_compression(tg.Model(mesh, {"film": FILM, "tip": plate}, ["fixed", rim], [])) == []
    assert bears_compression(tg.Model(mesh, {"film": FILM, "tip": plate}, ["fixed"], [])) == ["tip"]


def test_patches_on_each_other_are_joined_at_their_edges_but_in_a_mirror_plane():
    corners, edges = ((0, 0, 0), (0, 10 * mm, 0), (10 * mm, 10 * mm, 0), (10 * mm, 0, 0)), ("", "symmetry_y", "", "")
    lower = tg.bodies.Patch(corners=corners[::-1], faces=("lower",), edges=edges)
    upper = tg.bodies.Patch(corners=corners, faces=("upper",), edges=edges)
    pouch = tg.bodies.Film(patches=(lower, upper))
    mesh = tg.mesh(pouch, size=5 * mm)
    shared = np.intersect1d(mesh.face_nodes("lower"), mesh.face_nodes("upper"))
    assert (len(mesh.film_sides), len(mesh.points), len(shared)) == (8, 2 * 25 - 13, 13)
    assert len(np.unique(corner_keys(mesh.film_sides, len(mesh.points)))) == 8  # two of them share three corners
    with refused("patches 1 and 2", "'upper'", "one film", "size smaller"):
        tg.mesh(pouch, size=10 * mm)


def test_a_film_meets_an_obstacle_with_the_side_that_looks_out_of_its_cavity(pouch):
    sheets = {"film": FILM, "seams": FILM}
    model = tg.Model(pouch, sheets, ["fixed"], [tg.Pressure("cavity", 1 * kPa)])
    surface = film_surface(model, pouch.points * 1e3, 1 * GPa)
    out, cavity = surface.outward, of_face(pouch, surface, "cavity")
    assert out.sum() == (~out).sum() == len(pouch.film_sides)
    normal = points_of(pouch.points * 1e3, surface.sides, surface.N, surface.dN)[1]
    assert (normal[out & cavity, :, 2] > 0.99).all() and (normal[~out & cavity, :, 2] < -0.99).all()
    stiff = surface.spring * surface.height**2  # half of what the film has in its plane, 4 GPa · 50 µm
    assert stiff == pytest.approx(0.5 * 4 * 0.05)


def test_what_films_do_not_have_is_refused(pouch):
    with refused("pouch", "10 of its 35 sides", "no sheet", "seams"):
        tg.Model(pouch, {"film": FILM}, ["fixed"], [])
    sheets = {"film": FILM, "seams": FILM}
    thread, along = FILM.material, Winding(angle_from_axis=0.0, spacing=2 * mm)
    wound = tg.Fibers(face="film", material=thread, diameter=0.1 * mm, form="smeared", winding=along)
    with refused("pouch", "threads", "woven"):
        tg.Model(pouch, sheets, ["fixed"], [], reinforcements=[wound])
