"""Series of pictures, motion and presets: files that other programs read, with the shapes and sizes they must have."""

import itertools
import json
import struct
import sys

import numpy as np
import pytest
import results_cases as cases
from matplotlib.figure import Figure
from PIL import Image

import turgor as tg
from refused import refused
from turgor.core.results.fields.state_fields import StateFields
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.views.pictures.colors import FIELDS
from turgor.views.pictures.series.frames import frames
from turgor.views.pictures.series.motion import moving_pictures
from turgor.views.pictures.series.sheets import spread

SHORT = tg.pictures.Motion(seconds=0.5, rate=8, width=400)


@pytest.fixture(scope="module")
def path():
    model = cases.model(cases.body(half=True))
    return cases.solution([cases.state(model, cases.bent(1.2 * f), f) for f in (0.0, 0.3, 0.5, 1.0)])


def test_states_are_spread_evenly_with_both_ends(path):
    assert spread(path, 3) == [0, 2, 3]
    assert spread(path, 9) == [0, 1, 2, 3]


def test_small_multiples_and_two_designs_share_scale_and_colors(tmp_path, path):
    tg.pictures.small_multiples(path, tmp_path / "path.png", count=4, width=1600)
    image = Image.open(tmp_path / "path.png")
    assert 1200 < image.width <= 1720
    soft = cases.state(cases.model(cases.body()), cases.stretched(1.5))
    tg.pictures.side_by_side({"bent": path, "stretched": soft}, tmp_path / "two.png", width=900)
    two = np.asarray(Image.open(tmp_path / "two.png").convert("RGB")).astype(int)
    parts = np.flatnonzero((two[100:-120] < 250).any(axis=(0, 2)))
    gap = np.diff(parts).max()
    assert gap > 20  # two actuators, and white between them
    with refused("1 captions", "2 states"):
        tg.pictures.write_sheet(tmp_path / "a.png", path.states[:2], ["rest"])
    with refused("count", 1, 2):
        tg.pictures.small_multiples(path, tmp_path / "a.png", count=1)


def test_frames_pass_through_the_states_and_move_evenly(path):
    shapes = list(frames(path, FIELDS["von_mises"], 41))
    ways = [np.linalg.norm(b.displacement - a.displacement) for a, b in itertools.pairwise(shapes)]
    assert max(ways) < 1.5 * min(ways)
    near = min(np.abs(shape.displacement - path.states[2].displacement).max() for shape in shapes)
    assert near < 0.02 * np.abs(path.states[2].displacement).max()
    exact = StateFields(path.states[-1]).von_mises
    assert FIELDS["von_mises"].read(shapes[-1]) == pytest.approx(exact)


def test_gif_and_webp_have_all_pictures_of_one_size(tmp_path, path):
    for ending in ("gif", "webp"):
        file = tg.pictures.write_motion(tmp_path / f"m.{ending}", path, motion=SHORT)
        image = Image.open(file)
        assert image.n_frames == 4 + 2  # there, and back without the ends
        assert image.width == 400
    assert len({each.shape for each in moving_pictures(path, motion=SHORT)}) == 1


def test_the_fixed_end_stays_where_it_is():
    """The tip rises, so that pictures get taller upwards; the corner at the clamp is at the same pixels in all."""
    model = cases.model(cases.body(half=True))
    path = cases.solution([cases.state(model, cases.bent(-1.2 * f), f) for f in (0.0, 0.5, 1.0)])
    corners = []
    for each in moving_pictures(path, motion=SHORT):
        body = (each < 250).any(axis=2)
        left = np.flatnonzero(body.any(axis=0))[0]
        corners.append((left, np.flatnonzero(body[:, left : left + 8].any(axis=1))[-1]))
    assert np.ptp(corners, axis=0).max() <= 2


def test_mp4_is_read_again(tmp_path, path):
    cv2 = pytest.importorskip("cv2")
    file = tg.pictures.write_motion(tmp_path / "m.mp4", path, motion=SHORT)
    read = cv2.VideoCapture(str(file))
    assert read.get(cv2.CAP_PROP_FRAME_COUNT) == 4 + 3
    assert read.get(cv2.CAP_PROP_FRAME_WIDTH) == 400
    assert [each.name for each in tmp_path.iterdir()] == ["m.mp4"]


def test_mp4_without_opencv_says_what_to_install(tmp_path, path, monkeypatch):
    monkeypatch.setitem(sys.modules, "cv2", None)
    with refused("MP4", "OpenCV", "turgor[motion]"):
        tg.pictures.write_motion(tmp_path / "m.mp4", path, motion=SHORT)


