"""The demo actuator at three mesh sizes: writes docs/mesh-independence.md and its figure.

python benchmarks/mesh_independence.py
"""

from pathlib import Path

import matplotlib
import numpy as np

import turgor as tg
from turgor.units import deg, kPa, mm

matplotlib.use("agg")
import matplotlib.pyplot as plt

ROOT = Path(__file__).parents[1]
JOB = ROOT / "examples" / "fast_pneunet.toml"
PAGE = ROOT / "docs" / "mesh-independence.md"
FIGURE = ROOT / "docs" / "images" / "mesh-independence.svg"
SIZES = (4 * mm, 2.2 * mm, 1.3 * mm)
PRESSURE = 6 * kPa  # before walls meet
SAMPLES = 10  # pressures at which the curves are compared


def bend(job: tg.jobs.Job, size: float) -> tuple[tg.Mesh, tg.Response]:
    """Solve the demo at a mesh size [m], hitting the same pressures at every size."""
    mesh = tg.mesh(job.actuator.build(), size=size)
    model = tg.Model(mesh, materials=job.materials, supports=job.supports, loads=[tg.Pressure("cavity", PRESSURE)])
    factors = tuple((i + 1) / SAMPLES for i in range(SAMPLES))
    solution = tg.solve(model, tg.Static(first_step=factors[0], at=factors))
    measures = (
        tg.bending_angle,
        tg.cavity_volume,
        tg.measures.maximum_principal_stretch,
        tg.measures.maximum_von_mises,
    )
    return mesh, tg.measure(solution, *measures, mesh_error=False)


def main() -> None:
    """Solve, tabulate against the finest mesh, draw."""
    job = tg.jobs.read_job(JOB)
    runs = [bend(job, size) for size in SIZES]
    names = ("bending_angle", "cavity_volume", "maximum_principal_stretch", "maximum_von_mises")
    top = np.array([[response.column(name)[-1] for name in names] for _, response in runs])
    off = 100 * (top / top[-1] - 1)
    rows = []
    for size, (mesh, _), values, percent in zip(SIZES, runs, top, off, strict=True):
        numbers = (values[0] / deg, values[1] * 1e6, values[2], values[3] / 1e6)
        cells = [f"{number:.4g} ({each:+.2f} %)" for number, each in zip(numbers, percent, strict=True)]
        rows.append(f"| {size / mm:g} | {len(mesh.cells):,} | {mesh.unknown_count:,} | " + " | ".join(cells) + " |")
    pressure = runs[-1][1].column("pressure")[-1] / kPa
    PAGE.write_text(page(pressure, rows), encoding="utf-8")
    draw([response for _, response in runs])
    print(PAGE.read_text(encoding="utf-8"))


def page(pressure: float, rows: list[str]) -> str:
    """The page; in brackets how far each number lies from that of the finest mesh."""
    return f"""# Mesh independence

The actuator of `examples/fast_pneunet.toml` at three mesh sizes and {pressure:g} kPa, everything else unchanged. In
brackets the difference from the finest mesh. Written by `python benchmarks/mesh_independence.py`.

| size mm | cells | unknowns | bending angle ° | cavity volume mL | largest stretch | largest von Mises MPa |
|---|---|---|---|---|---|---|
{chr(10).join(rows)}

Angle and volume are integrals over the whole actuator and settle early. Largest values sit at re-entrant edges, where
the exact solution has no finite one: they keep growing with refinement, so compare them between designs on like
meshes only, or round the edge.

![Bending angle against pressure at three mesh sizes](images/{FIGURE.name})
"""


def draw(responses: list[tg.Response]) -> None:
    """Bending angle against pressure for all sizes; without a date, so that equal results give an equal file."""
    matplotlib.rcParams["svg.hashsalt"] = "turgor"
    figure, axes = plt.subplots(figsize=(5, 3.2), layout="constrained")
    for size, response, style in zip(SIZES, responses, (":", "--", "-"), strict=True):
        axes.plot(
            response.column("pressure") / kPa, response.column("bending_angle") / deg, style, label=f"{size / mm:g} mm"
        )
    axes.set(xlabel="pressure [kPa]", ylabel="bending angle [°]")
    axes.legend(title="mesh size", frameon=False)
    figure.savefig(FIGURE, metadata={"Date": None})


if __name__ == "__main__":
    main()
