"""Shape and loads in the studio: a family is picked and changed, faces of a part are named by clicks."""

import json
import re
import shutil
import tomllib
from pathlib import Path

import pytest
from served import PATIENCE, needs_browser, open_page, served

from turgor.job.job import ACTUATORS
from turgor.job.read import read_job

pytestmark = needs_browser

EXAMPLES = Path(__file__).parents[3] / "examples"
PAGE = Path(__file__).parents[3] / "src/turgor/studio/page/families"  # run docs/studio_thumbnails.py for new families

#: The pixel of the picture that shows the middle of a point, from the viewer that is mounted.
POINT = """async (point) => {
  const { stage } = document.querySelector(".viewer").viewer;
  const place = stage.center.clone().set(...point).project(stage.camera);
  const box = stage.box.getBoundingClientRect();
  return [box.left + (place.x + 1) / 2 * box.width, box.top + (1 - place.y) / 2 * box.height];
}"""


@pytest.fixture(scope="module")
def studio(tmp_path_factory):
    """A server of a folder with a job and a CAD file."""
    folder = tmp_path_factory.mktemp("workspace")
    shutil.copy(EXAMPLES / "fast_pneunet.toml", folder / "finger.toml")
    for name in ("cad_file.step", "cad_file.toml"):
        shutil.copy(EXAMPLES / name, folder)
    with served(folder) as running:
        yield running


@pytest.fixture
def shown(studio):
    """A page of the server, on the screen Start."""
    with open_page(studio, "#/start", size=(1400, 950)) as page:
        yield page
        page.check()


#: State of a job on disk, and the version that the page shows.
STATE = """async (name) => {
  const { text, version } = await (await fetch(`/api/jobs/${name}`)).json();
  return [text, version, document.querySelector("[data-version]")?.dataset.version];
}"""


def changed(page, name: str, act) -> str:
    """Do something that changes a job, and wait until the page shows it; return the text of the job."""
    before, _, _ = page.evaluate(STATE, name)
    act()
    for _ in range(PATIENCE * 10):
        text, version, seen = page.evaluate(STATE, name)
        if text != before and version == seen:
            return text
        page.wait_for_timeout(100)
    raise AssertionError(f"the page does not show the change of {name}")


def enter(field, text: str):
    """What a person does to write a value into a field."""

    def act() -> None:
        field.fill(text)
        field.press("Enter")

    return act


def fact(page, name: str) -> str:
    """A number beside the picture."""
    return page.locator(f".facts dt:text-is('{name}') + dd").inner_text()


def triangles(page) -> int:
    """Triangles of the modeled part that the picture shows."""
    return page.evaluate("document.querySelector('.viewer').viewer.skin.faces")


def go(page, screen: str, name: str) -> None:
    page.evaluate("(to) => { location.hash = to }", f"#/{screen}/{name}")
    page.wait_for_selector(f"main.screen-{screen} [data-version]")


def test_family_is_picked_changed_and_undone(shown, studio):
    page = shown.page
    page.get_by_label("close the tour").click()
    page.click("[data-family=slow_pneunet]")
    page.wait_for_selector("[data-version]")
    file = studio.workspace / "slow_pneunet.toml"
    before, count, size = file.read_bytes(), triangles(page), fact(page, "Outer size")
    field = page.locator("[data-key=chambers] input[type=text]")
    assert tomllib.loads(changed(page, file.name, enter(field, "7")))["actuator"]["chambers"] == 7
    assert triangles(page) > count
    length = page.locator("[data-key=length] input[type=range]")
    text = changed(page, file.name, lambda: length.press("ArrowRight"))
    length_text = tomllib.loads(text)["actuator"]["length"]
    assert fact(page, "Outer size").startswith(length_text.removesuffix(" mm"))
    for _ in range(2):
        changed(page, file.name, page.locator("#tools [aria-label=undo]").click)
    assert file.read_bytes() == before
    assert triangles(page) == count
    assert fact(page, "Outer size") == size


def test_impossible_value_is_explained_at_its_field(shown):
    page = shown.page
    go(page, "shape", "finger.toml")
    count = triangles(page)
    field = page.locator("[data-key=gap]")
    changed(page, "finger.toml", enter(field.locator("input[type=text]"), "20 mm"))
    sentence = field.locator(".wrong").inner_text()
    assert re.search(r"20 mm; allowed is 0.01 mm to .* mm, so that 11 chambers fit in 110 mm", sentence)
    assert field.locator("input[type=text]").get_attribute("aria-invalid") == "true"
    assert triangles(page) == count  # the last possible shape stays
    for other in page.locator(".field .wrong").all():
        assert other.inner_text() in ("", sentence)
    changed(page, "finger.toml", page.locator("#tools [aria-label=undo]").click)
    assert field.locator(".wrong").is_hidden()


@pytest.mark.slow
def test_no_slider_leaves_the_range(shown):
    page = shown.page
    go(page, "shape", "finger.toml")
    ends = page.evaluate(
        """async () => {
          const { form } = await (await fetch("/api/jobs/finger.toml/shape")).json();
          return form.keys.filter((key) => key.limits).map((key) => {
            const slider = document.querySelector(`[data-key=${key.name}] input[type=range]`);
            return [key.name, Number(slider.min), Number(slider.max), key.limits.low, key.limits.high];
          });
        }"""
    )
    assert len(ends) > 10
    for name, least, most, low, high in ends:
        assert low <= least < most <= high, name


