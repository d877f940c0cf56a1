"""Chains, tables and segments for robot simulators: their errors, and how fast MuJoCo runs the chains.

    python benchmarks/systems/robots.py            the page robots.md again; some ten minutes; needs mujoco-core

One process with one thread, coarse meshes: a chain is compared with the reduced model of the same mesh.
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.shared.machine import machine
from benchmarks.shared.tables import table
from turgor.job.prepare import prepare
from turgor.job.read import read_job

EXAMPLES, PAGE = Path(__file__).parents[2] / "examples", Path(__file__).with_suffix(".md")
OPTIONS = tg.EngineOptions(threads=1)
HEAD = """# Actuators as chains and segments

Written by `python benchmarks/systems/robots.py` in one run with one thread. The tip is compared with that of the
reduced model at 20 pressures to which nothing was fitted; stiffness is that against a small moment on the tip, by the
tangent of the full model. Seconds are processor time.
"""
PLATE = {"law": "neo_hooke", "C10": "50 MPa", "density": "1200 kg/m3"}
CASES = {
    "PneuNet of two chambers, 12 kPa": (
        "fast_pneunet.toml",
        {"mesh.size": "8 mm", "actuator.chambers": 2, "actuator.length": "22 mm"},
        {"loads.pressure": (0.0, 12e3)},
    ),
    "PneuNet of four chambers, 20 kPa": (
        "fast_pneunet.toml",
        {"mesh.size": "8 mm", "actuator.chambers": 4, "actuator.length": "44 mm"},
        {"loads.pressure": (0.0, 20e3)},
    ),
    "three parallel bellows, 1.5 kPa each": (
        "actuators/parallel_bellows.toml",
        {
            "mesh.size": "8 mm", "actuator.folds": 2, "actuator.constrained": False, "actuator.symmetric": False,
            "materials.plate": PLATE, "loads": {f"cavity_{k}": {"pressure": "1.5 kPa"} for k in (1, 2, 3)},
        },
        {f"loads.cavity_{k}.pressure": (0.0, 1.5e3) for k in (1, 2, 3)},
    ),
}  # fmt: skip
COLUMNS = (
    "actuator", "links and coordinates", "tip of the chain", "of its way", "stiffness", "MuJoCo from turgor",
    "times real time", "segments of constant strain", "made in",
)  # fmt: skip


def in_mujoco(fitted):
    """Largest distance of MuJoCo's tips from those of turgor's chain [m], and its speed over real time."""
    import mujoco

    with TemporaryDirectory() as folder:
        model = mujoco.MjModel.from_xml_path(str(tg.robots.write_mjcf(fitted, Path(folder) / "chain.xml")))
    data, away, spent = mujoco.MjData(model), [], 0.0
    for pressures, tip in zip(fitted.tested, fitted.tips, strict=True):
        data.ctrl[:] = pressures
        start = process_time()
        for _ in range(round(2.0 / model.opt.timestep)):
            mujoco.mj_step(model, data)
        spent += process_time() - start
        away.append(np.linalg.norm(data.site("tip").xpos - tip))
    return max(away), 2.0 * len(away) / spent


def row(name):
    """Numbers of an actuator."""
    job, changes, ranges = CASES[name]
    model = prepare(read_job(EXAMPLES / job, changes), print)[0]
    budget = tg.real_time.Budget(error=0.01, paths=8, steps=8, held_out=1)
    reduced = tg.reduce(model, ranges, budget=budget, options=OPTIONS)
    start = process_time()
    fitted = tg.robots.chain_of(reduced, options=OPTIONS)
    seconds = process_time() - start
    away, speed = in_mujoco(fitted)
    segments = tg.robots.strain_segments(reduced, 4, options=OPTIONS)
    chain = fitted.chain
    return (
        name, f"{chain.links}, {len(chain.springs)}", f"{100 * fitted.error:.2g} %",
        f"{100 * fitted.error / fitted.travel:.2g} %", f"{100 * fitted.stiffness_error:.2g} %", f"{1e6 * away:.1g} µm",
        f"{speed:.0f}", f"{100 * segments.error:.2g} %", f"{seconds:.0f} s",
    )  # fmt: skip


if __name__ == "__main__":
    rows = [row(name) for name in CASES]
    facts = "\n".join(f"- {name}: {value}" for name, value in machine().items())
    text = f"{HEAD}\n{table(COLUMNS, rows)}\n\n{facts}\n"
    PAGE.write_text(text, encoding="utf-8")
    print(text)
