"""Chosen numbers of the solvers: which of them decide anything, at half and at double their value.

python benchmarks/robustness/constants.py [SECONDS]   writes constants.md from the cases that take at most so long

Every chosen number in `turgor.core.solvers`, a field of settings or a name in upper case, is replaced by a probe: a
number that also knows half and double its value. A probe behaves like the number, so the cases run as they do without
it. Where it is compared, or a result of it, it notes whether half or double would decide otherwise. Where it leaves the
reach of probes, as in arrays, counts of loops and digits, it notes that it was used. One run therefore answers for all
numbers. What no case decides is not proven useless: set such a number to what removing it means, and run the cases
before it goes. `probe_plugin.py` does both in tests.
"""

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.robustness.probed_source import PLAN, install
from benchmarks.robustness.probes import NOTES

if __name__ == "__main__":
    install(["core.solvers"], [], [])

import turgor as tg
from benchmarks.robustness.robustness import written
from benchmarks.robustness.robustness_cases import CASES
from benchmarks.robustness.robustness_cases.case import MM, RUBBER, limited, one
from benchmarks.shared.tables import table

import meshes  # isort: skip  (found where robustness_cases.case says)

PAGE = Path(__file__).parent / "constants.md"
HEAD = ("module", "number", "value", "cases that use it", "decided otherwise at half", "at double", "cases")


def cases(seconds: float) -> list[tuple[str, Callable[[], tg.Model], Any]]:
    """Robustness cases that took at most so long, a bar that swings under its weight, and an arch in viscous air."""
    took = {name: float(line[6]) for name, line in written().items()}
    chosen = [(case.name, case.model, case.procedure) for case in CASES if took.get(case.name, 1e9) <= seconds]
    bar = partial(meshes.box, (40 * MM, 4 * MM, 4 * MM), (8, 1, 1))
    swinging = lambda: one(bar(), RUBBER, [tg.Gravity((0, 0, -1))], [tg.Fixed("x0")])  # noqa: E731
    arch = next(case.model for case in CASES if case.name == "arch, load control")
    return [*chosen, ("swinging bar", swinging, tg.Dynamic(duration=0.3)), ("viscous arch", arch, tg.Stabilized())]


def row(name: str, value: float, marks: dict[str, set[str]]) -> tuple[str, ...]:
    """One line of the table; of the cases that decide otherwise at most three are named."""
    used = marks["used"] | marks["number"]
    otherwise = sorted(marks["half"] | marks["double"])
    named = "; ".join(otherwise[:3]) + (" …" if len(otherwise) > 3 else "")
    count = [str(len(marks[what])) for what in ("half", "double")]
    if used and not otherwise and marks["number"]:
        named = "used as a number, such as a count or in arrays"
    name = name.removeprefix("core.solvers.")
    module, number = name.split(".settings.") if ".settings." in name else name.rsplit(".", 1)
    return (module, number, f"{value:g}", str(len(used)), *count, named)


def main() -> None:
    """Run the cases and write the page."""
    done = 0
    chosen = cases(float(sys.argv[1]) if len(sys.argv) > 1 else 1.0)
    for name, model, procedure in chosen:
        NOTES.case = name
        solution, seconds = limited(model(), procedure)
        done += 1
        print(f"{name}: {solution.status}, {solution.iterations} iterations, {seconds:.1f} CPU s", flush=True)
    lines = [row(name, value, NOTES.marks[name]) for name, value in PLAN.values.items()]
    text = (__doc__ or "").split("\n\n")[2].replace("\n", " ")
    written_by = f"Written by `python benchmarks/robustness/constants.py` from {done} cases."
    page = f"# Chosen numbers of the solvers\n\n{written_by} {text}\n\n"
    PAGE.write_text(page + table(HEAD, lines) + "\n", "utf-8")


if __name__ == "__main__":
    main()
