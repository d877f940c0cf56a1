"""Faces that a job moves: read, written back, solved as in Python, and refused where they cannot be moved."""

from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
from turgor.core.model.supports import Displacement, Fixed, Shift
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.units import mm

JOB = """
[actuator]
type = "extending_cylinder"
length = "20 mm"
cap = "3 mm"

[mesh]
cells = "axisymmetric"
size = "3 mm"
wall_cells = 1

[materials]
body = {{ law = "neo_hooke", C10 = "0.12 MPa" }}

[supports]
fixed = "xyz"
{support}

[output]
measures = ["tip_displacement_x", "reaction"]
"""


def written(folder: Path, support: str) -> Path:
    file = folder / "pulled.toml"
    file.write_text(JOB.format(support=support), encoding="utf-8")
    return file


def test_a_moved_face_is_read_and_written_back(tmp_path: Path) -> None:
    job = read_job(written(tmp_path, 'tip = { displacement = ["5 mm", 0, 0], directions = "x" }'))
    assert job.supports == (Fixed("fixed"), Displacement("tip", Shift((5e-3, 0.0, 0.0)), "x"))
    assert job.loads == ()
    again = tmp_path / "again.toml"
    again.write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(again).supports == job.supports


def test_a_move_with_a_history_is_read_and_written_back(tmp_path: Path) -> None:
    stated = 'tip = { displacement = ["5 mm", 0, 0], directions = "x", history = [[0, 0], [0.5, 1], [1, 0.2]] }'
    job = read_job(written(tmp_path, stated))
    (moved,) = (each for each in job.supports if each.place == "tip")
    assert isinstance(moved, Displacement)
    assert moved.displacement(np.zeros((1, 3)), 0.75)[0] == pytest.approx((0.6 * 5e-3, 0, 0))
    (tmp_path / "job.lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(tmp_path / "job.lock.toml").supports == job.supports


def test_a_pulled_tube_answers_as_in_python(tmp_path: Path) -> None:
    outcome = tg.jobs.run_job(
        read_job(written(tmp_path, 'tip = { displacement = ["5 mm", 0, 0] }'), {"output.mesh_error": False}),
        tmp_path / "out",
    )
    mesh = tg.mesh(
        ExtendingCylinder(length=20 * mm, cap=3 * mm).build(), size=3 * mm, wall_cells=1, cells="axisymmetric"
    )
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))
    supports = [Fixed("fixed"), Displacement("tip", (5 * mm, 0, 0))]
    solution = tg.solve(tg.Model(mesh, rubber, supports, []), tg.Static())
    here = tg.measure(solution, tg.measures.reaction, mesh_error=False)
    assert outcome.response.column("tip_displacement_x")[-1] == pytest.approx(5e-3, rel=1e-9)
    assert outcome.response.column("reaction")[-1] == pytest.approx(here.column("reaction")[-1], rel=1e-6)
    assert here.column("reaction")[-1] > 5.0


@pytest.mark.parametrize(
    ("support", "facts"),
    [
        ('tip = { displacment = [0, 0, "5 mm"] }', ("supports.tip.displacment", "displacement")),
        ('tip = { displacement = ["5 mm", 0] }', ("supports.tip.displacement",)),
        ('tip = { displacement = ["5 kPa", 0, 0] }', ("supports.tip.displacement", "kPa")),
        ('tip = { displacement = ["5 mm", 0, 0], directions = "yz" }', ("supports.tip.directions", "x", "yz")),
        ('tip = { displacement = ["5 mm", 0, 0], directions = "w" }', ("supports.tip", "'w'")),
        ('tip = { displacement = ["5 mm", 0, 0], history = [[0, 1], [1, 1]] }', ("supports.tip.history", "(0, 0)")),
        ('tip = { history = [[0, 0], [1, 1]], directions = "x" }', ("supports.tip.history",)),
        ("tip = 5", ("supports.tip", "5", "displacement")),
        ('tpi = { displacement = ["5 mm", 0, 0] }', ("supports.tpi", "'tip'")),
    ],
)
def test_moves_that_cannot_be(tmp_path: Path, support: str, facts: tuple[str, ...]) -> None:
    with refused(*facts):
        read_job(written(tmp_path, support))


def test_a_face_does_not_leave_the_mirror_plane_that_it_meets() -> None:
    mesh = tg.mesh(tg.actuators.RectangularBender().build(), size=6 * mm)
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))
    with refused("'tip'", "2 mm", "'symmetry_y'", "y"):
        tg.Model(mesh, rubber, [Fixed("fixed"), Displacement("tip", (0, 2 * mm, 0))], [])
    model = tg.Model(mesh, rubber, [Fixed("fixed"), Displacement("tip", (0, 0, 2 * mm))], [])
    assert np.isclose(model.supports[1].shift[2], 2e-3)
