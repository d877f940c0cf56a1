"""Places of supports: their nodes, their words, what is refused, and what else reads them."""

from dataclasses import replace

import numpy as np
import pytest
from lattice_cases import KINDS, lattice, refined

import turgor as tg
from refused import refused
from turgor.core.inp.write_inp import write_inp
from turgor.core.meshing.nodes.node_shares import node_shares
from turgor.core.meshing.surface import outer_triangles
from turgor.core.model.supports import Displacement, Fixed, NodesAt, Shift

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.05e6))


@pytest.mark.parametrize("kind", KINDS)
def test_a_place_has_the_nodes_that_it_says(kind: str) -> None:
    mesh = lattice((4, 2, 2), KINDS[kind])
    x, y, z = mesh.points.T
    box = NodesAt("half", box=((0.5, 2, -1), (1.0, -1, 2))).nodes(mesh)  # corners in any order
    assert np.array_equal(box, np.flatnonzero(x >= 0.5 - 1e-12))
    (corner,) = NodesAt("corner", near=(1.1, 1.05, 0.9)).nodes(mesh)
    assert np.allclose(mesh.points[corner], 1.0)
    rim = NodesAt("rim", edge=("middle", "patch")).nodes(mesh)
    assert np.array_equal(rim, np.flatnonzero((np.abs(x - 0.5) < 1e-9) & (y < 0.5 + 1e-9)))
    assert len(z) == len(mesh.points)


@pytest.mark.parametrize("kind", KINDS)
def test_a_place_follows_a_refined_mesh(kind: str) -> None:
    mesh = lattice((4, 2, 2), KINDS[kind])
    fine, place = refined(mesh, 1.0).mesh, NodesAt("rim", edge=("middle", "patch"))
    x, y, _ = fine.points.T
    assert np.array_equal(place.nodes(fine), np.flatnonzero((np.abs(x - 0.5) < 1e-9) & (y < 0.5 + 1e-9)))
    assert len(place.nodes(fine)) > len(place.nodes(mesh))


def test_middles_that_follow_are_no_nearest_node() -> None:
    mesh = replace(lattice((2, 2, 2), KINDS["hex"]), serendipity=True)
    (node,) = NodesAt("middle", near=(0.25, 0.25, 0.25)).nodes(mesh)
    assert node in mesh.carrying_cells


def test_films_without_a_solid_have_a_nearest_node() -> None:
    mesh = tg.mesh(tg.actuators.MiuraTube(rows=1).build(), size=20e-3)
    (node,) = NodesAt("crest", near=(0, 0, 1)).nodes(mesh)
    assert mesh.points[node] == pytest.approx((0, 0, mesh.points[:, 2].max()))


@pytest.mark.parametrize(
    ("given", "facts"),
    [
        ({}, ("'corner'", "none", "edge", "near", "box")),
        ({"edge": ("x0", "x1"), "near": (0, 0, 0)}, ("edge", "near", "box")),
        ({"edge": ("x0", "x0")}, ("edge", "x0", "x0")),
        ({"edge": "x0"}, ("edge", "x0")),
        ({"near": (0, 0)}, ("near", "(0, 0)")),
        ({"near": ("5 kPa", 0, 0)}, ("near", "kPa")),
        ({"box": ((0, 0, 0),)}, ("box", "((0, 0, 0),)")),
    ],
)
def test_other_places_are_refused(given: dict[str, object], facts: tuple[str, ...]) -> None:
    with refused(*facts):
        NodesAt("corner", **given)  # type: ignore[arg-type]


def test_a_place_without_nodes_says_where_the_mesh_is() -> None:
    mesh = lattice((2, 1, 1), KINDS["hex"])
    with refused("'far'", "(2000, 0, 0)", "(1000, 1000, 1000)"):
        tg.Model(mesh, RUBBER, [Fixed(NodesAt("far", box=((2, 0, 0), (3, 1, 1))))], [])
    with refused("face", "x3", "x0"):
        tg.Model(mesh, RUBBER, [Fixed(NodesAt("rim", edge=("x0", "x3")))], [])


