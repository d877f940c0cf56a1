"""The demo actuator at three mesh sizes, with estimated mesh errors: writes docs/mesh-independence.md and its figure.

python benchmarks/accuracy/mesh_independence.py
"""

from pathlib import Path

import matplotlib

import turgor as tg
from turgor.units import deg, kPa, mm

matplotlib.use("agg")
import matplotlib.pyplot as plt

ROOT = Path(__file__).parents[2]
JOB = ROOT / "examples" / "fast_pneunet.toml"
PAGE = ROOT / "docs" / "mesh-independence.md"
FIGURE = ROOT / "docs" / "images" / "mesh-independence.svg"
SIZES = (4 * mm, 2.2 * mm, 1.3 * mm)
PRESSURE = 6 * kPa  # before walls meet
SAMPLES = 10  # pressures at which the curves are compared


MEASURES = (
    tg.bending_angle,
    tg.cavity_volume,
    tg.measures.principal_stretch_p99,
    tg.measures.von_mises_p99,
    tg.measures.maximum_principal_stretch,
    tg.measures.maximum_von_mises,
)


def bend(job: tg.jobs.Job, size: float) -> tuple[tg.Mesh, tg.Response]:
    """Solve the demo at a mesh size [m], hitting the same pressures at every size."""
    mesh = tg.mesh(job.actuator.build(), size=size)
    model = tg.Model(mesh, materials=job.materials, supports=job.supports, loads=[tg.Pressure("cavity", PRESSURE)])
    factors = tuple((i + 1) / SAMPLES for i in range(SAMPLES))
    solution = tg.solve(model, tg.Static(first_step=factors[0], at=factors))
    return mesh, tg.measure(solution, *MEASURES)


def main() -> None:
    """Solve, tabulate against the finest mesh, draw."""
    job = tg.jobs.read_job(JOB)
    runs = [bend(job, size) for size in SIZES]
    finest = runs[-1][1]
    rows = []
    for size, (mesh, response) in zip(SIZES, runs, strict=True):
        cells = [cell(response, finest, each) for each in MEASURES]
        rows.append(f"| {size / mm:g} | {mesh.unknown_count:,} | " + " | ".join(cells) + " |")
    pressure = finest.column("pressure")[-1] / kPa
    PAGE.write_text(page(pressure, rows), encoding="utf-8")
    draw([response for _, response in runs])
    print(PAGE.read_text(encoding="utf-8"))


def cell(response: tg.Response, finest: tg.Response, measure: tg.measures.Measure) -> str:
    """Last value, its mesh error unless it is a maximum, and in brackets the difference from the finest mesh."""
    name = measure.name
    value, scale = response.column(name)[-1], response.find(name).in_unit[-1] / response.column(name)[-1]
    error = f"{name}_mesh_error"
    band = f" ± {response.column(error)[-1] * scale:.2g}" if not name.startswith("maximum") else ""
    return f"{value * scale:.4g}{band} ({100 * (value / finest.column(name)[-1] - 1):+.2f} %)"


def page(pressure: float, rows: list[str]) -> str:
    """The page; in brackets how far each number lies from that of the finest mesh."""
    names = " | ".join(
        f"{each.name.replace('_', ' ').replace(' p99', ', 99 %')} {each.unit}".strip() for each in MEASURES
    )
    return f"""# Mesh independence

The actuator of `examples/fast_pneunet.toml` at three mesh sizes and {pressure:g} kPa, everything else unchanged. ± is
the mesh error that turgor estimates on that mesh alone; in brackets stands the difference from the finest mesh. Written
by `python benchmarks/accuracy/mesh_independence.py`.

| size mm | unknowns | {names} |
|---|---|{"---|" * len(MEASURES)}
{chr(10).join(rows)}

Angle and volume are integrals over the whole actuator. They converge slowly, because corners limit the rate. A value
that hardly changes between two sizes need not be converged, and the estimate says how far it may be off. The 99th
percentiles of stretch and stress converge too, the stress more slowly. The largest values lie at
re-entrant edges, where the exact solution is unbounded. They grow with refinement, so they have no mesh error here.
*Unknowns* are degrees of freedom.

![Bending angle against pressure at three mesh sizes, with mesh errors](images/{FIGURE.name})
"""


def draw(responses: list[tg.Response]) -> None:
    """Bending angle against pressure for all sizes; without a date, so that equal results give an equal file."""
    matplotlib.rcParams["svg.hashsalt"] = "turgor"
    figure, axes = plt.subplots(figsize=(5, 3.2), layout="constrained")
    for size, response, style in zip(SIZES, responses, (":", "--", "-"), strict=True):
        pressures, angles = response.column("pressure") / kPa, response.column("bending_angle") / deg
        off = response.column("bending_angle_mesh_error") / deg
        (line,) = axes.plot(pressures, angles, style, label=f"{size / mm:g} mm")
        axes.fill_between(pressures, angles - off, angles + off, color=line.get_color(), alpha=0.2, linewidth=0)
    axes.set(xlabel="pressure [kPa]", ylabel="bending angle [°]")
    axes.legend(title="mesh size", frameon=False)
    figure.savefig(FIGURE, metadata={"Date": None})


if __name__ == "__main__":
    main()
