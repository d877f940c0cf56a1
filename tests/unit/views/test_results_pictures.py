"""Pictures: what is drawn lies where it must, in the colors it must have, without any graphics library."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
import results_cases as cases
from PIL import Image

from refused import refused
from turgor.core.results.fields.state_fields import StateFields
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.units import deg
from turgor.views.pictures import framing as pictures
from turgor.views.pictures.colors import color_map
from turgor.views.pictures.raycast import Raster, Scene, camera
from turgor.views.pictures.settings import FRAMING
from turgor.views.pictures.shading import Look, find_lines, paint, reduced
from turgor.views.pictures.skin import Skin, visible_skin
from turgor.views.pictures.state_picture import picture_title, shared_view, write_picture

WIDTH = 500
EYE = camera(0.0, 0.0)


def square(size=1.0, *, y=0.0, value=1.0, start=0, corner=0.0):
    """Two triangles in the plane y, seen from the front."""
    points = np.array([[0, y, 0], [size, y, 0], [size, y, size], [0, y, size]]) + [corner, 0, corner]
    return Skin(points=points, normals=np.tile([0.0, -1.0, 0.0], (4, 1)), values=np.full(4, value),
                triangles=np.array([[0, 1, 2], [0, 2, 3]]) + start, patch=np.zeros(2, dtype=np.int64))  # fmt: skip


def joined(a: Skin, b: Skin) -> Skin:
    return Skin(**{
        name: np.concatenate([getattr(a, name), getattr(b, name)])
        for name in ("points", "normals", "values", "triangles", "patch")
    })  # fmt: skip


def look(skin, raster, eye=EYE):
    return Scene(skin, eye).look(raster)


@pytest.fixture(scope="module")
def rest():
    return cases.state(cases.model(cases.body(half=True)), None, 0.0)


@pytest.fixture(scope="module")
def bent():
    return cases.state(cases.model(cases.body(half=True)), cases.bent(1.2))


def drawn(path):
    return np.asarray(Image.open(path).convert("RGB")).astype(int)


def test_camera_axes():
    """From the front x is right and z up; from above the eye looks down."""
    np.testing.assert_allclose(EYE.project(np.eye(3)), [[1, 0, 0], [0, 0, 1], [0, 1, 0]], atol=1e-15)
    eye = camera(20 * deg, 30 * deg)
    frame = np.stack([eye.right, eye.up, eye.forward])
    np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-15)
    assert eye.forward[2] == pytest.approx(-0.5)
    assert eye.up[2] > 0


def test_rays_hit_where_the_triangles_are():
    raster = Raster(left=-0.5, top=1.5, step=0.05, rows=40, columns=40)
    hits = look(square(y=3.0), raster)
    seen = hits.triangle >= 0
    expected = np.zeros((40, 40), dtype=bool)
    expected[10:30, 10:30] = True
    np.testing.assert_array_equal(seen, expected)
    assert np.ptp(hits.depth[seen]) < 1e-5
    skin = square(y=3.0)
    corners = skin.points[skin.triangles[hits.triangle[seen]]]
    u, v = hits.u[:, None], hits.v[:, None]
    place = corners[:, 0] * (1 - u - v) + corners[:, 1] * u + corners[:, 2] * v
    rows, columns = np.nonzero(seen)
    np.testing.assert_allclose(place[:, 0], -0.5 + 0.05 * (columns + 0.5), atol=1e-5)
    np.testing.assert_allclose(place[:, 2], 1.5 - 0.05 * (rows + 0.5), atol=1e-5)


def test_the_nearer_hides_the_farther():
    skin = joined(square(2.0, y=1.0), square(1.0, y=0.0, start=4))
    hits = look(skin, Raster(left=0, top=2, step=0.1, rows=20, columns=20))
    assert set(hits.triangle[10:, :10].ravel()) == {2, 3}
    assert set(hits.triangle[:10].ravel()) == {0, 1}


def test_a_triangle_larger_than_the_picture_fills_its_part():
    half = replace(square(0.03), triangles=np.array([[0, 1, 2]]), patch=np.zeros(1, dtype=np.int64))
    raster = Raster(left=-0.005, top=0.035, step=0.0005, rows=120, columns=120)
    seen = look(half, raster).triangle[:60, :60] >= 0
    assert seen.sum() * raster.step**2 == pytest.approx(0.02**2 / 2, rel=0.05)


def test_triangles_leave_no_gap_between_them(bent):
    """Inside the outline of a body every sample has a triangle, and its place is that of the sample."""
    at = StateFields(bent)
    skin, eye = visible_skin(at, at.von_mises), camera(20 * deg, 18 * deg)
    raster = Raster(left=-0.02, top=0.04, step=0.0005, rows=160, columns=160)
    hits = look(skin, raster, eye)
    hit = hits.triangle >= 0
    around = [np.roll(hit, shift, axis) for shift in (-1, 1) for axis in (0, 1)]
    assert not (~hit & np.all(around, axis=0)).any()
    corners = skin.points[skin.triangles[hits.triangle[hit]]]
    weights = np.stack([1 - hits.u - hits.v, hits.u, hits.v], axis=1)
    flat = eye.project(np.einsum("sa,sai->si", weights, corners))
    rows, columns = np.nonzero(hit)
    np.testing.assert_allclose(flat[:, 0], raster.left + (columns + 0.5) * raster.step, atol=1e-7)
    np.testing.assert_allclose(flat[:, 1], raster.top - (rows + 0.5) * raster.step, atol=1e-7)


def test_openness_of_a_plane_and_under_a_roof():
    floor = square()
    assert Scene(floor, EYE).openness(10.0) == pytest.approx(1.0)
    covered = joined(floor, square(11.0, y=-0.1, start=4, corner=-5.0))
    openness = Scene(covered, EYE).openness(10.0)
    assert openness[:4].max() < 0.05
    assert Scene(covered, EYE).openness(0.05)[:4] == pytest.approx(1.0)  # the roof is farther than that
    assert openness[4:] == pytest.approx(1.0)


def test_colors_darken_steadily_from_rest():
    """More stress is darker everywhere along the bar, so that it reads in gray print too."""
    table = color_map("von_mises")(np.linspace(0, 1, 50))[:, :3]
    luminance = table**2.2 @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(luminance) < 0).all()
    assert luminance[0] > 0.8 > 0.1 > luminance[-1]


def test_beyond_the_limit_the_last_color_is_used():
    colors = color_map("von_mises")
    raster = Raster(left=0.1, top=0.9, step=0.1, rows=8, columns=8)
    images = []
    for value in (1.0, 7.0):
        skin = square(value=value)
        images.append(paint(skin, look(skin, raster), EYE, Look(colors=colors, limit=1.0, openness=np.ones(4))))
    np.testing.assert_array_equal(*images)


def test_lines_are_drawn_at_outlines_and_steps_but_not_on_slopes():
    raster = Raster(left=-0.5, top=2.5, step=0.05, rows=60, columns=60)
    outline, inner = find_lines(square(2.0), look(square(2.0), raster))
    assert outline.sum() == pytest.approx(4 * 40, abs=8)
    assert not inner.any()
    stepped = joined(square(2.0, y=1.0), square(1.0, y=0.0, start=4))
    _, inner = find_lines(stepped, look(stepped, raster))
    assert inner.sum() == pytest.approx(2 * 2 * 20, abs=8)  # two sides of 20 samples, a step is two samples wide
    steep = Raster(left=-0.5, top=2.5, step=0.05, rows=60, columns=60)
    slope = square(2.0)
    tilted = Skin(points=slope.points + np.outer(slope.points[:, 0], [0, 8.0, 0]), normals=slope.normals,
                  values=slope.values, triangles=slope.triangles, patch=slope.patch)  # fmt: skip
    assert not find_lines(tilted, look(tilted, steep))[1].any()


def test_samples_are_averaged():
    image = np.zeros((4, 4, 3), dtype=np.uint8)
    image[:2, :2] = [[[100], [200]], [[0], [100]]]
    assert reduced(image, 2)[0, 0, 0] == 100
    assert reduced(image, 2).shape == (2, 2, 3)


def test_skin_of_a_half_is_that_of_the_whole(rest):
    """Mirrored: no mirror plane within, the same area as the whole body, normals smooth across the plane."""
    half = visible_skin(StateFields(rest), np.zeros(len(rest.displacement)))
    whole_state = cases.state(cases.model(cases.body()))
    whole = visible_skin(StateFields(whole_state), np.zeros(len(whole_state.displacement)))
    assert half.areas.sum() == pytest.approx(whole.areas.sum())
    assert (half.points.min(axis=0), half.points.max(axis=0)) == (
        pytest.approx(whole.points.min(axis=0)), pytest.approx(whole.points.max(axis=0)),
    )  # fmt: skip
    on_plane = np.abs(half.points[:, 1]) < 1e-12
    assert np.abs(half.normals[on_plane, 1]).max() < 1e-12
    flat = half.points[half.triangles]
    outward = np.cross(flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0])
    assert (np.einsum("ti,ti->t", outward, half.normals[half.triangles[:, 0]]) > 0).all()


def test_the_surface_is_smooth_across_the_mirror_plane():
    """A slope across the plane is rounded off there, as the surface goes on into its mirror image."""
    state = cases.state(cases.model(cases.body(half=True)), lambda X: X - np.outer(X[:, 1], [0, 0, 0.2]))
    skin = visible_skin(StateFields(state), np.zeros(len(state.displacement)))
    on_plane = np.abs(skin.points[:, 1]) < 1e-12
    assert np.abs(skin.normals[on_plane, 1]).max() < 1e-12
    assert np.abs(skin.normals[~on_plane, 1]).max() > 0.1


def test_patches_end_at_edges_of_the_undeformed_body_and_between_regions():
    """A box with a box-shaped hollow has 6 + 6 sides; the lower third of the four upright outer ones is the base's."""
    state = cases.state(cases.model(cases.body()), cases.bent(1.2))
    at = StateFields(state)
    skin = visible_skin(at, at.von_mises)
    assert len(np.unique(skin.patch)) == 12 + 4


