"""Build and mesh every actuator family with default dimensions at its default size: time, cells, unknowns, quality.

Times are of the processor: both steps use one thread, so other work on the machine does not count.

python benchmarks/meshing.py [FAMILY ...]
"""

import sys
import time

from turgor.job.job import ACTUATORS
from turgor.meshing.generate import default_size, mesh
from turgor.meshing.quality.cell_quality import quality
from turgor.units import mm

LIMIT = 10.0  # seconds of one processor that building and meshing may take


def row(name: str) -> tuple[str, float]:
    """Build and mesh one family; its line and the seconds it took."""
    start = time.process_time()
    geometry = ACTUATORS[name]().build()
    built = time.process_time()
    made = mesh(geometry, cells="tetrahedra")
    done = time.process_time()
    found = quality(made)
    line = (
        f"| {name} | {default_size(geometry) / mm:g} | {geometry.smallest_wall / mm:.3g} | {built - start:.2f} "
        f"| {done - built:.2f} | {found.cells:,} | {found.unknowns:,} | {found.min_shape:.2f} "
        f"| {found.mean_shape:.2f} | {found.min_jacobian_ratio:.2f} |"
    )
    return line, done - start


def main() -> int:
    """Print a line for each family; return 1 where one took too long."""
    names = sys.argv[1:] or list(ACTUATORS)
    print("| family | size mm | wall mm | build s | mesh s | cells | unknowns | worst shape | mean | worst Jacobian |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    slow = []
    for name in names:
        line, seconds = row(name)
        print(line, flush=True)
        if seconds > LIMIT:
            slow.append(name)
    print(f"slower than {LIMIT:g} s: {', '.join(slow)}" if slow else f"all within {LIMIT:g} s")
    return 1 if slow else 0


if __name__ == "__main__":
    sys.exit(main())
