"""An independent code for the truth set: displacement of third order and mean stress of second order, in NGSolve.

Nothing of turgor's engine is used: NGSolve meshes the CAD shape with curved cells of its own, differentiates the
energies by itself and factorizes with its own solver. Shared are the dimensions, the materials (the energy of a law is
called with NGSolve's symbols) and the definitions of the measures. Units are mm, N and MPa.

The mean stress is continuous within a region and jumps between regions, hence at membranes and wound faces as well.
Path: elements of second order take the load in steps; the cells that carry most of the error are bisected at its end
(`third_order_refine.py`); the third order starts from there and needs few iterations.
NGSolve is for development only: its wheel carries UMFPACK (GPL). Its factorization calls the split matrix singular
anyway; `sparsecholesky` factorizes it.

    python benchmarks/truth/third_order.py CASE [SIZE in mm] [ORDER]
"""

import json
import math
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import ngsolve as ng
import numpy as np

import turgor as tg

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.truth.third_order_energies import rubber_energy, surface_energies
from benchmarks.truth.third_order_refine import bisected, mark_edges
from benchmarks.truth.truth_cases import CASES

#: Strains over which the bend between slack and taut threads is rounded off, one after the other; taut ones have 4e-4.
ROUNDED = (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6)
#: Of these, how many are left out where the start is good.
SKIPPED = 2
ITERATIONS = 14
AXES = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True, slots=True)
class Problem:
    """A case on a mesh with elements of some order."""

    case: Any
    mesh: ng.Mesh
    order: int
    space: ng.FESpace
    load: ng.Parameter
    rounding: ng.Parameter
    form: ng.BilinearForm


@dataclass(frozen=True, slots=True)
class Found:
    """Measures at the full load, by name, in the unit of the measure, and what they cost."""

    values: dict[str, float]
    cells: int
    unknowns: int
    seconds: float
    change: float


def curved_mesh(case: Any, size: float, order: int, grading: float = 0.5) -> ng.Mesh:
    """Mesh the CAD shape of a case at a size [mm], with cells that are curved to an order."""
    shape = case.actuator.build().shape
    for face in shape.faces:
        if face.name in case.face_sizes:
            face.maxh = min(size, case.face_sizes[face.name])
    if case.layers:
        mark_edges(case, shape)
    mesh = ng.Mesh(shape.GenerateMesh(maxh=size, grading=grading, curvaturesafety=2.0, ngs_mesh=False))
    if case.layers:
        mesh.RefineHP(case.layers)
    mesh.Curve(order)
    return mesh


def problem(case: Any, mesh: ng.Mesh, order: int) -> Problem:
    """Spaces and the energy of a case."""
    held = {axis: held_faces(case, mesh, axis) for axis in "xyz"}
    V = ng.VectorH1(mesh, order=order, dirichletx=held["x"], dirichlety=held["y"], dirichletz=held["z"])
    regions = sorted(set(mesh.GetMaterials()))
    parts = [ng.H1(mesh, order=order - 1, definedon=mesh.Materials(name)) for name in regions]
    space = ng.FESpace([V] + [ng.Compress(part, active_dofs=part.FreeDofs()) for part in parts])
    u, *means = space.TrialFunction()
    load, rounding = ng.Parameter(0.0), ng.Parameter(ROUNDED[0])
    form = ng.BilinearForm(space, symmetric=True)
    for name, mean in zip(regions, means, strict=True):
        energy = rubber_energy(case.materials[name], u, mean)
        form += ng.Variation(energy.Compile() * ng.dx(name, bonus_intorder=2 * order - 3))
    for where, energy in surface_energies(case, u, load, rounding):
        form += ng.Variation(energy.Compile() * ng.ds(where, bonus_intorder=order))
    return Problem(case, mesh, order, space, load, rounding, form)


