"""Setups: what stops the tip, how an object is pulled, and what cannot be asked."""

from dataclasses import replace

import numpy as np
import pytest
import results_cases as cases

from refused import refused
from turgor.core.model.contact import Contact
from turgor.core.model.loads import Gravity, Pressure, Traction
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Box, Cylinder, Obstacle, Plane, RigidSurface, Sphere
from turgor.core.model.supports import Fixed
from turgor.core.setups.blocked_tip import NEAR_TIP, FixedTip, Plate, blocked_force, first_direction
from turgor.core.setups.grasped_object import Grasped, grasp
from turgor.core.setups.setup_values import HOLDS, BlockedForce, Grasp
from turgor.core.setups.with_setup import with_setup
from turgor.core.solvers.procedures.stages import Stage
from turgor.units import kPa, mm

BAR = Cylinder(center=(30 * mm, 0, -12 * mm), axis=(0, 1, 0), radius=6 * mm)


def model(*obstacles: Obstacle, half: bool = False, loads: tuple = (Pressure("cavity", 20 * kPa),)) -> Model:
    """The box with a cavity below its middle, so that it bends."""
    mesh = cases.body(half=half)
    rubber = {"body": cases.RUBBER, "base": cases.RUBBER}
    return Model(mesh, rubber, [Fixed("fixed")], loads, contact=Contact(obstacles=obstacles))


def bar(**changes) -> Obstacle:
    return replace(Obstacle(name="object", shape=BAR, friction=0.5), **changes)


def only(obstacles: tuple[Obstacle, ...], name: str) -> Obstacle:
    (result,) = (each for each in obstacles if each.name == name)
    return result


def test_without_a_setup_the_model_is_what_it_was():
    question = model()
    assert with_setup(question, None) is question


def test_a_setup_of_a_job_is_the_function():
    question = model(bar())
    assert with_setup(question, BlockedForce(direction="-z")).contact == blocked_force(question, direction="-z").contact
    made = with_setup(question, Grasp(pull_distance=8 * mm))
    assert made.contact == grasp(question, pull_distance=8 * mm).contact
    assert made.loads == grasp(question, pull_distance=8 * mm).loads


@pytest.mark.parametrize("half", [False, True])
def test_the_plate_stands_below_the_tip(half):
    question = model(half=half)
    amended = blocked_force(question, direction="-z", distance=2 * mm, friction=0.3)
    plate = only(amended.contact.obstacles, "plate")
    assert isinstance(plate, Plate)
    assert isinstance(plate.shape, Plane)  # through a point below the middle of the tip, about which it is tilted
    assert plate.shape.point == pytest.approx((cases.LENGTH, 0, -2 * mm), abs=1e-9)
    assert plate.shape.normal == (0, 0, 1)
    assert (plate.friction, plate.face) == (0.3, NEAR_TIP)
    assert amended.contact.automatic, "self-contact stays as it was"
    assert (amended.supports, amended.loads) == (question.supports, question.loads)