def read_glb(file):
    """Document of a GLB file, and a function that gives the array of an accessor."""
    content = file.read_bytes()
    assert struct.unpack("<4sII", content[:12]) == (b"glTF", 2, len(content))
    size, kind = struct.unpack("<I4s", content[12:20])
    assert kind == b"JSON"
    document = json.loads(content[20 : 20 + size])
    numbers = content[20 + size + 8 :]

    def array(number):
        accessor = document["accessors"][number]
        view = document["bufferViews"][accessor["bufferView"]]
        part = numbers[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        flat = np.frombuffer(part, dtype="<f4" if accessor["componentType"] == 5126 else "<u4")
        return flat.reshape(-1, 3) if accessor["type"] == "VEC3" else flat

    return document, array


def test_glb_moves_from_rest_to_the_last_state(tmp_path, path):
    file = tg.pictures.write_motion(tmp_path / "m.glb", path, motion=SHORT)
    document, array = read_glb(file)
    (primitive,) = document["meshes"][0]["primitives"]
    rest, triangles = array(primitive["attributes"]["POSITION"]), array(primitive["indices"]).reshape(-1, 3)
    whole = cases.state(cases.model(cases.body()), cases.bent(1.2))
    ends = [array(target["POSITION"]) + rest for target in primitive["targets"]]
    assert np.ptp(rest, axis=0) == pytest.approx([cases.LENGTH, cases.WIDTH, cases.HEIGHT], rel=1e-5)
    moved = whole.model.mesh.points + whole.displacement
    assert np.ptp(ends[-1], axis=0) == pytest.approx(np.ptp(moved, axis=0), rel=1e-3)
    corners = ends[-1][triangles]
    outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = (array(primitive["targets"][-1]["NORMAL"]) + array(primitive["attributes"]["NORMAL"]))[triangles[:, 0]]
    assert (np.einsum("ti,ti->t", outward, normals) > 0).mean() > 0.99
    times = array(document["animations"][0]["samplers"][0]["input"])
    weights = array(document["animations"][0]["samplers"][0]["output"]).reshape(len(times), -1)
    assert (times[0], times[-1]) == (0, 1.0)
    assert weights[0].max() == 0 and weights[len(times) // 2].tolist() == [0] * (len(ends) - 1) + [1]


def test_glb_is_read_by_vtk(tmp_path, path):
    pyvista = pytest.importorskip("pyvista")
    file = tg.pictures.write_motion(tmp_path / "m.glb", path, motion=SHORT)
    x, y, _z = np.array(pyvista.get_reader(str(file)).read().bounds).reshape(3, 2)
    assert (x[1] - x[0], y[1] - y[0]) == (pytest.approx(cases.LENGTH, rel=1e-5), pytest.approx(cases.HEIGHT, rel=1e-5))


def test_bad_motions_are_refused(tmp_path, path):
    with refused("'.mpg'", "'.mp4'", ".gif, .glb"):
        tg.pictures.write_motion(tmp_path / "m.mpg", path)
    with refused("one state"):
        tg.pictures.write_motion(tmp_path / "m.gif", cases.solution([path.states[0]]), motion=SHORT)
    with refused("2 states"):
        tg.pictures.write_motion(tmp_path / "m.gif", cases.solution([path.states[0]] * 2), motion=SHORT)
    with refused("rate", 500, "2 to 60"):
        tg.pictures.Motion(rate=500)


def test_curves_have_the_size_of_the_preset_and_text_that_is_text(tmp_path):
    columns = (Column("pressure", "kPa", [0, 50e3]), Column("bending_angle", "deg", [0, 1.5]))
    response = Response(columns=columns, source=Source(text="a ruler"))
    svg = tg.pictures.write_curves(tmp_path / "a.svg", {"ruler": response}, "bending_angle").read_text()
    assert ">bending angle [°]</text>" in svg
    assert 'width="240.94' in svg  # 85 mm in points
    pdf = tg.pictures.write_curves(tmp_path / "a.pdf", response, "bending_angle", size="double").read_bytes()
    assert b"/MediaBox [ 0 0 481.88" in pdf
    png = tg.pictures.write_curves(
        tmp_path / "a.png", response, "bending_angle", size=tg.pictures.Preset(width=85, height=40)
    )
    assert Image.open(png).size == (1003, 472)
    with refused("preset 'singel'", "'single'"):
        tg.pictures.write_curves(tmp_path / "a.svg", response, "bending_angle", size="singel")
    with refused("'.jpg'", "'.png'", ".pdf, .png, .svg"):
        tg.pictures.write_curves(tmp_path / "a.jpg", response, "bending_angle")


def test_a_workspace_is_plotted_with_its_hull():
    def to(x, y, z):
        ends = zip(("x", "y", "z"), (x, y, z), strict=True)
        columns = tuple(Column(f"tip_displacement_{axis}", "mm", [0, end * 1e-3]) for axis, end in ends)
        return Response(columns=columns, source=Source(text="a ruler"))

    reached = tg.measures.workspace([to(30, 0, 0), to(0, 0, 20), to(30, 0, 20)])
    assert (reached.flat, reached.area) == (True, pytest.approx(30e-3 * 20e-3))
    axes = tg.pictures.plot_workspace(Figure().add_subplot(), reached)
    assert len(axes.patches) == 2
    assert axes.get_xlabel() == "tip displacement x [mm]"
    assert len(tg.pictures.plot_workspace(Figure().add_subplot(), reached, "x", "y").patches) == 0
    with refused("'x' and 'x'", "x, y and z"):
        tg.pictures.plot_workspace(Figure().add_subplot(), reached, "x", "x")
    with refused("line", "pressure"):
        tg.measures.workspace([to(30, 0, 0)])
    with refused("'tip_displacement_z'"):
        tg.measures.workspace([Response(columns=to(1, 1, 1).columns[:2], source=Source(text="a ruler"))])
