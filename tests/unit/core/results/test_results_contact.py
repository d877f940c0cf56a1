"""Contact in results: fields, files, pictures, plots and the report, from touches made by hand."""

from dataclasses import replace
from types import MappingProxyType

import numpy as np
import pytest
import results_cases as cases
from PIL import Image

from refused import refused
from turgor.core.model.contact import SELF, Contact
from turgor.core.model.loads import Pressure
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Box, Cylinder, Obstacle, Plane, RigidSurface, Sphere
from turgor.core.model.supports import Fixed
from turgor.core.results.drive import pressures_in
from turgor.core.results.fields.contact import contact_results, drawn_obstacles, extents_of, pose_of
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.files.vtu import write_series, write_state
from turgor.core.results.measures.measures import measure
from turgor.core.setups.grasped_object import BetweenFingers
from turgor.core.solvers.solution import Touch
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.units import kPa, mm
from turgor.views.pictures import framing
from turgor.views.pictures.overlays.contact_patches import laid_over
from turgor.views.pictures.overlays.obstacle_skin import obstacle_skin
from turgor.views.pictures.state_picture import shared_view, write_picture
from turgor.views.plots.response_plots import contact_figure
from turgor.views.report.contact_report import CONTACT_HEADS, contact_plot, contact_section
from turgor.views.report.page import Report, write_report

NOWHERE = np.zeros(3)
EXTENT = np.array([[0.0, -10.0, 0.0], [40.0, 10.0, 12.0]]) * mm
GROUND = Obstacle(name="ground", shape=Plane(point=(0, 0, -1 * mm), normal=(0, 0, 1)))
BALL = Obstacle(
    name="ball", shape=Sphere(center=(20 * mm, 0, 20 * mm), radius=6 * mm), path=[(0, (0, 0, 0)), (1, (0, 0, -5 * mm))]
)
WIDTH = 500


def question(*obstacles, half=True):
    mesh = cases.body(half=half)
    materials = dict.fromkeys(mesh.regions, cases.RUBBER)
    loads = [Pressure("cavity", 50 * kPa)]
    return Model(mesh, materials, [Fixed("fixed")], loads, contact=Contact(obstacles=obstacles))


def touch(model, *, force=(0, 0, 0), pressed=None, pressure=0.0, place=NOWHERE, share=0.0):
    """A touch whose force acts on the first pressed node."""
    count = len(model.mesh.points)
    nodes = np.arange(count) if pressed is None else np.flatnonzero(pressed)
    forces, pressures = np.zeros((count, 3)), np.zeros(count)
    forces[nodes[0]] = force
    pressures[nodes] = pressure
    return Touch(force=forces, pressure=pressures, area=3 * mm**2 * (pressure > 0), penetration=4e-6 * (pressure > 0),
                 place=np.asarray(place), share=share)  # fmt: skip


def state(model, touches, factor=1.0):
    return replace(cases.state(model, None, factor), touches=MappingProxyType(touches))


def top(model):
    return model.mesh.points[:, 2] > cases.HEIGHT - 1e-9


@pytest.fixture(scope="module")
def path():
    """A body on the ground with a ball that comes down on it, and walls that meet."""
    model = question(GROUND, BALL)
    low = model.mesh.points[:, 2] < 1e-9
    states = []
    for factor in (0.0, 0.5, 1.0):
        states.append(state(model, {
            "ground": touch(model, force=(0.2 * factor, 5, 0.7 * factor), pressed=low, pressure=2 * kPa * factor),
            "ball": touch(model, force=(0, 0, -3 * factor), pressed=top(model), pressure=8 * kPa * factor,
                          place=(0, 0, -5 * mm * factor), share=0.8),
            SELF: touch(model, force=(0.5 * factor, 0, 0), pressed=low | top(model), pressure=1 * kPa * factor),
        }, factor))  # fmt: skip
    return cases.solution(states)


# --- shapes ------------------------------------------------------------------------------------------------------


