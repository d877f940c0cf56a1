"""What the studio's worker says of shapes and forms, for every actuator family."""

import tomllib

import numpy as np
import pytest

from turgor.job.job import ACTUATORS
from turgor.job.reference.starters import example_job
from turgor.job.tables.sections import read_actuator
from turgor.job.text.problems import Problems
from turgor.studio.tasks.content import content_of, noted
from turgor.studio.tasks.forms import form_of_actuator
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
    assert len(keys) > 3
    for key in keys:
        low, high, unit = (key["limits"][name] for name in ("low", "high", "unit"))
        for value in np.linspace(low, high, PLACES):
            moved = f"{value:.9g} {unit}" if unit else round(value)
            assert possible({**table, key["name"]: moved}), (key["name"], moved)


def enclosed(corners: np.ndarray) -> float:
    """Volume within triangles (t, 3, 3) whose normals point out of it."""
    return float(np.einsum("ti,ti->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)


@pytest.mark.parametrize("family", ACTUATORS)
def test_images_of_the_picture_close_to_the_whole(family):
    """The triangles that are drawn, with their images, enclose the rubber: no face is missing, none is drawn twice."""
    shape = ACTUATORS[family]().build()
    patches = patches_of(shape)
    scene = patches.scene()
    points = unpack(scene["surface"]["positions"])[0]
    corners = points[unpack(scene["surface"]["triangles"]).reshape(-1, 3)]
    whole = 0.0
    for rows in scene["images"]:
        matrix = np.reshape(rows, (4, 4))
        moved = corners @ matrix[:3, :3].T + matrix[:3, 3]
        whole += enclosed(moved) * np.sign(np.linalg.det(matrix[:3, :3]))
    assert whole == pytest.approx(shape.solid_volume * len(patches.images), rel=FLAT)
    assert set(scene["parts"]["names"]) <= set(shape.faces)
    assert len(unpack(scene["parts"]["of"])) == len(corners)


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
