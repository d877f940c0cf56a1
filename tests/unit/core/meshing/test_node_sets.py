"""Node sets of mesh files: named in supports and forces, refined, saved, written in jobs, and refused elsewhere."""

from dataclasses import replace
from pathlib import Path

import exchange_cases as cases
import numpy as np
import pytest
from lattice_cases import KINDS, lattice, refined

import turgor as tg
from refused import refused
from turgor.core.meshing.bodies.combine import together
from turgor.core.meshing.exchange.read import read_mesh
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.places import NodesAt
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.05e6))
POINTS, CELLS, _ = cases.hollow_cube()


def with_sets(mesh: Mesh) -> Mesh:
    x, y, z = mesh.points.T
    sets = {"rim": np.flatnonzero((x == 1) & (z == 1)), "corner": np.flatnonzero((x == 1) & (y == 1) & (z == 1))}
    return replace(mesh, node_sets=sets)


@pytest.mark.parametrize("kind", KINDS)
def test_a_node_set_follows_a_refined_mesh(kind: str) -> None:
    mesh = with_sets(lattice((2, 2, 2), KINDS[kind]))
    fine = refined(mesh, 1.0).mesh
    x, _, z = fine.points.T
    assert np.array_equal(fine.node_sets["rim"], np.flatnonzero((abs(x - 1) < 1e-9) & (abs(z - 1) < 1e-9)))
    assert len(fine.node_sets["rim"]) > len(mesh.node_sets["rim"])
    assert fine.points[fine.node_sets["corner"]].tolist() == [[1, 1, 1]]


def test_supports_and_forces_take_its_name() -> None:
    mesh = with_sets(lattice((2, 1, 1), KINDS["hex"]))
    places = [NodesAt("rim", node_set="rim"), NodesAt("rim", box=((1, 0, 1), (1, 1, 1)))]
    named = tg.Model(mesh, RUBBER, ["x0", tg.Fixed("rim", "y")], [tg.loads.Force("rim", (5.0, 0, 0))])
    assert named.supports[1].face == places[0]
    assert named.loads[0].text() == "Force (5, 0, 0) N on rim (the nodes of the set 'rim'), fixed in direction."
    models = [named, tg.Model(mesh, RUBBER, ["x0", tg.Fixed(places[1], "y")], [tg.loads.Force(places[1], (5.0, 0, 0))])]
    ends = [tg.solve(model).states[-1].displacement for model in models]
    assert ends[0] == pytest.approx(ends[1], abs=1e-12)
    assert np.abs(ends[0]).max() > 1e-6


def test_a_node_set_is_saved_and_combined(tmp_path: Path) -> None:
    mesh = with_sets(lattice((2, 1, 1), KINDS["tet"]))
    model = tg.Model(mesh, RUBBER, ["x0"], [tg.loads.Force("corner", (1.0, 0, 0))])
    model.save(tmp_path / "model.turgor")
    again = tg.Model.load(tmp_path / "model.turgor")
    assert again.mesh.node_sets["rim"].tolist() == mesh.node_sets["rim"].tolist()
    assert again.loads == model.loads
    pair = together({"a": mesh, "b": replace(mesh, points=mesh.points + np.array([3.0, 0, 0]))})
    assert pair.points[pair.node_sets["corner_a"]].tolist() == [[1, 1, 1]]
    assert pair.points[pair.node_sets["corner_b"]].tolist() == [[4, 1, 1]]


def test_what_needs_a_face_says_so() -> None:
    mesh = with_sets(lattice((2, 1, 1), KINDS["hex"]))
    with refused("'rim'", "set", "face"):
        tg.Model(mesh, RUBBER, ["x0"], [tg.Pressure("rim", 1e3)])
    with refused("'rimm'", "node set", "'rim'"):
        tg.Model(mesh, RUBBER, [tg.Fixed(NodesAt("edge", node_set="rimm"))], [])


JOB = """
[mesh]
file = "cube.inp"

[materials]
body = {{ law = "neo_hooke", C10 = "0.12 MPa" }}

[supports]
low = "xyz"
{support}

[loads]
{load}
"""


def job_file(folder: Path, support: str, load: str) -> Path:
    low = sorted({int(node) + 1 for quad in cases.quads_at(CELLS, POINTS, 0, 0.0) for node in quad})
    edge = np.flatnonzero((POINTS[:, 0] == POINTS[:, 0].max()) & (POINTS[:, 2] == POINTS[:, 2].max())) + 1
    sets = [f"*NSET, NSET=low\n{', '.join(map(str, low))}", f"*NSET, NSET=rim\n{', '.join(map(str, edge))}"]
    lines = [*cases.inp_nodes(POINTS), *cases.inp_cells("C3D8", CELLS), *sets, ""]
    (folder / "cube.inp").write_text("\n".join(lines), encoding="utf-8")
    file = folder / "job.toml"
    file.write_text(JOB.format(support=support, load=load), encoding="utf-8")
    return file


def test_a_job_names_the_sets_of_its_mesh_file(tmp_path: Path) -> None:
    load = 'rim = { force = ["1 N", 0, 0] }\nagain = { node_set = "rim", hangs = "10 g" }'
    file = job_file(tmp_path, 'rim = "y"', load)
    job = read_job(file)
    rim = NodesAt("rim", node_set="rim")
    assert job.supports[1] == tg.Fixed(rim, "y")
    assert [each.face for each in job.loads] == [rim, NodesAt("again", node_set="rim")]
    mesh = read_mesh(tmp_path / "cube.inp")
    assert len(mesh.node_sets["rim"]) == 7  # four corners and three middles, which the file lacks
    lock = tmp_path / "lock.toml"
    lock.write_text(lock_text(job, {}), encoding="utf-8")
    again = read_job(lock)
    assert (again.supports, again.loads) == (job.supports, job.loads)


@pytest.mark.parametrize(
    ("support", "load", "facts"),
    [
        ('rimm = "y"', "", ("supports.rimm", "'rim'")),
        ("", 'rimm = { force = ["1 N", 0, 0] }', ("loads.rimm", "'rim'")),
        ("", 'pull = { node_set = "rimm", force = ["1 N", 0, 0] }', ("loads.pull.node_set", "'rim'")),
    ],
)
def test_jobs_with_other_names_are_refused(tmp_path: Path, support: str, load: str, facts: tuple[str, ...]) -> None:
    with refused(*facts):
        read_job(job_file(tmp_path, support, load or 'rim = { force = ["1 N", 0, 0] }'))
