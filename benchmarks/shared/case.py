"""One measurement in its own process, which prints one line of JSON.

    python benchmarks/shared/case.py '{"case": "bender", ...}'

A process of its own makes CPU time and peak memory those of this run alone, start-up and imports included, and lets
`run.py` set the number of threads before anything is imported.
"""

import csv
import json
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

import turgor as tg

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.peers.problem import STEPS as PEER_STEPS
from benchmarks.peers.problem import mesh_file, peak_memory, stated
from turgor.core.engine.runtime import EngineOptions
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES
from turgor.core.meshing.refining.split import split_edges
from turgor.units import MPa, kPa, mm

ROOT = Path(__file__).parents[2]
BENDER = ROOT / "tests" / "verification" / "data" / "reference_bender"
STEPS = 20


def bender_model(size: str = "S", share: float = 1.0) -> tg.Model:
    """The reference bender as its files state it: the peers' mesh, materials, clamp, and a share of the pressure."""
    problem, arrays = stated(), np.load(mesh_file(size))
    points, cells = arrays["points_linear"] * mm, arrays["tets"].astype(np.int64)
    stiff = arrays["stiff"].astype(bool)
    mesh = tg.Mesh(
        points=points,
        cells=cells,
        regions={"body": np.flatnonzero(~stiff), "base": np.flatnonzero(stiff)},
        faces={"cavity": outward(points, cells, arrays["cavity"].astype(np.int64)), "fixed": clamped(cells, points)},
        name=f"reference bender {size}",
    )
    soft, hard = problem["materials"]["soft"], problem["materials"]["stiff"]
    return tg.Model(
        mesh,
        materials={
            "body": rubber(tg.Yeoh(C10=soft["C1"] * MPa, C20=soft["C2"] * MPa, C30=soft["C3"] * MPa), soft["nu0"]),
            "base": rubber(tg.laws.NeoHooke(C10=hard["C1"] * MPa), hard["nu0"]),
        },
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity", share * problem["load"]["p_max"] * MPa)],
        formulation="continuous",  # the element of the peers
    )


def rubber(law: Any, nu: float) -> tg.Material:
    """A material with the bulk modulus that its initial Poisson's ratio means."""
    mu = law.shear_modulus
    return tg.Material(name="rubber", law=law, bulk_modulus=2 * mu * (1 + nu) / (3 * (1 - 2 * nu)))


def sides(cells: np.ndarray) -> np.ndarray:
    """The six-node sides of all cells, normals pointing out of the cell."""
    from turgor.core.meshing.cells import TETRAHEDRON

    return cells[:, np.array(TETRAHEDRON.sides)].reshape(-1, 6)


def outward(points: np.ndarray, cells: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """The same triangles as sides of their cells, so that they point out of the solid."""
    candidates = sides(cells)
    wanted = {tuple(row) for row in np.sort(triangles[:, :3], axis=1).tolist()}
    return candidates[[tuple(row) in wanted for row in np.sort(candidates[:, :3], axis=1).tolist()]]


def clamped(cells: np.ndarray, points: np.ndarray) -> np.ndarray:
    """The sides on the plane x = 0."""
    candidates = sides(cells)
    return candidates[(points[candidates, 0] < 1e-9).all(axis=1)]


def bender(*, solver: str, threads: int) -> dict[str, Any]:
    """The whole path of the reference bender in the peers' 20 equal steps, residual to 1e-8."""
    factors = tuple((i + 1) / STEPS for i in range(STEPS))
    procedure = tg.Static(first_step=1 / STEPS, max_step=1 / STEPS, at=factors, tolerance=1e-8)
    solution = tg.solve(bender_model(), procedure, options=EngineOptions(linear_solver=solver, threads=threads))
    with (BENDER / "reference_S.csv").open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["code"].startswith("dolfinx")]
    node = int(np.load(BENDER / "bender_S.npz")["tip"][0])
    expected = np.array([[float(row[f"tip_u{axis}_mm"]) for axis in "xyz"] for row in rows])
    at = {round(state.load_factor * STEPS): state for state in solution.states}
    got = np.array([at[i + 1].displacement[node] / mm for i in range(STEPS)])
    off = np.linalg.norm(got - expected, axis=1) / np.linalg.norm(expected, axis=1)
    return facts(solution) | {"deviation": float(off.max())}


