"""Environments of Gymnasium: steps a second, and how many states and derivatives a second the functions give.

    python benchmarks/systems/learning.py       the page learning.md again; a minute

One process with one thread; seconds are processor time. It needs Gymnasium; PyTorch and JAX are measured where they are
installed.
"""

import sys
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from time import process_time

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.shared.machine import machine
from benchmarks.shared.tables import table
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.units import kPa, mm

JOB, PAGE = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml", Path(__file__).with_suffix(".md")
CHAMBERS, PRESSURE = 4, 10 * kPa
HEAD = """# Reduced models for learning

Written by `python benchmarks/systems/learning.py` in one run with one thread; seconds are processor time. The
actuator has four chambers of the demo's finger, whose walls meet, and is pressurized to 10 kPa. The target
is 200 steps a second.

"""


def model() -> tg.real_time.Reduced:
    """A reduced model of four chambers."""
    changes = {"mesh.size": "8 mm", "actuator.chambers": CHAMBERS, "actuator.length": "42 mm"}
    full = prepare(read_job(JOB, changes), lambda text: None)[0]
    budget = tg.real_time.Budget(steps=8, held_out=1)
    return tg.reduce(full, {"loads.pressure": (0.0, PRESSURE)}, budget=budget, options=tg.EngineOptions(threads=1))


def steps_a_second(reduced: tg.real_time.Reduced, air: tg.control.Air | tg.learning.Valves, episodes: int = 5) -> float:
    """Steps of random smooth commands a second, resets included."""
    limits = tg.control.Limits(rate=100 * kPa)
    task = tg.learning.FollowTask(reduced=reduced, air=air, limits=limits, noise=0.1 * mm, pressure_noise=50.0)
    env, count = tg.learning.environment(task), 0
    env.reset(seed=0)
    began = process_time()
    for seed in range(episodes):
        env.reset(seed=seed)
        share, ended = np.zeros(len(task.reduced.inputs.keys)), False
        while not ended:
            share = np.clip(share + 0.1 * env.np_random.normal(size=len(share)), -1, 1)
            _, _, lost, truncated, _ = env.step(share.astype(np.float32))
            count, ended = count + 1, lost or truncated
    return count / (process_time() - began)


def states_a_second(work: Callable[[np.ndarray], object], count: int = 400) -> float:
    """States a second of a batch of random pressures."""
    inputs = np.random.default_rng(0).uniform(0, PRESSURE, (count, 1))
    work(inputs[:2])
    began = process_time()
    work(inputs)
    return count / (process_time() - began)


def with_torch(reduced: tg.real_time.Reduced) -> Callable[[np.ndarray], object]:
    """Values of a batch and their gradient, by PyTorch."""
    import torch

    of_tip = tg.learning.to_torch(reduced)

    def work(inputs: np.ndarray) -> object:
        tensor = torch.tensor(inputs, requires_grad=True)
        return torch.autograd.grad(of_tip(tensor).square().sum(), tensor)

    torch.set_num_threads(1)
    return work


def with_jax(reduced: tg.real_time.Reduced) -> Callable[[np.ndarray], object]:
    """Values of a batch and their gradient, by JAX."""
    import jax

    of_tip = tg.learning.to_jax(reduced)
    gradient = jax.grad(lambda inputs: (of_tip(inputs) ** 2).sum())
    return lambda inputs: gradient(jax.numpy.asarray(inputs)).block_until_ready()


def main() -> None:
    """Measure all and write the page."""
    reduced = model()
    valve = tg.air.Restriction(conductance=1e-9)
    airs = {
        "lag of first order, 20 ms": tg.control.Air(lag=20e-3),
        "valves of 0.1 dm³/(s bar) at 50 kPa": tg.learning.Valves(supply=50 * kPa, valve=valve),
    }
    steps = [[name, f"{steps_a_second(reduced, air):.0f}"] for name, air in airs.items()]
    works = {"NumPy": tg.learning.function(reduced).with_rates}
    if find_spec("torch"):
        works["PyTorch"] = with_torch(reduced)
    if find_spec("jax"):
        works["JAX"] = with_jax(reduced)
    states = [[name, f"{states_a_second(work):.0f}"] for name, work in works.items()]
    PAGE.write_text(
        HEAD
        + f"`{reduced!r}`\n\n"
        + table(["environment, a period of 20 ms", "steps a second"], steps)
        + "\n\n"
        + table(["tip and its derivatives, random pressures", "states a second"], states)
        + "\n\n"
        + "\n".join(f"- {name}: {value}" for name, value in machine().items())
        + "\n",
        encoding="utf-8",
    )


if __name__ == "__main__":
    main()
