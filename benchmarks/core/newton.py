"""What the refinements of Newton's method save: iterations and time, on hard cases and on the demo.

Plain Newton with equal steps; steps that adapt with extrapolation; and with mixed integration points too, which is the
default. All on one thread in this process. Run: python benchmarks/run.py newton; some minutes.
"""

import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import turgor as tg

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.robustness.robustness_cases import CASES
from benchmarks.robustness.robustness_cases.case import OPTIONS
from benchmarks.shared.tables import table
from turgor.core.engine.runtime import MIXED, NEWTON, PLAIN
from turgor.core.engine.warmup.compiling import compile_kernels
from turgor.core.engine.warmup.needs import Needs
from turgor.units import kPa, mm

ROOT = Path(__file__).parents[2]

#: Cases under load control that reach their load in the default way, of every kind.
NAMES = (
    "sphere, one step",
    "sphere close below its limit point",
    "Arruda-Boyce, near locking",
    "cantilever bent by 80 %",
    "clamped block squeezed to half",
    "slender closed tube",
    "McKibben muscle",
    "slow PneuNet, fine mesh",
    "bender up and down",
    "softest bender falls, then is filled",
    "ball pressed into a coarse block",
    "plate that sticks, 40 %",
)

EQUAL = tg.Static(first_step=0.05, max_step=0.05)
WAYS = (("equal steps, plain", PLAIN), ("adaptive, extrapolated", NEWTON), ("and mixed points", MIXED))

#: CPU seconds after which a run is left.
LIMIT = 300.0


def demo() -> tuple[tg.Model, tg.Static]:
    """The example at 4 mm, until shortly before its walls meet."""
    job = tg.jobs.read_job(ROOT / "examples" / "fast_pneunet.toml")
    mesh = tg.mesh(job.actuator.build(), size=4 * mm, grading=job.mesh.grading)
    return tg.Model(mesh, job.materials, job.supports, [tg.Pressure("cavity", 6 * kPa)]), tg.Static()


def run(model: tg.Model, procedure: tg.Static, way: str) -> tuple[int | None, float]:
    """Iterations, None where the load was not reached, and CPU seconds."""
    procedure = EQUAL if way == PLAIN else procedure
    start = time.process_time()

    def watch(iteration: object, state: object) -> None:
        if time.process_time() - start > LIMIT:
            raise KeyboardInterrupt

    options = replace(OPTIONS, iteration=way)
    solution = tg.solve(model, procedure, options=options, progress=watch, throw=False)
    return solution.iterations if solution.complete else None, time.process_time() - start


def section() -> str:
    """All runs as a section of the page of results."""
    for nodes, side in ((10, 6), (27, 9)):
        compile_kernels(None, Needs(nodes=nodes, sides=side))
    cases = {case.name: case for case in CASES}
    questions = [(name, cases[name].model(), cases[name].procedure) for name in NAMES]
    questions.append(("demo", *demo()))
    return text_of({name: [run(model, how, way) for _, way in WAYS] for name, model, how in questions})


def text_of(runs: Mapping[str, Sequence[tuple[int | None, float]]]) -> str:
    """The section: a row for each case, their sum, and the demo."""
    rows, sums = [], {way: [0, 0.0] for _, way in WAYS}
    for name, result in runs.items():
        if name != "demo" and all(count is not None for count, _ in result):
            for (_, way), (count, seconds) in zip(WAYS, result, strict=True):
                sums[way] = [sums[way][0] + (count or 0), sums[way][1] + seconds]
        rows.append((name, *(text for each in result for text in cells(*each))))
    rows.insert(-1, ("all that all reach", *(text for _, way in WAYS for text in cells(*sums[way]))))
    head = ("case", *(text for title, _ in WAYS for text in (title, "CPU s")))
    text = (
        "Newton iterations and CPU seconds to the full load, one thread, rslab. *Plain* makes 20 equal steps, starts "
        "each at the last state and factors every tangent; *adaptive* are the default steps, extrapolation and kept "
        "factors; the last pair adds mixed integration points and is the default. A dash: the load "
        f"was not reached in {LIMIT:g} CPU s."
    )
    return f"## Newton's method\n\n{text}\n\n{table(head, rows)}\n"


def cells(count: int | None, seconds: float) -> tuple[str, str]:
    """Two cells of a row."""
    return "–" if count is None else str(count), f"{seconds:.1f}"


if __name__ == "__main__":
    print(section())
