"""Arms in series and grippers: weights of outer links load inner ones, and an object pushes back."""

from dataclasses import replace

import numpy as np
import pytest
from reduced_cases import reduced
from robot_chains import fitted, spatial

import turgor as tg
from refused import refused
from turgor.cli.app import main
from turgor.cli.exits import BAD_INPUT
from turgor.core.model.obstacles.box import Box
from turgor.core.model.obstacles.cylinder import Cylinder
from turgor.core.model.obstacles.plane import Plane
from turgor.systems.robots.chains.chain import TipForce
from turgor.systems.robots.mechanisms import mechanism_file

mujoco = pytest.importorskip("mujoco")
NAMES = {"cavity_1.pressure": 1e4, "cavity_2.pressure": 5e3}
SPHERE = tg.obstacles.Sphere(center=(0.05, 0, -0.026), radius=0.02)


def arm(count=2, name="arm", **given):
    segment = tg.robots.Segment(chain=spatial(), pressures=NAMES, roll=0.0)
    return tg.robots.Arm(segments=[segment, *[replace(segment, roll=np.pi / 2)] * (count - 1)], name=name, **given)


def test_an_arm_in_series_is_one_segment_on_the_tip_of_the_other():
    state = tg.robots.Mechanism(arms=[arm()], gravity=(0, 0, 0)).solve()["arm"]
    single = replace(spatial(), gravity=np.zeros(3))
    x = single.equilibrium(np.array(list(NAMES.values())))
    assert state.x == pytest.approx(np.tile(x, 2), abs=1e-9), "without weight every segment stands as alone"
    at = single.placed(x)
    roll = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    moved = single.tip(at) - single.base
    assert state.tip == pytest.approx(moved + at.turns[-1] @ roll @ moved, abs=1e-9)


def test_the_weight_of_the_outer_segment_bends_the_inner_one():
    alone = tg.robots.Mechanism(arms=[arm(count=1)]).solve()["arm"]
    both = tg.robots.Mechanism(arms=[arm()]).solve()["arm"]
    inner = both.placed.origins[2]
    assert inner[2] < alone.placed.origins[2][2] - 1e-4
    load = float(spatial().masses.sum()) * np.array([0, 0, -9.80665])
    rough = replace(alone.chain).equilibrium(np.array(list(NAMES.values())), outside=TipForce(load))
    assert inner[2] < replace(alone.chain).placed(rough).origins[2][2], "its lever is longer than the tip's"


def test_mujoco_finds_the_same_arms(tmp_path):
    states = tg.robots.Mechanism(arms=[arm(name="left"), arm(name="right", turn=(0, 0.3, np.pi))]).solve()
    file = tg.robots.write_mechanism({n: s.chain for n, s in states.items()}, None, tmp_path / "robot.xml")
    model = mujoco.MjModel.from_xml_path(str(file))
    data = mujoco.MjData(model)
    data.ctrl[:] = list(NAMES.values()) * 4
    for _ in range(4000):
        mujoco.mj_step(model, data)
    assert np.abs(data.qvel).max() < 1e-4
    for name, state in states.items():
        assert data.site(f"{name}_tip").xpos == pytest.approx(state.tip, abs=2e-5)


def test_an_object_gets_the_force_that_bends_the_arm_back():
    free = tg.robots.Mechanism(arms=[arm(count=1)], gravity=(0, 0, 0)).solve()["arm"]
    state = tg.robots.Mechanism(arms=[arm(count=1)], gravity=(0, 0, 0), object=SPHERE).solve()["arm"]
    assert state.force[2] < -0.005, "the arm bends down onto it"
    assert state.tip[2] > free.tip[2]
    assert 0 < state.depth < 1e-3
    pressed = np.array(list(NAMES.values())) @ state.chain.pressed(state.x) - state.chain.spring_forces(state.x)[0]
    bent = state.chain.work(state.placed, 2, state.tip, -state.force)
    assert np.sign(pressed[6]) == -np.sign(bent[6])


def test_arms_on_both_sides_press_alike():
    arms = [arm(count=1, name="left"), arm(count=1, name="right", position=(0.1, 0, 0), turn=(0, 0, np.pi))]
    left, right = tg.robots.Mechanism(arms=arms, object=SPHERE).solve().values()
    turned = np.diag([-1.0, -1.0, 1.0])
    assert right.force == pytest.approx(turned @ left.force, rel=1e-6, abs=1e-9)