def test_a_box_is_reported_summed_and_exported_as_a_face_is(tmp_path) -> None:
    mesh = lattice((2, 1, 1), KINDS["hex"])
    end = NodesAt("end", box=((0, 0, 0), (0, 1, 1)))
    fixed = [[Fixed("x0")], [Fixed(end)]]
    loads = [tg.loads.Force("x1", (100.0, 0, 0))]
    runs = [tg.solve(tg.Model(mesh, RUBBER, each, loads)) for each in fixed]
    reactions = [tg.measure(run, "reaction", mesh_error=False).column("reaction")[-1] for run in runs]
    assert reactions[1] == pytest.approx(100.0, rel=1e-6)
    assert reactions[1] == pytest.approx(reactions[0], rel=1e-9)
    assert fixed[1][0].text() == "end (the box from (0, 0, 0) to (0, 1000, 1000) mm) does not move in x, y, z."


def test_an_inp_file_holds_the_nodes_of_a_place(tmp_path) -> None:
    mesh = lattice((2, 1, 1), KINDS["hex"])
    end = NodesAt("end", box=((0, 0, 0), (0, 1, 1)))
    model = tg.Model(mesh, RUBBER, [Fixed(end, "xz")], [tg.Pressure("x1", 100.0)])
    write_inp(model, tmp_path / "box.inp", program="abaqus")
    rows = (tmp_path / "box.inp").read_text().split("*BOUNDARY")[1].split("*")[0].split("\n")
    written = np.intersect1d(mesh.face_nodes("x0"), mesh.cells[:, :20]) + 1
    assert [row for row in rows if row] == [f"{node}, {axis}" for node in written for axis in (1, 3)]


def test_an_inp_file_holds_the_force_on_a_place_and_on_a_face(tmp_path) -> None:
    mesh = lattice((2, 1, 1), KINDS["hex"])
    rows = {}
    for name, place in (("box", NodesAt("end", box=((1, 0, 0), (1, 1, 1)))), ("face", "x1")):
        model = tg.Model(mesh, RUBBER, [Fixed("x0")], [tg.loads.Force(place, (6.0, 0, 0))])
        write_inp(model, tmp_path / "force.inp", program="abaqus")
        text = (tmp_path / "force.inp").read_text().split("*CLOAD, AMPLITUDE=ramp\n")[1].split("*")[0]
        rows[name] = [row.split(", ") for row in text.splitlines()]
    assert rows["box"] == rows["face"]
    assert sum(float(value) for _, _, value in rows["box"]) == pytest.approx(6.0)
    by_node = {int(node) - 1: float(value) for node, axis, value in rows["box"] if axis == "1"}
    corners = [value for node, value in by_node.items() if node < mesh.vertex_count]
    assert corners == pytest.approx([-0.5] * 4)  # of a side with eight nodes, as CalculiX spreads a pressure
    assert len(by_node) == 8


def test_an_inp_file_holds_a_traction_on_the_part_that_is_modeled(tmp_path) -> None:
    mesh = lattice((2, 1, 1), KINDS["tet"])
    sides = outer_triangles(mesh)
    half = replace(mesh, faces={**mesh.faces, "symmetry_y": sides[(mesh.points[sides, 1] == 0).all(axis=1)]})
    for each in (mesh, half):
        write_inp(
            tg.Model(each, RUBBER, "x0", [tg.Traction("x1", (3.0, 0, 0))]), tmp_path / "pull.inp", program="abaqus"
        )
        text = (tmp_path / "pull.inp").read_text().split("*CLOAD, AMPLITUDE=ramp\n")[1].split("*")[0]
        assert sum(float(row.split(", ")[2]) for row in text.splitlines()) == pytest.approx(3.0)  # of an area of 1 m²


