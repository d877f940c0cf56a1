"""Build and mesh prints, CAD parts, a part with a film, and every actuator family: time, cells, unknowns, quality.

Times are of the processor, so other work on the machine does not count.

python benchmarks/run.py meshing         a section of results.md
python benchmarks/core/meshing.py [PART ...]  the same, printed; all parts by default
"""

import os
import sys
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from turgor.cad import WithNormal

import turgor as tg

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.shared.case import ROOT
from benchmarks.shared.tables import table
from turgor.core.geometry.cad.read import read_here
from turgor.core.geometry.cad.symmetry.requested import RequestedSymmetry
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.quality.cell_quality import quality
from turgor.foundation.store.caches import FOLDER
from turgor.job.job import ACTUATORS
from turgor.units import deg, mm

sys.path.insert(0, str(ROOT / "tests"))
import wedge_cases
from prints import PRINTS

ACTUATOR = tg.actuators
#: Dimensions at which families are hard to mesh.
SPECIAL = {
    "helical_pneunet, 8 chambers at 45°": ACTUATOR.HelicalPneuNet(chambers=8, chamber_angle=45 * deg),
    "helical_pneunet, 5 chambers at 60°": ACTUATOR.HelicalPneuNet(chambers=5, chamber_angle=60 * deg),
    "fast_pneunet, open at the bottom": ACTUATOR.FastPneuNet(floor=0.0),
    "omnidirectional_actuator, webs of 0.5 mm": ACTUATOR.OmnidirectionalActuator(
        chamber_shape="ring_sector", web=0.5 * mm
    ),
}

#: CPU seconds that a family may take, a print, and the axisymmetric bellows from its dimensions to its last state.
FAMILY, PRINT, SOLVED = 10.0, 60.0, 3.0

ENDS = {"fixed": WithNormal("-x"), "tip": WithNormal("+x")}
QUARTER = {"symmetry_y": WithNormal("-y"), "symmetry_z": WithNormal("-z")}
LOBED = ROOT / "tests" / "unit" / "data" / "cad" / "bellows.step"
AXISYMMETRIC = ROOT / "examples" / "axisymmetric_bellows.toml"
JOBS = {
    "film": "film.toml",
    "stiff film": "stiff_film.toml",
    "rig: lifted weight": "lifted_weight.toml",
    "axisymmetric bellows": "axisymmetric_bellows.toml",
    "STEP with an inlet, two bodies": "cad_file.toml",
}
HEAD = ("part", "given as", "build s", "mesh s", "cells", "unknowns", "worst shape", "mean", "worst Jacobian")


@dataclass(frozen=True)
class Part:
    """What is built and meshed: how it is given, its mesh settings, and the CPU seconds that it may take."""

    given: str
    build: Callable[[], Geometry]
    limit: float
    settings: Mapping[str, Any]


