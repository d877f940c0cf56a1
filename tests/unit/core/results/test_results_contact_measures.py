"""Measures of contact on touches made by hand: a half answers for the whole, fingers are counted, signs are right."""

from dataclasses import replace

import numpy as np
import pytest
import results_cases as cases

import meshes
from refused import refused
from turgor.core.meshing.bodies.combine import together
from turgor.core.meshing.bodies.named import nodes_of_body
from turgor.core.meshing.bodies.placing import placed
from turgor.core.model.contact import Contact
from turgor.core.model.loads import Moment, Pressure, Traction
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Cylinder, Obstacle, Plane
from turgor.core.model.supports import Fixed
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.files.response_csv import read_response
from turgor.core.results.measures import contact_measures as of
from turgor.core.results.measures.grasping.grasp_measures import contact_force
from turgor.core.results.measures.measures import check_measures, find_measure, measure
from turgor.core.results.measures.standard_measures import STANDARD_MEASURES
from turgor.core.setups.blocked_tip import FixedTip, blocked_force
from turgor.core.setups.setup_values import BlockedForce, Grasp, Setup
from turgor.core.setups.with_setup import with_setup
from turgor.core.solvers.solution import Solution, State, Touch
from turgor.core.solvers.solve import solve
from turgor.units import kPa, mm
from turgor.views.report import describe

BAR = Obstacle(name="bar", shape=Cylinder(center=(30 * mm, 0, -12 * mm), axis=(0, 1, 0), radius=6 * mm), friction=0.5)
WALL = Obstacle(name="wall", shape=Plane(point=(1, 0, 0), normal=(-1, 0, 0)))


def question(setup: Setup | None, *obstacles: Obstacle, half: bool = False) -> Model:
    model = Model(
        cases.body(half=half), {"body": cases.RUBBER, "base": cases.RUBBER}, [Fixed("fixed")],
        [Pressure("cavity", 20 * kPa)], contact=Contact(obstacles=obstacles),
    )  # fmt: skip
    return with_setup(model, setup)


def replace_loads(model: Model, *loads: Traction | Moment) -> Model:
    return Model(model.mesh, model.materials, model.supports, loads)


def touch(model: Model, force: tuple, node: int = 0, **values) -> Touch:
    """A force on one node of the actuator."""
    forces, pressure = np.zeros_like(model.mesh.points), np.zeros(len(model.mesh.points))
    forces[node], pressure[node] = force, values.pop("pressure", 0.0)
    return Touch(
        **{"force": forces, "pressure": pressure, "area": 0.0, "penetration": 0.0, "place": np.zeros(3)} | values
    )


def touching(model: Model, load_factor: float = 1.0, **touches: Touch) -> State:
    return replace(cases.state(model, load_factor=load_factor), touches=touches)


def solved(*states: State) -> Solution:
    return cases.solution(list(states))


@pytest.mark.parametrize("half", [False, True])
def test_force_on_the_plate(half):
    """The plate pushes the actuator up with 3 N a half; across the mirror plane its image pushes the other way."""
    model = question(BlockedForce(direction="-z"), half=half)
    state = touching(model, plate=touch(model, (0.4, 5.0, 3.0)))
    whole = 2 if half else 1
    assert of.blocked_force(state) == pytest.approx(3.0 * whole)
    assert of.blocked_force_x(state) == pytest.approx(-0.4 * whole)
    assert of.blocked_force_y(state) == pytest.approx(0.0 if half else -5.0)
    assert of.blocked_force_z(state) == pytest.approx(-3.0 * whole)
    sideways = 0.0 if half else 5.0
    assert of.force_on("plate")(state) == pytest.approx(whole * np.hypot(np.hypot(0.4, 3.0), sideways))


def test_where_the_plate_is_touched():
    """Half of the force on an edge of the tip, half of it 10 mm behind."""
    model = question(BlockedForce(direction="-z"))
    tip, behind = (at_rest(model, x * mm) for x in (40, 30))
    both = touch(model, (0, 0, 1.0), tip)
    assert of.bearing_distance(touching(model, plate=both)) == 0
    both.force[behind] = (0.3, 0, 1.0)
    assert of.bearing_distance(touching(model, plate=both)) == pytest.approx(5 * mm)
    assert np.isnan(of.bearing_distance(touching(model, plate=touch(model, (0, 0, 0)))))
    assert np.isnan(of.bearing_distance(cases.state(model)))
    with refused("'bearing_distance'", "setups.blocked_force"):
        of.bearing_distance(cases.state(question(None)))


def at_rest(model: Model, x: float) -> int:
    """The node on the lower edge in the middle, at x."""
    return int(np.flatnonzero(np.linalg.norm(model.mesh.points - [x, 0, 0], axis=1) < 1e-9)[0])


def test_nothing_pushes_before_it_touches():
    model = question(BlockedForce(direction="-z"))
    assert of.blocked_force(cases.state(model)) == 0.0
    assert of.contact_area(cases.state(model)) == of.maximum_contact_pressure(cases.state(model)) == 0.0
    assert of.deepest_penetration(cases.state(model)) == 0.0


