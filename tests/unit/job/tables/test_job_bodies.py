"""Several bodies in one job file: copies, names of keys, plates, rigid bodies, and what is refused."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.solvers.checks.supports import free_motions
from turgor.job.job import Job
from turgor.job.meshes import mesh_of
from turgor.job.output.lock import lock_text
from turgor.job.prepare import model_of, prepare
from turgor.job.read import read_job
from turgor.job.text.problems import JobError
from turgor.units import kPa, mm

ARM = """
[bodies.segment]
type = "rectangular_bender"
length = "20 mm"
copies = 2
step = ["21 mm", 0, 0]
on = "tip"
size = "10 mm"

[bodies.load]
type = "block"
length = "8 mm"
width = "20 mm"
height = "8 mm"
mirrors = "y"
mass = "30 g"
size = "10 mm"
origin = ["10 mm", 0, "-20 mm"]

[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa", density = "1000 kg/m³" }
base_segment_2 = { law = "neo_hooke", C10 = "0.3 MPa", density = "1000 kg/m³" }

[materials.segment]
base = { law = "neo_hooke", C10 = "0.2 MPa", density = "1000 kg/m³" }

[loads]
gravity = "-z"

[loads.segment]
pressure = "2 kPa"

[loads.segment_2]
pressure = "3 kPa"
history = [[0, 0], [1, 1]]

[procedure]
type = "stabilized"
"""
BALLS = """
[bodies.ball]
type = "ball"
radius = "4 mm"
size = "8 mm"
copies = 3
around = "z"
origin = ["10 mm", 0, 0]

[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa" }

[loads.ball_2.outside]
force = [0, 0, "1 N"]
"""


def _read(folder: Path, text: str, **changes: Any) -> Job:
    file = folder / "bodies.toml"
    file.write_text(text, encoding="utf-8")
    return read_job(file, changes)


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> Job:
    return _read(tmp_path_factory.mktemp("arm"), ARM)


def test_a_key_of_one_body_comes_before_that_of_its_copies_and_of_all(arm: Job) -> None:
    assert {load.face: load.pressure for load in arm.loads if isinstance(load, tg.Pressure)} == {
        "cavity_segment_1": 2 * kPa, "cavity_segment_2": 3 * kPa,
    }  # fmt: skip
    moduli = {name: each.law.C10 for name, each in arm.materials.items() if name != "body_load"}  # type: ignore[union-attr]
    assert moduli == {
        "body_segment_1": 0.1e6, "body_segment_2": 0.1e6, "base_segment_1": 0.2e6, "base_segment_2": 0.3e6,
    }  # fmt: skip


def test_the_first_segment_is_fixed_and_a_plate_joins_the_next_one(arm: Job) -> None:
    assert arm.supports == (tg.Fixed("fixed_segment_1"),)
    assert {name: rig.point.face for name, rig in arm.points.items()} == {
        "load": "surface_load", "plate_segment_2": "joint_segment_2",
    }  # fmt: skip
    mesh = mesh_of(arm, arm.geometry())
    joint, ends = mesh.face_nodes("joint_segment_2"), ("tip_segment_1", "fixed_segment_2")
    assert set(joint) == {node for face in ends for node in mesh.face_nodes(face)}
    assert free_motions(model_of(arm, mesh)) == 3  # the block, along x and z and about y: half of it is modeled


def test_a_rigid_body_has_its_mass_also_where_a_mirror_plane_cuts_it(arm: Job) -> None:
    model = model_of(arm, mesh_of(arm, arm.geometry()))
    others = {name: tg.Material(name="light", law=NeoHooke(C10=1.0), density=1e-9) for name in model.mesh.regions}
    alone = tg.Model(
        model.mesh, materials=others | {"body_load": arm.materials["body_load"]}, supports=model.supports, loads=[]
    )
    assert tg.measures.total_mass(alone) == pytest.approx(0.030, rel=1e-6)


def test_a_lock_file_repeats_the_bodies(arm: Job, tmp_path: Path) -> None:
    again = _read(tmp_path, lock_text(arm, {}))
    assert again.actuator == arm.actuator
    assert (again.loads, again.supports, again.points) == (arm.loads, arm.supports, arm.points)
    assert {n: m.law for n, m in again.materials.items()} == {n: m.law for n, m in arm.materials.items()}  # type: ignore[union-attr]


def test_copies_stand_around_an_axis(tmp_path: Path) -> None:
    job = _read(tmp_path, BALLS, **{"supports": {"outside_ball_1": "xyz"}})
    mesh = job.geometry().shape.mesh
    for number, angle in enumerate(2 * np.pi * np.arange(3) / 3, start=1):
        points = mesh.points[mesh.face_nodes(f"outside_ball_{number}")]
        middle = (points.min(axis=0) + points.max(axis=0)) / 2
        assert middle == pytest.approx([10 * mm * np.cos(angle), 10 * mm * np.sin(angle), 0], abs=0.5 * mm)
    assert [load.place for load in job.loads] == ["outside_ball_2"]


@pytest.mark.parametrize(
    ("changes", "facts"),
    [
        ({"bodies.ball.copies": 0}, ("bodies.ball.copies", "1 to 100")),
        ({"bodies.ball.around": "w"}, ("bodies.ball", "'w'", "x, y, z")),
        ({"bodies.ball.orgin": [0, 0, 0]}, ("bodies.ball.orgin", "origin")),
        ({"bodies.ball.type": "bal"}, ("bodies.ball.type", "ball")),
        ({"bodies.other.like": "bell"}, ("bodies.other.like", "ball")),
        ({"bodies.ball.around": "z", "bodies.ball.step": ["1 mm", 0, 0]}, ("bodies.ball.copies", "around", "step")),
        ({"bodies.ball.on": "ball_1.tip"}, ("bodies", "tip", "outside")),
        ({"bodies.ball.origin": ["1 mm", 0, 0]}, ("bodies:", "ball_1", "ball_2", "overlap")),
        ({"actuator.type": "fast_pneunet"}, ("actuator", "[bodies.NAME]")),
        ({"loads.ball_4.pressure": "1 kPa"}, ("loads.ball_4", "'ball_3'", "outside_ball_1")),
        ({"loads.ball_4.force": [0, 0, "1 N"]}, ("loads.ball_4", "'ball_3'")),
        ({"loads.ball_1.outsid.force": [0, 0, "1 N"]}, ("loads.ball_1.outsid", "no face", "'outside'")),
        ({"loads.ball.force": [0, 0, "1 N"]}, ("loads.ball.force", "acts on a face", "[loads.ball.outside]")),
        ({"loads.ball_1.pressure": "1 kPa"}, ("loads.ball_1.pressure", "no cavity", "[loads.ball_1.outside]")),
        ({"supports.ball.tip": "xyz"}, ("supports.ball.tip", "no face 'tip'", "outside")),
        ({"supports.ball_1": "xyz"}, ("supports.ball_1", "supports.ball_1.outside")),
        ({"materials.bell.body.law": "neo_hooke"}, ("materials.bell", "'ball'")),
        ({"materials.ball.bdy.law": "neo_hooke"}, ("materials.ball.bdy", "no region 'bdy'", "'body'")),
        ({"bodies.gravity.like": "ball"}, ("bodies.gravity", "a key of [loads]")),
        (
            {"bodies.ball.around": None, "bodies.ball.copies": 1, "bodies.ball.on": "tip"},
            ("bodies.ball.on", "'palm.tip'"),
        ),
        ({"bodies.ball.on": "ball_1.body"}, ("bodies", "'ball_1'", "Known: outside")),
        ({"mesh.face_sizes": {"outside_bell": "2 mm"}}, ("outside_bell", "outside_ball")),
        ({"bodies.ball.mass": "-1 g"}, ("bodies.ball.mass",)),
        ({"bodies.ball.size": "0 mm"}, ("bodies.ball.size", "0 mm", "more than 0")),
        ({"bodies.ball.mass": "1 g", "bodies.ball.on": "ball_2.outside"}, ("bodies.ball.on", "joint_NAME")),
    ],
)
def test_what_cannot_be_is_refused(changes: dict[str, Any], facts: tuple[str, ...], tmp_path: Path) -> None:
    with refused(*facts, error=JobError):
        _read(tmp_path, BALLS, **changes)


def test_a_half_that_is_turned_needs_the_whole(tmp_path: Path) -> None:
    turned = {"bodies.segment.rotation": [0, 0, "30 deg"]}
    with refused("segment_1", "symmetric = false", error=JobError):
        _read(tmp_path, ARM, **turned)


def test_a_loose_soft_body_is_checked_like_a_rigid_one(tmp_path: Path) -> None:
    job = _read(tmp_path, BALLS, **{"procedure.type": "stabilized", "output.mesh_error": False})
    model, _ = prepare(job)
    assert free_motions(model) == 18


def test_the_job_of_the_guide_on_grasping_is_read(tmp_path: Path) -> None:
    guide = (Path(__file__).parents[4] / "docs" / "howto" / "grasping.md").read_text(encoding="utf-8")
    job = _read(tmp_path, guide.split("```toml\n")[1].split("```")[0])
    pressures = {load.face: load.pressure for load in job.loads if isinstance(load, tg.Pressure)}
    assert pressures == {"cavity_finger_1": 25 * kPa, "cavity_finger_2": 20 * kPa, "cavity_finger_3": 25 * kPa}
