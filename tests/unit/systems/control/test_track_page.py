"""The page of a track: motion, pictures and limits in one file."""

import json
import re
from functools import cache

import numpy as np
import pytest
from browser import needs_browser, opened
from reduced_cases import LENGTH, pressing, reduced

import turgor as tg
from refused import refused
from turgor.units import mm
from turgor.views.viewer.packing import unpack


@cache
def followed():
    """There and back, past the limit of the pressure."""
    pressures = np.concatenate([np.linspace(500.0, 11e3, 25), np.linspace(11e3, 4e3, 25)])
    tips = np.array([reduced().solve(float(pressure)).tip for pressure in pressures])[:, [0, 2]]
    limits = tg.control.Limits(high=9.5e3)
    return tg.control.track(reduced(), tips, times=np.linspace(0, 3, 50), output=tg.control.Tip("xz"), limits=limits)


def test_page_has_the_motion_with_the_wanted_path_and_the_limits(tmp_path):
    track = followed()
    page = tg.control.write_page(track, tmp_path / "page.html", "There and back").read_text(encoding="utf-8")
    assert "<h1>There and back</h1>" in page
    assert "loads.pressure from 0.5 kPa to 9.5 kPa" in page
    assert "<td>loads.pressure high</td>" in page
    assert f"{sum(map(bool, track.active))} of 50" in page
    assert not re.search(r"(src|href)=.http", page)
    scene = json.loads(page.split('<script type="application/json">')[1].split("</script>")[0])
    assert scene["steps"][0] == {"state": 0, "label": "at rest"}
    assert scene["steps"][-1]["state"] == 50
    assert scene["steps"][-1]["label"] == "3 s \xb7 distance < 0.0003 mm"
    last = np.array(unpack(scene["path"]["positions"]))[-1]
    wanted = np.array([[0.022, 0.0, 0.0]]) + np.array([[track.target[-1, 0], 0.0, track.target[-1, 1]]])
    ball = last[-72:].mean(axis=0)
    assert ball[[0, 1]] == pytest.approx(wanted[0, [0, 1]], abs=0.1 * mm)


@needs_browser
def test_motion_plays_in_a_browser_and_its_plots_follow(tmp_path):
    from playwright.sync_api import sync_playwright

    file = tg.control.write_page(followed(), tmp_path / "page.html")
    with sync_playwright() as driver, opened(driver, file) as shown:
        before = shown.pixels()
        marked = "document.querySelector('figure .v-marker').getAttribute('cx')"
        first = shown.page.evaluate(marked)
        shown.change("slider", "5")
        assert shown.pixels() != before
        assert shown.page.evaluate(marked) != first
        with_path = shown.pixels()
        shown.change("path", False)
        assert shown.pixels() != with_path
        assert shown.complaints == []
        assert shown.requests == []


def test_page_of_a_force_has_the_plate_and_no_path(tmp_path):
    place = {"point.1": LENGTH + 3 * mm}
    limits = tg.control.Limits(low=place, high=place)
    track = tg.control.track(pressing(), np.linspace(0, 0.5, 4), output=tg.control.ContactForce(), limits=limits)
    page = tg.control.write_page(track, tmp_path / "page.html").read_text(encoding="utf-8")
    assert "obstacles.plate.point.1 31 mm" in page
    assert "No row reached a limit." in page
    scene = json.loads(page.split('<script type="application/json">')[1].split("</script>")[0])
    assert scene["obstacles"]
    assert "path" not in scene
    assert "point_1" in track.response().names
    with refused("page.htm", ".html"):
        tg.control.write_page(track, tmp_path / "page.htm")
