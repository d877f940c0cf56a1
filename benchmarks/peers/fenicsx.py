"""The reference bender in FEniCSx (dolfinx 0.5, Debian): Taylor-Hood, Newton's method, MUMPS.

/usr/bin/python3 benchmarks/peers/fenicsx.py FILE STEPS prints one line of JSON. The system's Python has dolfinx. Behind
`mpirun -n 2` it shares the work between two processes, as its users do who have two cores.
"""

import json
import sys
import time

import dolfinx
import numpy as np
import problem
import ufl
from dolfinx import fem, mesh, nls
from mpi4py import MPI
from petsc4py import PETSc

WORLD = MPI.COMM_WORLD

#: How the kernels are compiled, as users do who want them fast.
FAST = {"cffi_extra_compile_args": ["-O3", "-march=native", "-ffast-math"], "cffi_libraries": ["m"]}


def read(file: str) -> tuple[mesh.Mesh, dict[str, np.ndarray]]:
    """The mesh of the corners; its edges are straight."""
    known = dict(np.load(file))
    shape = ufl.VectorElement("Lagrange", ufl.Cell("tetrahedron"), 1)
    cells, points = known["tets"][:, :4].astype(np.int64), known["points_linear"][: int(known["nv"])]
    if WORLD.rank:  # the first process hands out the mesh
        cells, points = cells[:0], points[:0]
    return mesh.create_mesh(WORLD, cells, points, ufl.Mesh(shape)), known


def materials(body: mesh.Mesh) -> tuple[fem.Function, fem.Function, fem.Function]:
    """C1, C2 and the bulk modulus in each cell."""
    local = body.topology.index_map(3)
    count = local.size_local + local.num_ghosts
    middle = mesh.compute_midpoints(body, 3, np.arange(count, dtype=np.int32))
    stiff = middle[:, 2] < problem.stated()["geometry"]["stiff_layer"]
    space = fem.FunctionSpace(body, ("DG", 0))
    results = tuple(fem.Function(space) for _ in range(3))
    for name, where in (("soft", ~stiff), ("stiff", stiff)):
        for function, value in zip(results, problem.constants(name), strict=True):
            function.x.array[where] = value
    return results


def solver(file: str) -> tuple[nls.petsc.NewtonSolver, fem.Function, fem.Constant, tuple[int, ...]]:
    """Newton's method for the bender, its unknowns, the pressure, and the dofs of the tip."""
    body, known = read(file)
    geometry = problem.stated()["geometry"]
    W = fem.FunctionSpace(
        body,
        ufl.MixedElement(
            ufl.VectorElement("Lagrange", body.ufl_cell(), 2), ufl.FiniteElement("Lagrange", body.ufl_cell(), 1)
        ),
    )
    V, _ = W.sub(0).collapse()
    w, test, pressure = fem.Function(W), ufl.TestFunction(W), fem.Constant(body, 0.0)
    u, p = ufl.split(w)
    v, _ = ufl.split(test)
    F = ufl.Identity(3) + ufl.grad(u)
    J = ufl.det(F)
    invariant = J ** (-2 / 3) * ufl.tr(F.T * F) - 3
    C1, C2, bulk = materials(body)
    dx = ufl.dx(metadata={"quadrature_degree": 4})
    stored = (C1 * invariant + C2 * invariant**2 + p * (J - 1) - p**2 / (2 * bulk)) * dx
    facets = np.sort(mesh.locate_entities_boundary(body, 2, lambda x: problem.in_cavity(x, geometry)))
    tags = mesh.meshtags(body, 2, facets, np.ones(len(facets), dtype=np.int32))
    ds = ufl.Measure("ds", domain=body, subdomain_data=tags, metadata={"quadrature_degree": 4})
    pushed = pressure * J * ufl.dot(ufl.inv(F).T * ufl.FacetNormal(body), v) * ds(1)
    residual = ufl.derivative(stored, w, test) + pushed
    clamp = mesh.locate_entities_boundary(body, 2, lambda x: x[0] < 1e-9)
    fixed = fem.locate_dofs_topological((W.sub(0), V), 2, clamp)
    nonlinear = fem.petsc.NonlinearProblem(
        residual, w, [fem.dirichletbc(fem.Function(V), fixed, W.sub(0))], jit_params=FAST
    )
    newton = nls.petsc.NewtonSolver(WORLD, nonlinear)
    newton.rtol, newton.atol, newton.convergence_criterion = 1e-8, 1e-12, "residual"
    options, prefix = PETSc.Options(), newton.krylov_solver.getOptionsPrefix()
    for name, value in (("ksp_type", "preonly"), ("pc_type", "lu"), ("pc_factor_mat_solver_type", "mumps")):
        options[f"{prefix}{name}"] = value
    newton.krylov_solver.setFromOptions()
    end = known["points_linear"][known["tip"][0]]
    at = fem.locate_dofs_geometrical((W.sub(0), V), lambda x: np.linalg.norm(x.T - end, axis=1) < 1e-6)
    return newton, w, pressure, tuple(at[0])


def main() -> None:
    file, steps = sys.argv[1], int(sys.argv[2])
    newton, w, pressure, tip = solver(file)
    load, iterations, tips, began = problem.stated()["load"], 0, [], time.perf_counter()
    for step in range(1, steps + 1):
        pressure.value = step / load["steps"] * load["p_max"]
        count, _ = newton.solve(w)
        iterations += count
        tips.append([float(w.x.array[k]) for k in tip])
    facts = {
        "code": f"FEniCSx (dolfinx {dolfinx.__version__}, MUMPS)",
        "unknowns": w.function_space.dofmap.index_map.size_global * w.function_space.dofmap.index_map_bs,
        "iterations": iterations,
        "solve": time.perf_counter() - began,
        "cpu": WORLD.allreduce(time.process_time()),
        "memory": WORLD.allreduce(problem.peak_memory()),
        "tips": next(result for result in WORLD.allgather(tips) if result[0]),
    }
    if not WORLD.rank:
        print(json.dumps(facts))


if __name__ == "__main__":
    main()
