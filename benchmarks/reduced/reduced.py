"""A reduced model of the demo finger: its held-out error, and how many states it gives in a second.

    python benchmarks/reduced/reduced.py            the page reduced.md again; ten minutes

One process with one thread trains a fast PneuNet of 28,000 unknowns up to 22.5 kPa, walls in contact from 8 kPa, and
compares it with full solves at pressures that training never saw.
"""

import sys
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.shared.machine import machine
from benchmarks.shared.tables import table
from turgor.accuracy.gradients.model_keys import with_number
from turgor.core.model.model import Model
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.reduced.reduce import Budget
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.compare import errors_of
from turgor.reduced.training.trainer import Trainer

JOB, PAGE = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml", Path(__file__).with_suffix(".md")
KEY, PRESSURE = "loads.pressure", 22.5e3
STEPS, STATES, HELD_OUT = 45, 1000, 200
OPTIONS = tg.EngineOptions(threads=1)
HEAD = """# Reduced model of the demo finger

Written by `python benchmarks/reduced/reduced.py` in one run with one thread. The full step is the mean of another path
of full solves, with steps as in training. Times of states are processor time, with the displacement of every node.

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


def estimates(model: Model, reduced: Reduced) -> tuple[NDArray[np.float64], NDArray[np.float64], int]:
    """Estimates over true errors, and true errors, at held-out states of more paths; how many above 2 % lack a flag."""
    ratios, true, missed = [], [], 0
    for more, share in enumerate(np.linspace(0.85, 0.99, 4)):
        trainer = Trainer(
            lambda values: with_number(model, KEY, values[KEY]), reduced.inputs, STEPS + 5 + more, OPTIONS
        )
        path = trainer.path(np.array([share * PRESSURE]), differentiated=False)
        for inputs, displacement in zip(path.inputs, path.displacements, strict=True):
            answer = reduced.at(inputs[1:])
            true.append(errors_of(answer, displacement)[0])
            ratios.append(answer.estimate / true[-1])
            missed += true[-1] > 0.02 and not answer.doubtful
    return np.array(ratios[:HELD_OUT]), np.array(true[:HELD_OUT]), missed


def times(reduced: Reduced) -> NDArray[np.float64]:
    """Processor time [ms] of states at random pressures, with their displacements."""
    out = []
    for pressure in np.random.default_rng(0).uniform(0, PRESSURE, STATES):
        start = process_time()
        _ = reduced.solve(float(pressure)).displacement
        out.append(1e3 * (process_time() - start))
    return np.array(out)


def main() -> None:
    """Train, compare, measure, and write the page."""
    model, _ = prepare(read_job(JOB, {"mesh.size": "4 mm"}), lambda text: None)
    began, budget = perf_counter(), Budget(steps=STEPS, held_out=1)
    reduced = tg.reduce(model, {KEY: (0.0, PRESSURE)}, budget=budget, options=OPTIONS, say=print)
    made = perf_counter() - began
    reduced.solve(PRESSURE / 2)  # compiled loops are loaded
    ms, errors = times(reduced), reduced.held_out
    angle, step = angle_error(model, reduced)
    ratios, true, missed = estimates(model, reduced)
    within = np.mean((ratios > 0.3) & (ratios < 3))
    low, middle, high = np.percentile(ratios, [0, 50, 100])
    with TemporaryDirectory() as folder:
        size = reduced.save(Path(folder) / "finger").stat().st_size
    modes, means = reduced.equations.sizes
    median, slow = np.percentile(ms, [50, 99])
    rows = [
        ("unknowns of the full model", f"{model.mesh.unknown_count:,}", ""),
        ("modes of displacement and mean stress", f"{modes} + {means}", ""),
        ("training and held-out path", f"{made:.0f} s", ""),
        (f"tip, {len(errors.tip)} held-out states", f"{errors.tip.max():.2%} of its travel", "0.5 %"),
        ("any node", f"{errors.displacement.max():.2%} of the largest displacement", ""),
        ("volume", f"{errors.volume.max():.3%}", "0.2 %"),
        ("bending angle, ten states of another path", f"{angle:.3f}°", "0.5°"),
        (f"estimate over true error within 0.3 to 3, {len(ratios)} other held-out states", f"{within:.0%}", "95 %"),
        ("least, median and largest of these", f"{low:.2f}, {middle:.2f}, {high:.2f}", ""),
        (f"states with more than 2 % and no flag (largest error {true.max():.2%})", f"{missed}", "0"),
        (f"states a second, median of {STATES:,} random pressures", f"{1e3 / median:.0f}", "150"),
        ("99th percentile of their time", f"{slow:.1f} ms", "15 ms"),
        ("full step over a state", f"{1e3 * step / median:.0f}", "300"),
        ("file", f"{size / 1e6:.2f} MB", "5 MB"),
    ]
    facts = "\n".join(f"- {name}: {value}" for name, value in machine().items())
    PAGE.write_text(HEAD + table(("quantity", "measured", "target"), rows) + "\n\n" + facts + "\n", encoding="utf-8")
    print(PAGE.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