def spent() -> float:
    """CPU seconds of this process and of those it started, in which shapes of files are meshed."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def read_print(name: str) -> Geometry:
    """Write a print of the tests as STL and read it as anyone would."""
    with tempfile.TemporaryDirectory() as folder:
        return read_here(PRINTS[name]().write(Path(folder) / f"{name}.stl"), faces=ENDS)


def read_example(job: str) -> Geometry:
    """Read a job of the examples, which builds its part."""
    return tg.jobs.read_job(ROOT / "examples" / job).geometry()


def read_wedge() -> Geometry:
    """Write a bellows of six lobes around its axis as STEP, and read a sector."""
    with tempfile.TemporaryDirectory() as folder:
        path = wedge_cases.written(wedge_cases.lobed(), Path(folder) / "lobed.step")
        return read_here(path, faces=wedge_cases.ENDS, symmetry=RequestedSymmetry("wedge"))


def parts() -> dict[str, Part]:
    """All parts by their names."""
    results = {
        f"print {name}": Part(f"STL, {len(make().corners):,} facets", lambda name=name: read_print(name), PRINT, {})
        for name, make in PRINTS.items()
    }
    for name, settings in {
        "lobed bellows": {"size": 2.5 * mm},
        "lobed bellows, two cells through walls": {"size": 2.5 * mm, "wall_cells": 2},
        "lobed bellows, axisymmetric": {"size": 2 * mm, "cells": "axisymmetric"},
    }.items():
        results[name] = Part("STEP, quarter", lambda: read_here(LOBED, faces=ENDS | QUARTER), FAMILY, settings)
    for name, job in JOBS.items():
        stated = tg.jobs.read_job(ROOT / "examples" / job).mesh
        settings = {key: value for key in ("size", "cells") if (value := getattr(stated, key))}
        results[name] = Part("job of the examples", lambda job=job: read_example(job), FAMILY, settings)
    results["lobed bellows, wedge of a sixth"] = Part("STEP", read_wedge, FAMILY, {"size": 2 * mm})
    for name, kind in SPECIAL.items():
        results[name] = Part("family", kind.build, FAMILY, {})
    for name, kind in ACTUATORS.items():
        results[name] = Part("family", kind().build, FAMILY, {"cells": "tetrahedra"})
    return results


def row(name: str, part: Part) -> tuple[tuple[str, ...], float]:
    """Build and mesh one part; its line and the seconds it took."""
    start = spent()
    geometry = part.build()
    built = spent()
    with tempfile.TemporaryDirectory() as empty:  # a mesh that was kept would cost nothing
        before = os.environ.get(FOLDER)
        os.environ[FOLDER] = empty
        made = mesh(geometry, **part.settings)
        if before is None:
            del os.environ[FOLDER]
        else:
            os.environ[FOLDER] = before
    done = spent()
    result = quality(made)
    seconds = (f"{built - start:.2f}", f"{done - built:.2f}")
    shape = (f"{result.min_shape:.2f}", f"{result.mean_shape:.2f}", f"{result.min_jacobian_ratio:.2f}")
    return (name, part.given, *seconds, f"{result.cells:,}", f"{result.unknowns:,}", *shape), done - start


def solved() -> float:
    """CPU seconds from the dimensions of the axisymmetric bellows to its last state, with kernels loaded before."""
    for _ in range(2):
        start = spent()
        job = tg.jobs.read_job(AXISYMMETRIC)
        made = mesh(job.actuator.build(), cells="axisymmetric")
        model = tg.Model(made, materials=job.materials, supports=job.supports, loads=job.loads)
        tg.solve(model, job.procedure, options=tg.EngineOptions(linear_solver="rslab", threads=1))
        seconds = spent() - start
    return seconds


def measured(names: list[str]) -> tuple[str, bool]:
    """The section of the page, and whether all parts met their limits."""
    known = parts()
    if missing := [name for name in names if name not in known]:
        sys.exit(f"unknown part {', '.join(missing)}; known: {', '.join(known)}.")
    rows, slow = [], []
    os.environ["TURGOR_CACHE_MB"] = "0"  # shapes are built, also those of jobs
    for name in names or known:
        line, seconds = row(name, known[name])
        rows.append(line)
        print(" | ".join(line), file=sys.stderr, flush=True)
        if seconds > known[name].limit:
            slow.append(f"{name} ({seconds:.0f} s)")
    text = (
        "CPU seconds of building or reading, and of meshing, with the default size where the part does not say. The "
        f"aims: {PRINT:g} s for a print, {FAMILY:g} s for the others."
    )
    if not names:
        bellows = solved()
        text += f" The axisymmetric bellows is built, meshed and solved in {bellows:.1f} s (aim {SOLVED:g} s)."
        slow += [f"the solved bellows ({bellows:.1f} s)"] if bellows > SOLVED else []
    outcome = f"Slower than aimed at: {', '.join(slow)}." if slow else "All aims are met."
    return f"## Meshing\n\n{text} {outcome}\n\n{table(HEAD, rows)}\n", not slow


def section() -> str:
    """The section of results.md."""
    return measured([])[0]


if __name__ == "__main__":
    page, met = measured(sys.argv[1:])
    print(page)
    sys.exit(0 if met else 1)
