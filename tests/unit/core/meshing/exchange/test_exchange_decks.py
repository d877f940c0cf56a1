"""Decks and meshes of others: what no solid cell needs is left out with a note, and a cavity is what encloses."""

import exchange_cases as cases
import numpy as np
import pytest

import deck_cases
import prints
import turgor as tg
from refused import refused
from turgor.core.geometry.cad.selectors import InBox, WithNormal
from turgor.core.meshing.exchange.formats.stl import stl_bytes
from turgor.core.meshing.exchange.read import read_mesh
from turgor.core.meshing.exchange.surface_filling import mesh_surfaces
from turgor.core.meshing.quality.checks import check_mesh
from turgor.job.output.lock import lock_text
from turgor.units import mm

POINTS, CELLS, _ = cases.hollow_cube()
SOLID = [*cases.inp_nodes(POINTS), *cases.inp_cells("C3D8", CELLS, elset="solid")]
LOW = cases.quads_at(CELLS, POINTS, 0, 0.0)
BEAM = ["*ELEMENT, TYPE=B31, ELSET=beams", "900, 1, 2"]
INNER = [(1, 10.0, 10), (1, 20.0, 10), (2, 10.0, 10), (2, 20.0, 10), (0, 10.0, 10), (0, 20.0, 10)]


def deck(folder, *lines):
    file = folder / "deck.inp"
    file.write_text("\n".join([*SOLID, *lines, ""]), encoding="utf-8")
    return file


def left_out(mesh):
    return " ".join(finding.message for finding in mesh.findings if finding.code == "G25")


def inner_sides(axis, position):
    """Numbers of the corners of the sides of the cavity in a plane."""
    return [quad for quad in cases.quads_at(CELLS, POINTS, axis, position) if (abs(POINTS[quad] - 15) < 6).all()]


def surface(name, quads):
    """A surface by node sets: as one set of the nodes of some sides."""
    nodes = sorted({int(node) + 1 for quad in quads for node in quad})
    return [f"*NSET, NSET={name}", ", ".join(map(str, nodes))]


@pytest.mark.parametrize(
    ("lines", "note"),
    [
        (["*NSET, NSET=some, GENERATE", "1, 4000000, 1"], "3999936 nodes of set 'some' that the file does not"),
        (["*NSET, NSET=b", "nothere"], "set 'nothere' in set 'b', which the file does not define"),
        ([*BEAM, "*ELSET, ELSET=everything", "solid, beams"], "cells of the types B31"),
        (
            [*BEAM, "*SURFACE, NAME=load", "beams, SPOS"],
            "surface 'load' of set 'beams', which has no cell that is read",
        ),
        (["*SURFACE, NAME=load", "solid, S9"], "surface 'load' 'S9' of solid cells"),
        (
            ["*NSET, NSET=edge", "1, 2, 3", "*NSET, NSET=corner", "1"],
            "Sets of nodes of 'deck.inp' without a whole side: 'corner', 'edge'",
        ),
    ],
)
def test_what_no_solid_needs_is_left_out_with_a_note(tmp_path, lines, note):
    mesh = read_mesh(deck(tmp_path, *lines))
    assert len(mesh.cells) == 26
    assert note in left_out(mesh)


def test_groups_of_edges_and_points_of_gmsh_are_noted(tmp_path):
    blocks = [(15, [np.array([0])], [7]), (1, [np.array([0, 1])], [8]), (5, CELLS, [1] * len(CELLS))]
    names = {(3, 1): "body", (0, 7): "corner", (1, 8): "edge"}
    (tmp_path / "cube.msh").write_text(cases.gmsh_2(POINTS, blocks, names))
    mesh = read_mesh(tmp_path / "cube.msh")
    assert "without a whole side: 'corner', 'edge'" in left_out(mesh)
    assert mesh.points[mesh.node_sets["corner"]] / mm == pytest.approx(POINTS[[0]])
    ends = POINTS[[0, 1]]
    assert sorted(mesh.points[mesh.node_sets["edge"]].sum(axis=1) / mm) == pytest.approx(
        sorted([*ends.sum(axis=1), ends.mean(axis=0).sum()])
    )


def test_surface_on_shells_names_the_sides_below_them(tmp_path):
    shells = cases.inp_cells("S4", LOW, first=500, elset="skin")
    mesh = read_mesh(deck(tmp_path, *shells, "*SURFACE, NAME=load", "skin, SNEG", "*ELSET, ELSET=all", "solid, skin"))
    assert len(mesh.faces["load"]) == 9
    assert left_out(mesh) == ""


def test_cells_at_one_place_are_taken_once(tmp_path):
    corners = np.array([[0.0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10]])
    lines = [*cases.inp_nodes(np.vstack([corners, corners])), *cases.inp_cells("C3D4", np.arange(8).reshape(2, 4))]
    (tmp_path / "two.inp").write_text("\n".join(lines))
    mesh = read_mesh(tmp_path / "two.inp")
    assert len(mesh.cells) == 1
    assert "1 cells written twice were taken once" in " ".join(result.message for result in mesh.findings)


