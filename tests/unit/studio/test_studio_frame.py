"""What all screens share: narrow windows, names of controls, and use by the keyboard alone."""

import pytest
import reduced_cases
from served import needs_browser, open_page, served

JOB = """[actuator]
type = "fast_pneunet"
wall = "1 mm"

[materials]
body = { library = "ecoflex-00-30", record = "yeoh-steck-2019" }
"""

#: Each screen, and what it shows when it is there.
SCREENS = {
    "start": "h1",
    "materials/finger.toml": ".plot-line",
    "code/finger.toml": ".code-problems li",
    "live/finger.reduced": ".live-grip",
}

#: Controls that a screen reader could not name.
NAMELESS = """[...document.querySelectorAll("button, input, select, textarea, a[href]")].filter((each) =>
  each.checkVisibility() && !each.closest(".viewer") && !each.textContent.trim() && !each.getAttribute("aria-label")
  && !each.title && !each.labels?.length).map((each) => each.outerHTML.slice(0, 120))"""


@pytest.fixture(scope="module")
def studio(tmp_path_factory):
    folder = tmp_path_factory.mktemp("frame")
    (folder / "finger.toml").write_text(JOB, encoding="utf-8")
    reduced_cases.reduced_of(6).save(folder / "finger.reduced")
    with served(folder) as made:
        yield made


@needs_browser
@pytest.mark.parametrize("screen", SCREENS)
def test_screen_fits_narrow_windows_and_names_its_controls(studio, screen):
    with open_page(studio, f"#/{screen}", (1200, 850)) as shown:
        shown.page.wait_for_selector(SCREENS[screen])
        for width in (1200, 800, 390):
            shown.page.set_viewport_size({"width": width, "height": 800})
            shown.page.wait_for_timeout(60)
            assert shown.page.evaluate("document.documentElement.scrollWidth") <= width
        assert shown.page.evaluate(NAMELESS) == []
        shown.check()


@needs_browser
def test_tip_is_moved_by_the_keyboard(studio):
    with open_page(studio, "#/live/finger.reduced") as shown:
        page = shown.page
        page.wait_for_selector(".live-grip")
        page.focus(".live-input input[type=range]")
        for _ in range(40):
            page.keyboard.press("ArrowRight")
        shown.until("Number(document.querySelector('.live-input .live-number').value) > 1")
        before = float(page.input_value(".live-input .live-number"))
        page.focus(".live-grip")
        for _ in range(3):
            page.keyboard.press("ArrowDown")  # the finger bends downwards
        shown.until(f"Number(document.querySelector('.live-input .live-number').value) > {before + 0.5}")
        page.keyboard.press("Escape")
        assert page.locator(".live-mark").is_hidden()


@needs_browser
def test_edits_are_undone_and_screens_reached_by_the_keyboard(studio):
    with open_page(studio, "#/materials/finger.toml") as shown:
        page = shown.page
        page.wait_for_selector(".plot-line")
        page.keyboard.press("Tab")
        assert page.evaluate("document.activeElement.className") == "skip"
        page.get_by_role("button", name="use ecoflex-00-10").first.press("Enter")
        page.wait_for_selector("dd:has-text('ecoflex-00-10')")
        page.locator("h1").click()
        page.keyboard.press("Control+z")
        page.wait_for_selector("dd:has-text('yeoh-steck-2019')")
        page.get_by_role("link", name="Show the code").press("Enter")
        page.wait_for_selector("textarea")