def held_faces(case: Any, mesh: ng.Mesh, axis: str) -> str:
    """Faces that do not move along an axis, as NGSolve takes them: supports and mirror planes."""
    names = {s.face for s in case.supports if isinstance(s, tg.Fixed) and axis in s.directions}
    return "|".join(sorted(names | ({f"symmetry_{axis}"} & set(mesh.GetBoundaries()))))


def newton(task: Problem, solution: ng.GridFunction, left: Any = None, tolerance: float = 1e-8) -> float | None:
    """Newton's method at the present load; the last relative correction, None where it does not converge.

    ``left`` is the imbalance that shall remain, none by default.
    """
    residual, update = solution.vec.CreateVector(), solution.vec.CreateVector()
    moved = len(solution.components[0].vec)
    for _ in range(ITERATIONS):
        task.form.Apply(solution.vec, residual)
        if left is not None:
            residual -= left
        task.form.AssembleLinearization(solution.vec)
        update.data = task.form.mat.Inverse(task.space.FreeDofs(), inverse="sparsecholesky") * residual
        solution.vec.data -= update
        step = np.linalg.norm(update.FV().NumPy()[:moved])
        size = step / max(np.linalg.norm(solution.vec.FV().NumPy()[:moved]), 1e-12)
        if not math.isfinite(size) or size > 1e6:
            return None
        if size < tolerance:
            return float(size)
    return None


def follow(task: Problem, first: float = 0.25) -> ng.GridFunction:
    """Take the load in steps, each predicted from the two states before; halve a step that fails."""
    now, before = ng.GridFunction(task.space), ng.GridFunction(task.space)
    at, last, step = 0.0, 0.0, first
    while at < 1:
        wanted = min(1.0, at + step)
        trial = ng.GridFunction(task.space)
        trial.vec.data = now.vec
        if at > last:
            trial.vec.data += (wanted - at) / (at - last) * (now.vec - before.vec)
        task.load.Set(wanted)
        if newton(task, trial) is None:
            step /= 2
            if step < 1e-3:
                raise RuntimeError(f"third order, {task.case.name}: no convergence past load factor {at:g}")
            continue
        before.vec.data, last = now.vec, at
        now.vec.data, at = trial.vec, wanted
    return sharpened(task, now, ROUNDED[1:])


def sharpened(task: Problem, start: ng.GridFunction, rounded: tuple[float, ...]) -> ng.GridFunction:
    """Round the bend of the threads off less and less; nothing to do where none goes slack."""
    slack = any(fibers.compression < 1 for fibers in task.case.reinforcements)
    for strain in rounded if slack else ():
        task.rounding.Set(strain)
        start = balanced(task, start)
    return start


def raised(task: Problem, start: ng.GridFunction) -> ng.GridFunction:
    """The solution of a higher order, or on smaller cells, at the full load, from the end of a lower one."""
    solution = ng.GridFunction(task.space)
    solution.components[0].Set(start.components[0])
    task.load.Set(1.0)
    task.rounding.Set(ROUNDED[SKIPPED])
    regions = sorted(set(task.mesh.GetMaterials()))
    for number, name in enumerate(regions, 1):
        solution.components[number].Set(start.components[number], definedon=task.mesh.Materials(name))
    return sharpened(task, balanced(task, solution), ROUNDED[SKIPPED + 1 :])


def balanced(task: Problem, start: ng.GridFunction) -> ng.GridFunction:
    """Take the imbalance of a start away: at once, or in steps where Newton's method would not converge."""
    imbalance, left = start.vec.CreateVector(), start.vec.CreateVector()
    task.form.Apply(start.vec, imbalance)
    now, at, step = start, 0.0, 1.0
    while at < 1:
        trial = ng.GridFunction(task.space)
        trial.vec.data = now.vec
        wanted = min(1.0, at + step)
        left.data = (1 - wanted) * imbalance
        if newton(task, trial, left) is None:
            step /= 2
            if step < 1e-3:
                raise RuntimeError(f"third order, {task.case.name}: no balance from the second order's end")
            continue
        now, at = trial, wanted
    return now


