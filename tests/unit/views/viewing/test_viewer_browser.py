"""The report in a real browser: it needs no network, turns, cuts, plays, prints, and does without WebGL."""

import re
from io import BytesIO
from itertools import pairwise

import numpy as np
import pytest
import results_cases as cases
from browser import needs_browser, opened
from PIL import Image

import turgor as tg
from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.results.measures.measures import measure
from turgor.core.results.measures.standard_measures import bending_angle, tip_displacement
from turgor.foundation.response import Column, Response
from turgor.units import mm
from turgor.views.viewer.between import weights_at
from turgor.views.viewer.packing import unpack
from turgor.views.viewer.scene import scene_of
from turgor.views.viewer.surface import surface_of

pytestmark = needs_browser

#: Numbers of an attribute of the face of a cut through the modeled part.
FACE = "Array.from(document.querySelector('.viewer').viewer.section.faces[0].geometry.attributes.{}.array)"

#: Seconds of drawing that the frame rate is measured over.
SPELL = 0.5


@pytest.fixture(scope="module")
def path():
    model = cases.model(cases.body(half=True))
    return cases.solution([cases.state(model, cases.bent(1.5 * f), f) for f in (0.0, 0.4, 1.0)])


@pytest.fixture(scope="module")
def report(path, tmp_path_factory):
    """A report whose bending angle has a mesh error."""
    measured = measure(path, bending_angle, tip_displacement)
    error = Column("bending_angle_mesh_error", "deg", 0.02 * measured["bending_angle"])
    response = Response(columns=(*measured.columns, error), source=measured.source)
    return tg.report(path, tmp_path_factory.mktemp("report") / "r.html", response=response)


@pytest.fixture(scope="module")
def driver():
    from playwright.sync_api import sync_playwright

    with sync_playwright() as started:
        yield started


@pytest.fixture(scope="module")
def shown(driver, report):
    with opened(driver, report) as page:
        yield page


def image(png):
    return np.asarray(Image.open(BytesIO(png)).convert("RGB")).astype(int)


def colored(png):
    """Share of the picture that is neither white nor gray."""
    return float((np.ptp(image(png), axis=2) > 25).mean())


def test_the_page_opens_from_a_file_and_draws(shown):
    assert shown.page.locator(".viewer").is_visible()
    assert not shown.page.locator(".still").first.is_visible()
    assert colored(shown.pixels()) > 0.08
    assert shown.page.locator(".v-path output").text_content() == "50 kPa · bending angle 85.9°"


def test_the_page_unpacks_what_python_packed(shown, path):
    values = scene_of(path).values
    result = shown.page.evaluate(
        """() => {
          const { positions, data, skin } = document.querySelector(".viewer").viewer;
          const numbers = (array) => Array.from(array);
          return [[0, 1, 2].map((k) => numbers(positions.at(k))), numbers(data[0].at(1)), numbers(skin.triangles)];
        }"""
    )
    wanted = unpack(values["surface"]["positions"])
    np.testing.assert_allclose(np.reshape(result[0], wanted.shape), wanted, rtol=1e-5, atol=1e-8)
    np.testing.assert_allclose(result[1], unpack(values["fields"][0]["data"])[1, :, 0], rtol=1e-5, atol=1e-5)
    np.testing.assert_array_equal(result[2], unpack(values["surface"]["triangles"]).ravel())


def test_the_slider_moves_the_actuator_and_the_markers(shown):
    def place():
        marks = shown.page.locator("circle.v-marker").all()
        return [(mark.get_attribute("cx"), mark.get_attribute("cy")) for mark in marks]

    shown.change("slider", "2")
    last, bent = place(), image(shown.pixels())
    shown.change("slider", "0")
    first, straight = place(), image(shown.pixels())
    assert len(first) == 2  # beside the picture, and in the panel of the response
    assert all(a != b for a, b in zip(first, last, strict=True))
    assert (np.abs(bent - straight).max(axis=2) > 40).mean() > 0.05
    assert shown.page.locator(".v-path output").text_content() == "0 kPa · bending angle 0.0°"


