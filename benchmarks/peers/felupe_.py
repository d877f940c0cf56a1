"""The reference bender in FElupe: ten-node tetrahedra with three fields, Newton's method, PyPardiso.

python benchmarks/peers/felupe_.py FILE STEPS prints one line of JSON. FElupe has no pressure on sides of tetrahedra;
the loop over them stands here. Its tetrahedra have four points, so that the answer differs.
"""

import json
import sys
import time

import felupe as fe
import numpy as np
import problem
import scipy.sparse as sp
from pypardiso import PyPardisoSolver

#: Relative residual, and Newton's steps at most.
TOLERANCE, MOST = 1e-8, 25

#: Points and weights on a triangle, exact for quartic polynomials.
A, B = 0.445948490915965, 0.091576213509771
POINTS = np.array([[A, A], [1 - 2 * A, A], [A, 1 - 2 * A], [B, B], [1 - 2 * B, B], [B, 1 - 2 * B]])
WEIGHTS = np.repeat([0.223381589678011, 0.109951743655322], 3) / 2


def shapes() -> tuple[np.ndarray, np.ndarray]:
    """Quadratic shape functions (q, 6) and their derivatives (q, 6, 2)."""
    r, s = POINTS.T
    t, zero = 1 - r - s, np.zeros_like(r)
    N = np.stack([t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * r * t, 4 * r * s, 4 * s * t], axis=1)
    by_r = np.stack([1 - 4 * t, 4 * r - 1, zero, 4 * (t - r), 4 * s, -4 * s], axis=1)
    by_s = np.stack([1 - 4 * t, zero, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s)], axis=1)
    return N, np.stack([by_r, by_s], axis=2)


class Pressure:
    """Forces of a pressure of 1 on sides that look out of the body, and their derivatives."""

    def __init__(self, sides: np.ndarray, size: int) -> None:
        self.sides, self.size = sides, size
        self.N, self.dN = shapes()
        self.dofs = (3 * sides[:, :, None] + np.arange(3)).reshape(len(sides), 18)

    def at(self, x: np.ndarray) -> tuple[np.ndarray, sp.csr_matrix]:
        """Residual (size,) and tangent (size, size) at positions (n, 3)."""
        along = np.einsum("qak,tai->tqki", self.dN, x[self.sides])
        normal = np.cross(along[:, :, 0], along[:, :, 1])
        force = np.einsum("q,qa,tqi->tai", WEIGHTS, self.N, normal)
        turned = np.einsum("ijk,tqk->tqij", _epsilon(), along[:, :, 1])  # e_j x a2 = eps_ijk (a2)_k
        other = np.einsum("ikj,tqk->tqij", _epsilon(), along[:, :, 0])
        slope = np.einsum("q,qa,qb,tqij->taibj", WEIGHTS, self.N, self.dN[:, :, 0], turned)
        slope += np.einsum("q,qa,qb,tqij->taibj", WEIGHTS, self.N, self.dN[:, :, 1], other)
        row, column = np.repeat(self.dofs, 18, axis=1), np.tile(self.dofs, (1, 18))
        tangent = sp.csr_matrix((slope.reshape(-1), (row.ravel(), column.ravel())), shape=(self.size, self.size))
        return np.bincount(self.dofs.ravel(), force.ravel(), minlength=self.size), tangent


def _epsilon() -> np.ndarray:
    out = np.zeros((3, 3, 3))
    out[[0, 1, 2], [1, 2, 0], [2, 0, 1]], out[[0, 2, 1], [2, 1, 0], [1, 0, 2]] = 1.0, -1.0
    return out


class Rubber:
    """The cells of one material; both share displacements and, as with the other peers, the fields at vertices."""

    def __init__(self, known: dict[str, np.ndarray], name: str) -> None:
        C1, C2, bulk = problem.constants(name)
        cells = known["tets"][known["stiff"] == (name == "stiff")].astype(int)
        mesh = fe.Mesh(known["points_linear"], cells, "tetra10")
        self.field = fe.FieldsMixed(fe.RegionQuadraticTetra(mesh), n=3)
        law = fe.NearlyIncompressible(fe.Hyperelastic(fe.yeoh, C10=C1, C20=C2, C30=0.0), bulk=bulk)
        self.solid = fe.SolidBody(law, self.field)
        moved, vertices = self.field[0].values.size, int(known["nv"])
        starts = (0, moved, moved + vertices)
        parts = zip(starts, self.field.fields, strict=True)
        self.dofs = np.concatenate([start + np.arange(one.values.size) for start, one in parts])
        self.end = moved + 2 * vertices

    def assembled(self, size: int) -> tuple[np.ndarray, sp.csr_matrix]:
        """Internal forces (size,) and tangent (size, size)."""
        place = sp.csr_matrix(
            (np.ones(len(self.dofs)), (self.dofs, np.arange(len(self.dofs)))), shape=(size, len(self.dofs))
        )
        force = self.solid.assemble.vector(self.field).toarray().ravel()
        return place @ force, place @ self.solid.assemble.matrix(self.field) @ place.T

    def move(self, update: np.ndarray) -> None:
        """Add an update of all unknowns."""
        self.field += update[self.dofs]


def steps_of(known: dict[str, np.ndarray], bodies: list[Rubber], steps: int) -> tuple[int, list[list[float]]]:
    """Newton's iterations in all, and where the tip moves."""
    load, size = problem.stated()["load"], bodies[-1].end
    pressure = Pressure(problem.outward(known), size)
    held = (3 * np.asarray(known["clamp"])[:, None] + np.arange(3)).ravel()
    iterations, tips, solver = 0, [], PyPardisoSolver()
    for step in range(1, steps + 1):
        share = step / load["steps"] * load["p_max"]
        for _ in range(MOST):
            moved = bodies[0].field[0].values
            push, slope = pressure.at(known["points_linear"] + moved)
            forces, tangents = zip(*(each.assembled(size) for each in bodies), strict=True)
            residual, tangent = sum(forces) + share * push, (sum(tangents) + share * slope).tocsr()
            used = np.flatnonzero(np.abs(tangent.diagonal()) + abs(tangent).sum(axis=1).A1 > 0)
            free = np.setdiff1d(used, held)
            if np.linalg.norm(residual[free]) <= TOLERANCE * np.linalg.norm(share * push[free]):
                break
            update = np.zeros(size)
            update[free] = solver.solve(tangent[free][:, free], -residual[free])
            for each in bodies:
                each.move(update)
            iterations += 1
        tips.append(moved[known["tip"][0]].tolist())
    return iterations, tips


def main() -> None:
    known = dict(np.load(sys.argv[1]))
    bodies = [Rubber(known, name) for name in ("soft", "stiff")]
    began = time.perf_counter()
    iterations, tips = steps_of(known, bodies, int(sys.argv[2]))
    told = {
        "code": f"FElupe {fe.__version__} (PyPardiso, 4 points)",
        "unknowns": bodies[-1].end,
        "iterations": iterations,
        "solve": time.perf_counter() - began,
        "cpu": time.process_time(),
        "memory": problem.peak_memory(),
        "tips": tips,
    }
    print(json.dumps(told))


if __name__ == "__main__":
    main()
