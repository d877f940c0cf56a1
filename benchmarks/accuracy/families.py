"""Every actuator family as `turgor init` writes it, on its default mesh: error against a finer mesh, time, iterations.

    python benchmarks/accuracy/families.py                       all default meshes, and families.md again
    python benchmarks/accuracy/families.py --only NAME           this family; the stored rows of the others stay
    python benchmarks/accuracy/families.py --references NAME     the reference of a family again, which takes minutes
    python benchmarks/accuracy/families.py --page                nothing but the page, from what is stored

The job of a family is its starter, without a mesh size. Every run is a process of its own with one thread. References
and rows lie in `families.json`. A reference is a finer mesh of another kind of spacing: `REFERENCES` says which.
"""

import argparse
import json
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

import turgor as tg

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.accuracy.families_page import page
from benchmarks.shared.machine import machine
from benchmarks.truth.truth import read, separate, write
from turgor.accuracy.adaptivity.second_mesh import SecondMesh
from turgor.core.engine.transfer import transfer_to
from turgor.core.meshing.generate import mesh_with
from turgor.core.meshing.refining.split_films import refine_films
from turgor.core.meshing.revolved.axisymmetric import axisymmetric_mesh
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.job.job import ACTUATORS, Job
from turgor.job.prepare import model_of
from turgor.job.read import read_job
from turgor.job.reference.starters import example_job
from turgor.units import mm

HERE = Path(__file__).parent
STORED, PAGE = HERE / "families.json", HERE / "families.md"
OPTIONS = tg.EngineOptions(linear_solver="rslab", threads=1)
#: The demo has a page of its own (docs/mesh-independence.md).
FAMILIES = tuple(name for name in ACTUATORS if name != "fast_pneunet")
#: Mesh of each reference: longest edge, and where given, edges next to sharp edges, the longest edge along a straight
#: path and on cavities [mm], cells through a wall and around a quarter of a turn, and the kind of cells; how often the
#: sides of a film that wrinkles are halved, whose path on short sides would end at folds.
REFERENCES: dict[str, dict[str, Any]] = {
    "bellows_of_revolution": {"size": 0.4, "edge": 0.02, "cells": "axisymmetric"},
    "bidirectional_bender": {"size": 4.5, "edge": 0.3, "along": 13.5},
    "bidirectional_pneunet": {"size": 3.0, "edge": 0.45},
    "buckling_muscle": {"size": 3.0},
    "contracting_tube": {"size": 1.5, "cells": "hexahedra"},
    "eccentric_bender": {"size": 3.0, "edge": 0.3},
    "extending_cylinder": {"size": 2.0, "edge": 0.2},
    "fiber_reinforced_bender": {"size": 2.5, "edge": 0.25},
    "fiber_reinforced_cylinder": {"size": 3.0, "edge": 0.15},
    "free_bottom_pneunet": {"size": 3.0, "edge": 0.6},
    "helical_pneunet": {"size": 3.0, "edge": 0.6},
    "inflatable_beam": {"size": 20.0, "cells": "films"},
    "manta_fin": {"size": 4.5, "edge": 0.7},
    "miura_tube": {"size": 1.5, "cells": "films"},
    "omnidirectional_actuator": {"size": 3.0, "edge": 0.3},
    "parallel_bellows": {"size": 4.0, "cavity": 0.8, "cells": "tetrahedra"},
    "pouch": {"size": 1.58, "cells": "films", "halved": 2},
    "rectangular_bender": {"size": 4.5, "edge": 0.25},
    "revolute_joint": {"size": 4.5, "edge": 0.45},
    "semicircular_bender": {"size": 2.7, "edge": 0.4},
    "slow_pneunet": {"size": 4.5, "edge": 0.45},
    "three_extenders": {"size": 6.0, "edge": 0.4},
    "trapezoidal_pneunet": {"size": 2.7, "edge": 0.4},
    "triangular_pneunet": {"size": 2.7, "edge": 0.4},
    "twisting_tube": {"size": 3.0, "edge": 0.3},
    "yoshimura_bellows": {"size": 2.0, "cells": "films"},
    "two_material_bender": {"size": 8.0, "along": 12.0, "wall_cells": 4, "quarter_cells": 12},
}


def job_of(name: str) -> Job:
    """The job that `turgor init` writes, without a mesh size."""
    return replace(read_job(example_job(name)), mesh=MeshSettings(), threads=1)