def test_an_inp_file_holds_rollers_as_equations(tmp_path) -> None:
    mesh = lattice((2, 1, 1), KINDS["hex"])
    rim = NodesAt("rim", box=((1, 0, 0), (1, 0, 1)))
    slopes = [tg.supports.Roller(rim, (3, 0, 4)), tg.supports.Roller(rim, (0, 1, 1))]
    write_inp(tg.Model(mesh, RUBBER, ["x0", *slopes], []), tmp_path / "slope.inp", program="abaqus")
    text = (tmp_path / "slope.inp").read_text()
    nodes = np.intersect1d(rim.nodes(mesh), mesh.cells[:, :20]) + 1
    rows = [f"{node}, 3, 1, {node}, 1, 0.75\n*EQUATION\n2\n{node}, 2, 1, {node}, 1, -0.75" for node in nodes]
    assert len(nodes) == 3 and all(row in text for row in rows)
    assert text.count("*EQUATION") == 2 * len(nodes)
    write_inp(tg.Model(mesh, RUBBER, ["x0", Fixed(rim, "x"), slopes[0]], []), tmp_path / "slope.inp", program="abaqus")
    text = (tmp_path / "slope.inp").read_text()
    assert "*EQUATION" not in text
    assert all(f"\n{node}, 3\n" in text for node in nodes)


def test_rollers_that_cannot_be() -> None:
    mesh = lattice((2, 1, 1), KINDS["hex"])
    bent = replace(mesh, points=mesh.points + np.outer(mesh.points[:, 1] ** 2, [0.1, 0, 0]))
    with refused("'x1'", "not plane", "Radial"):
        tg.Model(bent, RUBBER, ["x0", tg.supports.Roller("x1")], [])
    with refused("'rim'", "along"):
        tg.supports.Roller(NodesAt("rim", near=(0, 0, 0)))
    with refused("'x1'", "along", "zero"):
        tg.supports.Roller("x1", (0, 0, 0))
    slopes = [
        tg.supports.Roller("x1", (1, 1, 0)),
        tg.supports.Roller("x1", (1, -1, 0)),
        Displacement("x1", (0, 0, 1), "z"),
    ]
    with refused("moved", "Roller"):
        tg.solve(tg.Model(mesh, RUBBER, ["x0", *slopes], []))


def test_a_force_says_where_it_acts_and_a_later_stage_replaces_it() -> None:
    line = tg.loads.Force(NodesAt("line", box=((1, 0, 0), (1, 1, 0))), (0, 0, -1))
    assert (
        line.text()
        == "Force (0, 0, -1) N on line (the box from (1000, 0, 0) to (1000, 1000, 0) mm), fixed in direction."
    )
    assert (line.place, line.label, line.named_faces) == ("line", "Force(line)", ())
    mesh = lattice((2, 1, 1), KINDS["hex"])
    with refused("'far'", "(2000, 0, 0)", "(1000, 1000, 1000)"):
        tg.Model(mesh, RUBBER, "x0", [tg.loads.Force(NodesAt("far", box=((2, 0, 0), (3, 1, 1))), (1, 0, 0))])
    with refused("'line'", "reference point"):
        tg.Model(mesh, RUBBER, "x0", [tg.loads.Force(line.face, (1, 0, 0), follower=True)])
    stages = tg.Stages([tg.Stage("more", tg.Static(), loads=[tg.loads.Force(line.face, (0, 0, -2))])])
    solution = tg.solve(tg.Model(mesh, RUBBER, "x0", [line]), stages)
    assert solution.states[-1].nodal_force[mesh.face_nodes("x0"), 2].sum() == pytest.approx(2.0, rel=1e-5)


def test_scattered_nodes_bear_equal_shares() -> None:
    mesh = lattice((2, 2, 2), KINDS["tet"])
    corners = [int(np.linalg.norm(mesh.points - at, axis=1).argmin()) for at in ((0, 0, 0), (1, 1, 1))]
    shares = node_shares(mesh, np.array(corners))
    assert shares[corners].tolist() == [0.5, 0.5] and shares.sum() == pytest.approx(1)


def test_a_place_may_not_leave_its_mirror_plane() -> None:
    mesh = tg.mesh(tg.actuators.RectangularBender().build(), size=8e-3)
    rim = NodesAt("rim", edge=("tip", "symmetry_y"))
    with refused("'rim'", "symmetry_y", "along y"):
        tg.Model(mesh, RUBBER, [Fixed("fixed"), Displacement(rim, Shift((0, 1e-3, 0)))], [])
