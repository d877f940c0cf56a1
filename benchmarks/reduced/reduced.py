"""Reduced models next to full solves: the demo finger, then a plate, motion, and a wound bender that relaxes.

    python benchmarks/reduced/reduced.py            the page reduced.md again; half an hour
    python benchmarks/reduced/reduced.py plate      its section on a plate again

One process with one thread trains a fast PneuNet of 28,000 unknowns up to 22.5 kPa, walls in contact from 8 kPa, and
compares it with full solves at pressures that training never saw. The other cases are in `cases.py`.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.reduced import cases
from benchmarks.reduced.cases import JOB, KEY, OPTIONS, Rows
from benchmarks.shared.machine import machine
from benchmarks.shared.tables import table
from turgor.accuracy.gradients.model_keys import with_number
from turgor.core.model.model import Model
from turgor.foundation.errors import NotSolved
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.reduced.reduce import Budget
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.compare import errors_of
from turgor.reduced.training.trainer import Trainer
from turgor.views.viewer.between import error_between

PAGE = Path(__file__).with_suffix(".md")
PRESSURE, STEPS, STATES, HELD_OUT = 22.5e3, 45, 1000, 200
HEAD = """# Reduced models next to full solves

Written by `python benchmarks/reduced/reduced.py`; with names of cases (finger, plate, motion, impact, wound) it writes
their sections again. Each case has one thread. All times but that of the training are processor time. The full step is
the mean of another path of full solves, with steps as in training; times of states have the displacement of every node.
The settings of the estimate were chosen on other paths than those that are counted here.

