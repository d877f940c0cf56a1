"""Measures: numbers of states whose answer is known by formula; a half model answers for the whole actuator."""

from dataclasses import replace

import numpy as np
import pytest
import results_cases as cases

import meshes
from refused import refused
from turgor.core.engine.faces import surfaces
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.loads import Traction
from turgor.core.model.model import Model
from turgor.core.model.supports import Fixed, Radial
from turgor.core.results.fields import state_fields as fields
from turgor.core.results.measures import field_measures, measures
from turgor.core.results.measures import standard_measures as standard
from turgor.core.results.measures.measures import Measure, check_measures, find_measure, measure
from turgor.core.solvers.solution import Status
from turgor.core.solvers.solve import solve
from turgor.units import deg, kPa, mL, mm

STRETCH = 1.3


@pytest.mark.parametrize("half", [False, True])
@pytest.mark.parametrize("angle", [-60, 0, 30, 120, 179])
def test_bending_angle_of_a_circle(half, angle):
    state = cases.state(cases.model(cases.body(half=half)), cases.bent(angle * deg))
    assert standard.bending_angle(state) / deg == pytest.approx(angle, abs=1e-2)  # quadratic faces of a curved body


@pytest.mark.parametrize("half", [False, True])
@pytest.mark.parametrize("angle", [-60, 30, 120])
def test_chord_angle_of_a_circle_is_half_of_it(half, angle):
    state = cases.state(cases.model(cases.body(half=half)), cases.bent(angle * deg))
    assert find_measure("chord_angle")(state) / deg == pytest.approx(angle / 2, abs=1e-2)


def test_bending_angle_ignores_a_turn_of_the_whole_actuator():
    """The base may turn: what counts is the tip against it."""
    c, s = np.cos(50 * deg), np.sin(50 * deg)
    turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    bend = cases.bent(40 * deg)
    state = cases.state(cases.model(cases.body()), lambda X: bend(X) @ turn.T)
    assert standard.bending_angle(state) / deg == pytest.approx(40, abs=1e-2)


def test_bending_angle_continues_past_half_a_turn():
    model = cases.model(cases.body())
    path = [cases.state(model, cases.bent(a * deg), a / 400) for a in (0, 100, 200, 300, 400)]
    response = measure(cases.solution(path), standard.bending_angle)
    assert response.column("bending_angle") / deg == pytest.approx([0, 100, 200, 300, 400], abs=0.1)


def test_tip_displacement_is_the_mean_over_the_area():
    """The tip moves in proportion to z²: over a height h the mean of z² is h²/3, whatever the nodes."""
    state = cases.state(cases.model(cases.body()), lambda X: X + np.outer(X[:, 2] ** 2, [30.0, 0.0, -40.0]))
    mean = cases.HEIGHT**2 / 3
    assert standard.tip_displacement(state) == pytest.approx(50 * mean)
    assert standard.tip_displacement_x(state) == pytest.approx(30 * mean)
    assert standard.tip_displacement_z(state) == pytest.approx(-40 * mean)


def test_tip_displacement_of_a_half_leaves_out_what_its_mirror_image_cancels():
    """A half that gets thinner moves towards the mirror plane; the whole tip does not."""
    half = cases.state(cases.model(cases.body(half=True)), lambda X: X * [1.0, 0.5, 1.0])
    assert standard.tip_displacement(half) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("half", [False, True])
@pytest.mark.parametrize("shift", [0.0, 7 * mm])
def test_cavity_volume(half, shift):
    """At rest the hollow is 2 x 2 x 1 bricks; stretched by 2 about the mirror plane, wherever that lies, it doubles."""
    model = cases.model(cases.body(half=half, shift=shift))
    hollow = cases.LENGTH / 2 * cases.WIDTH / 2 * cases.HEIGHT / 3
    assert standard.cavity_volume(cases.state(model)) == pytest.approx(hollow)
    wider = cases.state(model, lambda X: (X - [0, shift, 0]) * [1, 2, 1] + [0, shift, 0])
    assert standard.cavity_volume(wider) == pytest.approx(2 * hollow)


def test_open_cavity_has_no_volume():
    mesh = cases.body(half=True)
    faces = {**mesh.faces, "cavity": mesh.faces["cavity"][1:]}
    state = cases.state(cases.model(Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces)))
    with refused("cavity_volume", "3 edges", "inlet"):
        standard.cavity_volume(state)


def test_several_cavities_are_summed():
    mesh = cases.body()
    cavity = mesh.faces["cavity"]
    faces = {**mesh.faces, "cavity": cavity[:10], "cavity_2": cavity[10:]}
    both = cases.model(Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces))
    one = cases.state(cases.model(mesh))
    assert standard.cavity_volume(cases.state(both)) == pytest.approx(standard.cavity_volume(one))