def volume(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.einsum("ti,ti->", a, np.cross(b, c)) / 6


def rounded(size, r):
    """Volume of a block with round edges (Steiner)."""
    a, b, c = np.array(size) - 2 * r
    return a * b * c + 2 * r * (a * b + b * c + c * a) + np.pi * r**2 * (a + b + c) + 4 / 3 * np.pi * r**3


SOLID = {
    "sphere": (Sphere(center=(1, 2, 3), radius=0.5), 4 / 3 * np.pi * 0.125),
    "box": (Box(center=(1, 2, 3), size=(1, 2, 3)), 6.0),
    "rounded box": (Box(center=(1, 2, 3), size=(1, 2, 3), rounding=0.2), rounded((1, 2, 3), 0.2)),
    "pill": (Box(center=(1, 2, 3), size=(1, 2, 3), rounding=0.5), rounded((1, 2, 3), 0.5)),
    "cylinder": (Cylinder(center=(1, 2, 3), axis=(0, 1, 1), radius=0.5, length=4), np.pi),
}


@pytest.mark.parametrize("name", SOLID)
def test_outlines_are_closed_face_outward_and_hold_the_volume(name):
    shape, expected = SOLID[name]
    place = np.array([10.0, 0, 0])
    points, triangles = shape.outline(place, EXTENT)
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    assert volume(points, triangles) == pytest.approx(expected, rel=2e-3)  # 96 straight pieces around a circle
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    np.testing.assert_allclose(middle, np.array([1.0, 2, 3]) + place, atol=1e-9)


def test_what_has_no_end_is_drawn_a_little_beyond_the_actuator():
    tilted = Plane(point=(3, 2, 1), normal=(1, 2, 2))
    points, triangles = tilted.outline(np.array([0, 0, 1e-3]), EXTENT)
    np.testing.assert_allclose((points - [3, 2, 1.001]) @ tilted.normal, 0, atol=1e-12)
    a, b, c = points[triangles[0]]
    assert np.cross(b - a, c - a) @ tilted.normal > 0
    flat, _ = Plane(point=(3, 2, -1 * mm), normal=(0, 0, 1)).outline(NOWHERE, EXTENT)
    assert (flat[:, :2].min(axis=0) < EXTENT[0, :2]).all()
    assert (flat[:, :2].max(axis=0) > EXTENT[1, :2]).all()
    assert np.ptp(flat, axis=0).max() < 1.5 * 40 * mm
    bar, _ = Cylinder(center=(7, 0, 0), axis=(1, 0, 0), radius=1 * mm).outline(NOWHERE, EXTENT)
    assert (bar[:, 0].min(), bar[:, 0].max()) == pytest.approx((-6 * mm, 46 * mm))


def test_a_rigid_surface_is_drawn_as_it_is():
    surface = RigidSurface(points=np.eye(3), triangles=np.array([[0, 1, 2]]))
    points, triangles = surface.outline(np.array([0, 0, 2.0]), EXTENT)
    np.testing.assert_array_equal(points, np.eye(3) + [0, 0, 2])
    assert triangles is surface.triangles


# --- what contact does -------------------------------------------------------------------------------------------


def test_forces_and_areas_are_those_of_the_whole_actuator(path):
    itself, ground, ball = contact_results(path.states[-1])
    assert [itself.name, ground.name, ball.name] == [SELF, "ground", "ball"]
    np.testing.assert_allclose(ground.force, [-0.4, 0, -1.4])  # twice, reversed, and nothing across the mirror
    np.testing.assert_allclose(ball.force, [0, 0, 6])
    np.testing.assert_array_equal(itself.force, 0)
    assert itself.pressing == pytest.approx(0.5)  # both halves, each wall with the force of the other
    assert ball.pressing == pytest.approx(6)
    assert (ball.area, ball.pressure, ball.penetration, ball.share) == (6 * mm**2, 8 * kPa, 4e-6, 0.8)
    assert contact_results(cases.state(path.model)) == ()


def test_pressure_at_the_nodes_is_that_of_all_contacts(path):
    at = StateFields(path.states[-1])
    z = path.model.mesh.points[:, 2]
    np.testing.assert_allclose(at.contact_pressure[z < 1e-9], 3 * kPa)
    np.testing.assert_allclose(at.contact_pressure[top(path.model)], 9 * kPa)
    middle = (z > 1e-9) & ~top(path.model)
    np.testing.assert_array_equal(at.contact_pressure[middle], 0)
    np.testing.assert_array_equal(StateFields(cases.state(path.model)).contact_pressure, 0)


def test_obstacles_are_where_the_state_has_them(path):
    at = StateFields(path.states[1])
    np.testing.assert_allclose(pose_of(at, BALL).place, [0, 0, -2.5 * mm])
    sprung = replace(path.states[1], touches={"ball": touch(path.model, place=(1 * mm, 0, 0))})
    np.testing.assert_allclose(pose_of(StateFields(sprung), BALL).place, [1 * mm, 0, 0])
    untouched = cases.state(path.model, None, 0.2)
    np.testing.assert_allclose(pose_of(StateFields(untouched), BALL).place, [0, 0, -1 * mm])


def test_a_turned_plane_is_drawn_as_far_as_the_actuator():
    wall = Obstacle(name="wall", shape=Plane(point=(0, 0, 0), normal=(0, 0, 1)), about=(0, 0, 0),
                    rotation=[(0, (0, 0, 0)), (1, (0, np.pi / 2, 0))])  # fmt: skip
    extent = np.array([[1.0, 2, 3], [2, 3, 9]])
    points, triangles = wall.outline(wall.pose(1.0), extent)
    assert points[:, 0] == pytest.approx(0)
    assert (points[:, 1:].min(axis=0) < [2, 3]).all()
    assert (points[:, 1:].max(axis=0) > [3, 9]).all()
    a, b, c = points[triangles[0]]
    assert np.cross(b - a, c - a)[0] > 0  # the normal has turned from z to x


def test_room_of_the_actuator_and_of_the_face_that_may_touch():
    model = question(replace(GROUND, face="tip"))
    states = [StateFields(cases.state(model, place)) for place in (None, lambda x: x + [0, 0, 3 * mm])]
    result = extents_of(states)
    np.testing.assert_allclose(result[""], EXTENT + [[0, 0, 0], [0, 0, 3 * mm]], atol=1e-12)
    np.testing.assert_allclose(result["tip"][:, 0], 40 * mm)
    np.testing.assert_allclose(result["tip"][:, 1], [-10 * mm, 10 * mm])  # mirrored
    skin = obstacle_skin(states[0], result)
    assert np.ptp(skin.points[:, 0]) < 10 * mm  # a plate under the tip, no floor under everything


def test_mirror_planes_between_fingers_are_no_bodies():
    between = BetweenFingers(name="between_fingers_1", shape=Plane(point=(0, 0, 0), normal=(0, 0, 1)))
    bar = Obstacle(name="between_fingers_bar", shape=Sphere(center=(0, 0, 0), radius=1 * mm))
    drawn = drawn_obstacles(question(GROUND, between, bar))
    assert [each.name for each in drawn] == ["ground", "between_fingers_bar"]  # a name makes no plane


# --- files for ParaView ------------------------------------------------------------------------------------------


def test_files_hold_pressure_and_obstacles_at_their_place(path, tmp_path):
    vtk_io = pytest.importorskip("vtkmodules.vtkIOXML")
    convert = pytest.importorskip("vtkmodules.util.numpy_support").vtk_to_numpy

    def read(name):
        reader = vtk_io.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(tmp_path / name))
        reader.Update()
        assert reader.GetErrorCode() == 0
        return reader.GetOutput()

    assert write_series(tmp_path, path).name == "state.pvd"
    listed = (tmp_path / "state_obstacles.pvd").read_text(encoding="utf-8")
    assert listed.count("<DataSet ") == 3
    assert 'timestep="25" part="0" file="state_obstacles_0001.vtu"' in listed
    grid = read("state_obstacles_0001.vtu")
    points, number = (
        convert(grid.GetPoints().GetData()), convert(grid.GetCellData().GetArray("obstacle")),
    )  # fmt: skip
    force = convert(grid.GetCellData().GetArray("force"))
    numbers = [grid.GetFieldData().GetArray(f"obstacle:{name}") for name in ("ground", "ball")]
    assert [int(convert(each)[0]) for each in numbers] == [0, 1]
    assert grid.GetCellType(0) == 5
    ball = [grid.GetCell(int(k)).GetPointId(0) for k in np.flatnonzero(number == 1)]
    assert points[ball, 2].min() == pytest.approx(20 * mm - 2.5 * mm - 6 * mm, abs=1e-5)
    np.testing.assert_allclose(force[number == 1][0], [0, 0, 3])
    body = read("state_0002.vtu")
    pressure = body.GetPointData().GetArray("contact_pressure")
    assert pressure.GetInformation().Get(pressure.UNITS_LABEL()) == "Pa"
    node = convert(body.GetPointData().GetArray("node"))
    np.testing.assert_allclose(convert(pressure), StateFields(path.states[2]).contact_pressure[node])


