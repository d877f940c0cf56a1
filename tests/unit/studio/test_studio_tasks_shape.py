"""What the studio's worker says of shapes and forms, for every actuator family."""

import tomllib

import numpy as np
import pytest

from turgor.core.geometry.cad.placing.rotate import turned_shape
from turgor.core.geometry.directions import rotation_to
from turgor.core.meshing.generate import mesh
from turgor.core.results.files.mesh_vtu import write_mesh_vtu
from turgor.job.job import ACTUATORS
from turgor.job.reference.starters import example_job
from turgor.job.tables.sections import read_actuator
from turgor.job.text.problems import Problems
from turgor.studio.tasks.content import content_of, noted
from turgor.studio.tasks.forms import LIBRARY, form_of_actuator, forms_of
from turgor.studio.tasks.patches import patches_of
from turgor.studio.tasks.shapes import shape_of
from turgor.views.viewer.packing import unpack

#: Places of a slider that are tried.
PLACES = 17

#: The display of the CAD kernel draws a circle with 36 corners or more: its area is within 0.6 %.
FLAT = 0.02


def actuator_of(family: str) -> dict:
    return tomllib.loads(example_job(family).read_text(encoding="utf-8"))["actuator"]


def possible(table: dict) -> bool:
    problems = Problems("", {})
    read_actuator(table, problems)
    return not problems.entries


@pytest.mark.parametrize("family", ACTUATORS)
def test_every_place_of_every_slider_is_possible(family):
    table = actuator_of(family)
    keys = [key for key in form_of_actuator(table)["keys"] if key["limits"]]
    assert len(keys) >= 3
    for key in keys:
        low, high, unit = (key["limits"][name] for name in ("low", "high", "unit"))
        for value in np.linspace(low, high, PLACES):
            moved = f"{value:.9g} {unit}" if unit else round(value)
            assert possible({**table, key["name"]: moved}), (key["name"], moved)


def enclosed(corners: np.ndarray) -> float:
    """Volume within triangles (t, 3, 3) whose normals point out of it."""
    return float(np.einsum("ti,ti->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)


def whole_of(scene: dict) -> float:
    """Volume within what is drawn, with all images."""
    points = unpack(scene["surface"]["positions"])[0]
    corners = points[unpack(scene["surface"]["triangles"]).reshape(-1, 3)]
    whole = 0.0
    for rows in scene["images"]:
        matrix = np.reshape(rows, (4, 4))
        moved = corners @ matrix[:3, :3].T + matrix[:3, 3]
        whole += enclosed(moved) * np.sign(np.linalg.det(matrix[:3, :3]))
    return whole


@pytest.mark.parametrize("family", ACTUATORS)
def test_images_of_the_picture_close_to_the_whole(family):
    """The triangles that are drawn, with their images, enclose the rubber: no face is missing, none is drawn twice.

    Films enclose their cavity.
    """
    shape = ACTUATORS[family]().build()
    patches = patches_of(shape)
    scene = patches.scene()
    whole = whole_of(scene)
    modeled = shape.solid_volume or sum(shape.cavity_volumes.values())
    assert whole == pytest.approx(modeled * len(patches.images), rel=FLAT)
    assert set(scene["parts"]["names"]) <= set(shape.faces)
    assert 3 * len(unpack(scene["parts"]["of"])) == len(unpack(scene["surface"]["triangles"]).ravel())


def test_facts_are_those_of_the_whole(tmp_path):
    job = tmp_path / "finger.toml"
    job.write_text(example_job("fast_pneunet").read_text(encoding="utf-8"), encoding="utf-8")
    facts = shape_of(job)["facts"]
    half = ACTUATORS["fast_pneunet"]().build()
    assert facts["size"] == pytest.approx([0.11, 0.02, 0.015], rel=1e-6)
    assert facts["cavities"]["cavity"] == pytest.approx(2 * half.cavity_volume)
    assert facts["volume"] == pytest.approx(2 * half.solid_volume)
    assert facts["mass"] == pytest.approx(facts["volume"] * 1130, rel=1e-9)  # the density of the library's Elastosil


def test_problems_are_at_their_keys(tmp_path):
    job = tmp_path / "finger.toml"
    job.write_text('[actuator]\ntype = "fast_pneunet"\nwall = "9 mm"\ngap = "1 furlong"\n', encoding="utf-8")
    content, problems = content_of(job)
    read_actuator(content["actuator"], problems)
    assert [each["key"] for each in noted(problems)] == ["actuator.gap"]
    shape = shape_of(job)
    assert [each["key"] for each in shape["problems"]] == ["actuator.gap"]
    assert "scene" not in shape
    assert shape["form"]["keys"]


def test_layer_may_be_chosen_from_the_library_on_any_part(tmp_path):
    job = tmp_path / "tube.toml"
    job.write_text(example_job("twisting_tube").read_text(encoding="utf-8"), encoding="utf-8")
    forms = forms_of(job, (LIBRARY,))
    assert "strain_limiting_layer" not in forms["faces"]
    (table,) = forms["tables"]
    assert "paper" in next(key["choices"] for key in table["keys"] if key["name"] == "library")
    assert forms["problems"] == []


def test_mesh_is_shown_as_the_whole(tmp_path):
    half = ACTUATORS["rectangular_bender"]().build()
    write_mesh_vtu(tmp_path / "bender.vtu", mesh(half, size=6e-3))
    job = tmp_path / "bender.toml"
    job.write_text('[mesh]\nfile = "bender.vtu"\n', encoding="utf-8")
    shape = shape_of(job)
    assert shape["problems"] == []
    assert shape["kind"] == "mesh_file"
    assert shape["facts"]["volume"] == pytest.approx(2 * half.solid_volume, rel=1e-3)
    assert len(shape["scene"]["images"]) == 2
    assert whole_of(shape["scene"]) == pytest.approx(2 * half.solid_volume, rel=1e-3)


def test_part_is_named_as_in_its_file_and_loaded_as_it_is_modeled(tmp_path):
    """A finger that lies along z in its file, with fixed and tip: loads and gravity are along our axes."""
    finger = ACTUATORS["rectangular_bender"](symmetric=False).build()
    turned_shape(finger.shape, rotation_to(("z", "x", "y"))).WriteStep(str(tmp_path / "finger.step"))
    job = tmp_path / "finger.toml"
    job.write_text('[actuator]\ntype = "cad_file"\nfile = "finger.step"\n', encoding="utf-8")
    in_file, modeled = shape_of(job), shape_of(job, modeled=True)
    assert modeled["facts"]["size"][0] == pytest.approx(max(in_file["facts"]["size"]), rel=1e-6)
    assert in_file["facts"]["size"][0] < max(in_file["facts"]["size"]) / 2
    assert in_file["facts"]["volume"] == pytest.approx(modeled["facts"]["volume"], rel=1e-9)
    assert {each["name"] for each in in_file["faces"]} >= {"fixed", "tip", "cavity"}
    assert whole_of(in_file["scene"]) == pytest.approx(whole_of(modeled["scene"]), rel=1e-3)
