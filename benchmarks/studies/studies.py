"""Measure a sweep of a job: how well two processes share the work, and what a run costs beside its own computation.

Run ``python benchmarks/studies/studies.py [DESIGNS]``. A short tube is solved at so many wall thicknesses (12 by
default), with workers that have computed one design before, so that what a process needs once is told apart.

- efficiency: designs in a second with two processes, over twice those with one.
- overhead of a run: seconds in which a worker of the sweep with one process did not compute its function, over the
  designs: handing out runs, files, and reading them again. The function itself reads, meshes, solves and measures.
- start: seconds until the first design of the first worker has ended, less what this design takes later.
"""

import os
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import numpy as np

import turgor as tg
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.executors.worker_processes import Workers
from turgor.studies.runs.jobs.job_function import job_function
from turgor.units import mm

JOB = """
[actuator]
type = "extending_cylinder"
length = "40 mm"
[mesh]
cells = "axisymmetric"
size = "1.5 mm"
[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa" }
[loads]
pressure = "20 kPa"
[output]
measures = ["tip_displacement_x", "cavity_volume"]
"""

#: Wall of the design that each worker computes first.
FIRST = 1.9 * mm


def main(count: int) -> None:
    """Measure with one process and with two, and print."""
    os.environ["TURGOR_CACHE_MB"] = "0"  # every design is built and meshed
    with TemporaryDirectory() as temporary:
        folder = Path(temporary)
        (folder / "tube.toml").write_text(JOB, encoding="utf-8")
        base = job_function(tg.jobs.read_job(folder / "tube.toml"), folder / "study")
        computation = base.computation(mesh_error=True)
        runs = [computation.run({"actuator.wall": float(wall)}) for wall in np.linspace(2 * mm, 3 * mm, count)]
        walls, busy = {}, {}
        for processes in (1, 2):
            first = [computation.run({"actuator.wall": FIRST + k * 1e-5}) for k in range(processes)]
            with Evaluations(folder=folder / str(processes), executor=Workers(processes=processes)) as study:
                begun = perf_counter()
                study.of(first)
                start = perf_counter() - begun
                begun = perf_counter()
                ended = study.of(runs)
                walls[processes] = perf_counter() - begun
            busy[processes] = sum(each.result.seconds for each in ended if each.result is not None)
            print(f"{processes} process(es): {walls[processes]:.2f} s for {count} designs, {busy[processes]:.2f} CPU s "
                  f"in their functions; the first design of each worker {start:.2f} s")  # fmt: skip
    print(f"efficiency of two processes: {walls[1] / (2 * walls[2]):.0%}")
    print(f"overhead of a run: {(walls[1] - busy[1]) / count:.3f} s")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 12)