def test_stretch_and_von_mises_of_uniaxial_tension():
    """Neo-Hooke: the von Mises stress is the principal stress difference, mu (s² − 1/s), at any mean stress."""
    state = cases.state(cases.model(cases.body()), cases.stretched(STRETCH))
    state = replace(state, mean_stress=np.linspace(-1e6, 1e6, len(state.mean_stress)))
    assert field_measures.maximum_principal_stretch(state) == pytest.approx(STRETCH)
    expected = cases.RUBBER.law.shear_modulus * (STRETCH**2 - 1 / STRETCH)
    assert field_measures.maximum_von_mises(state) == pytest.approx(expected)


def test_maximum_is_taken_at_quadrature_points_and_not_averaged():
    """One node moved: the largest stretch is that of the worst point of its cells."""
    model = cases.model(cases.body())
    at = fields.StateFields(cases.state(model, lambda X: X + 1e-3 * (np.arange(len(X)) == 0)[:, None]))
    assert field_measures.maximum_principal_stretch(at) == at.cells.stretch.max()
    assert at.cells.stretch.max() > at.stretch.max() * 1.001


def test_reaction_sums_each_node_once_and_only_what_is_held():
    mesh = cases.body()
    model = Model(mesh, {"body": cases.RUBBER, "base": cases.RUBBER}, [Fixed("fixed"), Fixed("fixed", "x")], [])
    force = np.zeros_like(mesh.points)
    force[mesh.face_nodes("fixed")] = [3.0, 0.0, 4.0]
    force[mesh.face_nodes("tip")] = 100.0  # held by nothing
    state = replace(cases.state(model), nodal_force=force)
    assert standard.reaction(state) == pytest.approx(5.0 * len(mesh.face_nodes("fixed")))
    rolling = replace(state, model=Model(mesh, model.materials, [Fixed("fixed", "x")], []))
    assert standard.reaction(rolling) == pytest.approx(3.0 * len(mesh.face_nodes("fixed")))


def test_reaction_of_a_half_is_that_of_the_whole():
    mesh = cases.body(half=True)
    force = np.zeros_like(mesh.points)
    force[mesh.face_nodes("fixed")[0]] = [3.0, 12.0, 4.0]  # along y its mirror image pulls the other way
    state = replace(cases.state(cases.model(mesh)), nodal_force=force)
    assert standard.reaction(state) == pytest.approx(2 * 5.0)


def test_reaction_without_support_is_refused():
    mesh = cases.body()
    state = cases.state(Model(mesh, {"body": cases.RUBBER, "base": cases.RUBBER}, [], []))
    with refused("reaction", "Fixed", "Radial", "Roller", "Foundation"):
        standard.reaction(state)


def test_smallest_gap_is_infinite_without_facing_walls():
    assert standard.smallest_gap(cases.state(cases.model(cases.body()))) == np.inf


def test_response_begins_with_the_drive():
    model = cases.model(cases.body(), pressure=50 * kPa)
    path = [cases.state(model, cases.stretched(1 + f), f) for f in (0.0, 0.4, 1.0)]
    response = measure(cases.solution(path, Status.LIMIT_POINT), standard.cavity_volume)
    assert response.names == ("load_factor", "pressure", "cavity_volume")
    assert response.column("pressure") == pytest.approx([0, 20e3, 50e3])
    assert response.column("cavity_volume") / mL == pytest.approx([0.8] * 3)
    assert (response.status, response.message) == ("limit_point", "Reached 50 kPa.")
    assert "box" in str(response.source)


def test_without_pressure_the_load_factor_alone_drives():
    model = cases.model(cases.body(hollow=False))
    response = measure(cases.solution([cases.state(model)]), standard.tip_displacement)
    assert response.names == ("load_factor", "tip_displacement")


def test_measures_are_given_themselves_or_by_name():
    solution = cases.solution([cases.state(cases.model(cases.body()))])
    by_name, itself = measure(solution, "tip_displacement"), measure(solution, standard.tip_displacement)
    assert by_name.column("tip_displacement") == itself.column("tip_displacement")
    with refused("tip_displacment", "tip_displacement"):
        measure(solution, "tip_displacment")
    with refused(3, "tg.measures"):
        measure(solution, 3)


def test_standard_measures_are_those_that_the_part_has():
    mesh = cases.body(hollow=False)
    faces = {name: sides for name, sides in mesh.faces.items() if name != "tip"}
    other = Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces)
    model = Model(other, {"body": cases.RUBBER, "base": cases.RUBBER}, [Fixed("fixed")], [])
    names = measure(cases.solution([cases.state(model)])).names
    assert not {"bending_angle", "tip_displacement", "cavity_volume"} & set(names)
    assert {"von_mises_p99", "reaction"} <= set(names)


