"""The demo as a user runs it, and a blocked finger: steps, files, pictures and report, against what is asked for.

python benchmarks/run.py demo_run      a section of results.md
python benchmarks/job/demo_run.py          the same, printed; about two minutes

`turgor run` and `turgor report` are processes of their own on two threads; what they print tells when each part begins.
"""

import csv
import os
import re
import resource
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.robustness.robustness_cases.touching import blocked
from benchmarks.shared.tables import table
from benchmarks.views import pictures

THREADS = min(2, os.cpu_count() or 1)

#: Lines of `turgor run` that begin a part, in their order.
PARTS = ("solving", "measuring", "writing the fields", "plotting", "writing the report")

Row = tuple[str, str, str]

#: Rows of chambers without a mesh size: the keys in place of those of the demo, the angle on a fine mesh [°]
#: (`benchmarks/choices.md`), and the seconds at most.
DEFAULTS = {
    "eleven chambers, 22.5 kPa": ({}, 252.3, 30.0),
    "five chambers, 12 kPa": (
        {"chambers = 11": "chambers = 5", '"110 mm"': '"50 mm"', '"22.5 kPa"': '"12 kPa"'},
        60.9,
        10.0,
    ),
}


def run(folder: Path, job: Path = pictures.JOB) -> dict[str, float]:
    """Wall seconds of each part of `turgor run`, and of all of it."""
    command = [sys.executable, "-m", "turgor", "run", str(job), "--threads", str(THREADS)]
    began = perf_counter()
    process = subprocess.Popen(
        [*command, "--output", str(folder), "--force"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    assert process.stdout is not None
    times = []
    for line in process.stdout:
        if len(times) < len(PARTS) and re.fullmatch(rf"\[.*\] {PARTS[len(times)]}\n", line):
            times.append(perf_counter())
    if process.wait() or len(times) < len(PARTS):
        raise SystemExit(f"turgor run ended with {process.returncode} after {len(times)} of {len(PARTS)} parts")
    end = perf_counter()
    return {part: after - before for part, before, after in zip(PARTS, times, [*times[1:], end], strict=True)} | {
        "all": end - began
    }


def on_default_meshes(place: Path) -> list[tuple[str, ...]]:
    """Rows of chambers as `turgor run` meshes and solves them by default, the second of two runs."""
    rows = []
    for number, (name, (keys, reference, most)) in enumerate(DEFAULTS.items()):
        text = pictures.JOB.read_text(encoding="utf-8").replace('[mesh]\nsize = "3 mm"\n', "")
        for old, new in keys.items():
            text = text.replace(old, new)
        job, folder = place / f"row{number}.toml", place / f"row{number}"
        job.write_text(text, encoding="utf-8")
        run(folder, job)
        spent = run(folder, job)
        solution = tg.load(folder)
        angle = float(np.degrees(tg.bending_angle(solution.states[-1]))) % 360
        taken = f"{len(solution.states) - 1}, {solution.iterations}"
        rows.append(
            (
                name,
                f"{solution.model.mesh.unknown_count:,}",
                taken,
                f"{angle:.1f}° ({angle / reference - 1:+.1%})",
                f"{spent['solving']:.1f}",
                f"{spent['all']:.1f}",
                f"{most:g}",
            )
        )
    return rows


def report(folder: Path) -> float:
    """CPU seconds of `turgor report` of the run."""
    before = _of_children()
    subprocess.run([sys.executable, "-m", "turgor", "report", str(folder)], check=True, capture_output=True)
    return _of_children() - before


def _of_children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def section() -> str:
    """The section of the page."""
    with TemporaryDirectory() as place:
        folder = Path(place) / "demo"
        spent = run(folder)
        with (folder / "steps.csv").open(encoding="utf-8") as file:
            steps = list(csv.DictReader(file))
        again = report(folder)
        solution = tg.load(folder)
        stills = pictures.rows(solution)
        defaults = on_default_meshes(Path(place))
    taken = sum(int(step["iterations"]) for step in steps)
    cuts = sum(step["accepted"] != "True" for step in steps)
    angle = np.degrees(tg.measure(solution, tg.bending_angle, mesh_error=False).column("bending_angle")[-1])
    finger = tg.solve(blocked(), tg.Static(), options=tg.EngineOptions(threads=1))
    stated = f"{finger.model.mesh.unknown_count:,} unknowns, paper, {len(finger.steps)} steps"
    rows: list[Row] = [
        (f"all steps, to {angle:.0f}°, wall s", f"{spent['solving']:.1f}", "25"),
        (f"iterations in {len(steps)} steps", str(taken), "110"),
        ("steps that were cut", str(cuts), "0"),
        ("measures, wall s", f"{spent['measuring']:.1f}", ""),
        ("mesh error, meanwhile fields and pictures, wall s", f"{spent['writing the fields']:.1f}", ""),
        ("plot and report, wall s", f"{spent['plotting'] + spent['writing the report']:.1f}", "5"),
        ("whole run, wall s", f"{spent['all']:.1f}", "30"),
        ("`turgor report` of the finished run, CPU s", f"{again:.1f}", "5"),
        *((f"picture: {name}, CPU s", f"{best:.2f}", f"{pictures.TARGET:g}") for name, best, _ in stills),
        (f"blocked finger, {stated}: iterations", str(finger.iterations), "60"),
    ]
    text = (
        f"`turgor run examples/fast_pneunet.toml`, {solution.model.mesh.unknown_count:,} unknowns, {THREADS} threads, "
        "caches filled; pictures once more in one process, the best of two after a first."
    )
    head = (
        "row",
        "unknowns",
        "steps, iterations",
        "angle (off a fine mesh)",
        "solve, wall s",
        "whole run, wall s",
        "at most",
    )
    more = "The same without a mesh size, the second of two runs; iterations are those of the whole row."
    return (
        f"## Demo as it is run\n\n{text}\n\n{table(('what', 'measured', 'at most'), rows)}\n\n"
        f"{more}\n\n{table(head, defaults)}\n"
    )


if __name__ == "__main__":
    print(section())
