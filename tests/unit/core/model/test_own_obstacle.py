"""Shapes of one's own: one file serves Python, job files, contact, checks, wedges, pictures and reports."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import turgor as tg
import turgor.core.model.obstacles
from class_queries import files_that_query
from refused import refused
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Box, Obstacle, RigidShape, RigidSurface, TriangulatedShape
from turgor.core.model.obstacles.outlines import rounded_block
from turgor.core.results.fields.contact import extents_of
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.solvers.checks.obstacles import overlapping_obstacles
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.reference.sections import section_tables
from turgor.job.tables.obstacles import SHAPES
from turgor.units import deg, mm
from turgor.views.pictures.overlays.obstacle_skin import obstacle_skin
from turgor.views.report import describe

CAPSULE = '''
from dataclasses import dataclass, field

import numpy as np

from turgor.core.model.obstacles.distances import outer
from turgor.core.model.obstacles.outlines import rounded_block
from turgor.core.model.obstacles.rigid_shape import RigidShape, Vector, in_mm


@dataclass(frozen=True, slots=True, kw_only=True)
class Capsule(RigidShape):
    """A round bar along x with round ends.

    Parameters
    ----------
    center : (3,) floats [m]
        Its center.
    radius : float [m]
        More than 0.
    length : float [m]
        Length of the straight part.
    tilt : float [rad]
        Without any effect here.
    """

    center: Vector
    radius: float
    length: float = 0.01
    tilt: float = field(default=0.0, metadata={"dimension": "angle"})

    def text(self):
        return f"capsule around {in_mm(self.center)}"

    def signed_distance(self, points):
        from_middle = points - np.array(self.center)
        from_middle[:, 0] -= np.clip(from_middle[:, 0], -self.length / 2, self.length / 2)
        distance = np.linalg.norm(from_middle, axis=1)
        out = from_middle / distance[:, None]
        free = (from_middle != 0)[:, :, None] * np.eye(3)
        return distance - self.radius, out, (free - outer(out, out)) / distance[:, None, None]

    def outline(self, place, extent):
        half = np.array([self.length / 2 + self.radius, self.radius, self.radius])
        points, triangles = rounded_block(half, self.radius)
        return points + self.center + place, triangles
'''

JOB = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "5 mm"
cells = "hexahedra"

[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa", bulk_modulus = "5 MPa" }
base = { law = "neo_hooke", C10 = "0.1 MPa", bulk_modulus = "5 MPa" }

[loads]
pressure = "0.1 kPa"

[obstacles.bar]
shape = "capsule"
center = ["8 mm", "1 mm", "-3.1 mm"]
radius = "3 mm"
length = "4 mm"
tilt = "30 deg"
path = [[0, [0, 0, 0]], [1, [0, 0, "0.4 mm"]]]
"""


CAPSULE_ONLY = 'length = "4 mm"\ntilt = "30 deg"\n'


@dataclass(frozen=True, slots=True, kw_only=True)
class Slab(TriangulatedShape):
    """A slab below the actuator, of triangles."""

    top: float
    thickness: float = 2 * mm

    def surface(self):
        points, triangles = rounded_block(np.array([4 * mm, 4 * mm, self.thickness / 2]), 0.0)
        return points + [8 * mm, 0, self.top - self.thickness / 2], triangles


@pytest.fixture
def capsule(tmp_path, monkeypatch):
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "capsule.py").write_text(CAPSULE, encoding="utf-8")
    package = turgor.core.model.obstacles
    assert "capsule" not in SHAPES
    monkeypatch.setattr(package, "__path__", [*package.__path__, str(folder)])
    return SHAPES["capsule"]


def read(folder, text=JOB):
    (folder / "own.toml").write_text(text, encoding="utf-8")
    return read_job(folder / "own.toml")


def with_shape(model, shape):
    (obstacle,) = model.contact.obstacles
    return replace(model, contact=Contact(False, [replace(obstacle, shape=shape)]))


def solved(model):
    solution = tg.solve(model, tg.Static(at=(1.0,)))
    return solution, solution.states[-1]