def test_a_part_along_another_axis_has_no_bending_angle_unless_it_is_requested():
    mesh, rubber = cases.body(hollow=False), {"body": cases.RUBBER, "base": cases.RUBBER}
    across = replace(mesh, points=mesh.points @ np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]]))  # along y
    model = Model(across, rubber, [Fixed("fixed")], [])
    check_measures(model, standard.STANDARD_MEASURES)
    check_measures(model, measures.fitting_measures(across.faces))  # those that a job takes by itself
    names = measure(cases.solution([cases.state(model, load_factor=0), cases.state(model)])).names
    assert "bending_angle" not in names and "tip_displacement" in names
    with refused("bending_angle", "x-z plane"):
        check_measures(model, ["bending_angle"])
    along = Model(mesh, rubber, [Fixed("fixed")], [])
    assert "bending_angle" in measure(cases.solution([cases.state(along)])).names


def test_standard_measures_and_fields_computed_once_a_state(monkeypatch):
    model = cases.model(cases.body(half=True))
    calls = []
    original = fields.cell_fields
    monkeypatch.setattr(fields, "cell_fields", lambda *a: calls.append(1) or original(*a))
    response = measure(cases.solution([cases.state(model, load_factor=0.0), cases.state(model)]))
    assert response.names == (
        "load_factor", "pressure", "bending_angle", "tip_displacement", "cavity_volume", "principal_stretch_p99",
        "base_principal_stretch_p99", "body_principal_stretch_p99", "maximum_principal_stretch", "von_mises_p99",
        "base_von_mises_p99", "body_von_mises_p99", "maximum_von_mises", "reaction",
    )  # fmt: skip
    assert len(calls) == 2


def test_a_path_that_grows_is_measured_once_a_state_where_regions_have_columns_of_their_own(monkeypatch):
    model = cases.model(cases.body(half=True))
    states = [cases.state(model, load_factor=0.0), cases.state(model)]
    calls = []
    original = fields.cell_fields
    monkeypatch.setattr(fields, "cell_fields", lambda *a: calls.append(1) or original(*a))
    reader = measures.Reader()
    reader.response(cases.solution(states[:1]))
    grown = reader.response(cases.solution(states))
    assert "base_von_mises_p99" in grown.names
    assert len(calls) == 2


@pytest.mark.parametrize(
    ("face", "measured"), [("tip", standard.bending_angle), ("tip", standard.tip_displacement),
                           ("fixed", standard.bending_angle), ("cavity", standard.cavity_volume)],
)  # fmt: skip
def test_missing_face_names_the_measure_before_the_solve(face, measured):
    mesh = cases.body()
    faces = {("end" if name == face else name): triangles for name, triangles in mesh.faces.items()}
    other = Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces)
    model = Model(other, {"body": cases.RUBBER, "base": cases.RUBBER}, [Fixed("outside")], [])
    with refused(f"'{measured.name}'", f"'{face}'", "end"):
        check_measures(model, [measured])


def test_own_measure():
    def rise(at):
        return at.displacement[:, 2].max()

    highest = Measure(name="rise", unit="mm", function=rise, definition="largest displacement along z")
    model = cases.model(cases.body())
    response = measure(cases.solution([cases.state(model, lambda X: X + [0, 0, 2 * mm])]), highest)
    assert response.find("rise").in_unit[0] == pytest.approx(2.0)
    assert highest.text(2 * mm) == "2 mm"


def test_measure_refuses_an_unknown_unit_and_an_unknown_name():
    with refused("rise", "mmm", "mm"):
        Measure(name="rise", unit="mmm", function=lambda at: 0.0, definition="")
    with refused("bending_angel", "bending_angle"):
        find_measure("bending_angel")


def test_reaction_counts_radial_supports():
    """Solved: a tube is pushed sideways from within; what holds its outside and one end takes the whole of the load."""

    def place(parameters):
        r, angle = 3 * mm + 2 * mm * parameters[:, 0], 2 * np.pi * parameters[:, 1]
        return np.column_stack([r * np.cos(angle), r * np.sin(angle), 2 * mm * parameters[:, 2]])

    names = {"x0": "inside", "x1": "outside", "z0": "fixed", "z1": "end"}
    tube = meshes.glued([meshes.Block((1, 8, 1), place, names)])
    push = Traction("inside", (2 * kPa, 1 * kPa, 0.5 * kPa))
    held = [Fixed("fixed"), Radial("outside", axis=(0, 0, 1))]
    result = solve(Model(tube, {"body": cases.RUBBER}, held, [push])).states[-1]
    load = surfaces.area(tube.points, tube.face("inside")) * np.linalg.norm(push.vector)
    assert standard.reaction(result) == pytest.approx(load, rel=1e-6)
    free = replace(result.model, supports=held[:1])
    assert standard.reaction(replace(result, model=free)) < 0.7 * load  # the rest is what the outside takes
