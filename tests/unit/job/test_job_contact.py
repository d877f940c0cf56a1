"""Contact and obstacles in jobs: what they become, every mistake, what the report says, and the way back."""

import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import any_states, refused
from turgor.cli import main
from turgor.core.inp.write_inp import write_inp
from turgor.core.meshing.exchange.formats.stl import stl_bytes
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Box, Cylinder, Obstacle, Plane, RigidSurface, SelfContact, Sphere
from turgor.job.export import InpOptions, export_job
from turgor.job.job import Job
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.tables.obstacles import SHAPES, obstacle_table
from turgor.job.text.problems import JobError
from turgor.units import mm
from turgor.views.report import describe

FINGER = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "4 mm"

[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa" }
base = { law = "neo_hooke", C10 = "0.12 MPa" }

[loads]
pressure = "10 kPa"

[output]
measures = ["bending_angle"]

[contact]
friction = 0.3

[obstacles.plate]
shape = "plane"
point = [0, 0, "-2 mm"]
normal = "+z"
friction = 0.2
"""

CONTACT = FINGER[FINGER.index("[contact]") :]
BARE = FINGER.replace(CONTACT, "")

EVERY_KEY = """\
[contact]
self_contact = true
friction = 0.25
tolerance = 0.02
stiffness = "5 MPa/mm"

[obstacles.floor]
shape = "plane"
point = ["1 mm", 0, "-2 cm"]
normal = [1, 2, -2]

[obstacles.ball]
shape = "sphere"
center = [0, 0, "-9 mm"]
radius = "7.3 mm"
friction = 0.5
path = [[0, [0, 0, 0]], [0.4, [0, 0, "3.3 mm"]], [1, [0, 0, 0]]]

[obstacles.bar]
shape = "cylinder"
center = [0, 0, "-9 mm"]
axis = "y"
radius = "7 mm"
length = "30 mm"
spring = "50 N/m"
face = "tip"

[obstacles.rail]
shape = "cylinder"
center = [0, 0, 0]
axis = [0.3, -0.5, 0.7]
radius = "7 mm"

[obstacles.block]
shape = "box"
center = [0, 0, "-9 mm"]
size = ["10 mm", "20 mm", "6 mm"]
rotation = [[0, [0, 0, 0]], [0.4, [0, "90 deg", 0]], [1, [0, "-0.5 rad", "720 deg"]]]
about = ["1 mm", 0, "-9 mm"]
rounding = "1 mm"
stiffness = "3e6 Pa/m"
elastic_slip = "0.005 mm"
"""


def read(tmp_path: Path, text: str) -> Job:
    file = tmp_path / "finger.toml"
    file.write_text(text, encoding="utf-8")
    return read_job(file)


def problems(tmp_path: Path, text: str) -> list[str]:
    with pytest.raises(JobError) as caught:
        read(tmp_path, text)
    return [line.replace(f"{tmp_path}/", "") for line in caught.value.problems]


def again(tmp_path: Path, job: Job) -> Job:
    """Write the lock file of a job and read it."""
    return read(tmp_path, lock_text(job, {"turgor": "0"}))


def block(path: Path, side=10.0):
    """Write a cube as STL, from the origin."""
    points = side * np.array([[x, y, z] for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(stl_bytes(points, np.array([[q[0], *pair] for q in quads for pair in (q[1:3], q[2:])])))
    return path


def test_nothing_stated_is_the_default(tmp_path):
    assert read(tmp_path, BARE).contact == Contact()


@pytest.mark.parametrize(
    ("stated", "meant"),
    [
        ("self_contact = true", Contact(self_contact=True)),
        ("self_contact = false", Contact(self_contact=False)),
        ("self_contact = 'automatic'\ntolerance = 0.05", Contact(tolerance=0.05)),
        ("friction = 0.4", Contact(self_contact=SelfContact(friction=0.4))),
        ("stiffness = '2 MPa/mm'", Contact(self_contact=SelfContact(stiffness=2e9))),
        ("elastic_slip = '2 um'", Contact(self_contact=SelfContact(elastic_slip=2e-6))),
    ],
)
def test_self_contact(tmp_path, stated, meant):
    job = read(tmp_path, f"{BARE}[contact]\n{stated}\n")
    assert job.contact == meant
    assert again(tmp_path, job).contact == meant


def test_every_key_reaches_the_job_and_comes_back_from_the_lock_file(tmp_path):
    job = read(tmp_path, BARE + EVERY_KEY)
    assert job.contact.self_contact == SelfContact(friction=0.25, stiffness=5e9)
    assert job.contact.tolerance == 0.02
    floor, ball, bar, rail, box = job.contact.obstacles
    assert floor == Obstacle(name="floor", shape=Plane(point=(1 * mm, 0, -20 * mm), normal=(1, 2, -2)))
    assert ball == Obstacle(
        name="ball",
        shape=Sphere(center=(0, 0, -9 * mm), radius=7.3 * mm),
        friction=0.5,
        path=((0, (0, 0, 0)), (0.4, (0, 0, 3.3 * mm)), (1, (0, 0, 0))),
    )
    around = Cylinder(center=(0, 0, -9 * mm), axis=(0, 1, 0), radius=7 * mm, length=30 * mm)
    assert bar == Obstacle(name="bar", shape=around, spring=50, face="tip")
    assert rail.shape == Cylinder(center=(0, 0, 0), axis=(0.3, -0.5, 0.7), radius=7 * mm)
    assert box.shape == Box(center=(0, 0, -9 * mm), size=(10 * mm, 20 * mm, 6 * mm), rounding=1 * mm)
    assert (box.stiffness, box.elastic_slip) == (3e6, 5e-6)
    assert [factor for factor, _ in box.rotation] == [0, 0.4, 1]
    assert np.array([turn for _, turn in box.rotation]) == pytest.approx(
        np.array([[0, 0, 0], [0, np.pi / 2, 0], [0, -0.5, 4 * np.pi]])
    )
    assert box.about == pytest.approx((0.001, 0, -0.009))
    assert again(tmp_path, job) == job
    stated = tomllib.loads(lock_text(job, {}))["obstacles"]
    assert stated["ball"]["path"][1] == [0.4, ["0 mm", "0 mm", "3.3 mm"]]
    assert stated["bar"]["spring"] == "50 N/m"


def test_keys_of_a_shape_are_its_fields():
    assert set(obstacle_table("plane").model_fields) - set(obstacle_table("sphere").model_fields) == {"point", "normal"}
    for name, kind in SHAPES.items():
        assert set(kind.__dataclass_fields__) < set(obstacle_table(name).model_fields)


def test_stl_body_is_found_beside_the_job_file(tmp_path):
    block(tmp_path / "parts" / "block.stl")
    text = f'{BARE}[obstacles.block]\nshape = "stl"\nfile = "parts/block.stl"\nunit = "cm"\nfriction = 0.1\n'
    job = read(tmp_path, text)
    (obstacle,) = job.contact.obstacles
    assert isinstance(obstacle.shape, RigidSurface)
    assert np.ptp(obstacle.shape.points, axis=0) == pytest.approx([0.1, 0.1, 0.1])
    back = again(tmp_path, job)
    assert back.rigid_files == job.rigid_files
    assert back.contact.obstacles[0].shape.points.tolist() == obstacle.shape.points.tolist()
    assert replace(back, contact=job.contact) == job  # triangles are compared by identity
    with refused("'block'", "triangles", "STL file"):
        lock_text(replace(job, rigid_files={}), {})


def test_changed_stl_body_is_noticed(tmp_path):
    file = block(tmp_path / "block.stl")
    lock = lock_text(read(tmp_path, f'{BARE}[obstacles.block]\nshape = "stl"\nfile = "block.stl"\n'), {})
    block(file, side=11.0)
    (problem,) = problems(tmp_path, lock)
    assert any_states([problem], ["obstacles.block.sha256:", "'block.stl'"])


BAD_STL = [
    ('shape = "stl"', [":19: obstacles.block.file:", "'file'", "missing"]),
    ('shape = "stl"\nfile = "blok.stl"', [":21: obstacles.block.file:", "'blok.stl'", "'block.stl'"]),
    ('shape = "stl"\nfile = "block.stl"\nunit = "mmm"', [":22: obstacles.block.unit:", "'mmm'", "'mm'"]),
    ('shape = "stl"\nfile = "open.stl"', [":19: obstacles.block:", "'open.stl'", "3 edges"]),
    (
        'shape = "stl"\nfile = "block.stl"\nradius = "1 mm"',
        [":22: obstacles.block.radius:", "'radius'", "friction, path"],
    ),
]


@pytest.mark.parametrize(("stated", "facts"), BAD_STL, ids=range(len(BAD_STL)))
def test_each_mistake_with_a_file_is_one_clear_sentence(tmp_path, stated, facts):
    block(tmp_path / "block.stl")
    (tmp_path / "open.stl").write_bytes(stl_bytes(np.eye(3), np.array([[0, 1, 2]])))
    (result,) = problems(tmp_path, f"{BARE}[obstacles.block]\n{stated}\n")
    assert any_states([result], facts), result


PLATE = FINGER[FINGER.index("[obstacles") :]
MISTAKES = [
    # (what stands in the file, what it is changed to, what the problem states)
    ("[contact]", "[contcat]", [":19: contcat:", "'contcat'", "'contact'"]),
    ("[obstacles.plate]", "[obstacle.plate]", [":22: obstacle:", "'obstacle'", "'obstacles'"]),
    ("friction = 0.3", "frction = 0.3", [":20: contact.frction:", "'frction'", "'friction'"]),
    ("friction = 0.3", "friction = 3", [":20: contact.friction:", "3", "0 and 2"]),
    ("friction = 0.3", "friction = true", [":20: contact.friction:", "true", "number"]),
    ("friction = 0.3", "self_contact = 'yes'", [":20: contact.self_contact:", "'yes'", "true", "'automatic'"]),
    ("friction = 0.3", "self_contact = false\nfriction = 0.3", [":21: contact.friction:", "self_contact = false"]),
    ("friction = 0.3", "tolerance = 0.5", [":20: contact.tolerance:", "0.5", "0.0001 to 0.1"]),
    ("friction = 0.3", "stiffness = '5 MPa'", [":20: contact.stiffness:", "'5 MPa'", "contact stiffness"]),
    ("friction = 0.3", "elastic_slip = '0 mm'", [":20: contact.elastic_slip:", "0 mm", "more than 0"]),
    ("friction = 0.3", "stiffness = '-5 MPa/mm'", [":20: contact.stiffness:", "-5e+09", "more than 0"]),
    ("[obstacles.plate]", "[obstacles]", [":23: obstacles.shape:", "[obstacles.plate]"]),
    ("[obstacles.plate]", "[obstacles.self]", [":22: obstacles.self:", "'self'", "self-contact"]),
    ("[obstacles.plate]", "[obstacles.my-plate]", [":22: obstacles.my-plate:", "'my-plate'", "letters", "underscores"]),
    ("friction = 0.2", "rotation = [[0, [0, 0, 0]], [1, [0, '90 mm', 0]]]",
     [":26: obstacles.plate.rotation:", "90 mm"]),
    ("friction = 0.2", "rotation = [[0, [0, 0]]]", [":26: obstacles.plate.rotation:", "about x, y and z"]),
    ("friction = 0.2", "rotation = [[0.5, [0, 0, 0]], [1, [0, 0, 0]]]",
     [":26: obstacles.plate.rotation:", "from 0 to 1"]),
    ("friction = 0.2", "about = [0, 0, 0]", [":26: obstacles.plate.about:", "add a rotation"]),
    ("friction = 0.2", "about = [0, 0]", [":26: obstacles.plate.about:", "three lengths"]),
    ('shape = "plane"', "", [":22: obstacles.plate.shape:", "'shape'", "plane, sphere"]),
    ('"plane"', '"plain"', [":23: obstacles.plate.shape:", "'plain'", "'plane'"]),
    ('"plane"', '"sphere"', [":25: obstacles.plate.normal:", "'normal'", "center, radius"]),
    ('"plane"', '"sphere"', [":22: obstacles.plate.radius:", "'radius'", "missing"]),
    ("point =", "pint =", [":24: obstacles.plate.pint:", "'pint'", "'point'"]),
    ('"-2 mm"', "-2", [":24: obstacles.plate.point:", "-2", "'1.5 mm'"]),
    ('"-2 mm"', '"-2 kPa"', [":24: obstacles.plate.point:", "'-2 kPa'", "length"]),
    ('[0, 0, "-2 mm"]', '"-2 mm"', [":24: obstacles.plate.point:", "'-2 mm'", "three"]),
    ('[0, 0, "-2 mm"]', "[0, 0]", [":24: obstacles.plate.point:", "[0, 0]", "three"]),
    ('"+z"', '"+w"', [":25: obstacles.plate.normal:", "'+w'", "+x, +y"]),
    ('"+z"', "[0, 1]", [":25: obstacles.plate.normal:", "[0, 1]", "'+z'"]),
    ('"+z"', "[0, 0, '1 mm']", [":25: obstacles.plate.normal:", "[0, 0, '1 mm']", "'+z'"]),
    ('"+z"', "[0, 0, 0]", [":25: obstacles.plate.normal:", "zero", "(0, 0, 1)"]),
    ('"+z"', "[1e300, 1e300, 0]", [":25: obstacles.plate.normal:", "(1e+300, 1e+300, 0.0)", "(0, 0, 1)"]),
    ('"+z"', "[nan, 0, 1]", [":25: obstacles.plate.normal:", "nan", "finite"]),
    ("friction = 0.2", "friction = -1", [":26: obstacles.plate.friction:", "-1", "0 and 2"]),
    ("friction = 0.2", 'face = "tipp"', [":26: obstacles.plate.face:", "'tipp'", "'tip'"]),
    ("friction = 0.2", 'spring = "50 mm"', [":26: obstacles.plate.spring:", "'50 mm'", "spring stiffness"]),
    ("friction = 0.2", 'spring = "0 N/m"', [":26: obstacles.plate.spring:", "0", "more than 0"]),
    ("friction = 0.2", "path = [[0, 1]]", [":26: obstacles.plate.path:", "1", "three"]),
    ("friction = 0.2", "path = 3", [":26: obstacles.plate.path:", "3", "[load factor, [x, y, z]]"]),
    ("friction = 0.2", "path = [[0, [0, 0, 0]], ['5 mm', [0, 0, 0]]]",
     [":26: obstacles.plate.path:", "['5 mm', [0, 0, 0]]", "[load factor, [x, y, z]]"]),
    ("friction = 0.2", "path = [[0, [0, 0, 0]], [0.5, [0, 0, 0]]]",
     [":26: obstacles.plate.path:", "load factors 0, 0.5;", "0 to 1"]),
    (PLATE, '[obstacles.box]\nshape = "box"\ncenter = [0, 0, 0]\nsize = ["1 mm", "1 mm", "1 mm"]\nrounding = "2 mm"',
     [":26: obstacles.box.rounding:", "2 mm", "0.5 mm"]),
    (PLATE, '[obstacles.ball]\nshape = "sphere"\ncenter = [0, 0, 0]\nradius = "0 mm"',
     [":25: obstacles.ball.radius:", "0 mm", "more than 0"]),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "facts"), MISTAKES, ids=[f"{new}"[:40] for _, new, _ in MISTAKES])
def test_each_mistake_is_one_clear_sentence(tmp_path, old, new, facts):
    assert old in FINGER
    result = problems(tmp_path, FINGER.replace(old, new, 1))
    assert any_states(result, facts), "\n".join(result)
    assert all(line.endswith((".", "?")) and "\n" not in line for line in result)


def test_what_is_no_table(tmp_path):
    result = problems(tmp_path, f"contact = 3\nobstacles = 4\n{BARE}")
    assert any_states(result[:1], ["finger.toml:1: contact:", "3", "[contact]"])
    assert any_states(result[1:], ["finger.toml:2: obstacles:", "4", "[obstacles.plate]"])


def test_moved_obstacle_drives_without_loads(tmp_path):
    loads = '[loads]\npressure = "10 kPa"\n'
    moved = "friction = 0.2\npath = [[0, [0, 0, 0]], [1, [0, 0, '1 mm']]]"
    assert read(tmp_path, FINGER.replace(loads, "").replace("friction = 0.2", moved)).loads == ()
    (problem,) = problems(tmp_path, FINGER.replace(loads, ""))
    assert any_states([problem], ["finger.toml: loads:", "[loads]", "missing"])


def test_contact_reaches_the_model_and_the_report(tmp_path):
    whole = BARE.replace('length = "10 mm"', 'length = "10 mm"\nsymmetric = false')  # a half refuses the turning block
    job = read(tmp_path, whole + EVERY_KEY)
    model, _ = prepare(job)
    assert model.contact == job.contact
    assert describe.contact(model) == [
        "The actuator touches itself with friction 0.25.",
        "floor: plane through (1, 0, -20) mm with the normal (0.3333, 0.6667, -0.6667); without friction.",
        "ball: sphere of radius 7.3 mm around (0, 0, -9) mm; with friction 0.5; moved by (0, 0, 3.3) mm at load factor "
        "0.4, (0, 0, 0) mm at load factor 1.",
        "bar: cylinder 30 mm long of radius 7 mm around (0, 0, -9) mm along (0, 1, 0); without friction; touches tip "
        "only; supported by a spring of 50 N/m.",
        "rail: endless cylinder of radius 7 mm around (0, 0, 0) mm along (0.3293, -0.5488, 0.7683); without friction.",
        "block: box of 10 × 20 × 6 mm around (0, 0, -9) mm, its edges rounded by 1 mm; without friction; turned about "
        "(1, 0, -9) mm by (0, 90, 0)° at load factor 0.4, (0, -28.65, 720)° at load factor 1.",
    ]
    off = tg.Model(model.mesh, model.materials, [], model.loads, contact=Contact(self_contact=False))
    assert describe.contact(off) == ["Walls of the actuator do not stop each other: self-contact is off."]
    assert describe.contact(tg.Model(model.mesh, model.materials, [], model.loads)) == []  # one chamber meets no other
    tent = RigidSurface(points=np.eye(3), triangles=np.array([[0, 1, 2]]), name="tent")
    given = Contact(self_contact=False, obstacles=[Obstacle(name="tent", shape=tent)])
    tented = tg.Model(model.mesh, model.materials, [], model.loads, contact=given)
    assert describe.contact(tented)[1:] == ["tent: 1 triangles of tent; without friction."]


def test_check_tells_what_may_touch_what(tmp_path, capsys):
    read(tmp_path, FINGER)
    main(["check", str(tmp_path / "finger.toml")])
    said = capsys.readouterr().out.splitlines()
    assert said[1:3] == [
        "The actuator touches itself with friction 0.3.",
        "plate: plane through (0, 0, -2) mm with the normal (0, 0, 1); with friction 0.2.",
    ]


def test_a_face_that_nothing_can_touch_is_refused(tmp_path):
    text = FINGER.replace("friction = 0.2", 'face = "strain_limiting_layer"')
    with refused("'plate'", "'strain_limiting_layer'"):
        prepare(read(tmp_path, text))
    assert prepare(read(tmp_path, text.replace("strain_limiting_layer", "tip")))[0].contact.obstacles[0].face == "tip"


def test_inp_files_have_contact(tmp_path):
    model, _ = prepare(read(tmp_path, FINGER))
    done = export_job(read(tmp_path, FINGER), tmp_path / "files", ["inp"], inp=InpOptions(poisson=0.45))
    notes = {note.what: note for note in done.notes}
    assert "penalty" in notes["obstacles.plate"].text and "contact_outside, rigid_plate" in done.files[0].read_text()
    file = tmp_path / "a.inp"
    for wanted, pair in ((SelfContact(friction=0.3), True), (None, False)):
        bare = tg.Model(model.mesh, model.materials, model.supports, model.loads, contact=Contact(self_contact=wanted))
        write_inp(bare, file, program="abaqus")
        text = file.read_text()
        assert ("\ncontact_outside, contact_outside\n" in text) is pair
        assert ("\n*FRICTION, SLIP TOLERANCE=0.005\n0.3\n" in text) is pair