def test_files_without_contact_have_neither(tmp_path):
    plain = cases.state(cases.model(cases.body()))
    write_state(tmp_path / "plain.vtu", plain)
    assert "contact_pressure" not in (tmp_path / "plain.vtu").read_text(encoding="utf-8")
    write_series(tmp_path, cases.solution([plain]))
    assert not list(tmp_path.glob("*obstacles*"))


# --- pictures ----------------------------------------------------------------------------------------------------


def drawn(path):
    image = np.asarray(Image.open(path).convert("RGB")).astype(int)
    head, foot = framing.bands(image.shape[1])
    return image[head:-foot]


def colorful(image):
    """How many pixels have a color that neither rubber nor gray has."""
    return int((np.ptp(image, axis=2) > 60).sum())


def test_an_obstacle_before_the_actuator_veils_it_and_one_behind_is_hidden(tmp_path):
    def shot(name, *center, radius):
        obstacles = [Obstacle(name=name, shape=Sphere(center=center, radius=radius))] if center else []
        at = state(question(*obstacles, half=False), {})
        write_picture(tmp_path / f"{name}.png", at, shared_view([at], width=WIDTH))
        return drawn(tmp_path / f"{name}.png")

    alone = shot("alone", radius=0)
    before = shot("before", 20 * mm, -16 * mm, 6 * mm, radius=4 * mm)
    behind = shot("behind", 20 * mm, 16 * mm, 3 * mm, radius=2 * mm)
    np.testing.assert_array_equal(behind, alone)
    changed = np.abs(before - alone).max(axis=2) > 8
    assert changed.sum() > 1000
    body = alone.min(axis=2) < 250
    veiled = before[changed & body].mean() - alone[changed & body].mean()
    assert -90 < veiled < -15  # darker, but what is behind is still seen


