"""The whole way of a newcomer: from the picture of a family to the report of its run, by clicks alone."""

import re
import tomllib

import pytest
from served import needs_browser, open_page, served
from talking import Talk


@needs_browser
@pytest.mark.slow
def test_from_a_picture_to_a_report(tmp_path):
    with served(tmp_path) as studio, open_page(studio) as shown:
        page, file = shown.page, tmp_path / "rectangular_bender.toml"
        page.get_by_label("close the tour").click()
        page.click("[data-family=rectangular_bender]")
        page.wait_for_selector("main.screen-shape [data-version]")
        field = page.locator("[data-key=length] input[type=text]")
        field.fill("40 mm")
        field.press("Enter")
        shown.until("document.querySelector('#tools [aria-label=undo]')?.disabled === false")

        page.click("nav >> text=Loads")
        page.wait_for_selector("main.screen-setup [data-version]")
        pressure = page.locator("[data-key=pressure] input").first
        pressure.fill("10 kPa")
        pressure.press("Enter")
        shown.until("[...document.querySelectorAll('[data-face]')].some((e) => e.innerText.includes('10 kPa'))")
        content = tomllib.loads(file.read_text("utf-8"))
        assert (content["actuator"]["length"], content["loads"]["pressure"]) == ("40 mm", "10 kPa")

        page.click("nav >> text=Solve")
        page.wait_for_selector("p.good")
        page.click("button:has-text('Coarse only'):enabled")
        ended = Talk(studio).wait("rectangular_bender-draft", lambda state: state["state"] != "running", seconds=300)
        assert ended["state"] == "ended"
        page.click("a:has-text('Look')[href*=draft], button:has-text('Look')")
        page.wait_for_selector("table.numbers tbody tr")
        assert page.locator(".coarse").count() > 0
        angle = page.locator("table.numbers tbody tr", has_text="bending angle").inner_text()
        assert float(re.search(r"bending angle\s+([\d.]+)", angle)[1]) > 0.1

        page.click("main button:has-text('Report'):enabled")  # it is made, and is a link then
        with page.context.expect_page() as opened:
            page.click("main a:has-text('Report')")
        opened.value.wait_for_load_state()
        assert "rectangular" in opened.value.title().lower()
        shown.check()
