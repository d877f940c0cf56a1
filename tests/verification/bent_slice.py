"""Uniform bending: half a slice of a bender between a mirror plane and a plane that turns with it.

Far from its ends every section of a long bender is like every other. Then a slice is enough: its nodes at x = 0 stay
on a mirror plane, those at its other end on a plane n·x = s with n = (cos θ, 0, −sin θ), whose turn θ and place s are
unknowns. The plane is a cap: what the wall pulls at it, and that pull's moment, balance the pressure on the void in it.
Newton's method with one multiplier for each node on the plane; the void's area and moment are those of the iterate.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

import problems
import turgor as tg
from turgor.engine.system import System
from turgor.model.fibers import Fibers

#: Scaled residual that is small enough, and the first step as a share of the largest pressure.
TOLERANCE, FIRST_STEP = 1e-7, 0.01

_GAUSS, _WEIGHTS = np.polynomial.legendre.leggauss(4)


@dataclass(frozen=True)
class Bent:
    """What a slice does at a pressure: rotation [1/m] and volume of the void [m²] for each reference length."""

    curvature: float
    volume: float


def one_layer(mesh: tg.Mesh, thickness: float, at: float) -> tg.Mesh:
    """The layer of cells of a swept mesh around x = ``at`` as a slice of a thickness, between faces `near`, `far`."""
    x = mesh.points[mesh.cells, 0]
    low, high = x.min(axis=1), x.max(axis=1)
    cells = np.flatnonzero((low < at) & (at <= high))
    start, end = low[cells[0]], high[cells[0]]
    nodes = np.unique(mesh.cells[cells])
    number = np.full(len(mesh.points), -1)
    number[nodes] = np.arange(len(nodes))
    points = mesh.points[nodes]
    points[:, 0] = (points[:, 0] - start) / (end - start) * thickness
    faces = {name: number[sides] for name, sides in mesh.faces.items()}
    faces = {name: sides[(sides >= 0).all(axis=1)] for name, sides in faces.items()}
    faces = {name: sides for name, sides in faces.items() if len(sides)}
    for name, x0 in (("near", 0.0), ("far", thickness)):
        on = np.flatnonzero(np.abs(points[:, 0] - x0) < 1e-9)
        faces[name] = np.resize(on, (-(-len(on) // 9), 9))  # as many rows as it takes: only the nodes count
    where = np.full(len(mesh.cells), -1)
    where[cells] = np.arange(len(cells))
    regions = {name: where[rows][where[rows] >= 0] for name, rows in mesh.regions.items()}
    return tg.Mesh(points=points, cells=number[mesh.cells[cells]], regions=regions, faces=faces)


class BentSlice:
    """A slice with its fibers; `follow` takes it through pressures."""

    def __init__(self, mesh: tg.Mesh, law, fibers: Sequence[Fibers], largest: float) -> None:
        pin = mesh.face_nodes("near")[[np.argmin(np.abs(mesh.points[mesh.face_nodes("near")] @ [0, 1, 1]))]]
        faces = {**mesh.faces, "pin": np.resize(pin, (1, 9))}
        mesh = tg.Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces)
        materials = {name: problems.rubber(law) for name in mesh.regions}
        supports = [tg.Fixed("near", "x"), tg.Fixed("pin", "z")]
        load = tg.Pressure("cavity", largest)
        self.system = System(tg.Model(mesh, materials, supports, [load], reinforcements=fibers))
        self.largest = largest
        self.far = mesh.face_nodes("far")
        self.rim = _rim(mesh)
        self.thickness = float(np.ptp(mesh.points[:, 0])) / self.system.length
        self.free = np.flatnonzero(~self.system.held)

    def follow(self, pressures: Sequence[float]) -> list[Bent]:
        """Take the slice to pressures [Pa], with steps that grow and cut back and hit them exactly."""
        rest = np.zeros(self.system.size), np.zeros(len(self.far) + 2)
        rest[1][-2] = self.thickness
        path, step, out = [(0.0, *rest)], FIRST_STEP * self.largest, []
        for pressure in pressures:
            while path[-1][0] < pressure:
                target = min(path[-1][0] + step, pressure)
                found = self._solve(*_predicted(path, target), target / self.largest)
                if found is None:
                    step = (target - path[-1][0]) / 2
                    assert step > 1e-5 * self.largest, f"no equilibrium beyond {path[-1][0]} Pa"
                    continue
                step = max(step, 1.5 * (target - path[-1][0]))
                path = [path[-1], (target, *found)]
            out.append(self._bent(*path[-1][1:]))
        return out

    def _bent(self, unknowns, plane) -> Bent:
        place, turn = plane[-2:]
        area, moment = self._void(unknowns, turn)
        volume = moment * turn + area * place * turn / np.tan(turn)  # Pappus, about the line where the planes meet
        length = self.system.length
        return Bent(turn / self.thickness / length, volume / self.thickness * length**2)

    def _solve(self, unknowns, plane, factor):
        for _ in range(12):
            try:
                residual, matrix = self._equations(unknowns, plane, factor)
            except tg.TurgorError:  # a cell turned inside out
                return None
            if float(np.abs(residual).max()) < TOLERANCE:
                return unknowns, plane
            update = splu(matrix).solve(-residual)
            unknowns, plane = unknowns.copy(), plane + update[len(self.free) :]
            unknowns[self.free] += update[: len(self.free)]
        return None

    def _equations(self, unknowns, plane, factor):
        system, pull, (place, turn) = self.system, plane[:-2], plane[-2:]
        n, across = np.array([np.cos(turn), 0, -np.sin(turn)]), np.array([np.sin(turn), 0, np.cos(turn)])
        x = (system.points + system.split(unknowns)[0])[self.far]
        t = x @ across
        count, dofs = len(self.far), (3 * self.far[:, None] + np.arange(3)).ravel()
        rows = np.repeat(np.arange(count), 3)
        G = sp.csr_matrix((np.tile(n, count), (rows, dofs)), shape=(count, system.size))
        slopes = -np.outer(pull, across).ravel()
        by_turn = sp.csr_matrix((slopes, (np.zeros(3 * count, int), dofs)), shape=(1, system.size))
        r = system.residual(unknowns, factor) + G.T @ pull
        pressure = factor * self.largest / system.stress_scale
        void, moment = self._void(unknowns, turn)
        half = pressure / 2  # half a model
        ends = [-pull.sum() - half * void, -pull @ t - half * moment]
        residual = np.concatenate([r[self.free], x @ n - place, ends])
        K = system.tangent(unknowns, factor)[self.free][:, self.free]
        G, by_turn = G[:, self.free], by_turn[:, self.free]
        border = sp.csr_matrix(np.stack([-np.ones(count), -t]))
        corner = sp.csr_matrix(np.array([[0.0, 0.0], [0.0, -pull @ (x @ n)]]))
        side = sp.vstack([sp.csr_matrix((1, len(self.free))), by_turn])
        matrix = sp.bmat([[K, G.T, side.T], [G, None, border.T], [side, border, corner]], format="csc")
        return residual, matrix

    def _void(self, unknowns, turn):
        """Area of the whole void in the turned plane, and its first moment along the plane; scaled."""
        x = (self.system.points + self.system.split(unknowns)[0])[self.rim]
        y, t = x[..., 1], x @ np.array([np.sin(turn), 0, np.cos(turn)])
        N = np.stack([_GAUSS * (_GAUSS - 1) / 2, _GAUSS * (_GAUSS + 1) / 2, 1 - _GAUSS**2], axis=1)
        dN = np.stack([_GAUSS - 0.5, _GAUSS + 0.5, -2 * _GAUSS], axis=1)
        y, dt, t = y @ N.T, t @ dN.T, t @ N.T
        area, moment = (_WEIGHTS * y * dt).sum(), (_WEIGHTS * y * t * dt).sum()
        return 2 * abs(area), 2 * np.sign(area) * moment


def _predicted(path, target):
    """Straight on from the last two points of a path."""
    (now, *at) = path[-1]
    if len(path) == 1:
        return at
    before, *was = path[-2]
    share = (target - now) / (now - before)
    return [a + share * (a - b) for a, b in zip(at, was, strict=True)]


def _rim(mesh: tg.Mesh) -> np.ndarray:
    """Edges of the void in the far plane, (e, 3): both ends and the middle, one after the other along the rim."""
    sides = mesh.face("cavity")
    far = set(mesh.face_nodes("far").tolist())
    edges = []
    for side in sides:
        for k in range(4):
            edge = (int(side[k]), int(side[(k + 1) % 4]), int(side[4 + k]))
            if far.issuperset(edge):
                edges.append(edge)
    return np.array(edges)