def test_normals_are_smooth_within_a_patch():
    """On a bent top the normals of neighbors agree where they meet."""
    at = StateFields(cases.state(cases.model(cases.body(hollow=False)), cases.bent(1.2)))
    skin = visible_skin(at, at.von_mises)
    top = np.isin(np.arange(len(skin.points)), skin.triangles[skin.patch == skin.patch[skin.points[skin.triangles].mean(
        axis=1)[:, 2].argmax()]])  # fmt: skip
    place, group = np.unique(np.round(skin.points[top], 9), axis=0, return_inverse=True)
    for i in range(3):
        spread = np.zeros((2, len(place)))
        spread[0], spread[1] = np.inf, -np.inf
        np.minimum.at(spread[0], group.ravel(), skin.normals[top, i])
        np.maximum.at(spread[1], group.ravel(), skin.normals[top, i])
        assert (spread[1] - spread[0]).max() < 1e-9


def test_picture_is_true_to_scale_and_framed(tmp_path, rest):
    """The body is as wide in the picture as the view says: margin to margin, to the pixel."""
    view = shared_view([rest], width=WIDTH)
    write_picture(tmp_path / "rest.png", rest, view)
    image = drawn(tmp_path / "rest.png")
    assert image.shape[1] == WIDTH
    body = (within_bands(image) < 250).any(axis=2)
    columns = np.flatnonzero(body.any(axis=0))
    assert columns[0] == pytest.approx(FRAMING.margin, abs=2)
    assert columns[-1] == pytest.approx(WIDTH - FRAMING.margin, abs=2)
    at = StateFields(rest)
    height = np.ptp(view.eye.project(visible_skin(at, at.von_mises).points)[:, 1]) / view.pixel
    rows = np.flatnonzero(body.any(axis=1))
    assert rows[-1] - rows[0] == pytest.approx(height, abs=3)


