"""The reference bender in NGSolve as it comes: energy, Taylor-Hood, Newton's method, sparsecholesky.

python benchmarks/peers/ngsolve_.py FILE STEPS prints one line of JSON.
"""

import json
import sys
import time

import netgen.meshing as ngm
import ngsolve as ngs
import numpy as np
import problem

SOFT, STIFF, CLAMP, CAVITY, REST = "soft", "stiff", "clamp", "cavity", "rest"

#: Relative residual, and Newton's steps at most.
TOLERANCE, MOST = 1e-8, 25


def read(file: str) -> tuple[ngs.Mesh, np.ndarray]:
    """The mesh of the corners; its edges are straight."""
    known, geometry = dict(np.load(file)), problem.stated()["geometry"]
    points, corners = known["points_linear"][: int(known["nv"])], known["tets"][:, :4].astype(int)
    made = ngm.Mesh(dim=3)
    numbers = [made.Add(ngm.MeshPoint(ngm.Pnt(*map(float, point)))) for point in points]
    for number, name in enumerate((CLAMP, CAVITY, REST), 1):
        made.Add(ngm.FaceDescriptor(surfnr=number, domin=1, domout=0, bc=number))
        made.SetBCName(number - 1, name)
    for row in problem.skin(corners):
        place = points[row].T
        kind = 1 if (place[0] < 1e-9).all() else 2 if problem.in_cavity(place, geometry).all() else 3
        made.Add(ngm.Element2D(kind, [numbers[k] for k in row]))
    for row, stiff in zip(corners, known["stiff"], strict=True):
        made.Add(ngm.Element3D(2 if stiff else 1, [numbers[k] for k in row]))
    made.SetMaterial(1, SOFT)
    made.SetMaterial(2, STIFF)
    return ngs.Mesh(made), points[known["tip"][0]]


def form(body: ngs.Mesh, space: ngs.FESpace, pressure: ngs.Parameter) -> ngs.BilinearForm:
    """Energy of the rubber and work of the follower pressure."""
    laws = {name: problem.constants(name) for name in (SOFT, STIFF)}
    C1, C2, bulk = (body.MaterialCF({name: law[k] for name, law in laws.items()}) for k in range(3))
    (u, p), (v, _) = space.TnT()
    F = ngs.Id(3) + ngs.Grad(u)
    J = ngs.Det(F)
    invariant = J ** (-2 / 3) * ngs.Trace(F.trans * F) - 3
    out = ngs.BilinearForm(space)
    out += ngs.Variation((C1 * invariant + C2 * invariant**2 + p * (J - 1) - p**2 / (2 * bulk)).Compile() * ngs.dx)
    there = ngs.Id(3) + ngs.Grad(u).Trace()
    out += (pressure * ngs.InnerProduct(ngs.Cof(there) * ngs.specialcf.normal(3), v.Trace())).Compile() * ngs.ds(CAVITY)
    return out


def step(a: ngs.BilinearForm, space: ngs.FESpace, w: ngs.GridFunction, before: float) -> tuple[int, float]:
    """Newton's method for one pressure; the iterations, and the first residual."""
    residual, update, first = w.vec.CreateVector(), w.vec.CreateVector(), 0.0
    free = ngs.Projector(space.FreeDofs(), True)
    for count in range(MOST):
        a.Apply(w.vec, residual)
        free.Project(residual)
        size = ngs.Norm(residual)
        first = first or size
        if size <= TOLERANCE * max(first, before):
            return count, max(first, before)
        a.AssembleLinearization(w.vec)
        update.data = a.mat.Inverse(space.FreeDofs(), inverse="sparsecholesky") * residual
        w.vec.data -= update
    raise RuntimeError(f"no convergence: {size:g} of {first:g}")


def main() -> None:
    file, steps = sys.argv[1], int(sys.argv[2])
    ngs.SetNumThreads(1)
    body, tip = read(file)
    space = ngs.VectorH1(body, order=2, dirichlet=CLAMP) * ngs.H1(body, order=1)
    w, pressure, load = ngs.GridFunction(space), ngs.Parameter(0.0), problem.stated()["load"]
    a, iterations, tips, began = form(body, space, pressure), 0, [], time.perf_counter()
    end = body(*tip)
    for number in range(1, steps + 1):
        pressure.Set(number / load["steps"] * load["p_max"])
        iterations += step(a, space, w, 0.0)[0]
        tips.append(list(map(float, w.components[0](end))))
    print(
        json.dumps(
            {
                "code": f"NGSolve {ngs.__version__} (sparsecholesky)",
                "unknowns": space.ndof,
                "iterations": iterations,
                "solve": time.perf_counter() - began,
                "cpu": time.process_time(),
                "memory": problem.peak_memory(),
                "tips": tips,
            }
        )
    )


if __name__ == "__main__":
    main()