FILE = """
name = "two"

[object]
shape = "sphere"
center = ["15 mm", "0 mm", "-28 mm"]
radius = "20 mm"

[arms.left]
[[arms.left.segments]]
file = "finger.reduced"
pressures = { pressure = "10 kPa" }
"""


@pytest.fixture
def file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(mechanism_file, "chain_of", lambda *_, **__: fitted())
    reduced().save(tmp_path / "finger.reduced")
    (tmp_path / "two.toml").write_text(FILE, encoding="utf-8")
    return tmp_path / "two.toml"


def test_a_file_is_answered_with_forces_picture_and_mjcf(file, capsys):
    assert main(["robot", str(file)]) == 0
    text = capsys.readouterr().out
    assert fitted().text in text
    assert "left: tip at" in text
    assert "force on the object" in text
    assert (file.parent / "two-robot" / "robot.png").stat().st_size > 5000
    mujoco.MjModel.from_xml_path(str(file.parent / "two-robot" / "robot.xml"))


def test_every_dimension_of_an_object_takes_a_unit(file):
    box = 'shape = "box"\nsize = ["20 mm", "30 mm", "40 mm"]\nrounding = "2 mm"'
    text = FILE.replace('shape = "sphere"', box).replace('radius = "20 mm"', "").replace("-28 mm", "-60 mm")
    file.write_text(text, encoding="utf-8")
    made = mechanism_file.read_mechanism(file).mechanism.object
    assert (made.size, made.rounding) == ((0.02, 0.03, 0.04), 0.002)


@pytest.mark.parametrize(
    ("shape", "inside", "outside"),
    [
        (Plane(point=(0.01, 0, 0), normal=(0, 1, 1)), (0, -0.1, 0.05), (0, 0.1, -0.05)),
        (Cylinder(center=(0, 0, 0.1), axis=(1, 1, 0), radius=0.01, length=0.08), (0.02, 0.02, 0.1), (0.02, -0.02, 0.1)),
        (Cylinder(center=(0, 0, 0.1), axis=(0, 1, 0), radius=0.01), (0, 0.5, 0.1), (0.02, 0, 0.1)),
        (Box(center=(0, 0, 0.1), size=(0.02, 0.04, 0.06), rounding=0.001), (0, 0.015, 0.1), (0.015, 0, 0.1)),
    ],
)
def test_objects_stand_in_mujoco_where_the_mechanism_has_them(tmp_path, shape, inside, outside):
    """A small ball touches where the distance is less than its radius."""
    file = tg.robots.write_mechanism({"arm": spatial()}, shape, tmp_path / "robot.xml")
    text = file.read_text(encoding="utf-8")
    for place in (inside, outside):
        ball = (
            f'<body pos="{" ".join(map(str, place))}"><freejoint/><geom name="ball" size="0.002"/></body></worldbody>'
        )
        model = mujoco.MjModel.from_xml_string(text.replace("</worldbody>", ball))
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        pairs = [{model.geom(each.geom1).name, model.geom(each.geom2).name} for each in data.contact[: data.ncon]]
        distance = shape.signed_distance(np.array([place], dtype=float))[0][0]
        assert ({"object", "ball"} in pairs) == (distance < 0.002) == (place is inside)


@pytest.mark.parametrize(
    ("old", "new", "facts"),
    [
        ('pressure = "10 kPa"', 'pressure = "40 kPa"', ("arms.left.segments[1]", "40", "12")),
        ('pressure = "10 kPa"', 'presure = "10 kPa"', ("presure", "pressure")),
        ("[arms.left]", "[arms.left]\nturn = [0, 1]", ("arms.left.turn", "three")),
        ('shape = "sphere"', 'shape = "spere"', ("spere", "sphere")),
        ('file = "finger.reduced"', "", ("arms.left.segments[1].file",)),
        ('name = "two"', "gravitiy = true", ("gravitiy", "gravity")),
        ('radius = "20 mm"', "", ("radius",)),
        ('"-28 mm"]', '"-20 mm"]', ("left", "mm inside")),
    ],
)
def test_what_a_file_states_wrongly_is_named(file, capsys, old, new, facts):
    file.write_text(FILE.replace(old, new), encoding="utf-8")
    assert main(["robot", str(file)]) == BAD_INPUT
    text = capsys.readouterr().err
    assert [fact for fact in facts if fact not in text] == []


def test_mechanisms_without_arms_or_segments_are_refused():
    with refused("none"):
        tg.robots.Mechanism(arms=[])
    with refused("hand"):
        tg.robots.Arm(segments=[], name="hand")