def measures(task: Problem, solution: ng.GridFunction) -> dict[str, float]:
    """Measures as `turgor.core.results.measures.measures` defines them, of the whole actuator."""
    mesh, u = task.mesh, solution.components[0]
    normal, F = ng.specialcf.normal(3), ng.Id(3) + ng.Grad(u).Trace()
    rest, moved = ng.CF((ng.x, ng.y, ng.z)), ng.CF((ng.x, ng.y, ng.z)) + u
    planes = [AXES[name[-1]] for name in set(mesh.GetBoundaries()) if name.startswith("symmetry_")]
    mirrored = np.array([0.0 if axis in planes else 1.0 for axis in range(3)])

    def over(what: Any, where: str) -> np.ndarray:
        return np.array(ng.Integrate(what, mesh, ng.BND, definedon=mesh.Boundaries(where), order=2 * task.order + 4))

    area = float(over(ng.CF(1.0), "tip"))
    shift = over(u, "tip") / area * mirrored
    vector = over(ng.Cof(F) * normal, "tip") * mirrored
    middle, center = over(rest, "tip") / area, over(moved, "tip") / area
    spread = over(ng.OuterProduct(moved - ng.CF(tuple(center)), rest - ng.CF(tuple(middle))), "tip").reshape(3, 3)
    left, _, right = np.linalg.svd(spread)
    turned = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
    twist = 0.0 if planes else 2 * math.atan2(turned[2, 1] - turned[1, 2], 1 + np.trace(turned))
    cavities = "|".join(sorted({name for name in mesh.GetBoundaries() if name.startswith("cavity")}))
    volume = -float(over(ng.InnerProduct(moved, ng.Cof(F) * normal), cavities)) / 3 * 2 ** len(planes)
    return {
        "bending_angle": math.degrees(math.atan2(-vector[2], vector[0])),
        "tip_displacement": float(np.linalg.norm(shift)),
        **{f"tip_displacement_{axis}": float(shift[i]) for axis, i in AXES.items()},
        "twist_angle": math.degrees(twist),
        "cavity_volume": volume / 1e3,
    }


def solve(case: Any, size: float, order: int = 3) -> Found:
    """Measures of a case at a size [mm]: second order on the path and on bisected cells, then the order asked for."""
    start = time.process_time()
    task = problem(case, curved_mesh(case, size, order), 2)
    solution = follow(task)
    for share in case.bisections:
        mesh = bisected(case, task.mesh, solution, share, order)
        task = problem(case, mesh, 2)
        solution = raised(task, solution)
    before = measures(task, solution)
    if order > 2:
        task = problem(case, task.mesh, order)
        solution = raised(task, solution)
    values = measures(task, solution)
    main = case.measures[0].name
    change = values[main] / before[main] - 1
    return Found(values, task.mesh.ne, sum(task.space.FreeDofs()), time.process_time() - start, change)


def main() -> None:
    """Solve one case and print its measures, or one line of JSON with --json."""
    words = [word for word in sys.argv[1:] if word != "--json"]
    case = next(case for case in CASES if case.name == words[0])
    size = float(words[1]) if len(words) > 1 else case.third_order_size
    result = solve(case, size, int(words[2]) if len(words) > 2 else 3)
    values = {each.name: result.values[each.name] for each in case.measures}
    if "--json" in sys.argv:
        row = {"size": size, "cells": result.cells, "unknowns": result.unknowns, "values": values}
        print(json.dumps(row | {"meshing": 0.0, "solving": result.seconds, "change": result.change}))
        return
    for each in case.measures:
        print(f"{each.name} {values[each.name]:.6g} {each.unit}")
    size_of = f"{result.cells} cells, {result.unknowns} unknowns"
    print(f"{size_of}, {result.seconds:.0f} CPU s; order 2 to 3: {result.change:+.3%}")


if __name__ == "__main__":
    main()