def test_only_the_surface_near_the_tip_touches_the_plate():
    mesh = blocked_force(model(half=True), direction="-z").mesh
    sides = mesh.face(NEAR_TIP)
    middles = mesh.points[sides[:, :3]].mean(axis=1)
    assert middles[:, 0].min() > 0.7 * cases.LENGTH
    assert {tuple(side) for side in mesh.face("tip").tolist()} <= {tuple(side) for side in sides.tolist()}
    inner = np.concatenate([mesh.face("cavity"), mesh.face("symmetry_y")])
    assert not {tuple(side) for side in inner.tolist()} & {tuple(side) for side in sides.tolist()}
    area = cases.WIDTH / 2 * cases.HEIGHT + cases.LENGTH / 4 * (cases.WIDTH + cases.HEIGHT)
    corners = mesh.points[sides[:, :3]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    assert np.linalg.norm(normals, axis=1).sum() == pytest.approx(area)


def test_a_plate_before_the_tip_stops_what_extends():
    plate = only(blocked_force(model(), direction="+x").contact.obstacles, "plate")
    assert isinstance(plate.shape, Plane)
    assert plate.shape.point == pytest.approx((cases.LENGTH, 0, cases.HEIGHT / 2), abs=1e-9)
    assert plate.shape.normal == (-1, 0, 0)


def test_a_held_tip_needs_no_contact():
    question = model()
    amended = blocked_force(question, hold="xz", direction="-z")
    assert amended.contact.obstacles == ()
    assert amended.mesh is question.mesh
    assert amended.supports[-1] == FixedTip("tip", "xz", (0.0, 0.0, -1.0))


@pytest.mark.parametrize(
    ("pull", "axes", "expected"),
    [((1, 0, 0), "xyz", "+x"), ((-1, 0, 0), "xyz", "-x"), ((1, 0, -1), "xyz", "-z"), ((1, 0, -1), "xy", "+x")],
)
def test_the_free_tip_sets_out_where_its_load_moves_it_most(pull, axes, expected):
    """A beam bends more than it stretches; the direction is sought among the axes that count."""
    assert first_direction(model(loads=(Traction("tip", pull),)), "tip", axes) == expected


def test_the_directions_of_a_hold_have_one_order():
    assert BlockedForce(hold="zx") == BlockedForce(hold="xz")


def test_the_free_direction_needs_a_load():
    with refused("blocked_force", "direction is 'free'", "'tip'"):
        blocked_force(model(loads=()))


@pytest.mark.parametrize(
    ("changes", "facts"),
    [
        ({"hold": "plat"}, ("hold 'plat'", "'plate'")),
        ({"hold": "xx"}, ("hold 'xx'", "'x'")),
        ({"direction": "z"}, ("direction 'z'", "'-z'")),
        ({"distance": float("nan")}, ("blocked_force", "distance")),
        ({"hold": "z", "distance": 1 * mm}, ("blocked_force", "distance", "hold is 'z'")),
        ({"hold": "z", "friction": 0.1}, ("blocked_force", "friction", "hold is 'z'")),
        ({"hold": "z", "direction": "+x"}, ("blocked_force", "direction is '+x'", "along z")),
        ({"friction": 3.0}, ("blocked_force", "friction is 3", "between 0 and 2")),
    ],
)
def test_what_cannot_block_is_refused(changes, facts):
    with refused(*facts):
        BlockedForce(**changes)


@pytest.mark.parametrize(
    ("changes", "half", "facts"),
    [
        ({"face": "tipp"}, False, ("tipp", "tip")),
        ({"direction": "-x"}, False, ("direction is '-x'", "hold = 'x'")),
        ({"direction": "+y"}, True, ("direction is '+y'", "symmetric=False")),
        ({"face": "cavity", "direction": "-z"}, False, ("face 'cavity'", "normals")),
    ],
)
def test_what_cannot_be_blocked_is_refused(changes, half, facts):
    with refused(*facts):
        blocked_force(model(half=half), **changes)


def test_a_model_with_a_plate_of_its_own_is_refused():
    own = Obstacle(name="plate", shape=Plane(point=(0, 0, -1), normal=(0, 0, 1)))
    with refused("blocked_force", "'plate'"):
        blocked_force(model(own), direction="-z")


def test_the_holds_are_the_plate_and_every_choice_of_axes():
    assert HOLDS == ("plate", "x", "y", "z", "xy", "xz", "yz", "xyz")


def test_a_grasp_closes_then_pulls():
    floor = Obstacle(name="floor", shape=Plane(point=(0, 0, -1), normal=(0, 0, 1)))
    amended = grasp(model(floor, bar(), half=True), pull_distance=8 * mm, closing=0.4)
    (load,) = amended.pressures
    assert [load.at(factor) for factor in (0.2, 0.4, 0.7, 1.0)] == [10 * kPa, 20 * kPa, 20 * kPa, 20 * kPa]
    grasped = only(amended.contact.obstacles, "object")
    assert isinstance(grasped, Grasped)
    assert (grasped.shape, grasped.friction, grasped.fingers, grasped.pull) == (BAR, 0.5, 2, (1.0, 0.0, 0.0))
    moved = [grasped.displacement(factor)[0] for factor in (0.0, 0.4, 0.7, 1.0)]
    assert moved == pytest.approx([0, 0, 4 * mm, 8 * mm])
    between = only(amended.contact.obstacles, "between_fingers")
    assert between.friction == 0
    assert between.shape.point == BAR.center
    assert between.shape.normal == pytest.approx((0, 0, 1))
    assert only(amended.contact.obstacles, "floor") is floor


@pytest.mark.parametrize("half", [False, True])
def test_three_fingers_stand_a_third_of_a_turn_apart(half):
    """The planes between a finger and the next ones are 60 degrees from its own plane; a half meets one of them."""
    ball = bar(shape=Sphere(center=(30 * mm, 0, -40 * mm), radius=6 * mm))
    amended = grasp(model(ball, half=half), pull_distance=8 * mm, fingers=3)
    normals = [each.shape.normal for each in amended.contact.obstacles if each.name.startswith("between_fingers")]
    expected = [(0, -0.5, 3**0.5 / 2), (0, 0.5, 3**0.5 / 2)][: 1 if half else 2]
    assert np.array(normals) == pytest.approx(np.array(expected))


@pytest.mark.parametrize(
    ("changes", "facts"),
    [
        ({"pull_distance": 0.0}, ("pull_distance", "0 mm", "more than 0")),
        ({"pull": "+z"}, ("pull is '+z'", "+x, -x, +y, -y")),
        ({"pull": "x"}, ("pull 'x'", "'-x'")),
        ({"fingers": 1}, ("fingers is 1", "2 to 12")),
        ({"fingers": 3, "pull": "+y"}, ("pull is '+y'", "3 fingers", "along x", "'+x' or '-x'")),
        ({"closing": 1.0}, ("closing is 1", "between 0 and 1")),
    ],
)
def test_what_cannot_grasp_is_refused(changes, facts):
    with refused(*facts):
        Grasp(**{"pull_distance": 8 * mm} | changes)


RISEN = Pressure("cavity", 20 * kPa, history=((0, 0), (0.2, 1), (1, 1)))
LYING = RigidSurface(points=np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.2]]), triangles=np.array([[0, 1, 2]]))


