"""Speed and size of the report of a run of 20 steps, against what is asked for: python benchmarks/views/report.py.

The path is made by formula, without a solve: a fast PneuNet of eleven chambers is bent into a circle in 20 steps. Exit
code 1 where the report takes more than 8 s of CPU time or has more than 10 MB.
"""

import sys
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import numpy as np

import turgor as tg
from turgor.units import kPa, mm

STEPS, MOST_SECONDS, MOST_BYTES = 20, 8.0, 10_000_000


def bent(points: np.ndarray, angle: float) -> np.ndarray:
    """Displacement of points that bend into an arc of an angle [rad] over their length along x."""
    if angle == 0:
        return np.zeros_like(points)
    x, y, z = points.T
    turn, radius = angle * x / np.ptp(x), np.ptp(x) / angle
    out = np.stack([(radius + z) * np.sin(turn), y, (radius + z) * np.cos(turn) - radius], axis=1)
    return out - points


def path(size: float) -> tg.Solution:
    """A path of 20 steps after the state at rest, on a mesh of a size [m]."""
    rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    mesh = tg.mesh(tg.FastPneuNet().build(), size=size)
    regions = dict.fromkeys(mesh.regions, rubber)
    model = tg.Model(mesh, regions, [tg.Fixed("fixed")], [tg.Pressure("cavity", 0.1 * kPa)])
    solved = tg.solve(model, tg.Static(), throw=False)
    last = solved.states[-1]
    shares = np.linspace(0, 1, STEPS + 1)
    states = tuple(
        replace(last, load_factor=float(share), displacement=bent(mesh.points, 4 * share)) for share in shares
    )
    return replace(solved, states=states)


def main() -> int:
    solution = path(3 * mm)
    response = tg.measure(solution, tg.bending_angle, tg.tip_displacement, mesh_error=False)
    with TemporaryDirectory() as folder:
        file = Path(folder) / "report.html"
        tg.report(solution, file, response=response)  # compiles and fills caches
        began = process_time()
        tg.report(solution, file, response=response)
        seconds, size = process_time() - began, file.stat().st_size
    print(f"{solution.model.mesh.counts}, {STEPS} steps")
    print(f"{seconds:.1f} s of CPU time (at most {MOST_SECONDS:g}), {size / 1e6:.1f} MB (at most {MOST_BYTES / 1e6:g})")
    return int(seconds > MOST_SECONDS or size > MOST_BYTES)


if __name__ == "__main__":
    sys.exit(main())
