"""One run of the truth set in its own process: `python benchmarks/truth/truth_run.py '{"case": ..., "kind": ...}'`.

It prints one line of JSON: measures at the full load, unknowns, CPU seconds of meshing and of solving. A short solve of
the same case on its coarsest mesh comes first, so that no compilation is counted. Where walls touch, the step "refined"
refines the mesh on the path without contact, whose rounds are cheap, and follows the path with contact once.
"""

import json
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

import turgor as tg

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.truth.truth_cases import CASES
from benchmarks.truth.truth_cases.case import ESTIMATED, GRADED, NO_CONTACT, STEPS, Case
from turgor.accuracy.adaptivity.mesh_to import refine_to
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.sizing.default_size import default_size
from turgor.core.meshing.sizing.sizes import wall_size
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.units import mm

OPTIONS = tg.EngineOptions(linear_solver="rslab", threads=1)
#: Estimated mesh errors of the headline at which refinement ends.
TARGETS = {"target": 0.02, "refined": 0.001}
#: Most unknowns of refined meshes; the path with contact takes many iterations on the last one.
MOST_REFINED, MOST_TOUCHING = 120_000, 60_000


def wanted_size(case: Case, geometry: Geometry, kind: str, step: str) -> float | None:
    """Mesh size of a step [m], whose name may be a size in mm; None where no mesh of that size is allowed."""
    if step == GRADED:
        return case.graded[0] * mm if case.graded else None
    if step not in STEPS:
        return float(step) * mm
    default = default_size(geometry, kind)
    size = STEPS[step] * default
    largest = wall_size(geometry)
    if step == "double" and size > largest:
        return largest if largest > 1.2 * default else None
    return size


def meshed(case: Case, geometry: Geometry, size: float, kind: str, step: str) -> tg.Mesh:
    """Mesh of a step, at a size [m]."""
    if step == GRADED and case.graded:
        return swept_mesh(geometry, Fineness(size=size, edge=case.graded[1] * mm))
    return tg.mesh(geometry, size=size, cells=kind)


def warm(case: Case, geometry: Geometry, kind: str, formulation: str) -> None:
    """Load every compiled loop that the case needs: its first load step on the coarsest mesh."""
    mesh = tg.mesh(geometry, size=wall_size(geometry), cells=kind)
    solve(case, mesh, formulation, stop=lambda state: "warm" if state.load_factor > 0 else "", throw=False)


def solve(case: Case, mesh: tg.Mesh, formulation: str, **more: Any) -> tg.Solution:
    """The path of a case with every option as it comes, on one thread."""
    return tg.solve(case.model(mesh, formulation), options=OPTIONS, **more)


def run(case: Case, kind: str, step: str, formulation: str, most: float) -> dict[str, Any]:
    """Mesh, solve and measure; a row with ``note`` where there is nothing to solve."""
    geometry = case.actuator.build()
    size = wanted_size(case, geometry, kind, step)
    if size is None:
        return {"note": "larger than allowed"}
    start = time.process_time()
    mesh = meshed(case, geometry, size, kind, step)
    meshing = time.process_time() - start
    row = {"size": size / mm, "cells": len(mesh.cells), "unknowns": mesh.unknown_count, "meshing": meshing}
    if mesh.unknown_count > most and step != GRADED:
        return row | {"note": f"more than {most:,.0f} unknowns"}
    warm(case, geometry, kind, formulation)
    start = time.process_time()
    apart = replace(case, contact=NO_CONTACT) if step == "refined" else case
    solution = solve(apart, mesh, formulation)
    if step in TARGETS:
        most = MOST_TOUCHING if case.touches else MOST_REFINED
        result = refine_to(solution, case.measures[0], TARGETS[step], most_unknowns=most, options=OPTIONS)
        solution, row["rounds"] = result.solution, [[each.unknowns, each.value, each.error] for each in result.rounds]
        row["cells"] = len(solution.model.mesh.cells)
    if apart.touches != case.touches:
        solution = solve(case, solution.model.mesh, formulation)
    row["solving"] = time.process_time() - start
    start = time.process_time()
    response = tg.measure(solution, *case.measures, mesh_error=step in ESTIMATED, options=OPTIONS)
    row["estimating"] = time.process_time() - start
    row["values"] = {each.name: float(response.find(each.name).in_unit[-1]) for each in case.measures}
    row["estimates"] = estimates(response, case)
    row["iterations"] = int(solution.iterations)
    row["unknowns"] = unknowns_of(solution)
    return row


def unknowns_of(solution: tg.Solution) -> int:
    """Displacements and mean stresses, those that were doubled at jumps included, middles that follow left out."""
    mesh = solution.model.mesh
    return int(mesh.unknown_count - mesh.vertex_count + np.size(solution.states[-1].mean_stress))


def estimates(response: tg.Response, case: Case) -> dict[str, float]:
    """Estimated mesh errors of the measures in their unit, where the response has columns for them."""
    results = {}
    for each in case.measures:
        name = f"{each.name}_mesh_error"
        if name in response.names and np.isfinite(response.column(name)[-1]):
            results[each.name] = float(response.find(name).in_unit[-1])
    return results


if __name__ == "__main__":
    request = json.loads(sys.argv[1])
    request["case"] = next(case for case in CASES if case.name == request["case"])
    print(json.dumps(run(**request)))
