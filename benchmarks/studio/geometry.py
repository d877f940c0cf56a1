"""Time from a slider that stops to the new picture of a shape, for every actuator family, in headless Chromium.

Run `python benchmarks/studio/geometry.py`; it takes some minutes, and writes geometry.md. The page draws in software.
Each of three sliders of a family is moved once. The time is counted from the last event of the slider, so it has the
0.12 s in it after which the page takes the slider for one that stopped.
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))
sys.path.insert(0, str(Path(__file__).parents[2] / "tests/unit/studio"))
sys.path.insert(0, str(Path(__file__).parents[2] / "tests/unit/views/viewing"))
from served import open_page, served

from benchmarks.shared.machine import machine
from turgor.job.job import ACTUATORS
from turgor.job.reference.starters import example_job
from turgor.studio.edits import with_values
from turgor.studio.tasks.shapes import shape_of

#: What a redraw may take at the 95th percentile [s].
TARGET = 1.0

#: Sliders that are moved in each family.
SLIDERS = 3

PAGE = Path(__file__).parent / "geometry.md"

#: Moves a slider by one place, and waits until the page shows the job that it wrote.
MOVE = """async (number) => {
  const slider = document.querySelectorAll(".field input[type=range]:enabled")[number];
  const shown = document.querySelector("[data-version]");
  const before = shown.dataset.version;
  if (slider.value < slider.max) slider.stepUp(); else slider.stepDown();
  const begun = performance.now();
  slider.dispatchEvent(new Event("input"));
  await new Promise((resolve) => {
    const watch = new MutationObserver(() => shown.dataset.version !== before && (watch.disconnect(), resolve()));
    watch.observe(shown, { attributes: true });
  });
  await new Promise(requestAnimationFrame);
  const wrong = [...document.querySelectorAll(".field .wrong")].map((each) => each.textContent).join(" ").trim();
  return [(performance.now() - begun) / 1000, wrong, document.querySelector(".viewer").viewer.skin.faces];
}"""


def measured(page, family: str) -> tuple[list[float], int]:
    """Times of the redraws of a family [s], and the triangles of its modeled part."""
    page.evaluate("(to) => { location.hash = to }", f"#/shape/{family}.toml")
    page.wait_for_selector(".viewer:not([hidden])")
    page.wait_for_selector("[data-version]")
    page.wait_for_function(
        "(name) => document.querySelector('#tools .file').textContent === name", arg=f"{family}.toml"
    )
    page.wait_for_timeout(1500)
    times, count = [], 0
    for number in range(SLIDERS):
        seconds, wrong, count = page.evaluate(MOVE, number)
        if wrong:
            raise AssertionError(f"a slider of {family} has left its range: {wrong}")
        times.append(seconds)
    return times, count


def processor_time(file: Path) -> float:
    """Processor time of one redraw in the worker [s], which does not depend on what else the machine does."""
    shape = shape_of(file)
    key = next(each for each in shape["form"]["keys"] if each["limits"] and each["limits"]["unit"])
    low, high, unit = (key["limits"][name] for name in ("low", "high", "unit"))
    text = with_values(file.read_text(encoding="utf-8"), {f"actuator.{key['name']}": f"{(low + high) / 2:.6g} {unit}"})
    file.write_text(text, encoding="utf-8")
    begun = process_time()
    if shape_of(file)["problems"]:
        raise AssertionError(f"{key['name']} has left its range")
    return process_time() - begun


def main() -> None:
    """Measure all families, and write the page."""
    rows, every, spent = [], [], []
    with TemporaryDirectory() as folder:
        for family in ACTUATORS:
            text = example_job(family).read_text(encoding="utf-8")
            Path(folder, f"{family}.toml").write_text(text, encoding="utf-8")
        with served(Path(folder)) as studio, open_page(studio, "#/start") as shown:
            for family in ACTUATORS:
                times, count = measured(shown.page, family)
                every += times
                spent.append(processor_time(Path(folder) / f"{family}.toml"))
                each_time = " | ".join(f"{each:.2f}" for each in (spent[-1], *times))
                rows.append(f"| {family} | {count} | {each_time} |")
    late = float(np.percentile(every, 95))
    PAGE.write_text(
        "# Redraw of a shape in the studio\n\nWritten by `python benchmarks/studio/geometry.py`. Seconds from the last "
        "event of a slider to the new picture, drawn in software; three sliders of each family.\n\n"
        f"{', '.join(f'{key} {value}' for key, value in machine().items())}.\n\n"
        f"95th percentile: **{late:.2f} s**, median {np.median(every):.2f} s, worst {max(every):.2f} s; the target is "
        f"{TARGET:g} s. Of this the worker computes for {np.percentile(spent, 95):.2f} s (95th percentile); "
        "the rest is the page, and what other programs take of the machine.\n\n"
        f"| family | triangles | worker [CPU s] | {' | '.join(f'slider {k + 1} [s]' for k in range(SLIDERS))} |\n"
        "|---|---|---|"
        f"{'---|' * SLIDERS}\n" + "\n".join(rows) + "\n",
        encoding="utf-8",
    )


if __name__ == "__main__":
    main()