def meshed(job: Job, spec: dict[str, Any]) -> tg.Mesh:
    """The default mesh where nothing is specified, else a mesh of this size, short next to edges where requested."""
    geometry = job.geometry()
    if spec and ("edge" in spec or "cells" not in spec):
        lengths = {key: spec[key] * mm for key in ("size", "edge", "along") if key in spec}
        counts = {key: spec[key] for key in ("wall_cells", "quarter_cells") if key in spec}
        fine = Fineness(**lengths, **counts)
        if spec.get("cells") == "axisymmetric" and geometry._sweep is not None:
            return axisymmetric_mesh(geometry, replace(fine, corners=geometry._sweep.hinges))
        return replace(swept_mesh(geometry, fine), serendipity=False)
    settings: dict[str, Any] = (
        {"size": spec["size"] * 2 ** spec.get("halved", 0) * mm, "cells": spec["cells"]} if spec else {}
    )
    if spec.get("cells") == "films":
        settings["cells"] = None
    if "cavity" in spec:
        settings["face_sizes"] = dict.fromkeys(geometry.cavity_volumes, spec["cavity"] * mm)
    return mesh_with(geometry, MeshSettings(**settings))


def run(name: str, spec: dict[str, Any]) -> dict[str, Any]:
    """Mesh, solve and measure one family; compiled loops are loaded before."""
    job = job_of(name)
    start = time.process_time()
    mesh = meshed(job, spec)
    meshing = time.process_time() - start
    model = model_of(job, mesh)
    tg.solve(model, job.procedure, options=OPTIONS, stop=lambda state: "loaded", throw=False)
    start, clock = time.process_time(), time.perf_counter()
    solution = tg.solve(model, job.procedure, options=OPTIONS, throw=False)
    solution = halved(solution, spec.get("halved", 0))
    solving, wall = time.process_time() - start, time.perf_counter() - clock
    mesh = solution.states[-1].model.mesh
    row = {
        "kind": mesh.cell_type.name,
        "cells": len(mesh.cells),
        "unknowns": mesh.unknown_count,
        "status": str(solution.status),
        "steps": sum(step.accepted for step in solution.steps),
        "iterations": sum(step.iterations for step in solution.steps),
        "rejected": sum(not step.accepted for step in solution.steps),
        "meshing": round(meshing, 2),
        "solving": round(solving, 2),
        "wall": round(wall + meshing, 2),
        "load": solution.states[-1].load_factor,
    }
    return row | measures(job, solution, estimated=not spec)


def halved(solution: tg.Solution, times: int) -> tg.Solution:
    """The last state of films on sides of half the size, so many times, each from the interpolated one before."""
    for _ in range(times):
        last = solution.states[-1]
        cut = refine_films(last.model.mesh)
        mesh = SecondMesh(cut, transfer_to(last.model.mesh, cut), OPTIONS)
        state = mesh.solved_again(last, solution.procedure, exact=True)
        if state is None:
            raise RuntimeError(f"films were not solved again on {cut.mesh.unknown_count} unknowns")
        solution = replace(solution, states=(mesh.at_rest(solution.states[0]), state))
    return solution


def measures(job: Job, solution: tg.Solution, estimated: bool) -> dict[str, Any]:
    """Values at the last state, and where requested their estimated mesh errors and what the estimate took."""
    names = [each for each in job.output.measures if not each.startswith("maximum") and each != "reaction"]
    names = list(dict.fromkeys([*names, "tip_displacement", "von_mises_p99"]))
    start, clock = time.process_time(), time.perf_counter()
    response = tg.measure(solution, *names, mesh_error=estimated, options=OPTIONS)
    row: dict[str, Any] = {
        "estimating": round(time.process_time() - start, 2),
        "estimating_wall": round(time.perf_counter() - clock, 2),
        "values": {each: float(response.column(each)[-1]) for each in names},
    }
    found = {each: f"{each}_mesh_error" for each in names if f"{each}_mesh_error" in response.names}
    errors = {each: float(response.column(column)[-1]) for each, column in found.items()}
    return row | {"estimates": {each: error for each, error in errors.items() if np.isfinite(error)}}


def request(name: str, spec: dict[str, Any]) -> dict[str, Any]:
    """A run in a process of its own."""
    return separate([str(Path(__file__)), "--run", json.dumps({"name": name, "spec": spec})])


def renew(names: list[str], kind: str) -> None:
    """Run families again, and store each row as it is done."""
    for name in names:
        spec = REFERENCES[name] if kind == "references" else {}
        row = request(name, spec) | ({"mesh": spec} if spec else {})
        stored = read(STORED)
        write(STORED, stored | {kind: stored.get(kind, {}) | {name: row}})
        print(name, json.dumps(row), flush=True)


def main() -> None:
    """Run what was asked for, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", choices=FAMILIES, default=list(FAMILIES))
    parser.add_argument("--references", nargs="+", choices=FAMILIES, default=[])
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--run", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.run:
        print(json.dumps(run(**json.loads(given.run))))
        return
    if given.references:
        renew(given.references, "references")
    elif not given.page:
        renew(given.only, "rows")
    PAGE.write_text(page(read(STORED), FAMILIES, machine()), encoding="utf-8")


if __name__ == "__main__":
    main()