@pytest.mark.slow
def test_part_is_brought_and_its_faces_are_named_by_clicks(shown, studio):
    page = shown.page
    page.locator("#part-file").set_input_files(
        {"name": "My Finger.STEP", "mimeType": "model/step", "buffer": (EXAMPLES / "cad_file.step").read_bytes()}
    )
    page.wait_for_selector("main.screen-shape [data-version]")
    file = studio.workspace / "My-Finger.toml"
    assert (studio.workspace / "My-Finger.step").read_bytes() == (EXAMPLES / "cad_file.step").read_bytes()
    assert tomllib.loads(file.read_text())["actuator"]["file"] == "My-Finger.step"
    before = file.read_bytes()
    # the side of the last chamber, towards the viewer
    x, y = page.evaluate(POINT, [0.036, -0.008, 0.009])
    page.mouse.move(x, y)
    page.wait_for_selector("[data-face=outside].lit")
    page.mouse.click(x, y)
    page.get_by_label("name of the face").fill("grip")
    changed(page, file.name, page.get_by_role("button", name="Name it").click)
    page.wait_for_selector("[data-face=grip]")
    (choice,) = [
        value for name, value in tomllib.loads(file.read_text())["actuator"]["faces"].items() if name == "grip"
    ]
    assert "near" in choice or "name" in choice
    grip = read_job(file).geometry()
    assert "grip" in grip.faces
    changed(page, file.name, page.locator("#tools [aria-label=undo]").click)
    assert file.read_bytes() == before


@pytest.mark.slow
def test_unit_is_asked_for_where_a_file_states_none(shown, studio):
    page = shown.page
    page.get_by_label("close the tour").click()
    page.locator("#part-file").set_input_files(EXAMPLES / "print.stl")
    page.get_by_role("button", name="50 × 16 × 8 cm").click()
    page.wait_for_selector("main.screen-shape [data-version]")
    assert tomllib.loads((studio.workspace / "print.toml").read_text())["actuator"]["unit"] == "cm"
    assert fact(page, "Outer size") == "500 × 160 × 80 mm"


@pytest.mark.slow
def test_part_that_cannot_be_read_is_explained_at_the_drop_zone(shown, studio):
    page = shown.page
    page.get_by_label("close the tour").click()
    page.locator("#part-file").set_input_files({"name": "bad.step", "mimeType": "", "buffer": b"ISO-10303-21;"})
    assert "bad.step" in page.locator("[role=alert] .wrong").inner_text()
    assert not (studio.workspace / "bad.step").exists()
    shown.complaints.clear()  # the browser notes the refusal


@pytest.mark.slow
def test_loads_are_put_on_faces(shown, studio):
    page = shown.page
    go(page, "setup", "finger.toml")
    page.click("[data-face=tip]")
    changed(page, "finger.toml", lambda: page.get_by_label("Support").select_option("y"))
    page.click("[data-face=outside]")
    changed(page, "finger.toml", enter(page.locator("[data-key=force] input"), "0, 0, -0.1 N"))
    changed(page, "finger.toml", enter(page.locator("[data-key=pressure] input").first, "30 kPa"))
    changed(page, "finger.toml", page.get_by_role("button", name="Add a plane").click)
    text = changed(page, "finger.toml", lambda: page.get_by_label("Gravity").select_option("-z"))
    content = tomllib.loads(text)
    assert content["supports"] == {"fixed": "xyz", "tip": "y"}  # the default one stays
    assert content["loads"]["outside"] == {"force": [0, 0, "-0.1 N"]}
    assert (content["loads"]["pressure"], content["loads"]["gravity"]) == ("30 kPa", "-z")
    assert content["obstacles"]["plate"]["shape"] == "plane"
    job = read_job(studio.workspace / "finger.toml")
    assert len(job.loads) == 3
    assert len(job.contact.obstacles) == 1


@pytest.mark.slow
def test_wrong_load_is_explained_at_its_field(shown):
    page = shown.page
    go(page, "setup", "cad_file.toml")
    field = page.locator("[data-key=pressure]").first
    changed(page, "cad_file.toml", enter(field.locator("input"), "30 kilopascal"))
    assert "kPa" in field.locator(".wrong").inner_text()


@pytest.mark.slow
def test_tour_points_at_five_things_once(shown):
    page = shown.page
    page.wait_for_selector(".tour")
    for number in range(1, 6):
        assert f"{number} of 5" in page.locator(".tour").inner_text()
        assert page.locator(".pointed").count() == 1
        page.locator(".tour .primary").click()
    assert page.locator(".tour").count() == 0
    page.reload()
    page.wait_for_selector(".family")
    assert page.locator(".tour").count() == 0


def test_list_of_families_is_that_of_the_registry():
    listed = json.loads((PAGE / "families.json").read_text(encoding="utf-8"))
    assert listed == [{"name": name, "words": kind.__doc__.splitlines()[0]} for name, kind in ACTUATORS.items()]
    assert {file.stem for file in PAGE.glob("*.png")} == set(ACTUATORS)


@pytest.mark.slow
def test_every_family_has_a_picture_to_begin_with(shown):
    page = shown.page
    page.wait_for_selector(".family")
    assert {each.get_attribute("data-family") for each in page.locator(".family").all()} == set(ACTUATORS)
    page.wait_for_function("[...document.querySelectorAll('.family img')].every((each) => each.loading)")
    for image in page.locator(".family img").all():
        image.scroll_into_view_if_needed()
    page.wait_for_function("[...document.querySelectorAll('.family img')].every((each) => each.naturalWidth === 240)")