@pytest.mark.parametrize("half", [False, True])
def test_force_of_a_held_tip(half):
    """The gauge pushes back on every node of the tip; what is not held there belongs to others."""
    model = question(BlockedForce(hold="xz", direction="-z"), half=half)
    nodes = model.mesh.face_nodes("tip")
    force = np.zeros_like(model.mesh.points)
    force[nodes] = [-0.2, 7.0, 0.1]
    force[model.mesh.face_nodes("fixed")] = 100.0
    state = replace(cases.state(model), nodal_force=force)
    count = len(nodes) * (2 if half else 1)
    assert of.blocked_force(state) == pytest.approx(0.1 * count)
    assert of.blocked_force_x(state) == pytest.approx(0.2 * count)
    assert of.blocked_force_y(state) == 0.0
    assert of.blocked_force_z(state) == pytest.approx(-0.1 * count)


@pytest.mark.parametrize("half", [False, True])
def test_a_held_tip_takes_the_whole_of_a_load_on_it(half):
    """Solved: a traction on the held face goes into the gauge; the clamp at the other end feels nothing."""
    model = replace_loads(question(None, half=half), Traction("tip", (5 * kPa, 0, 0)))
    path = solve(blocked_force(model, hold="zyx", direction="+x"))
    force = 5 * kPa * cases.WIDTH * cases.HEIGHT
    response = measure(path)
    assert response.names[-4:] == ("blocked_force", "blocked_force_x", "blocked_force_y", "blocked_force_z")
    assert response.column("blocked_force")[-1] == pytest.approx(force)
    assert response.column("blocked_force_x") == pytest.approx(force * response.column("load_factor"))
    assert response.column("blocked_force_z")[-1] == pytest.approx(0, abs=1e-9 * force)
    assert path.model.supports[-1] == FixedTip("tip", "xyz", (1.0, 0.0, 0.0))
    against = measure(solve(blocked_force(model, hold="zyx", direction="-x")))
    assert against.column("blocked_force")[-1] == pytest.approx(-force)  # it pulls away from where it is blocked
    assert against.column("blocked_force_x")[-1] == pytest.approx(force)
    again = solve(path.model, path.procedure)  # as on a refined mesh: nothing is added twice
    assert again.model is path.model
    assert measure(again).column("blocked_force")[-1] == pytest.approx(force)


@pytest.mark.parametrize("half", [False, True])
def test_a_tip_on_a_tab_that_turns(half):
    """A beam with a moment on its tip, which is held in z: 3 M / 2 L on a hinge, less 3 E I / (5/6 G A L²) of it for
    shear (Timoshenko). A spring takes k times its angle of the moment, and of the force its share."""
    moment, slender = 1e-4, cases.HEIGHT / cases.LENGTH
    force, turned = {}, {}
    for spring in (0.0, 0.4):
        model = blocked_force(question(None, half=half), hold="z", direction="-z", rotational_spring=spring)
        path = solve(replace_loads(model, Moment("tab", (0, moment, 0))))
        response = measure(path)
        force[spring], turned[spring] = (response.column(each)[-1] for each in ("blocked_force", "tab_rotation_y"))
        if spring:
            assert response.column("tab_reaction_moment_y")[-1] == pytest.approx(-spring * turned[spring], rel=1e-6)
        assert response.column("tab_displacement_z")[-1] == pytest.approx(0, abs=1e-12)
        assert response.column("tab_displacement_x")[-1] != 0, "it slides"
    assert force[0.0] == pytest.approx(1.5 * moment / cases.LENGTH / (1 + 0.9 * slender**2), rel=0.02)
    left = 1 - 0.4 * turned[0.4] / moment
    assert 0.3 < left < 0.7, "the spring counts"
    assert force[0.4] == pytest.approx(left * force[0.0], rel=1e-3)
    assert turned[0.4] == pytest.approx(left * turned[0.0], rel=1e-3)


def test_blocked_force_needs_something_that_blocks():
    model = question(None, WALL)
    with refused("'blocked_force'", "'plate'", "setups.blocked_force"):
        of.blocked_force(cases.state(model))


@pytest.mark.parametrize("fingers", [2, 4])
def test_forces_of_a_grasp(fingers):
    """A half finger is pulled along by 1.5 N and pushed up by 2 N; it resists and presses down as much."""
    bar = replace(BAR, shape=replace(BAR.shape, axis=(1, 0, 0), center=(30 * mm, 0, -25 * mm)))
    setup = Grasp(object="bar", pull_distance=8 * mm, fingers=fingers)
    model = question(setup, bar, half=True)
    state = touching(model, 0.75, bar=touch(model, (1.5, 9.0, 2.0)))
    assert of.holding_force(state) == pytest.approx(2 * fingers * 1.5)
    assert of.grip_force(state) == pytest.approx(2 * 2.0)
    assert of.pull_distance(state) == pytest.approx(4 * mm)


def test_holding_force_needs_a_grasp():
    model = question(None, BAR)
    for each in (of.holding_force, of.grip_force, of.pull_distance):
        with refused(f"'{each.name}'", "setups.grasp"):
            each(cases.state(model))


