"""Hexahedra against tetrahedra at equal error: a fast PneuNet, and a closed tube that is inflated.

Every row is a process of its own with one thread, meshing and solving included, compilation not. Errors are against
the finest tetrahedra (PneuNet) and the finest hexahedra (tube, where both kinds tend to the same value).
Run: python benchmarks/swept.py; it takes a few minutes and writes benchmarks/swept.md.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

#: Problem: cells and size [mm] of each run; the last one is the reference.
RUNS = {
    "pneunet": [
        ("hexahedra", 4.0), ("hexahedra", 2.0), ("tetrahedra", 3.0), ("tetrahedra", 2.0), ("tetrahedra", 1.0),
    ],
    "tube": [
        ("tetrahedra", 6.0), ("tetrahedra", 3.0), ("tetrahedra", 1.5), ("hexahedra", 8.0), ("hexahedra", 4.0),
        ("hexahedra", 2.0),
    ],
}  # fmt: skip

TITLES = {
    "pneunet": "Fast PneuNet of three chambers on a base 20 times stiffer, 5 kPa: bending angle [°]",
    "tube": "Closed tube (extending cylinder, a quarter), 40 kPa: displacement of the tip [mm]",
}

RUN = """
import json, sys, time
import turgor as tg
from turgor.engine.runtime import compile_kernels
from turgor.units import deg, kPa, mm

problem, kind, size = sys.argv[1], sys.argv[2], float(sys.argv[3]) * mm
compile_kernels(None, 27 if kind == "hexahedra" else 10)
rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
if problem == "pneunet":
    actuator, pressure, wanted, unit = tg.FastPneuNet(chambers=3, length=30 * mm), 5 * kPa, tg.bending_angle, deg
else:
    actuator, pressure, wanted, unit = tg.ExtendingCylinder(), 40 * kPa, tg.tip_displacement, mm
start = time.process_time()
mesh = tg.mesh(actuator.build(), size=size, cells=kind)
meshed = time.process_time() - start
materials = {name: rubber for name in mesh.regions}
if problem == "pneunet":
    materials["base"] = tg.Material(name="stiff rubber", law=tg.NeoHooke(C10=20 * 0.11e6))
model = tg.Model(mesh, materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", pressure)])
solution = tg.solve(model, options=tg.EngineOptions(linear_solver="rslab", threads=1))
value = tg.measure(solution, wanted).column(wanted.name)[-1] / unit
print(json.dumps({
    "unknowns": mesh.unknown_count, "cells": len(mesh.cells), "value": value, "meshing": meshed,
    "iterations": sum(step.iterations for step in solution.steps), "solve": time.process_time() - start - meshed,
}))
"""


def run(problem: str, kind: str, size: float) -> dict[str, float]:
    """Mesh and solve in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", RUN, problem, kind, str(size)],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"OMP_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"},
    )
    if done.returncode:
        raise SystemExit(done.stderr)
    result: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return result


def table(problem: str) -> str:
    """Write the table of a problem."""
    rows = [(kind, size, run(problem, kind, size)) for kind, size in RUNS[problem]]
    reference = rows[-1][2]["value"]
    lines = [
        f"## {TITLES[problem]}",
        "",
        "| cells | size [mm] | number | unknowns | value | error | iterations | mesh [CPU s] | solve [CPU s] |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for kind, size, got in rows:
        error = "reference" if got["value"] == reference else f"{100 * (got['value'] / reference - 1):+.2f} %"
        lines.append(
            f"| {kind} | {size:g} | {got['cells']:.0f} | {got['unknowns']:.0f} | {got['value']:.4f} | {error} | "
            f"{got['iterations']:.0f} | {got['meshing']:.1f} | {got['solve']:.1f} |"
        )
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    text = "# Hexahedra against tetrahedra\n\n" + "\n".join(table(problem) for problem in RUNS)
    (Path(__file__).parent / "swept.md").write_text(text, encoding="utf-8")
    print(text)