def test_a_job_file_states_it_and_the_lock_file_gives_it_back(capsule, tmp_path):
    job = read(tmp_path)
    (bar,) = job.contact.obstacles
    assert bar.shape == capsule(center=(8 * mm, 1 * mm, -3.1 * mm), radius=3 * mm, length=4 * mm, tilt=30 * deg)
    (tmp_path / "lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(tmp_path / "lock.toml") == job
    table = next(each for each in section_tables() if "capsule" in each.header)
    assert [key.name for key in table.keys] == ["center", "radius", "length", "tilt"]
    with refused("obstacles.bar.radius", "'3 kPa'"):
        read(tmp_path, JOB.replace('radius = "3 mm"', 'radius = "3 kPa"'))
    with refused("obstacles.bar.shape", "capsul", "capsule"):
        read(tmp_path, JOB.replace('"capsule"', '"capsul"'))
    half = bar.shape.scaled(2 * mm)
    assert (half.center[0], half.radius, half.length, half.tilt) == pytest.approx((4, 1.5, 2, 30 * deg))


def test_a_formula_presses_as_the_same_body_made_of_a_box(capsule, tmp_path):
    """A box that is rounded by half of its width is the same body."""
    model, _ = prepare(read(tmp_path))
    model = with_shape(model, model.contact.obstacles[0].shape)
    box = Box(center=(8 * mm, 1 * mm, -3.1 * mm), size=(10 * mm, 6 * mm, 6 * mm), rounding=3 * mm)
    (own, end), (other, same) = solved(model), solved(with_shape(model, box))
    assert len(own.states) == len(other.states)
    moved = np.abs(same.displacement).max()
    assert end.displacement == pytest.approx(same.displacement, abs=1e-9 * moved)
    forces = [tg.measure(each, "bar_force").column("bar_force")[-1] for each in (own, other)]
    assert forces[0] == pytest.approx(forces[1], rel=1e-9)
    assert forces[0] > 1e-3
    assert describe.contact(model)[-1].startswith("bar: capsule around (8, 1, -3.1) mm; without friction; moved by")
    at = StateFields(end)
    skins = [obstacle_skin(StateFields(each), extents_of([at])) for each in (end, same)]
    assert skins[0].points == pytest.approx(skins[1].points)
    assert len(skins[0].points) > 100


def test_triangles_press_as_a_rigid_surface(tmp_path):
    model, _ = prepare(
        read(tmp_path, JOB.replace("capsule", "sphere").replace(CAPSULE_ONLY, "").replace("0.4 mm", "0.15 mm"))
    )
    slab = Slab(top=-0.1 * mm)
    points, triangles = slab.surface()
    surface = RigidSurface(points=points, triangles=triangles)
    (_, end), (_, same) = solved(with_shape(model, slab)), solved(with_shape(model, surface))
    assert np.array_equal(end.displacement, same.displacement)
    assert np.abs(end.touches["bar"].force[:, 2].sum()) > 1e-4
    at = StateFields(end)
    assert len(obstacle_skin(at, extents_of([at])).points) == 24
    assert slab.middle == pytest.approx((8 * mm, 0, -1.1 * mm))
    (finding,) = overlapping_obstacles(with_shape(model, Slab(top=2 * mm)))
    assert finding.code == "B08"
    assert Obstacle(name="floor", shape=slab).text() == "floor: slab; without friction."


def test_a_shape_that_leaves_out_what_it_must_say_is_named():
    @dataclass(frozen=True, slots=True, kw_only=True)
    class Bare(RigidShape):
        pass

    @dataclass(frozen=True, slots=True, kw_only=True)
    class Open(TriangulatedShape):
        pass

    with refused("Bare", "signed_distance"):
        Bare().clearance(np.zeros((1, 3)))
    with refused("Bare", "outline"):
        Bare().outline(np.zeros(3), np.zeros((2, 3)))
    with refused("Open", "surface"):
        Open().outline(np.zeros(3), np.zeros((2, 3)))


def test_few_files_ask_for_classes_of_obstacles():
    classes = {kind.__name__ for kind in SHAPES.values()}
    classes |= {"RigidSurface", "Plate", "Grasped", "BetweenFingers", "SelfContact"}
    assert len(classes) == 9
    querying = files_that_query(classes, without=("core/model/obstacles",))
    assert len(querying) <= 2, querying
