"""Draw docs/images/tearing.svg: tearing energy and life of the extender of examples/extender_life.toml.

Run it after a change of these: ``python docs/tearing_picture.py``, about a minute.
"""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import turgor as tg

ROOT = Path(__file__).parents[1]
FIGURE = ROOT / "docs" / "images" / "tearing.svg"


def main():
    job = tg.jobs.read_job(ROOT / "examples" / "extender_life.toml")
    model, _ = tg.jobs.prepare(job)
    solution = tg.solve(model, tg.Static(at=tuple(np.linspace(0.05, 0.95, 19))))
    response = tg.measure(solution, "tearing_energy", "log_cycles_to_tear", mesh_error=False)
    growth = model.region_materials["body"].crack_growth
    pressure, torn = response["pressure_kPa"], response["tearing_energy"]
    cycles = 10 ** response["log_cycles_to_tear"]
    grows = torn > growth.threshold
    figure = Figure(figsize=(7.6, 3.2), layout="constrained", facecolor="white")
    left, right = figure.subplots(1, 2)
    color, other = tg.pictures.COLORS[:2]
    left.plot(pressure, torn, color=color)
    left.axhline(growth.threshold, color=other, linestyle="--")
    left.annotate("no growth below", (1, growth.threshold * 1.05), color=other)
    left.set(xlabel="pressure [kPa]", ylabel="tearing energy of the flaw [J/m²]")
    low, high = cycles[grows] / growth.spread, cycles[grows] * growth.spread
    right.fill_between(pressure[grows], low, high, color=color, alpha=0.25, label="rates known to a factor of 10")
    right.semilogy(pressure[grows], cycles[grows], color=color)
    right.axvline(np.interp(growth.threshold, torn, pressure), color=other, linestyle="--")
    right.set(xlabel="pressure [kPa]", ylabel="cycles until it tears", xlim=(0, 41), ylim=(1e3, 1e8))
    right.legend(frameon=False)
    figure.savefig(FIGURE)
    print(pressure[-1], torn[-1], cycles[-1], np.interp(growth.threshold, torn, pressure))


if __name__ == "__main__":
    main()
