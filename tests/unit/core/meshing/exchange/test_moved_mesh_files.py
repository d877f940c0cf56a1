"""Mesh files that are turned, moved and halved in a job, and what is refused."""

from pathlib import Path

import exchange_cases as cases
import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.meshing.bodies.half import half_of
from turgor.core.meshing.exchange.read import read_mesh
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.units import mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.05e6))


def bar_file(folder: Path, low: tuple[float, ...] = (0.0, -10.0, 0.0), across: int = 4) -> Path:
    points, cells = cases.grid((4, across, 2), low, 5.0)
    ends = {name: np.flatnonzero(points[:, 0] == at) + 1 for name, at in (("left", low[0]), ("right", low[0] + 20))}
    edge = np.flatnonzero((points[:, 0] == low[0] + 20) & (points[:, 2] == points[:, 2].max())) + 1
    sets = {**ends, "edge": edge}
    lines = [f"*NSET, NSET={name}\n" + "\n".join(map(str, nodes)) for name, nodes in sets.items()]
    file = folder / "bar.inp"
    file.write_text(
        "\n".join([*cases.inp_nodes(points), *cases.inp_cells("C3D8", cells), *lines, ""]), encoding="utf-8"
    )
    return file


def test_a_half_answers_as_the_whole_does(tmp_path: Path) -> None:
    whole = read_mesh(bar_file(tmp_path))
    half = half_of(whole, "y")
    assert half.points[:, 1].min() == 0 and len(half.cells) == len(whole.cells) // 2
    assert half.symmetry_faces == ("symmetry_y",) and set(half.faces) == {*whole.faces, "symmetry_y"}
    assert len(half.faces["outside"]) == (len(whole.faces["outside"])) // 2
    assert half.points[half.node_sets["edge"], 1].min() == 0
    ends = []
    for mesh in (whole, half):
        model = tg.Model(mesh, RUBBER, ["left"], [tg.loads.Force("edge", (0, 0, -0.02))])
        solution = tg.solve(model)
        force = tg.measure(solution, "reaction", mesh_error=False).column("reaction")[-1]
        ends.append((force, solution.states[-1].displacement[mesh.face_nodes("right"), 2].min()))
    assert ends[0][0] == pytest.approx(0.02, rel=1e-5)
    assert ends[1] == pytest.approx(ends[0], rel=1e-5)


def test_hexahedra_are_not_cut(tmp_path: Path) -> None:
    with refused("mirror plane y = 0", "8 of 24 cells", "hexahedra", "tetrahedra"):
        half_of(read_mesh(bar_file(tmp_path, low=(0.0, -7.5, 0.0), across=3)), "y")
    with refused("'w'", "x, y, z"):
        half_of(read_mesh(bar_file(tmp_path)), "w")


JOB = """
[mesh]
file = "bar.inp"
{keys}

[materials]
body = {{ law = "neo_hooke", C10 = "0.12 MPa" }}

[supports]
left = "xyz"

[loads]
edge = {{ force = [0, 0, "-20 mN"] }}
"""


def job_with(folder: Path, keys: str) -> Path:
    file = folder / "job.toml"
    file.write_text(JOB.format(keys=keys), encoding="utf-8")
    return file


def test_a_job_moves_turns_and_halves_its_mesh(tmp_path: Path) -> None:
    bar_file(tmp_path, low=(10.0, 2.0, 0.0))
    keys = 'turn = { z = "90 deg" }\nmove = ["12 mm", "-10 mm", 0]\nmirror = ["x"]'
    job = read_job(job_with(tmp_path, keys))
    assert set(job.geometry().faces) == {"left", "right", "outside", "symmetry_x"}
    low, high = job.geometry().bounds
    assert np.array([low, high]) / mm == pytest.approx(np.array([[0, 0, 0], [10, 20, 10]]), abs=1e-9)
    lock = tmp_path / "lock.toml"
    lock.write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(lock).actuator == job.actuator


@pytest.mark.parametrize(
    ("keys", "facts"),
    [
        ('mirror = ["x"]', ("mirror plane x = 0", "0 to 20 mm", "move")),
        ('mirror = ["w"]', ("'w'", "x, y, z")),
        ('move = [0, "2 mm", 0]\nmirror = ["y"]', ("mirror plane y = 0", "-8", "12 mm")),
        ('turn = { w = "90 deg" }', ("'w'", "x, y, z")),
        ('turn = { x = "90 deg", y = "90 deg" }', ("x and y", "one axis")),
        ('turn = { z = "90" }', ("actuator.turn.z", "'90 deg'")),
        ('mirrors = ["x"]', ("mirrors", "'mirror'")),
    ],
)
def test_moves_that_cannot_be(tmp_path: Path, keys: str, facts: tuple[str, ...]) -> None:
    bar_file(tmp_path)
    with refused(*facts):
        read_job(job_with(tmp_path, keys)).geometry()
