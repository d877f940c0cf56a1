"""From a slider to the picture with a reduced model: python benchmarks/studio/live.py FILE.reduced.

Headless Chromium draws in software, without a graphics card. A slider moves to random places, and the tip is dragged,
as fast as a hand does: 30 times a second. A delay ends with the second frame of the browser after the new state, so
that the first one, which has it, is on the screen. Exit code 1 where the 95th percentile of the slider is above 50 ms.
"""

import random
import re
import shutil
import subprocess
import sys
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

MOST, MOVES, PAUSE = 50.0, 200, 33
GRAPHICS = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")
LIVE = "document.querySelector('main').live"


def slid(page: Page) -> None:
    """Move the first slider to random places."""
    random.seed(0)
    for _ in range(MOVES):
        page.evaluate(
            """(share) => {
              const slider = document.querySelector('.live-input input[type=range]');
              slider.value = Number(slider.min) + share * (slider.max - slider.min);
              slider.dispatchEvent(new Event('input', { bubbles: true }));
            }""",
            random.random(),
        )
        page.wait_for_timeout(PAUSE)


def dragged(page: Page) -> None:
    """Drag the tip up and down."""
    box = page.locator(".live-grip").bounding_box()
    assert box is not None
    x, y = box["x"] + 12, box["y"] + 12
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(MOVES):
        page.mouse.move(x - 0.3 * (k % 100), y + (k % 100))
        page.wait_for_timeout(PAUSE)
    page.mouse.up()


def percentiles(page: Page, act: object) -> tuple[int, float, float, float]:
    """Pictures, and the median, the 95th percentile and the largest delay [ms]."""
    page.wait_for_timeout(1000)
    page.evaluate(f"void ({LIVE}.delays = [])")
    act(page)  # type: ignore[operator]
    page.wait_for_timeout(500)
    delays = sorted(page.evaluate(f"{LIVE}.delays"))
    return len(delays), delays[len(delays) // 2], delays[int(0.95 * len(delays))], delays[-1]


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    command = [sys.executable, "-m", "turgor", "live", sys.argv[1], "--no-browser", "--port", "0"]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert server.stdout is not None
    address = re.search(r"http\S+", server.stdout.readline())
    assert address is not None
    try:
        with sync_playwright() as driver:
            started = driver.chromium.launch(executable_path=browser, args=list(GRAPHICS))
            page = started.new_page(viewport={"width": 1300, "height": 900})
            page.goto(address[0])
            page.wait_for_selector(".live-rows dd", timeout=120_000)
            size = page.evaluate(f"[{LIVE}.model.points, {LIVE}.model.q.length]")
            print(f"{Path(sys.argv[1]).name}: {size[0]} vertices, {size[1]} modes")
            rows = {"slider": percentiles(page, slid), "tip dragged": percentiles(page, dragged)}
            started.close()
    finally:
        server.kill()
    for name, (count, median, high, largest) in rows.items():
        print(f"{name}: {count} pictures of {MOVES} moves")
        print(f"  {median:.0f} ms in the median, 95th percentile {high:.0f}, largest {largest:.0f}")
    return int(rows["slider"][2] > MOST)


if __name__ == "__main__":
    sys.exit(main())
