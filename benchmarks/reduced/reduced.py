"""A reduced model of the demo finger: its held-out error, and how many states it gives in a second.

One process with one thread trains a fast PneuNet of 28,000 unknowns up to 22.5 kPa, walls in contact from 8 kPa, and
compares it with full solves at pressures that training never saw. The full step is the mean of the training path.
Targets: tip within 0.5 % of its travel, angle within 0.5°, volume within 0.2 %; 150 states a second in the median, the
99th percentile within 15 ms; 300 times the full step. Run: python benchmarks/reduced/reduced.py [JOB key=value ...].
"""

import sys
from pathlib import Path
from time import perf_counter, process_time

import numpy as np

import turgor as tg
from turgor.core.model.model import Model
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.reduced.reduce import Budget
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.trainer import Path as FullPath
from turgor.reduced.training.trainer import Trainer

JOB = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml"
PRESSURE = 22.5e3
STEPS, STATES = 45, 1000


def angle_errors(model: Model, reduced: Reduced, steps: int) -> tuple[float, FullPath]:
    """Largest error of the bending angle [deg] at ten full states that training never saw."""
    trainer = Trainer(
        lambda values: reduced_model(model, values["loads.pressure"]),
        reduced.inputs, steps, tg.EngineOptions(threads=1),
    )  # fmt: skip
    path = trainer.path(np.array([0.97 * PRESSURE]), differentiated=False)
    worst = 0.0
    for place in np.linspace(0, len(path.inputs) - 1, 10).astype(int):
        state = reduced.at(path.inputs[place, 1:]).state()
        angle = tg.bending_angle(state)
        full = tg.bending_angle(with_displacement(state, path.displacements[place] * reduced.scales[0]))
        difference = np.rad2deg(angle - full)
        worst = max(worst, abs((difference + 180) % 360 - 180))
    return worst, path


def with_displacement(state: object, displacement: object) -> object:
    """The state with another displacement."""
    from dataclasses import replace

    return replace(state, displacement=displacement)  # type: ignore[type-var]


def reduced_model(model: Model, pressure: float) -> Model:
    """The model at a pressure."""
    from turgor.accuracy.gradients.model_keys import with_number

    return with_number(model, "loads.pressure", pressure)


def times(reduced: Reduced) -> np.ndarray:
    """Milliseconds of processor time of states at random pressures, with their displacements."""
    out = []
    for pressure in np.random.default_rng(0).uniform(0, PRESSURE, STATES):
        start = process_time()
        _ = reduced.solve(float(pressure)).displacement
        out.append(1e3 * (process_time() - start))
    return np.array(out)


def main(job: Path, changes: dict[str, str]) -> None:
    """Train, compare, measure."""
    model, _ = prepare(read_job(job, {"mesh.size": "4 mm", **changes}), lambda text: None)
    options, began = tg.EngineOptions(threads=1), perf_counter()
    ranges = {"loads.pressure": (0.0, PRESSURE)}
    reduced = tg.reduce(model, ranges, budget=Budget(steps=STEPS, held_out=1), options=options, say=print)
    print(f"made in {perf_counter() - began:.0f} s; {model.mesh.unknown_count} unknowns")
    errors, nodes = reduced.held_out, reduced.held_out.displacement.max()
    print(
        f"{len(errors.tip)} held-out states: tip {errors.tip.max():.2%}, any node {nodes:.2%}, "
        f"volume {errors.volume.max():.3%}"
    )
    reduced.solve(PRESSURE / 2)
    ms = times(reduced)
    median, slow = np.percentile(ms, [50, 99])
    print(f"{1e3 / median:.0f} states a second; median {median:.2f} ms, 99th percentile {slow:.1f} ms")
    angle, path = angle_errors(model, reduced, STEPS + 3)
    full = 1e3 * path.seconds / len(path.inputs)
    print(f"angle {angle:.3f} deg at ten held-out states; full step {full:.0f} ms, {full / median:.0f} times")
    file = reduced.save(Path(sys.argv[0]).with_suffix("").name)
    print(f"file {file.stat().st_size / 1e6:.2f} MB")
    file.unlink()


if __name__ == "__main__":
    where = Path(sys.argv[1]) if len(sys.argv) > 1 else JOB
    main(where, dict(item.split("=", 1) for item in sys.argv[2:]))
