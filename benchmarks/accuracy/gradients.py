"""CPU time of a gradient by ten numbers of a job, compared with the run that it differentiates.

    python benchmarks/accuracy/gradients.py [--pressure "20 kPa"] [--size "4 mm"]

One thread, so that the figures hardly depend on what else the machine does. The target is 30 % of the run. Both ways
are timed: the adjoint, for two measures with a closed derivative, and the direct one, for those and a stress.
"""

import argparse
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import turgor as tg

KEYS = (
    "actuator.wall", "actuator.height", "actuator.width", "actuator.base", "actuator.length",
    "materials.body.C10", "materials.body.C20", "materials.base.C10", "materials.base.C20", "loads.pressure",
)  # fmt: skip

SMOOTH, ALL = ("bending_angle", "cavity_volume"), ("bending_angle", "cavity_volume", "von_mises_p99")

JOB = """
[actuator]
type = "fast_pneunet"
chambers = 3

[mesh]
size = "{size}"
cells = "hexahedra"

[materials.body]
law = "yeoh"
C10 = "0.11 MPa"
C20 = "0.02 MPa"

[materials.base]
law = "yeoh"
C10 = "0.15 MPa"
C20 = "0.02 MPa"

[loads]
pressure = "{pressure}"
"""


def main() -> None:
    """Time the run and both gradients, and print a line for each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pressure", default="20 kPa")
    parser.add_argument("--size", default="4 mm")
    arguments = parser.parse_args()
    options = tg.EngineOptions(threads=1)
    with TemporaryDirectory() as folder:
        file = Path(folder) / "finger.toml"
        file.write_text(JOB.format(size=arguments.size, pressure=arguments.pressure), encoding="utf-8")
        job = tg.jobs.read_job(file)
    model, _ = tg.jobs.prepare(job)
    tg.solve(
        model, replace(job.procedure, at=(0.01,)), options=options, stop=lambda state: "warm", throw=False
    )  # kernels
    start = process_time()
    solution = tg.solve(model, job.procedure, options=options)
    run = process_time() - start
    told = f"{model.mesh.unknown_count:,} unknowns, {solution.timing.factorizations} factorizations"
    print(f"run: {run:.1f} CPU s, {told}")
    for measures in (SMOOTH, ALL):
        start = process_time()
        result = tg.studies.gradient_of_job(job, KEYS, measures, solution=solution, options=options)
        spent = process_time() - start
        print(f"{result.way}: {spent:.1f} CPU s, {spent / run:.0%} of the run, {result.solves} solutions")


if __name__ == "__main__":
    main()
