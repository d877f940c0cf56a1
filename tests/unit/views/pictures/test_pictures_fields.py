"""Fields in pictures: values can be read off the colors of pixels; cut away or transparent bodies show the inside."""

from dataclasses import replace

import numpy as np
import pytest
import results_cases as cases
from PIL import Image

import turgor as tg
from refused import refused
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.solvers.solution import Touch
from turgor.units import deg, mm
from turgor.views.pictures.colors import FIELDS, RUBBER, Field, color_map
from turgor.views.pictures.overlays.contact_patches import contact_skin
from turgor.views.pictures.raycast import Raster, Scene, camera
from turgor.views.pictures.settings import RENDERING
from turgor.views.pictures.shading import Look, paint
from turgor.views.pictures.skin import visible_skin
from turgor.views.pictures.state_picture import pixels_of, shared_view, state_figure, write_picture

WIDTH = 500
HEIGHT = Field(name="height", label="height", unit="mm", values=lambda at: at.points[:, 2])


@pytest.fixture(scope="module")
def bent():
    return cases.state(cases.model(cases.body(half=True)), cases.bent(1.2))


def decoded(pixels, colors):
    """Values 0 to 1 of colors under any light, by the ratios of red, green and blue in linear light."""
    table = colors(np.linspace(0, 1, 512))[:, :3] ** 2.2
    table, light = table / table.sum(axis=1, keepdims=True), (pixels / 255.0) ** 2.2
    light /= np.maximum(light.sum(axis=-1, keepdims=True), 1e-6)
    return np.abs(light[:, None, :] - table[None]).sum(axis=2).argmin(axis=1) / 511


def seen_from(elevation, values):
    """Pixels and values of a body; from below it lies in shadow."""
    at = StateFields(cases.state(cases.model(cases.body(hollow=False)), cases.bent(1.2)))
    skin = visible_skin(at, values(at))
    eye = camera(20 * deg, elevation * deg)
    scene = Scene(skin, eye)
    raster = Raster(left=-0.01, top=0.03, step=0.0005, rows=120, columns=120)
    hits = scene.look(raster)
    seen = hits.triangle >= 0
    corners = skin.values[skin.triangles[hits.triangle[seen]]]
    exact = corners[:, 0] * (1 - hits.u - hits.v) + corners[:, 1] * hits.u + corners[:, 2] * hits.v
    look = Look(color_map("von_mises"), float(skin.values.max()), scene.openness(0.005))
    return paint(skin, hits, eye, look)[seen], exact / skin.values.max()


@pytest.mark.parametrize("elevation", [18, -50])
def test_values_are_read_off_pixels_whatever_the_light(elevation):
    pixels, exact = seen_from(elevation, lambda at: at.mesh.points[:, 0])
    error = np.abs(decoded(pixels, color_map("von_mises")) - exact)
    assert np.percentile(error, 95) < 0.03
    light = ((pixels / 255.0) ** 2.2).sum(axis=1) / (color_map("von_mises")(exact)[:, :3] ** 2.2).sum(axis=1)
    assert np.percentile(light, 2) > 0.7
    assert np.percentile(light, 98) < 1.05
    assert np.percentile(light, 98) - np.percentile(light, 2) > 0.08  # it still looks like a body


@pytest.mark.parametrize("name", [name for name in FIELDS if name != "fiber_tension"])
def test_every_field_has_a_picture(bent, name):
    image = pixels_of(bent, shared_view([bent], WIDTH, name))
    assert image.shape[2] == 3
    assert ((image < 250).any(axis=2)).mean() > 0.2


def test_a_field_of_ones_own_and_its_mistakes(bent):
    view = shared_view([bent], WIDTH, HEIGHT)
    assert view.limit == pytest.approx(
        np.percentile(bent.model.mesh.points[:, 2] + bent.displacement[:, 2], 99), rel=0.1
    )
    assert state_figure(bent, view).axes[0].get_xlim()[1] == pytest.approx(view.limit / mm)
    with refused("'height'", "'mmm'", "'mm'"):
        Field(name="height", label="height", unit="mmm", values=lambda at: at.points[:, 2])
    with refused("'half'", "(5,)", "309 nodes"):
        shared_view([bent], WIDTH, Field(name="half", label="", unit="", values=lambda at: at.points[:5, 2]))
    with refused("'stres'", "'stretch'"):
        shared_view([bent], WIDTH, "stres")


def test_signed_fields_have_rubber_at_zero(bent):
    view = shared_view([bent], WIDTH, "principal_stress")
    assert view.floor == -view.limit
    middle = np.array(view.field.color_map()(0.5)[:3]) * 255
    assert middle == pytest.approx([int(RUBBER[k : k + 2], 16) for k in (1, 3, 5)], abs=3)