def test_obstacles_are_within_the_picture_but_do_not_dwarf_the_actuator(path):
    alone = shared_view([cases.state(question())], width=WIDTH)
    with_ball = shared_view([path.states[0]], width=WIDTH)
    assert with_ball.right - with_ball.left > alone.right - alone.left
    huge = question(Obstacle(name="moon", shape=Sphere(center=(0, 0, -3.0), radius=2.99)))
    around = shared_view([cases.state(huge)], width=WIDTH)
    assert around.right - around.left < 1.7 * (alone.right - alone.left)


def test_an_obstacle_beside_the_mirror_plane_has_an_image():
    aside = Obstacle(name="aside", shape=Sphere(center=(0, 20 * mm, 0), radius=4 * mm))
    for obstacle, copies in ((BALL, 1), (aside, 2)):
        at = StateFields(cases.state(question(obstacle)))
        skin = obstacle_skin(at, extents_of([at]))
        points, _ = obstacle.shape.outline(NOWHERE, EXTENT)
        assert len(skin.points) == copies * len(points)
        np.testing.assert_allclose(np.linalg.norm(skin.normals, axis=1), 1)
    assert obstacle_skin(StateFields(cases.state(question())), {}) is None


def test_edges_of_a_box_are_sharp_and_a_ball_is_smooth():
    at = StateFields(cases.state(question(Obstacle(name="box", shape=Box(center=(0, 0, 0), size=(1, 1, 1))))))
    skin = obstacle_skin(at, extents_of([at]))
    assert (len(skin.points), skin.patch.max() + 1) == (24, 6)
    np.testing.assert_allclose(np.abs(skin.normals).max(axis=1), 1)
    at = StateFields(cases.state(question(BALL)))
    skin = obstacle_skin(at, extents_of([at]))
    assert skin.patch.max() == 0
    away = skin.points - [20 * mm, 0, 15 * mm]
    np.testing.assert_allclose(np.einsum("pi,pi->p", away, skin.normals), 6 * mm, rtol=1e-3)


def test_what_touches_is_seen_through_the_actuator(tmp_path):
    """The pressed lower side faces away from the eye, and its color is seen all the same."""
    model = question()
    x, y, z = model.mesh.points.T
    low = (z < 1e-9) & (x > 1 * mm) & (x < 39 * mm) & (y < 9 * mm)
    pressed = state(model, {SELF: touch(model, pressed=low, pressure=5 * kPa)})
    view = shared_view([pressed], width=WIDTH, color_by="contact_pressure")
    assert view.limit == pytest.approx(5 * kPa)
    write_picture(tmp_path / "pressed.png", pressed, view)
    write_picture(tmp_path / "free.png", cases.state(model), view)
    assert colorful(drawn(tmp_path / "free.png")) == 0
    assert colorful(drawn(tmp_path / "pressed.png")) > 5000
    assert shared_view([cases.state(model)], color_by="contact_pressure").limit == 1 * kPa