def peer_bender(*, solver: str, threads: int, size: str) -> dict[str, Any]:
    """The reference bender as `peers/compare.py` asks for it: the steps of a size, and the way of the tip."""
    steps = PEER_STEPS[size]
    at = tuple((i + 1) / steps for i in range(steps))
    procedure = tg.Static(first_step=1 / steps, max_step=1 / steps, at=at, tolerance=1e-8)
    options = EngineOptions(linear_solver=solver, threads=threads)
    solution = tg.solve(bender_model(size, steps / STEPS), procedure, options=options)
    node = int(np.load(mesh_file(size))["tip"][0])
    got = {state.load_factor: (state.displacement[node] / mm).tolist() for state in solution.states}
    return facts(solution) | {"tips": [got[factor] for factor in at]}


def demo(*, solver: str, threads: int) -> dict[str, Any]:
    """The actuator of `examples/fast_pneunet.toml`, on a finer mesh, until about its walls meet."""
    job = tg.jobs.read_job(ROOT / "examples" / "fast_pneunet.toml")
    mesh = tg.mesh(job.actuator.build(), size=2.2 * mm, grading=job.mesh.grading)
    model = tg.Model(mesh, materials=job.materials, supports=job.supports, loads=[tg.Pressure("cavity", 6 * kPa)])
    return facts(tg.solve(model, job.procedure, options=EngineOptions(linear_solver=solver, threads=threads)))


def growth(*, solver: str, threads: int, size: float, halved: bool = False) -> dict[str, Any]:
    """The first load step of a six-chamber fast PneuNet: a few iterations show what one costs.

    Where ``halved``, every edge of the mesh is cut in two.
    """
    options = EngineOptions(linear_solver=solver, threads=threads)
    first = tg.Static(first_step=0.05, max_step=0.05)
    model = growth_model(size, halved)
    return facts(tg.solve(model, first, options=options, stop=lambda state: "one step is enough", throw=False))


def growth_model(size: float, halved: bool = False, paper: bool = True) -> tg.Model:
    """The fast PneuNet of `growth`, with a shell of paper or without."""
    mesh = tg.mesh(tg.FastPneuNet(chambers=6, length=60 * mm).build(), size=size)
    mesh = split_edges(mesh, every_edge(mesh)) if halved else mesh
    rubber_ = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    sheet = tg.Shell(tg.from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * mm)
    materials = {"body": rubber_, "base": rubber_} | ({"strain_limiting_layer": sheet} if paper else {})
    return tg.Model(mesh, materials=materials, supports=[tg.Fixed("fixed")], loads=[tg.Pressure("cavity", 20 * kPa)])


def every_edge(mesh: tg.Mesh) -> np.ndarray:
    """The edges of all cells, as pairs of vertices."""
    pairs = mesh.cells[:, np.array(TETRAHEDRON_EDGES)[:, :2]].reshape(-1, 2)
    return np.unique(np.sort(pairs, axis=1), axis=0)


def facts(solution: tg.Solution) -> dict[str, Any]:
    """What a solution says of itself, and what the process has used by now."""
    timing = solution.timing
    return {
        "unknowns": solution.model.mesh.unknown_count,
        "solver": timing.linear_solver,
        "status": str(solution.status),
        "steps": len(solution.states) - 1,
        "iterations": solution.iterations,
        "compile": timing.compile,
        "setup": timing.setup,
        "assembly": timing.assembly,
        "residual": timing.residual,
        "factorizations": timing.factorizations,
        "factorization": timing.factorization,
        "solve": timing.solve,
        "total": timing.total,
        "cpu": time.process_time(),
        "memory": peak_memory(),
        "before": BEFORE,
    }


#: Memory of Python and the packages [MiB], before there is a problem.
BEFORE = peak_memory()

if __name__ == "__main__":
    request = json.loads(sys.argv[1])
    cases = {"bender": bender, "peer_bender": peer_bender, "demo": demo, "growth": growth}
    print(json.dumps(cases[request.pop("case")](**request)))