def test_half_and_whole_make_the_same_picture(tmp_path):
    for name, half in (("half", True), ("whole", False)):
        state = cases.state(cases.model(cases.body(half=half)), cases.stretched(1.3))
        view = replace(shared_view([state], width=WIDTH), limit=1e6)
        write_picture(tmp_path / f"{name}.png", state, view)
    a, b = drawn(tmp_path / "half.png"), drawn(tmp_path / "whole.png")
    assert a.shape == b.shape
    assert np.abs(a - b).mean() < 0.1
    assert np.ptp(a[200:300, 200:300]) > 20


def test_pictures_share_scale_and_colors(rest, bent):
    view = shared_view([rest, bent], width=WIDTH)
    alone = shared_view([rest], width=WIDTH)
    assert view.left <= alone.left
    assert view.right >= alone.right
    at = StateFields(bent)
    assert np.median(at.von_mises) < view.limit < at.cells.von_mises.max()
    assert alone.limit > 0  # an unstressed body alone still has a bar


def test_ghost_is_drawn_behind(tmp_path, rest, bent):
    view = shared_view([rest, bent], width=WIDTH)
    write_picture(tmp_path / "without.png", bent, view)
    write_picture(tmp_path / "with.png", bent, view, ghost=rest)
    a, b = drawn(tmp_path / "without.png"), drawn(tmp_path / "with.png")
    assert b.shape[0] >= a.shape[0]
    assert light_gray(b) > light_gray(a) + 200


def within_bands(image):
    """The image between title and color bar."""
    head, foot = pictures.bands(image.shape[1])
    return image[head:-foot]


def light_gray(image):
    """How many pixels around the body are light gray, as the lines of the ghost are."""
    picture = within_bands(image)
    mean = picture.mean(axis=2)
    return ((np.ptp(picture, axis=2) < 20) & (mean > 160) & (mean < 235)).sum()


def test_title_from_a_response():
    columns = (Column("load_factor", "", [0, 1]), Column("bending_angle", "deg", [0, 250 * deg]))
    response = Response(columns=columns, source=Source(text="a test"))
    assert picture_title(response) == "load factor 1 · bending angle 250.0°"
    assert picture_title(response, 0, "finger") == "finger · load factor 0 · bending angle 0.0°"


def test_bad_views_are_refused(rest):
    with refused("width", "100 pixels", "400 or more"):
        shared_view([rest], width=100)
    with refused("view", "state"):
        shared_view([])


def test_no_graphics_library_and_no_global_plotting_state_is_loaded():
    """VTK needs a graphics library that a bare machine lacks, and pyplot keeps figures alive."""
    code = (
        "import sys, turgor.core.results; "
        "bad = {'vtk', 'vtkmodules', 'pyvista', 'matplotlib.pyplot'} & set(sys.modules); "
        "sys.exit(str(bad) if bad else 0)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
