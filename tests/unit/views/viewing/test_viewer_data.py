"""Viewer: what the page holds equals the states within the quantization, and long paths are thinned out."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
import results_cases as cases

import turgor as tg
from refused import refused
from turgor.core.model.contact import Contact
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.model.obstacles import Obstacle, Sphere
from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.results.measures.measures import measure
from turgor.core.results.measures.standard_measures import bending_angle
from turgor.core.solvers.solution import Touch
from turgor.units import kPa, mm
from turgor.views.pictures.skin import drawn_triangles
from turgor.views.viewer.packing import MOST, pack_index, pack_steps, unpack
from turgor.views.viewer.scene import chosen_steps, scene_of
from turgor.views.viewer.settings import VIEWER
from turgor.views.viewer.surface import surface_of


@pytest.fixture(scope="module")
def half():
    model = cases.model(cases.body(half=True))
    return cases.solution([cases.state(model, cases.bent(1.5 * f), f) for f in (0.0, 0.4, 1.0)])


@pytest.fixture(scope="module")
def scene(half):
    return scene_of(half, response_of(half))


def response_of(path):
    return measure(path, bending_angle)


def test_numbers_along_a_path_come_back_within_half_a_step_of_16_bits():
    values = np.random.default_rng(1).normal(size=(5, 40, 3)) * [1e-3, 1, 1e6]
    result = unpack(pack_steps(values))
    assert result.shape == values.shape
    assert (np.abs(result - values) <= 0.5001 * np.ptp(values, axis=(0, 1)) / MOST).all()
    level = np.full((2, 3, 1), 7.0)
    np.testing.assert_array_equal(unpack(pack_steps(level)), level)


def test_whole_numbers_come_back_exactly():
    numbers = np.random.default_rng(2).integers(0, 2_000_000, size=(30, 6))
    np.testing.assert_array_equal(unpack(pack_index(numbers)), numbers)


def test_steps_that_hardly_differ_shrink():
    rest = np.random.default_rng(3).normal(size=(1, 2000, 3))
    path = rest + 1e-3 * np.arange(20)[:, None, None]
    assert len(pack_steps(path)["data"]) < 0.35 * len(pack_steps(rest + 0 * path)["data"]) * 20
    assert len(pack_steps(path)["data"]) < 3.5 * len(pack_steps(rest)["data"])


def test_the_page_holds_the_positions_and_fields_of_every_state(half, scene):
    surface = surface_of(StateFields(half.states[0], MeshFacts(half.model.mesh)))
    held = unpack(scene.values["surface"]["positions"])
    fields = {each["key"]: each for each in scene.values["fields"]}
    assert list(fields) == ["von_mises", "stretch", "principal_stress", "displacement"]
    assert fields["displacement"]["data"] is None  # the page finds it from the positions
    for k, state in enumerate(half.states):
        at = StateFields(state)
        assert np.abs(held[k] - at.points[surface.node]).max() < 0.51 * np.ptp(held, axis=(0, 1)).max() / MOST
        stress = unpack(fields["von_mises"]["data"])
        wanted = surface.pick(at.von_mises) / kPa
        assert np.abs(stress[k, :, 0] - wanted).max() < 0.51 * np.ptp(stress) / MOST
        stretch = unpack(fields["stretch"]["data"])[k, :, 0]
        np.testing.assert_allclose(stretch, surface.pick(at.stretch), atol=1e-5)


def test_the_surface_is_that_of_the_part_without_its_cut(half, scene):
    mesh, surface = half.model.mesh, surface_of(StateFields(half.states[0]))
    on_plane = np.isin(surface.node, mesh.face_nodes("symmetry_y"))
    np.testing.assert_array_equal(surface.cut == 1, on_plane)
    assert not (surface.cut[surface.triangles] == 1).all(axis=1).any()
    triangles = unpack(scene.values["surface"]["triangles"])
    np.testing.assert_array_equal(triangles, surface.triangles)
    corners = mesh.points[surface.node[triangles[:, :3]]]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    L, W, H = cases.LENGTH, cases.WIDTH / 2, cases.HEIGHT
    hole = 2 * (L / 2 * W / 2) + H / 3 * (L / 2 + 2 * W / 2)  # two bricks long, one wide in the half, a third high
    assert area == pytest.approx(2 * (L * W + W * H) + L * H + hole)


def test_a_vertex_has_the_value_of_the_region_behind_it(half):
    at = StateFields(half.states[0])
    surface, nodes = surface_of(at), at.facts.region_nodes
    assert len(nodes.region) > len(half.model.mesh.points)  # base and body meet
    behind = drawn_triangles(half.model.mesh)[1]
    np.testing.assert_array_equal(surface.pick(nodes.region)[surface.triangles], np.tile(behind[:, None], 6))


def test_images_make_the_whole(half, scene):
    shifted = cases.model(cases.body(half=True, shift=3 * mm))
    (_, away) = scene_of(cases.solution([cases.state(shifted)])).values["images"]
    np.testing.assert_allclose(np.reshape(away, (4, 4)) @ [0, 5 * mm, 0, 1], [0, 1 * mm, 0, 1])
    own, mirrored = (np.reshape(rows, (4, 4)) for rows in scene.values["images"])
    np.testing.assert_allclose(own, np.eye(4))
    np.testing.assert_allclose(mirrored, np.diag([1, -1, 1, 1]))


def test_a_curve_goes_with_the_states(half, scene):
    curves = scene.values["curves"]
    assert (curves["x"]["label"], curves["y"][0]["label"]) == ("pressure [kPa]", "bending angle [°]")
    assert curves["y"][0]["values"][-1] == pytest.approx(85.94, abs=0.01)
    assert curves["steps"] == [0, 1, 2]
    assert scene.values["steps"][-1]["label"] == "50 kPa · bending angle 85.9°"


def test_fibers_obstacles_and_contact(half):
    mesh = half.model.mesh
    thread = Fibers(face="outside", material=tg.from_library("kevlar-fiber"), diameter=0.2 * mm,
                    winding=Winding(angle_from_axis=np.pi / 2, spacing=10 * mm, hand="right"))  # fmt: skip
    ball = Obstacle(shape=Sphere(center=(20 * mm, 0, -8 * mm), radius=6 * mm), name="ball",
                    path=((0, (0, 0, 0)), (1, (0, 0, 2 * mm))))  # fmt: skip
    model = replace(half.model, contact=Contact(obstacles=(ball,)), reinforcements=(thread,))
    pressed = np.where(mesh.points[:, 2] < 1e-9, 3 * kPa, 0.0)
    touch = Touch(force=np.zeros_like(mesh.points), pressure=pressed, area=1e-6, penetration=0.0,
                  place=np.array([0, 0, 2 * mm]), share=0.0)  # fmt: skip
    first, last = cases.state(model, None, 0), cases.state(model, None, 1)
    result = scene_of(cases.solution([first, replace(last, touches={"ball": touch})])).values
    places = unpack(result["obstacles"]["positions"])
    np.testing.assert_allclose(np.diff(places, axis=0)[0], np.broadcast_to([0, 0, 2 * mm], places[0].shape), atol=1e-6)
    contact = next(each for each in result["fields"] if each["key"] == "contact_pressure")
    assert contact["high"] == pytest.approx(3)
    assert unpack(contact["data"]).max() == pytest.approx(3)
    lengths = unpack(result["threads"]["lengths"])
    assert lengths.sum() == result["threads"]["positions"]["shape"][1] > 0


def test_long_paths_and_large_surfaces_are_thinned_out():
    assert chosen_steps(3, 10) == [0, 1, 2]
    for count, vertices in ((500, 5_000), (30, 150_000), (7, 10**7)):
        steps = chosen_steps(count, vertices)
        assert steps[0] == 0 and steps[-1] == count - 1
        assert np.ptp(np.diff(steps)) <= 1
        assert len(steps) == 2 or 2 * vertices * 7 * len(steps) <= VIEWER.part_bytes


def test_a_long_path_says_what_is_left_out(half):
    path = replace(half, states=tuple(half.states[k % 3] for k in range(100)))
    result = scene_of(path)
    assert len(result.steps) == 40
    assert result.notes == ("The viewer shows 40 of 100 states, to keep the page small.",)


def test_a_scene_that_is_too_large_leaves_out_steps(half):
    path = replace(half, states=tuple(half.states[k % 3] for k in range(9)))
    whole = sum(len(each["data"]["data"]) for each in scene_of(path).values["fields"] if each["data"])
    result = scene_of(path, most_text=whole)
    assert len(result.steps) < 9
    assert result.steps[0] == 0 and result.steps[-1] == 8


def test_the_face_of_a_cut_has_all_of_the_body(half, scene):
    """The tetrahedra inside fill the volume of the modeled part, whichever step."""
    corners = unpack(scene.values["inside"]["positions"])[:, unpack(scene.values["inside"]["tetrahedra"])]
    sides = corners[:, :, 1:] - corners[:, :, :1]
    volume = np.abs(np.linalg.det(sides)).sum(axis=1) / 6
    L, W, H = cases.LENGTH, cases.WIDTH / 2, cases.HEIGHT
    np.testing.assert_allclose(volume, L * W * H - L / 2 * W / 2 * H / 3, rtol=1e-2)  # straight sides


def test_a_page_needs_no_other_and_a_notebook_shows_it(half, tmp_path):
    shown = tg.pictures.viewer(half)
    file = shown.save(tmp_path / "v.html")
    text = file.read_text(encoding="utf-8")
    assert file.stat().st_size < 900_000
    assert not re.search(r"<(script|link|img|iframe)[^>]*\b(src|href)=", text)
    assert set(re.findall(r"https?://[\w./-]+", text)) <= {
        "http://www.w3.org/1999/xhtml", "http://www.w3.org/2000/svg",
    }  # fmt: skip
    values = re.search(r'<script type="application/json">(.*?)</script>', text, re.DOTALL)[1]
    assert len(json.loads(values)["steps"]) == 3
    assert shown._repr_html_().startswith("<iframe srcdoc=")
    assert repr(shown) == "Viewer(title='box')"


def test_bad_viewers_are_refused(half, tmp_path):
    with refused(tmp_path / "v.png", "'.png'", ".html"):
        tg.pictures.viewer(half).save(tmp_path / "v.png")
    with refused("3 rows", "2 states"):
        tg.pictures.viewer(replace(half, states=half.states[:2]), response=response_of(half))
    with refused("viewer", "state"):
        tg.pictures.viewer(replace(half, states=()))


def test_the_page_goes_on_between_states_where_every_other_one_follows_from_the_rest():
    model = cases.model(cases.body(half=True))

    def path(angles, shares=None):
        shares = np.linspace(0, 1, len(angles)) if shares is None else shares
        return cases.solution([cases.state(model, cases.bent(a), f) for a, f in zip(angles, shares, strict=True)])

    smooth = scene_of(path(np.linspace(0, 4, 9)))
    assert smooth.values["places"] == pytest.approx(np.linspace(0, 1, 9))
    stated = float(re.search(r"within ([0-9.]+) %", " ".join(smooth.notes)).group(1))
    assert 0.01 < stated < 1.0
    snapping = scene_of(path([0, 0.1, 0.2, 0.3, 2.5, 2.6, 2.7, 2.8, 2.9]))
    assert snapping.values["places"] is None
    assert "cubics" not in " ".join(snapping.notes)
    back = scene_of(path(np.linspace(0, 1, 7), [0, 0.2, 0.4, 0.6, 0.5, 0.8, 1]))
    assert back.values["places"] is None
    assert scene_of(path(np.linspace(0, 1, 5))).values["places"] is None


def test_a_cable_of_a_later_stage_is_a_point_before():
    mesh = cases.body()
    ends = [mesh.points[mesh.face_nodes("tip")[k]] for k in (0, -1)]
    cable = tg.loads.Tendon(through=ends, tension=1.0)
    models = [cases.model(mesh), replace(cases.model(mesh), loads=(cable,))]
    path = cases.solution([cases.state(each, cases.bent(f), f) for each, f in zip(models, (0.0, 1.0), strict=True)])
    threads = scene_of(path).values["threads"]
    before, after = unpack(threads["positions"])
    assert unpack(threads["lengths"]).tolist() == [2]
    assert np.ptp(before, axis=0) == pytest.approx(np.zeros(3), abs=1e-6)
    assert np.linalg.norm(after[1] - after[0]) > 1e-3