def test_cells_that_do_not_fit_are_refused_in_words_for_a_file(tmp_path):
    corners = np.array([[0.0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10], [10, 10, 10]])
    ends = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
    points = np.vstack([corners, [(corners[a] + corners[b]) / 2 for a, b in ends]])
    more = [(4, 1), (1, 3), (3, 4), (4, 5), (1, 5), (3, 5)]  # a cell whose corner is the middle of the other's edge
    points = np.vstack([points, [(points[a] + points[b]) / 2 for a, b in more]])
    cells = np.array([[0, 1, 2, 3, 5, 6, 7, 8, 9, 10], [4, 1, 3, 5, *range(11, 17)]])
    (tmp_path / "part.vtk").write_bytes(cases.vtk_legacy(points, [(24, cells)]))
    with refused("part.vtk", 1, "(5, 0, 0) mm"):
        read_mesh(tmp_path / "part.vtk")


def test_open_face_called_cavity_is_none(tmp_path):
    mesh = read_mesh(deck(tmp_path, *surface("cavity_rim", LOW)))
    assert mesh.cavities == ("cavity",)
    assert len(mesh.faces["cavity_rim"]) == 9
    assert [finding.code for finding in check_mesh(mesh) if finding.code in ("G02", "G26")] == ["G26"]


def test_job_with_an_open_face_called_cavity(tmp_path):
    (tmp_path / "solid.vtk").write_bytes(cases.vtk_legacy(POINTS, [(12, CELLS[:1])]))
    assert read_mesh(tmp_path / "solid.vtk", faces={"cavity": WithNormal("-x")}).cavities == ()
    text = (
        '[mesh]\nfile = "solid.vtk"\nfaces = { cavity = { normal = "-x" }, fixed = { normal = "+x" } }\n'
        '[materials]\nbody = { law = "neo_hooke", C10 = "50 kPa", density = "1100 kg/m³" }\n[loads]\n'
    )
    (tmp_path / "job.toml").write_text(text + 'pressure = "1 kPa"\n')
    with refused("job.toml:7", "loads.pressure", "1 kPa", "cavity"):
        tg.jobs.read_job(tmp_path / "job.toml")
    (tmp_path / "job.toml").write_text(text + 'gravity = "-z"\n')
    assert "cavity_volume" not in tg.jobs.read_job(tmp_path / "job.toml").output.measures


def test_closed_inner_surface_of_another_name_is_a_cavity(tmp_path):
    inside = [quad for axis, position, _ in INNER for quad in inner_sides(axis, position)]
    mesh = read_mesh(deck(tmp_path, *surface("chamber", inside)))
    assert mesh.cavities == ("cavity",)
    assert len(mesh.faces["chamber"]) == len(mesh.faces["cavity"]) == 6
    (note,) = [finding.message for finding in mesh.findings if finding.code == "G22"]
    assert "became 'cavity' (1000 mm³), also 'chamber'" in note


def test_walls_of_one_void_are_one_cavity(tmp_path):
    low, high = inner_sides(2, 10.0), inner_sides(2, 20.0)
    one = read_mesh(deck(tmp_path, *surface("cavity_air", low)))
    assert one.cavities == ("cavity_air",)
    assert len(one.faces["cavity_air"]) == 6
    assert (
        "'cavity_air' (1 of 6 sides) is now all of the closed" in " ".join(str(each) for each in one.findings).lower()
    )
    two = read_mesh(deck(tmp_path, *surface("cavity_low", low), *surface("cavity_high", high)))
    assert two.cavities == ("cavity",)
    assert len(two.faces["cavity"]) == 6


def test_open_cavity_lies_on_its_surface(tmp_path):
    opened = CELLS[np.abs(POINTS[CELLS].mean(axis=1) - [25, 15, 15]).max(axis=1) > 1]  # a hole toward +x
    (tmp_path / "open.vtk").write_bytes(cases.vtk_legacy(POINTS, [(12, opened)]))
    box = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    triangles = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5]]
    triangles += [[2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]]
    for name, scale, shift in (("air", [20.0, 10, 10], 10.0), ("wide", [20.0, 12, 12], 9.0)):
        (tmp_path / f"{name}.stl").write_bytes(stl_bytes([10.0, shift, shift] + scale * box, np.array(triangles)))
    mesh = read_mesh(tmp_path / "open.vtk", cavities={"cavity": tmp_path / "air.stl"})
    assert mesh.cavities == ("cavity",)
    assert "it holds 2000 mm³, the surface 2000 mm³" in " ".join(str(each) for each in mesh.findings)
    assert [finding.code for finding in check_mesh(mesh) if finding.code in ("D01", "G02")] == ["D01"]
    with refused("'cavity'", "wide.stl", "1.41 mm"):
        read_mesh(tmp_path / "open.vtk", cavities={"cavity": tmp_path / "wide.stl"})