@pytest.mark.parametrize(
    ("question", "changes", "facts"),
    [
        (model(), {}, ("'object'", "no obstacles")),
        (model(bar()), {"object": "objct"}, ("'objct'", "'object'")),
        (model(bar(spring=10.0)), {}, ("'object'", "spring")),
        (model(bar(path=((0, (0, 0, 0)), (1, (0, 0, 1 * mm))))), {}, ("'object'", "path")),
        (model(bar(shape=Plane(point=(0, 0, -1), normal=(0, 0, 1)))), {}, ("'object'", "plane")),
        (model(bar()), {"fingers": 3}, ("'object'", "3 fingers", "along x", "cylinder's axis")),
        (model(bar(shape=replace(BAR, axis=(1, 0, 1)))), {}, ("'object'", "cylinder", "mid-plane")),
        (model(bar(), loads=()), {}, ("grasp", "pressure")),
        (model(bar(), loads=(RISEN,)), {}, ("pressure on 'cavity'", "history", "load factor 0.5")),
        (model(bar(), half=True), {"pull": "+y"}, ("pull is '+y'", "symmetric=False")),
        (model(bar(shape=LYING)), {}, ("100 mm", "2 fingers", "(500, 500, 100) mm", "'object'")),
        (
            model(bar(shape=Box(center=(0, 0, 4 * mm), size=(1, 1, 1)))),
            {},
            ("4 mm", "2 fingers", "(0, 0, 4) mm", "'object'"),
        ),
    ],
)
def test_what_cannot_be_grasped_is_refused(question, changes, facts):
    with refused(*facts):
        grasp(question, **{"pull_distance": 8 * mm} | changes)


def test_weight_does_not_stop_growing_and_is_refused():
    heavy = replace(cases.RUBBER, density=1100.0)
    materials = {"body": heavy, "base": heavy}
    contact = Contact(obstacles=[bar()])
    loads = [Pressure("cavity", 1e3), Gravity()]
    question = Model(cases.body(), materials, [Fixed("fixed")], loads, contact=contact)
    with refused("grasp", "Gravity"):
        grasp(question, pull_distance=8 * mm)


def test_displacements_of_a_stage_are_displacements():
    with refused("stage 'pull'", "'tip'", "Displacement"):
        Stage("pull", displacements={"tip": (0, 0, 1e-3)})