"""


def angle_error(model: Model, reduced: Reduced) -> tuple[float, float]:
    """Largest error of the bending angle [deg] at ten states of another path; processor time of its steps [s]."""
    trainer = Trainer(lambda values: with_number(model, KEY, values[KEY]), reduced.inputs, STEPS + 3, OPTIONS)
    began = process_time()
    path = trainer.path(np.array([0.97 * PRESSURE]), differentiated=False)
    step, worst = (process_time() - began) / len(path.inputs), 0.0
    for place in np.linspace(0, len(path.inputs) - 1, 10).astype(int):
        state = reduced.at(path.inputs[place, 1:]).state()
        full = replace(state, displacement=path.displacements[place] * reduced.scales[0])
        difference = np.rad2deg(tg.bending_angle(state) - tg.bending_angle(full))
        worst = max(worst, abs((difference + 180) % 360 - 180))
    return worst, step


@dataclass(frozen=True, slots=True)
class Unseen:
    """Held-out states of more paths.

    Parameters
    ----------
    ratios, true : (k,) arrays
        Estimates over true errors, and true errors.
    missed : int
        States whose error exceeds 2 % without a flag.
    between : float
        Error of shapes between every other state of the first of these paths, as the slider of a report draws them.
    """

    ratios: NDArray[np.float64]
    true: NDArray[np.float64]
    missed: int
    between: float


def unseen(model: Model, reduced: Reduced) -> Unseen:
    """Compare estimates with true errors at held-out states of more paths."""
    ratios, true, missed, between = [], [], 0, []
    for more, share in enumerate(np.linspace(0.83, 0.98, 4)):
        trainer = Trainer(
            lambda values: with_number(model, KEY, values[KEY]), reduced.inputs, STEPS + 6 + more, OPTIONS
        )
        path = trainer.path(np.array([share * PRESSURE]), differentiated=False)
        between.append(error_between(path.inputs[:, 1], path.displacements))
        for inputs, displacement in zip(path.inputs, path.displacements, strict=True):
            answer = reduced.at(inputs[1:])
            true.append(errors_of(answer, displacement)[0])
            ratios.append(answer.estimate / true[-1])
            missed += true[-1] > 0.02 and not answer.doubtful
    return Unseen(np.array(ratios[:HELD_OUT]), np.array(true[:HELD_OUT]), missed, between[0])


def jumps(reduced: Reduced) -> tuple[int, int]:
    """Answers and refusals of jumps to random pressures, each from the answer before."""
    answered, refused, last = 0, 0, None
    for pressure in np.random.default_rng(1).uniform(0, PRESSURE, STATES):
        try:
            last = reduced.solve(float(pressure), start=last)
            answered += 1
        except NotSolved:
            refused += 1
    return answered, refused


def times(reduced: Reduced) -> NDArray[np.float64]:
    """Processor time [ms] of states at random pressures, with their displacements."""
    out = []
    for pressure in np.random.default_rng(0).uniform(0, PRESSURE, STATES):
        start = process_time()
        _ = reduced.solve(float(pressure)).displacement
        out.append(1e3 * (process_time() - start))
    return np.array(out)


def finger() -> Rows:
    """Train the demo finger, compare, measure."""
    model, _ = prepare(read_job(JOB, {"mesh.size": "4 mm"}), lambda text: None)
    began, budget = perf_counter(), Budget(steps=STEPS, held_out=1)
    reduced = tg.reduce(model, {KEY: (0.0, PRESSURE)}, budget=budget, options=OPTIONS, say=print)
    made, (modes, means) = perf_counter() - began, reduced.equations.sizes
    reduced.solve(PRESSURE / 2)  # compiled loops are loaded
    median, slow = np.percentile(times(reduced), [50, 99])
    angle, step = angle_error(model, reduced)
    answered, refused = jumps(reduced)
    with TemporaryDirectory() as folder:
        size = reduced.save(Path(folder) / "finger").stat().st_size
    return [
        ("unknowns of the full model", f"{model.mesh.unknown_count:,}", ""),
        ("modes of displacement and mean stress", f"{modes} + {means}", ""),
        ("training and held-out path", f"{made:.0f} s", ""),
        *held_out_rows(reduced),
        ("bending angle, ten states of another path", f"{angle:.3f}°", "0.5°"),
        *unseen_rows(unseen(model, reduced)),
        (f"states a second, median of {STATES:,} random pressures", f"{1e3 / median:.0f}", "150"),
        ("99th percentile of their time", f"{slow:.1f} ms", "15 ms"),
        ("full step over a state", f"{1e3 * step / median:.0f}", "300"),
        (f"{STATES:,} random jumps, each from the answer before", f"{answered:,} answered, {refused} refused", "all"),
        ("file", f"{size / 1e6:.2f} MB", "5 MB"),
    ]


def held_out_rows(reduced: Reduced) -> Rows:
    """Errors on the held-out path of the training."""
    errors = reduced.held_out
    return [
        (f"tip, {len(errors.tip)} held-out states", f"{errors.tip.max():.2%} of its travel", "0.5 %"),
        ("any node", f"{errors.displacement.max():.2%} of the largest displacement", ""),
        ("volume", f"{errors.volume.max():.3%}", "0.2 %"),
    ]


def unseen_rows(states: Unseen) -> Rows:
    """Estimates on further paths, and what the slider of a report makes of one of them."""
    within = np.mean((states.ratios > 0.3) & (states.ratios < 3))
    low, middle, high = np.percentile(states.ratios, [0, 50, 100])
    count = len(states.ratios)
    return [
        (f"estimate over true error within 0.3 to 3, {count} other held-out states", f"{within:.1%}", "95 %"),
        ("least, median and largest of these", f"{low:.2f}, {middle:.2f}, {high:.2f}", ""),
        (f"states with more than 2 % and no flag (largest error {states.true.max():.2%})", f"{states.missed}", "0"),
        ("slider of a report, every other state left out", f"{states.between:.3%} of the largest displacement", ""),
    ]


#: Sections of the page: their titles, and what makes their rows.
CASES: dict[str, tuple[str, Callable[[], Rows]]] = {
    "finger": ("The demo finger", finger),
    "plate": ("A plate at untrained heights", cases.plate),
    "motion": ("Motion", cases.motion),
    "impact": ("Impact on a plate", cases.impact),
    "wound": ("A wound bender that relaxes", cases.wound),
}


def written(name: str) -> str:
    """Run a case and return its section of the page."""
    title, rows = CASES[name]
    facts = ", ".join(f"{key} {value}" for key, value in machine().items())
    return f"## {title}\n\n{table(('quantity', 'measured', 'target'), rows())}\n\n{facts}\n"


def main() -> None:
    """Run the named cases, or all, and write their sections of the page again."""
    for name in sys.argv[1:] or CASES:
        section, title = written(name), f"## {CASES[name][0]}\n"
        print(section)
        before = PAGE.read_text(encoding="utf-8").split("\n## ") if PAGE.exists() else []
        sections = {f"## {text.partition(chr(10))[0]}\n": f"## {text.strip()}\n" for text in before[1:]}
        sections[title] = section
        every = [sections[f"## {known}\n"] for known, _ in CASES.values() if f"## {known}\n" in sections]
        PAGE.write_text(HEAD + "\n".join(every), encoding="utf-8")


if __name__ == "__main__":
    main()