def test_lists_of_nodes_and_sides_name_faces(tmp_path):
    deck(tmp_path)
    nodes = np.unique(LOW) + 1
    (tmp_path / "fixed.txt").write_text("# nodes\n" + "\n".join(map(str, nodes)))
    (tmp_path / "sides.txt").write_text("\n".join(" ".join(map(str, row + 1)) for row in LOW[:4]))
    (tmp_path / "job.toml").write_text(
        '[mesh]\nfile = "deck.inp"\nunit = 0.001\n'
        f'faces = {{ fixed = {{ nodes = "fixed.txt" }}, some = {{ sides = "sides.txt" }}, tip = {{ normal = "+x" }},'
        f" same = {{ nodes = {nodes.tolist()} }} }}\n"
        '[materials]\nsolid = { law = "neo_hooke", C10 = "50 kPa" }\n[loads]\npressure = "1 kPa"\n'
    )
    job = tg.jobs.read_job(tmp_path / "job.toml")
    mesh = job.geometry().shape.mesh
    assert np.ptp(mesh.points[:, 0]) == pytest.approx(30 * mm)
    assert mesh.points[mesh.face_nodes("fixed"), 0].max() == 0
    assert [len(mesh.faces[name]) for name in ("fixed", "same", "some")] == [9, 9, 4]
    (tmp_path / "lock.toml").write_text(lock_text(job, {}))
    assert tg.jobs.read_job(tmp_path / "lock.toml") == job
    with refused("deck.inp", "node 65", "1 to 64"):
        read_mesh(tmp_path / "deck.inp", faces={"fixed": tg.files.ByNodes([65])})
    both = [tg.files.ByNodes(nodes.tolist()), InBox((-1, -1, -1), (1, 10 * mm, 1))]
    assert len(read_mesh(tmp_path / "deck.inp", faces={"fixed": both}).faces["fixed"]) == 3


@pytest.mark.parametrize("unit", [0.0, -1.0, True, float("nan"), "milli"])
def test_units_that_are_none(tmp_path, unit):
    with refused(f"{unit!r};", "m, cm, mm"):
        read_mesh(deck(tmp_path), unit=unit)


def test_stl_that_the_generator_cannot_fill_is_meshed_as_a_part(tmp_path):
    """It filled 23 % of this finger, without a word and without its cavity; other surfaces end it with SIGABRT."""
    mesh = mesh_surfaces(prints.finger().write(tmp_path / "finger.stl"))
    assert mesh.cavities == ("cavity",)
    inside = mesh.faces["cavity"][:, :3]
    a, b, c = (mesh.points[inside[:, i]] / mm for i in range(3))
    assert -np.einsum("fi,fi->", a, np.cross(b, c)) / 6 == pytest.approx(prints.finger().cavities[0], rel=0.02)
    assert [finding.code for finding in mesh.findings if finding.code == "G27"] == ["G27"]


def test_mid_side_node_off_its_mirror_plane_is_put_there(tmp_path):
    points, cells, _ = cases.hollow_cube(True)
    file = tmp_path / "half.vtk"
    file.write_bytes(cases.vtk_legacy(points, [(10, cells)]))
    plane = {"symmetry_y": WithNormal("-y")}
    whole = read_mesh(file, faces=plane)
    off = whole.points.copy() / mm
    nodes = whole.face_nodes("symmetry_y")
    off[nodes[nodes >= whole.vertex_count][:2], 1] += 0.05
    nodes_of_side = {int(node) for node in nodes}
    file.write_bytes(cases.vtk_legacy(off, [(24, whole.cells)]))
    mesh = read_mesh(file, faces={"symmetry_y": tg.files.ByNodes(sorted(nodes_of_side))})
    assert np.ptp(mesh.points[mesh.face_nodes("symmetry_y"), 1]) == 0
    (finding,) = [finding for finding in mesh.findings if finding.code == "G27"]
    assert "2 nodes of 'symmetry_y'" in finding.message
    off[nodes[0], 1] += 3.0
    file.write_bytes(cases.vtk_legacy(off, [(24, whole.cells)]))
    with refused("symmetry_y", "(0, 3, 0) mm", "3 mm", "y = 0 mm"):
        read_mesh(file, faces={"symmetry_y": tg.files.ByNodes(sorted(nodes_of_side))})


def test_a_set_with_a_side_and_other_nodes_is_a_face_and_a_node_set(tmp_path):
    mesh = deck_cases.NODES + deck_cases.CELLS + "*NSET, NSET=MIXED\n1,2,3,4,9\n"
    read = read_mesh(deck_cases.deck(tmp_path, mesh=mesh))
    assert "BOTTOM" not in read.node_sets
    assert len(read.face("MIXED")) == 1
    assert read.points[read.node_sets["MIXED"], 2].max() == pytest.approx(20 * mm)
    assert len(read.node_sets["MIXED"]) == 10  # nine nodes of the side, and a corner on the other end