def test_area_pressure_and_penetration_of_all_contacts():
    model = question(None, WALL, half=True)
    state = touching(
        model,
        wall=touch(model, (1, 0, 0), area=3e-6, pressure=2 * kPa, penetration=4e-6),
        self=touch(model, (0, 0, 0), area=5e-6, pressure=1 * kPa, penetration=9e-6),
    )
    assert of.contact_area(state) == pytest.approx(16e-6)
    assert of.area_on("wall")(state) == pytest.approx(6e-6)
    assert find_measure("self_contact_area")(state) == pytest.approx(10e-6)
    assert of.maximum_contact_pressure(state) == 2 * kPa
    assert of.deepest_penetration(state) == 9e-6


def test_measures_of_obstacles_that_are_not_there():
    model = question(None, WALL)
    with refused("wal_force", "wal", "wall"):
        check_measures(model, [find_measure("wal_force")])
    with refused("blockd_force", "blockd", "blocked_force"):
        check_measures(question(None), [find_measure("blockd_force")])
    with refused("plate_contact_area", "'plate'", "wall"):
        check_measures(model, [find_measure("plate_contact_area")])


ASKED = tuple(each.name for each in STANDARD_MEASURES)
STANDARD = (
    "bending_angle", "tip_displacement", "cavity_volume", "principal_stretch_p99", "base_principal_stretch_p99",
    "body_principal_stretch_p99", "maximum_principal_stretch", "von_mises_p99", "base_von_mises_p99",
    "body_von_mises_p99", "maximum_von_mises", "reaction",
)  # fmt: skip
CONTACT = ("contact_area", "maximum_contact_pressure", "deepest_penetration")


@pytest.mark.parametrize(
    ("setup", "obstacles", "added"),
    [
        (None, (), ()),
        (None, (WALL,), ("wall_force", *CONTACT)),
        (BlockedForce(direction="-z"), (), ("blocked_force", "bearing_distance", *CONTACT)),
        (BlockedForce(hold="z", direction="-z"), (), ("blocked_force",)),
        (BlockedForce(hold="xz", direction="-z"), (), ("blocked_force", "blocked_force_x", "blocked_force_z")),
        (
            Grasp(object="bar", pull_distance=8 * mm),
            (BAR, WALL),
            ("pull_distance", "grip_force", "holding_force", "wall_force", *CONTACT),
        ),
    ],
)
def test_the_standard_response_tells_of_contact_where_there_is_any(setup, obstacles, added):
    path = solved(cases.state(question(setup, *obstacles)))
    assert measure(path).names == ("load_factor", "pressure", *STANDARD, *added)
    asked = [find_measure(name) for name in ASKED]  # as a job asks
    assert measure(path, *asked).names == measure(path).names
    assert measure(path, asked[0]).names == ("load_factor", "pressure", STANDARD[0])


def test_self_contact_is_told_of_where_walls_were_looked_after():
    model = question(None)
    path = solved(cases.state(model, load_factor=0), touching(model, self=touch(model, (0, 0, 0), area=1e-6)))
    response = measure(path)
    assert response.names[-3:] == CONTACT
    assert response.find("contact_area").in_unit == pytest.approx([0, 1])


def test_areas_and_depths_are_written_and_read(tmp_path):
    model = question(None, WALL)
    path = solved(touching(model, wall=touch(model, (1, 0, 0), area=3e-6, penetration=4e-6)))
    response = measure(path)
    response.to_csv(tmp_path / "response.csv")
    again = read_response(tmp_path / "response.csv")
    assert again.names == response.names
    assert again.column("contact_area") == pytest.approx(3e-6)
    assert (again.find("contact_area").unit, again.find("deepest_penetration").unit) == ("mm2", "um")


@pytest.mark.parametrize(
    ("setup", "where", "along"),
    [
        (BlockedForce(direction="-z"), describe.contact, "-z"),
        (BlockedForce(hold="xz", direction="+x"), describe.supports, "+x"),
    ],
)
def test_the_report_names_the_direction_of_the_blocked_force(setup, where, along):
    said = f"; the blocked force is positive along {along}."
    assert any(line.endswith(said) for line in where(question(setup)))


def test_the_force_on_a_body_is_that_on_the_whole_of_it():
    part = meshes.box((10 * mm, 10 * mm, 10 * mm), (1, 1, 1))
    part = meshes.with_faces(part, symmetry_y=part.faces["y0"])
    mesh = together({"cut": part, "off": placed(meshes.box((5 * mm,) * 3, (1, 1, 1)), shift=(20 * mm, 5 * mm, 0))})
    model = Model(mesh, dict.fromkeys(mesh.regions, cases.RUBBER), [Fixed("x0_cut"), Fixed("x0_off")], [])
    for body, expected in (("cut", (0.6, 0.0, 2.0)), ("off", (0.3, 0.2, 1.0))):
        node = int(nodes_of_body(mesh, body)[0])
        state = touching(model, self=touch(model, (0.3, 0.2, 1.0), node))
        assert contact_force(body)(StateFields(state)) == pytest.approx(np.linalg.norm(expected))