def test_of_walls_in_one_place_the_larger_pressure_is_shown():
    """First and second sample: in one place. Third: the averted wall lies elsewhere. Fourth: nothing is above it."""
    averted = np.array([[5.0, 1.0, 5.0, 2.0]]), np.array([[3.0, 3.0, 9.0, 3.0]])
    facing = np.array([[4.0, 4.0, 4.0, 0.0]]), np.array([[3.01, 3.01, 3.0, -7.0]])
    value, place = laid_over(averted, facing, 0.1)
    np.testing.assert_array_equal(value, [[5, 4, 4, 2]])
    np.testing.assert_array_equal(place, [[3.0, 3.01, 3.0, 3.0]])


def test_upper_end_of_the_colors_is_that_of_what_touches():
    """A small patch among a large free surface: its own percentile counts."""
    model = question()
    corner = (np.abs(model.mesh.points - [0, 10 * mm, 0]) < 1e-9).all(axis=1)
    assert corner.sum() == 1
    pressed = state(model, {"x": touch(model, pressed=corner, pressure=7 * kPa)})
    assert 4 * kPa < shared_view([pressed], color_by="contact_pressure").limit <= 7 * kPa


def test_unknown_fields_are_refused(path):
    with refused("contact", "contact_pressure"):
        shared_view([path.states[0]], color_by="contact")


# --- plots and report --------------------------------------------------------------------------------------------


def test_contact_pressure_is_no_drive():
    columns = (Column("load_factor", "", [0]), Column("maximum_contact_pressure", "kPa", [0]),
               Column("cavity_1_pressure", "kPa", [0]))  # fmt: skip
    response = Response(columns=columns, source=Source(text="a test"))
    assert [column.name for column in pressures_in(response)] == ["cavity_1_pressure"]


def test_rows_of_the_report(path):
    rows = {row[0]: dict(zip(CONTACT_HEADS, row, strict=True)) for row in contact_section(path)["contact_rows"]}
    assert list(rows) == ["the actuator with itself", "ground", "ball"]
    ground = rows["ground"]
    assert [ground[f"force {axis} [N]"] for axis in "xyz"] == ["−0.400", "0", "−1.40"]
    assert (ground["force [N]"], ground["area [mm²]"]) == ("1.46", "6.00")
    assert (rows["ball"]["largest pressure [kPa]"], rows["ball"]["deepest penetration [µm]"]) == ("8.00", "4.00")
    assert [rows[name]["of the tolerance [%]"] for name in rows] == ["0", "0", "80"]
    assert (rows["the actuator with itself"]["force x [N]"], rows["the actuator with itself"]["force [N]"]) == (
        "–", "0.500",
    )  # fmt: skip
    assert contact_section(cases.solution([cases.state(path.model)]))["contact_rows"] == []


def test_plot_has_forces_and_areas_against_pressure():
    columns = (
        Column("pressure", "kPa", [0, 1e3]), Column("plate_force", "N", [0, 2]), Column("tip_force", "N", [0, 3]),
        Column("self_contact_area", "mm2", [0, 2e-6]), Column("tip_contact_area", "mm2", [0, 1e-6]),
    )  # fmt: skip
    figure = contact_figure(Response(columns=columns, source=Source(text="a test")))
    forces, areas = figure.axes
    assert (forces.get_xlabel(), forces.get_ylabel()) == ("pressure [kPa]", "force on the obstacle [N]")
    assert areas.get_ylabel() == "contact area [mm²]"
    assert [line.get_label() for line in areas.get_lines()] == ["walls of the actuator", "tip"]
    assert areas.get_lines()[1].get_color() == forces.get_lines()[1].get_color()
    assert areas.get_lines()[0].get_color() not in {line.get_color() for line in forces.get_lines()}
    np.testing.assert_allclose(areas.get_lines()[0].get_ydata(), [0, 2])
    assert contact_figure(Response(columns=columns[:1], source=Source(text="a test"))) is None


def test_report_has_a_section_on_contact(path, tmp_path):
    write_report(tmp_path / "r.html", Report(title="T", solution=path, response=measure(path)))
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "<h2>Contact</h2>" in text
    assert "the actuator with itself" in text
    assert "magnitude of the force of the actuator on the obstacle ball, whole actuator" in text
    assert "contact area" in contact_plot(path)
    free = cases.solution([cases.state(cases.model(cases.body()), None, f) for f in (0.0, 1.0)])
    write_report(tmp_path / "free.html", Report(title="T", solution=free, response=measure(free)))
    assert "<h2>Contact</h2>" not in (tmp_path / "free.html").read_text(encoding="utf-8")
    assert contact_plot(free) == ""