def test_a_click_on_a_curve_chooses_its_state(shown):
    for plot in (".v-chart", "figure[data-lines] svg"):
        shown.change("slider", "0")
        dot = shown.page.evaluate(
            """(plot) => {
              const viewer = document.querySelector(".viewer").viewer;
              const drawn = document.querySelector(plot);
              drawn.scrollIntoView({ block: "center" });
              viewer.show(1);
              const box = drawn.querySelector("circle.v-marker").getBoundingClientRect();
              viewer.show(0);
              return [box.x + box.width / 2, box.y + box.height / 2];
            }""",
            plot,
        )
        shown.page.mouse.click(*dot)
        assert shown.page.locator("[data-v=slider]").input_value() == "1", plot


@pytest.mark.parametrize("width", [1400, 800, 390])
def test_nothing_leaves_the_page(driver, report, width):
    """Cards hold their numbers, letters of the charts stay small, and no part is wider than the window."""
    with opened(driver, report) as page:
        page.page.set_viewport_size({"width": width, "height": 900})
        result = page.page.evaluate(
            """() => ({
              wide: document.documentElement.scrollWidth,
              cards: [...document.querySelectorAll(".numbers b")].map((b) => b.scrollWidth - b.clientWidth),
              caption: (([o, v]) => v.right - o.right)([".v-path output", ".viewer"].map(
                (name) => document.querySelector(name).getBoundingClientRect())),
              letters: [...document.querySelectorAll(".v-number")].map((text) => text.getBoundingClientRect().height),
            })"""
        )
    assert result["wide"] <= width
    assert max(result["cards"]) <= 0
    assert result["caption"] >= 0
    assert max(result["letters"]) < 24


def test_a_cut_opens_the_cavity(shown):
    shown.change("slider", "2")
    whole = image(shown.pixels())
    shown.change("axis", "1")
    cut = image(shown.pixels())
    shown.change("turned", True)
    other = image(shown.pixels())
    shown.change("turned", False)
    shown.change("axis", "-1")
    assert (np.abs(whole - cut).max(axis=2) > 40).mean() > 0.02
    assert (np.abs(other - cut).max(axis=2) > 40).mean() > 0.02
    np.testing.assert_array_equal(image(shown.pixels()), whole)


def test_the_face_of_a_cut_has_the_right_area_and_field(shown):
    """Across y = 4 mm lie the whole length and height but the hole: half of the length, a third of the height."""
    for name, value in (("slider", "0"), ("axis", "1"), ("place", "700")):
        shown.change(name, value)
    places = np.reshape(shown.page.evaluate(FACE.format("position")), (-1, 3, 3))
    np.testing.assert_allclose(places[..., 1], 4 * mm, atol=1e-6)
    sides = places[:, 1:] - places[:, :1]
    area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum() / 2
    assert area == pytest.approx(cases.LENGTH * cases.HEIGHT * (1 - 1 / 6), rel=1e-3)
    shown.change("field", "3")
    shown.change("slider", "2")
    shares = np.reshape(shown.page.evaluate(FACE.format("uv")), (-1, 2))[:, 0]
    for name, value in (("field", "0"), ("axis", "-1"), ("place", "500")):
        shown.change(name, value)
    assert shares.min() == pytest.approx(0, abs=0.01)
    assert shares.max() == pytest.approx(1, abs=0.01)  # the farthest way is that of the tip, at any y


def test_the_menu_changes_colors_and_the_bar(shown):
    shown.change("slider", "2")
    bars, pictures = [], []
    for number in ("0", "1", "3"):
        shown.change("field", number)
        bars.append(shown.page.locator(".v-bar").get_attribute("data-field"))
        pictures.append(image(shown.pixels()))
    shown.change("field", "0")
    assert bars == ["von_mises", "stretch", "displacement"]
    for a, b in pairwise(pictures):
        assert (np.abs(a - b).max(axis=2) > 20).mean() > 0.03


