"""Frames per second of the viewer of a report while a pointer turns it: python benchmarks/views/viewer.py FOLDER.

FOLDER holds a run, such as runs/demo; its report is written anew, elsewhere, so that the viewer is that of today.
Headless Chromium draws in software, without a graphics card. The rate falls with all else that the machine does, so
measure on an idle one. Exit code 1 below 30 frames a second.
"""

import shutil
import sys
from math import cos, sin
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from playwright.sync_api import Page, sync_playwright

import turgor as tg

LEAST, SPELLS, SECONDS = 30.0, 5, 2.0
GRAPHICS = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")
STAGE = "document.querySelector('.viewer').viewer.stage"


def turned(page: Page, seconds: float) -> float:
    """Frames per second while the pointer is dragged in circles over the picture."""
    page.locator(".v-picture canvas").scroll_into_view_if_needed()
    box = page.locator(".v-picture canvas").bounding_box()
    assert box is not None
    across, upward = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(across, upward)
    page.mouse.down()
    for k in range(10):
        page.mouse.move(across + k, upward)
    frames, began, k = page.evaluate(f"{STAGE}.frames"), perf_counter(), 0
    while perf_counter() - began < seconds:
        k += 1
        page.mouse.move(across + 120 * sin(0.05 * k), upward + 40 * (cos(0.05 * k) - 1))
    spent = perf_counter() - began
    drawn = page.evaluate(f"{STAGE}.frames") - frames
    page.mouse.up()
    return float(drawn / spent)


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    with TemporaryDirectory() as folder, sync_playwright() as driver:
        report = tg.report(tg.load(sys.argv[1]), Path(folder) / "report.html")
        started = driver.chromium.launch(executable_path=browser, args=list(GRAPHICS))
        page = started.new_page(viewport={"width": 1100, "height": 800})
        page.goto(report.resolve().as_uri())
        page.wait_for_function("document.querySelector('.viewer')?.viewer")
        rates = sorted(turned(page, SECONDS) for _ in range(SPELLS))
        drawn = page.evaluate(f"{STAGE}.now(), {STAGE}.renderer.info.render")
        started.close()
    listed = ", ".join(f"{rate:.0f}" for rate in rates)
    print(f"{drawn['triangles']} triangles, {drawn['lines']} lines; frames a second of {SPELLS} turns: {listed}")
    print(f"median {rates[SPELLS // 2]:.0f}, at least {LEAST:.0f} asked")
    return int(rates[SPELLS // 2] < LEAST)


if __name__ == "__main__":
    sys.exit(main())
