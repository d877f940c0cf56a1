"""tg.picture, tg.report and tg.write_vtu: from a solution to files, and what they refuse."""

import re

import numpy as np
import pytest
import results_cases as cases
from PIL import Image

import turgor as tg
from refused import refused
from turgor.units import mm


@pytest.fixture(scope="module")
def path():
    question = cases.model(cases.body())
    return cases.solution([cases.state(question, None, 0), cases.state(question, cases.bent(0.8))])


def test_a_picture_of_a_solution_is_written_and_shown(tmp_path, path):
    shown = tg.picture(path, tmp_path / "last.png", width=400)
    assert (tmp_path / "last.png").read_bytes() == shown.png == shown._repr_png_()
    assert Image.open(tmp_path / "last.png").size[0] == 400
    assert repr(shown) == "Picture(caption='box · load factor 1')"
    assert tg.picture(path, state=0, width=400).caption == "box · load factor 0"
    assert tg.picture(path, state=0, width=400).png == tg.picture(path, state=-2, width=400).png
    assert tg.picture(path.states[-1], title="bent", width=400).caption == "bent"


def test_the_picture_of_a_later_state_has_the_outline_of_rest_behind_it(tmp_path, path):
    tg.picture(path, tmp_path / "with.png", width=400, title="")
    tg.picture(path.states[-1], tmp_path / "without.png", width=400, title="")
    light = [light_gray(tmp_path / f"{name}.png") for name in ("with", "without")]
    assert light[0] > light[1] + 100


def light_gray(file):
    image = np.asarray(Image.open(file).convert("RGB")).astype(int)
    return ((np.ptp(image, axis=2) < 20) & (image.mean(axis=2) > 160) & (image.mean(axis=2) < 235)).sum()


def test_pictures_of_a_model_a_mesh_and_a_geometry(path):
    assert tg.picture(path.model, width=400).png == tg.picture(path.model.mesh, width=400).png
    part = tg.FastPneuNet(chambers=2, length=20 * mm).build()
    assert tg.picture(part, width=400).caption == "fast PneuNet, 2 chambers, half"


@pytest.mark.parametrize(
    ("arguments", "facts"),
    [
        ({"state": 2}, ["state", 2, "0 to 1"]),
        ({"path": "last.jpg"}, ["picture 'last.jpg'", "'.jpg'", ".png"]),
        ({"width": 100}, ["width", "100 pixels", "400 or more"]),
        ({"color_by": "stress"}, ["'stress'", "'mean_stress'"]),
    ],
)
def test_bad_pictures_are_refused(path, arguments, facts):
    with refused(*facts):
        tg.picture(path, **({"width": 400} | arguments))


def test_there_is_no_picture_of_anything_else():
    with refused("str", "solution", "geometry"):
        tg.picture("finger.png")


def test_report_has_the_pictures_the_response_and_the_mesh(tmp_path, path):
    assert tg.report(path, tmp_path / "report.html", title="A finger") == tmp_path / "report.html"
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "<title>A finger</title>" in text
    assert len(re.findall("data:image/png;base64", text)) == 1
    assert "At the last state" in text
    assert 'class="viewer"' in text
    assert "bending angle [°]" in text
    assert "264 ten-node tetrahedra" in text


def test_report_refuses_a_response_of_another_path(tmp_path, path):
    other = tg.measure(cases.solution(list(path.states[:1])), tg.bending_angle)
    with refused("1 rows", "2 states"):
        tg.report(path, tmp_path / "report.html", response=other)


def test_vtu_of_a_state_and_of_a_path(tmp_path, path):
    assert tg.write_vtu(path, tmp_path / "fields") == tmp_path / "fields" / "state.pvd"
    assert sorted(file.name for file in (tmp_path / "fields").iterdir()) == [
        "state.pvd",
        "state_0000.vtu",
        "state_0001.vtu",
    ]
    assert tg.write_vtu(path, tmp_path / "more" / "finger.pvd") == tmp_path / "more" / "finger.pvd"
    assert (tmp_path / "more" / "finger_0001.vtu").is_file()
    file = tg.write_vtu(path.states[-1], tmp_path / "one" / "last.vtu")
    assert file.read_bytes() == (tmp_path / "fields" / "state_0001.vtu").read_bytes()


def test_endings_that_do_not_fit_are_refused(tmp_path, path):
    with refused("'.vtu'", "2 states", ".pvd"):
        tg.write_vtu(path, tmp_path / "state.vtu")
    with refused(tmp_path / "state", "''", ".vtu"):
        tg.write_vtu(path.states[0], tmp_path / "state")