def test_a_color_is_that_of_its_value_on_the_bar(shown):
    """Without light the tip has the color at the end of the bar of the displacement, which it has most of."""
    shown.change("field", "3")
    shown.change("light", False)
    shown.change("slider", "2")
    result = image(shown.pixels()).reshape(-1, 3)
    last = shown.page.locator("#v-colors stop").last.get_attribute("stop-color")
    wanted = np.array([int(part) for part in re.findall(r"\d+", last)])
    shown.change("light", True)
    shown.change("field", "0")
    assert (np.abs(result - wanted).max(axis=1) <= 6).sum() > 30


def test_dragging_turns_the_picture(shown):
    before = image(shown.pixels())
    box = shown.page.locator(".v-picture").bounding_box()
    shown.page.mouse.move(box["x"] + 200, box["y"] + 200)
    shown.page.mouse.down()
    shown.page.mouse.move(box["x"] + 320, box["y"] + 240)
    shown.page.mouse.up()
    after = image(shown.pixels())
    shown.page.locator("[data-v=start]").click()
    assert (np.abs(before - after).max(axis=2) > 40).mean() > 0.05
    assert (np.abs(image(shown.pixels()) - before).max(axis=2) > 40).mean() < 0.01


def test_a_slow_browser_turns_a_rough_picture_and_rests_with_the_whole_one(shown):
    state = """() => {
      const { stage, body } = document.querySelector(".viewer").viewer;
      return [stage.renderer.domElement.width / stage.box.clientWidth, body.ghost.map((line) => line.visible)];
    }"""
    shown.change("slider", "2")
    whole = image(shown.pixels())
    canvas = shown.page.locator(".v-picture canvas")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    shown.page.mouse.move(box["x"] + 200, box["y"] + 200)
    shown.page.mouse.down()
    shown.page.mouse.move(box["x"] + 260, box["y"] + 220)
    ratio, ghost = shown.page.evaluate(state)
    turning = shown.pixels()
    shown.page.mouse.up()
    at_rest, outline = shown.page.evaluate(state)
    shown.page.locator("[data-v=start]").click()
    assert ratio == pytest.approx(0.5, abs=0.01)
    assert not any(ghost)
    assert colored(turning) > 0.08
    assert at_rest == 1
    assert all(outline) and outline
    np.testing.assert_array_equal(image(shown.pixels()), whole)


def test_a_fast_browser_turns_the_whole_picture_until_frames_are_late(shown):
    """Frames are told to come at 60, then at 20 per second."""
    result = shown.page.evaluate(
        """() => {
          const { stage } = document.querySelector(".viewer").viewer;
          const [slow, later, due] = [stage.slow, window.requestAnimationFrame, []];
          window.requestAnimationFrame = (told) => due.push(told);
          let time = 0;
          const frame = (passed) => { stage.draw(); due.splice(0).forEach((told) => told((time += passed))); };
          stage.waiting = stage.slow = false;
          stage.controls.dispatchEvent({ type: "start" });
          const rough = [16, 16, 16, 50, 16, 16, 50, 50].map((passed) => (frame(passed), stage.rough));
          stage.controls.dispatchEvent({ type: "end" });
          rough.push(stage.rough);
          window.requestAnimationFrame = later;
          [stage.slow, stage.waiting] = [slow, false];
          return rough;
        }"""
    )
    assert result == [False] * 7 + [True, False]


def test_the_inner_side_of_a_closed_body_is_not_seen(shown):
    shown.change("slider", "2")
    side, pictures = "document.querySelector('.viewer').viewer.body.surface.side", []
    for number in (2, 1, 0):  # both sides, the inner one, the outer one
        shown.page.evaluate(f"{side} = {number}")
        pictures.append(image(shown.pixels()))
    inner, outer = ((np.abs(each - pictures[0]).max(axis=2) > 10).mean() for each in pictures[1:])
    assert outer < 2e-3  # pixels of lines at the rim
    assert inner > 0.02


