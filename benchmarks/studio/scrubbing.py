"""Frames per second of the studio while a run is scrubbed: python benchmarks/studio/scrubbing.py FOLDER.

FOLDER holds a run, such as runs/demo. The screen Look shows it, with its curves and numbers, in headless Chromium,
which draws in software, without a graphics card. The slider moves by a twentieth of a step with each frame.
The rate falls
with all else that the machine does, so measure on an idle one; the CPU time of the page for each frame is printed, too.
Exit code 1 below 30 frames a second.
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from playwright.sync_api import CDPSession, sync_playwright

LEAST, SPELLS, SECONDS = 30.0, 5, 2.0
GRAPHICS = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")

#: Moves the slider with each frame of the browser, to and fro; returns frames and seconds.
SCRUB = """async (seconds) => {
  const slider = document.querySelector("[data-v=slider]");
  const most = Number(slider.max);
  const step = Math.max(Number(slider.step), most / 100);
  const began = performance.now();
  let frames = 0, place = most, way = -1;
  while (performance.now() - began < 1000 * seconds) {
    await new Promise(requestAnimationFrame);
    place += way * step;
    if (place <= 0 || place >= most) way = -way;
    slider.value = place;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    frames += 1;
  }
  return [frames, (performance.now() - began) / 1000];
}"""


def spent(session: CDPSession) -> dict[str, float]:
    """CPU time of the processes of the browser so far [s]: of the page, and of what draws."""
    processes = session.send("SystemInfo.getProcessInfo")["processInfo"]
    kinds = {"page": "renderer", "drawing": "GPU"}
    return {name: sum(each["cpuTime"] for each in processes if each["type"] == kind) for name, kind in kinds.items()}


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    run = Path(sys.argv[1]).resolve()
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    command = [sys.executable, "-m", "turgor", "studio", str(run.parent), "--no-browser", "--port", "0"]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        assert server.stdout is not None
        address = re.search(r"http\S+", server.stdout.readline())
        assert address is not None
        with sync_playwright() as driver:
            started = driver.chromium.launch(executable_path=browser, args=list(GRAPHICS))
            page = started.new_page(viewport={"width": 1200, "height": 900})
            page.goto(f"{address[0]}#/look/{run.name}")
            page.wait_for_selector(".v-picture canvas", timeout=300_000)
            page.wait_for_selector("table.numbers tbody tr")
            session = started.new_browser_cdp_session()
            page.evaluate(SCRUB, 1.0)
            rates, costs = [], []
            for _ in range(SPELLS):
                before = spent(session)
                frames, seconds = page.evaluate(SCRUB, SECONDS)
                rates.append(frames / seconds)
                now = spent(session)
                costs.append({name: 1000 * (now[name] - before[name]) / frames for name in now})
            started.close()
    finally:
        server.kill()
        server.wait()
    rates.sort()
    print(f"frames a second of {SPELLS} spells: {', '.join(f'{rate:.0f}' for rate in rates)}")
    for name in costs[0]:
        listed = ", ".join(f"{each[name]:.0f}" for each in costs)
        print(f"CPU milliseconds of each frame, {name}: {listed}")
    print(f"median {rates[SPELLS // 2]:.0f}, at least {LEAST:.0f} is the target")
    return int(rates[SPELLS // 2] < LEAST)


if __name__ == "__main__":
    sys.exit(main())