def test_what_is_free_of_stress_has_no_color_bar(bent):
    rest = cases.state(bent.model, None, 0.0)
    view = shared_view([rest, bent], WIDTH)
    assert len(state_figure(rest, view).axes) == 0
    assert len(state_figure(bent, view).axes) == 1


def test_the_canvas_is_filled(tmp_path):
    """A tall actuator makes a narrow picture, with the margin on both sides."""
    state = cases.state(cases.model(cases.body()), lambda X: X[:, [2, 1, 0]] * [-1, 1, 4])
    write_picture(tmp_path / "tall.png", state, shared_view([state], WIDTH))
    image = np.asarray(Image.open(tmp_path / "tall.png").convert("RGB")).astype(int)
    assert image.shape[1] == pytest.approx(0.6 * WIDTH, abs=1)
    body = np.flatnonzero((image[60:400] < 250).any(axis=(0, 2)))
    assert body[0] == pytest.approx(image.shape[1] - body[-1], abs=3)


@pytest.mark.parametrize("half", [False, True])
def test_a_cut_opens_the_cavity_and_shows_the_field_in_the_wall(half):
    """Cut across y, the section is that of the box less the hollow; its color is that of the field in this plane."""
    state = cases.state(cases.model(cases.body(half=half)))
    middle, side = 0.5 * cases.WIDTH, cases.WIDTH
    across = Field(name="across", label="y", unit="mm", values=lambda at: np.abs(at.mesh.points[:, 1] - middle))
    view = replace(shared_view([state], WIDTH, across), azimuth=0.0, elevation=0.0, limit=side)
    whole = pixels_of(state, view)
    cut = pixels_of(state, view, style=tg.pictures.Style(cut="y"))
    assert whole.shape == cut.shape
    row, column = cut.shape[0] // 2, round((38 * mm - view.edge) / view.pixel)
    in_wall = cut[row, column - 2 : column + 3]
    assert decoded(in_wall, view.field.color_map()).mean() == pytest.approx(0.5, abs=0.03)  # on the plane, y = 0
    in_hollow = cut[row, round((20 * mm - view.edge) / view.pixel)][None]
    assert decoded(in_hollow, view.field.color_map())[0] == pytest.approx(0.25, abs=0.03)  # behind it, y = 5 mm


def test_a_cut_beside_the_actuator_is_refused(bent):
    aside = tg.pictures.Style(cut=tg.pictures.Cut(axis="y", position=1.0))
    with refused("y = 1.0 m", "-0.01 and 0.01 m"):
        pixels_of(bent, shared_view([bent], WIDTH), style=aside)
    with refused("'w'", "x, y or z"):
        tg.pictures.Style(cut="w")
    with refused("cut", "transparent"):
        tg.pictures.Style(cut="y", transparent=True)


def test_a_transparent_body_shows_its_cavity(bent):
    view = shared_view([bent], WIDTH)
    solid, through = (pixels_of(bent, view, style=tg.pictures.Style(transparent=on)) for on in (False, True))
    dark = [(image.min(axis=2) < 150).sum() for image in (solid, through)]
    assert np.abs(solid.astype(int) - through).mean() > 2
    assert dark[0] != dark[1]


def test_edges_of_cells_are_drawn(bent):
    view = shared_view([bent], WIDTH)
    plain, edged = (pixels_of(bent, view, style=tg.pictures.Style(edges=on)).astype(int) for on in (False, True))
    assert (edged.sum() < plain.sum()) and (np.abs(edged - plain).max(axis=2) > 15).sum() > 500


def test_contact_patches_are_smooth_and_keep_their_force():
    """One node of the top is pressed: the force stays the same, and no triangle has a border within it."""
    mesh = cases.body(hollow=False)
    state = cases.state(cases.model(mesh))
    top = np.flatnonzero(mesh.points[:, 2] > cases.HEIGHT - 1e-9)
    pressure = np.zeros(len(mesh.points))
    pressure[top[np.linalg.norm(mesh.points[top] - mesh.points[top].mean(axis=0), axis=1) < 6 * mm]] = 1e4
    touch = Touch(force=np.zeros_like(mesh.points), pressure=pressure, area=1e-4, penetration=0.0, place=np.zeros(3))
    at = StateFields(replace(state, touches={"self": touch}))
    rough, smooth = visible_skin(at, pressure, parts=RENDERING.parts), contact_skin(at)
    force = [skin.areas @ skin.values[skin.triangles].mean(axis=1) for skin in (rough, smooth)]
    assert force[1] == pytest.approx(force[0], rel=0.02)
    steps = [np.ptp(skin.values[skin.triangles], axis=1).max() for skin in (rough, smooth)]
    assert steps[1] < 0.6 * steps[0]