def test_frames_are_drawn(shown, record_property):
    """A processor draws here instead of a graphics card, so the rate is told, not judged."""
    frames = shown.page.evaluate(
        """(spell) => {
          const { stage } = document.querySelector(".viewer").viewer;
          const pixel = new Uint8Array(4);
          const gl = stage.renderer.getContext();
          const start = performance.now();
          let frames = 0;
          while (performance.now() - start < 1000 * spell) {
            stage.now();
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // waits until the frame is drawn
            frames++;
          }
          return frames / (performance.now() - start) * 1000;
        }""",
        SPELL,
    )
    record_property("frames_per_second", round(frames))
    assert frames > 1


def test_the_print_has_the_still_picture(shown):
    pdf = shown.page.pdf(format="A4")
    assert len(re.findall(rb"/Type\s*/Page\b", pdf)) >= 3
    shown.page.emulate_media(media="print")
    assert shown.page.locator(".still").first.is_visible()
    assert not shown.page.locator(".viewer").is_visible()
    width = shown.page.evaluate("[document.body.scrollWidth, document.body.clientWidth]")
    shown.page.emulate_media(media="screen")
    assert width[0] <= width[1]


def test_nothing_was_asked_of_a_network_and_nothing_complained(shown):
    assert shown.requests == []
    assert [text for text in shown.complaints if "GPU stall" not in text] == []


def test_the_slider_goes_on_between_states(driver, tmp_path):
    """Shape and words of a place between two states are those of the true path, not of the nearest state."""
    model = cases.model(cases.body(half=True))
    shares = np.linspace(0, 1, 8)
    path = cases.solution([cases.state(model, cases.bent(1.5 * f), f) for f in shares])
    report = tg.report(path, tmp_path / "r.html", response=measure(path, bending_angle, tip_displacement))
    with opened(driver, report) as page:
        page.change("slider", "4.5")
        points = page.page.evaluate("Array.from(document.querySelector('.viewer').viewer.points)")
        label = page.page.locator(".v-path output").text_content()
        middle = image(page.pixels())
        page.change("slider", "4")
        state = image(page.pixels())
        page.page.locator("[data-v=play]").click()
        page.page.wait_for_function("document.querySelector('[data-v=slider]').value === '7'")
        assert page.complaints == []
    at = np.mean(shares[4:6])
    scene = scene_of(path)
    positions, places = unpack(scene.values["surface"]["positions"]), np.array(scene.values["places"])
    by_python = np.tensordot(weights_at(places, at), positions, 1)
    np.testing.assert_allclose(np.reshape(points, by_python.shape), by_python, atol=1e-7)
    surface = surface_of(StateFields(path.states[0], MeshFacts(model.mesh)))
    true = cases.bent(1.5 * at)(model.mesh.points)[surface.node]
    assert np.abs(by_python - true).max() < 2e-4 * np.abs(true - positions[0]).max()
    assert np.abs(positions[4:6].mean(axis=0) - true).max() > 2e-3 * np.abs(true - positions[0]).max()  # a line
    pressure, angle = (float(number) for number in re.findall(r"[0-9.]+", label))
    assert pressure == pytest.approx(50 * at, rel=1e-3)
    assert angle == pytest.approx(np.rad2deg(1.5 * at), abs=0.06)
    assert (np.abs(middle - state).max(axis=2) > 40).mean() > 0.01


def test_without_webgl_the_still_picture_stays(driver, report):
    with opened(driver, report, webgl=False) as page:
        assert not page.page.locator(".viewer").is_visible()
        assert page.page.locator(".still").first.is_visible()
        assert page.requests == []


def test_a_notebook_shows_the_viewer_in_a_frame(driver, path, tmp_path):
    file = tmp_path / "cell.html"
    file.write_text(f"<!DOCTYPE html><body>{tg.pictures.viewer(path)._repr_html_()}</body>", encoding="utf-8")
    with opened(driver, file, frame=True) as page:
        frame = page.page.frame_locator("iframe")
        assert frame.locator(".v-picture canvas").is_visible()
        assert not frame.locator("[data-v=curves]").is_visible()
        assert colored(frame.locator(".v-picture canvas").screenshot()) > 0.08
        assert page.requests == []
