"""Terms on named faces: follower pressures, membranes and fibers."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.engine.algebra.pattern import Pattern, locate, scatter_add
from turgor.engine.cells.reference import side_tables
from turgor.engine.faces import membranes, surfaces
from turgor.engine.faces.shells import shear_layers, shear_moduli, shell_layers
from turgor.engine.fibers import fiber_kernels as fibers
from turgor.engine.fibers import truss_bending as bending
from turgor.engine.fibers.fiber_trusses import FiberTrusses, lay
from turgor.materials.laws.laws import Hooke
from turgor.model.loads import History, Pressure
from turgor.model.model import Model

Array = NDArray[np.float64]
Triangles = NDArray[np.int64]


@dataclass(slots=True, eq=False)
class _Pressed:
    """Faces under the same pressure: triangles, the load of one of them, scale, whether it has a potential.

    No load: the pressure is not stated but sought.
    """

    triangles: Triangles
    load: Pressure | None
    stress: float
    symmetric: bool
    positions: NDArray[np.int32]

    def at(self, load_factor: float) -> float:
        """Scaled pressure at a load factor."""
        return 0.0 if self.load is None else self.load.share(load_factor) * (self.load.pressure / self.stress)


@dataclass(slots=True, eq=False)
class _Sheet:
    """A membrane: triangles, gradients, areas, scaled moduli times thickness."""

    triangles: Triangles
    gradients: Array
    areas: Array
    moduli: Array
    positions: NDArray[np.int32]


@dataclass(slots=True, eq=False)
class _Threads:
    """Fibers: their pieces, in scaled units."""

    pieces: fibers.Pieces
    positions: NDArray[np.int32]

    @property
    def triangles(self) -> Triangles:
        return self.pieces.sides


@dataclass(slots=True, eq=False)
class _Bent:
    """Joints of threads that resist bending, in scaled units."""

    joints: bending.Joints
    positions: NDArray[np.int32]


class FaceTerms:
    """Forces and tangents of pressures, membranes and fibers, in scaled units.

    Parameters
    ----------
    model : Model
    points : (n, 3) array
        Scaled reference positions.
    held : (n, 3) bool array
        Prescribed components.
    length, stress : float
        Scales.
    controlled : tuple of str
        Faces whose pressure is sought; they come first, in this order.
    """

    def __init__(
        self,
        model: Model,
        points: Array,
        held: NDArray[np.bool_],
        length: float,
        stress: float,
        controlled: tuple[str, ...] = (),
    ) -> None:
        self._pressed = _group_pressures(model, points, held, stress, controlled)
        self._sheets = []
        for name, membrane in model.membranes.items():
            law, scale = membrane.material.law, membrane.thickness / (length * stress)
            assert isinstance(law, Hooke)
            moduli = membranes.plane_stress_moduli(law) * scale
            if membrane.bending:
                layers = shell_layers(model.mesh, name, membrane.thickness, length)
                across = shear_layers(model.mesh, name, length)
                shear = shear_moduli(law) * scale
                self._sheets += [_Sheet(*layer, shear, np.empty(0, np.int32)) for layer in across]
            else:
                triangles = np.ascontiguousarray(model.mesh.face(name))
                layers = [(triangles, *membranes.surface_gradients(points, triangles))]
            self._sheets += [_Sheet(*layer, moduli, np.empty(0, np.int32)) for layer in layers]

        self._threads, self._bent = [], []
        for each in model.reinforcements:
            laid = lay(model.mesh, each)
            pieces = laid.pieces if isinstance(laid, FiberTrusses) else laid
            self._threads.append(_Threads(_scaled(pieces, length, stress), np.empty(0, np.int32)))
            if each.bending and isinstance(laid, FiberTrusses):
                joints = bending.joints_of(laid, each, model.mesh.points).scaled(length, stress)
                self._bent.append(_Bent(joints, np.empty(0, np.int32)))

    @property
    def symmetric(self) -> bool:
        """Whether all pressures derive from a potential."""
        return all(group.symmetric for group in self._pressed)

    @property
    def couplings(self) -> list[Triangles]:
        """Unknowns that are tied across the borders of cells, a row for each tie."""
        return [bent.joints.unknowns for bent in self._bent]

    def locate(self, pattern: Pattern) -> None:
        """Find where the entries of the triangles go in the tangent."""
        for bent in self._bent:
            unknowns = bent.joints.unknowns
            rows, columns = np.tril_indices(unknowns.shape[1])
            bent.positions = locate(
                pattern.indptr, pattern.indices, unknowns[:, rows].ravel(), unknowns[:, columns].ravel()
            )
        terms: list[_Pressed | _Sheet | _Threads] = [*self._pressed, *self._sheets, *self._threads]
        for term in terms:
            unknowns = _unknowns(term.triangles)
            rows, columns = np.tril_indices(unknowns.shape[1])
            term.positions = locate(
                pattern.indptr, pattern.indices, unknowns[:, rows].ravel(), unknowns[:, columns].ravel()
            )

    def _acting(self, load_factor: float, sought: Array | None) -> list[tuple[_Pressed, float]]:
        """Groups of pressed faces with their scaled pressures, the sought ones as given."""
        acting = [group.at(load_factor) for group in self._pressed]
        if sought is not None:
            acting[: len(sought)] = [float(pressure) for pressure in sought]
        return list(zip(self._pressed, acting, strict=True))

    def unit_forces(self, position: Array, count: int) -> list[Array]:
        """External forces (n, 3) of a scaled pressure of one on each of the first ``count`` groups."""
        found = []
        for group in self._pressed[:count]:
            local = surfaces.pressure_forces(position, group.triangles, *_tables(group.triangles))
            found.append(np.zeros_like(position))
            _add_at_nodes(found[-1], group.triangles, -local)
        return found

    def forces(self, position: Array, load_factor: float, sought: Array | None = None) -> tuple[Array, Array]:
        """Internal forces of the membranes and external forces of the pressures, (n, 3) each."""
        internal, external = np.zeros_like(position), np.zeros_like(position)
        for group, pressure in self._acting(load_factor, sought):
            local = surfaces.pressure_forces(position, group.triangles, *_tables(group.triangles))
            _add_at_nodes(external, group.triangles, -pressure * local)
        for sheet, stress in zip(self._sheets, self.membrane_stresses(position), strict=True):
            local = membranes.membrane_forces(position, sheet.triangles, sheet.gradients, sheet.areas, stress)
            _add_at_nodes(internal, sheet.triangles, local)
        for threads, tension in zip(self._threads, self.fiber_tensions(position), strict=True):
            p = threads.pieces
            _add_at_nodes(internal, p.sides, fibers.fiber_forces(position, p.sides, p.along, p.weights, tension))
        for bent in self._bent:
            _add_at_nodes(internal, bent.joints.nodes, bending.bending_forces(bent.joints, position))
        return internal, external

    def fiber_tensions(self, position: Array, update: Array | None = None) -> list[Array]:
        """Scaled tensions (k,) of the pieces of each winding, linearized for an update where one is given."""
        return [tension for _, tension in self._stretched(position, update)]

    def _stretched(self, position: Array, update: Array | None = None) -> list[tuple[Array, Array]]:
        """Stretch and tension of the pieces of each winding."""
        update = np.zeros_like(position) if update is None else update
        pieces = [threads.pieces for threads in self._threads]
        return [fibers.fiber_tensions(position, update, p.sides, p.along, p.stiffness, p.pushed) for p in pieces]

    def fiber_energy(self, position: Array) -> float:
        """Scaled energy of all fibers: ½ N (λ − 1) for each reference length, and that of bending."""
        bent = sum(bending.bending_energy(each.joints, position) for each in self._bent)
        return bent + sum(
            0.5 * float((threads.pieces.weights * tension * (stretch - 1)).sum())
            for threads, (stretch, tension) in zip(self._threads, self._stretched(position), strict=True)
        )

    def membrane_stresses(self, position: Array, update: Array | None = None) -> list[Array]:
        """Scaled stress times thickness (f, q, 3) of each membrane, linearized for an update where one is given."""
        update = np.zeros_like(position) if update is None else update
        return [
            membranes.membrane_stress(position, update, s.triangles, s.gradients, s.areas, s.moduli)
            for s in self._sheets
        ]

    def membrane_energy(self, position: Array) -> float:
        """Scaled energy of all membranes, ½ S : ℂ⁻¹ : S."""
        total = 0.0
        for sheet, stress in zip(self._sheets, self.membrane_stresses(position), strict=True):
            strain = stress @ np.linalg.pinv(sheet.moduli)
            total += 0.5 * float((sheet.areas[..., None] * stress * strain).sum())
        return total

    def add_tangents(
        self,
        data: Array,
        position: Array,
        load_factor: float,
        given: "FaceStresses | None",
        sought: Array | None = None,
    ) -> None:
        """Add the symmetric parts of all tangents to the lower triangle; the given stresses enter the geometric one."""
        for group, pressure in self._acting(load_factor, sought):
            local = surfaces.pressure_tangents(position, group.triangles, *_tables(group.triangles))
            local *= pressure
            local = 0.5 * (local + local.transpose(0, 2, 1))
            scatter_add(data, group.positions, _lower(local))
        stresses = given or self.stresses(position)
        for sheet, stress in zip(self._sheets, stresses.membranes, strict=True):
            local = membranes.membrane_tangents(
                position, sheet.triangles, sheet.gradients, sheet.areas, sheet.moduli, stress
            )
            scatter_add(data, sheet.positions, _lower(local))
        for threads, (stretch, _), tension in zip(
            self._threads, self._stretched(position), stresses.fibers, strict=True
        ):
            p = threads.pieces
            kept = np.where(stretch >= 1, 1.0, np.maximum(p.pushed, fibers.SLACK_TANGENT)) * p.stiffness
            local = fibers.fiber_tangents(position, p.sides, p.along, p.weights, kept, tension)
            scatter_add(data, threads.positions, _lower(local))
        for bent in self._bent:
            local = bending.bending_tangents(bent.joints, position)
            scatter_add(data, bent.positions, bending.lower_of_doubled(local, bent.joints.unknowns))

    def stresses(self, position: Array, update: Array | None = None) -> "FaceStresses":
        """Stresses of membranes and tensions of fibers, linearized for an update where one is given."""
        return FaceStresses(self.membrane_stresses(position, update), self.fiber_tensions(position, update))

    def skew_matrix(
        self, position: Array, load_factor: float, size: int, sought: Array | None = None
    ) -> sp.csc_matrix | None:
        """Skew part of the tangents of pressures without potential; None where there are none."""
        total: sp.csc_matrix | None = None
        for group, pressure in self._acting(load_factor, sought):
            if group.symmetric:
                continue
            local = surfaces.pressure_tangents(position, group.triangles, *_tables(group.triangles))
            local *= pressure
            local = 0.5 * (local - local.transpose(0, 2, 1))
            unknowns = _unknowns(group.triangles)
            count = unknowns.shape[1]
            rows = np.repeat(unknowns, count, axis=1).ravel()
            columns = np.tile(unknowns, (1, count)).ravel()
            part = sp.csc_matrix((local.ravel(), (rows, columns)), shape=(size, size))
            total = part if total is None else (total + part).tocsc()
        return total


@dataclass(frozen=True, slots=True, eq=False)
class FaceStresses:
    """Scaled stresses (f, q, 3) of each membrane and tensions (k,) of each winding."""

    membranes: list[Array]
    fibers: list[Array]

    @staticmethod
    def combine(parts: "Sequence[tuple[float, FaceStresses]]") -> "FaceStresses":
        """Weighted sum, for extrapolation."""
        return FaceStresses(
            _combined([(weight, part.membranes) for weight, part in parts]),
            _combined([(weight, part.fibers) for weight, part in parts]),
        )


def _combined(parts: Sequence[tuple[float, list[Array]]]) -> list[Array]:
    columns = zip(*(arrays for _, arrays in parts), strict=True)
    return [np.asarray(sum(w * a for (w, _), a in zip(parts, column, strict=True))) for column in columns]


def _scaled(pieces: fibers.Pieces, length: float, stress: float) -> fibers.Pieces:
    """Pieces in scaled units: the product of weight and stiffness is a force times a length, along is 1 / length."""
    return replace(
        pieces,
        along=np.ascontiguousarray(pieces.along * length),
        weights=pieces.weights,
        stiffness=pieces.stiffness / (stress * length**3),
    )


def _group_pressures(
    model: Model, points: Array, held: NDArray[np.bool_], stress: float, controlled: tuple[str, ...]
) -> list[_Pressed]:
    """Join faces under equal pressure at all times: together they may be closed where each alone is open."""
    groups = []
    for name in controlled:
        triangles = np.ascontiguousarray(model.mesh.face(name))
        symmetric = surfaces.has_potential(points, triangles, held)
        groups.append(_Pressed(triangles, None, stress, symmetric, np.empty(0, np.int32)))
    alike: dict[tuple[float, History], list[Pressure]] = {}
    for load in model.pressures:
        if load.face not in controlled:
            alike.setdefault((load.pressure, load.history), []).append(load)
    for loads in alike.values():
        triangles = np.ascontiguousarray(np.concatenate([model.mesh.face(load.face) for load in loads]))
        symmetric = surfaces.has_potential(points, triangles, held)
        groups.append(_Pressed(triangles, loads[0], stress, symmetric, np.empty(0, np.int32)))
    return groups


def _tables(triangles: Triangles) -> tuple[Array, Array, Array]:
    reference = side_tables(triangles.shape[1])
    return reference.N, reference.dN, reference.weights


def _lower(local: Array) -> Array:
    """Lower triangles of matrices, row by row."""
    rows, columns = np.tril_indices(local.shape[1])
    return np.asarray(local[:, rows, columns].ravel())


def _unknowns(triangles: Triangles) -> NDArray[np.int64]:
    return (3 * triangles[:, :, None] + np.arange(3)).reshape(len(triangles), -1)


def _add_at_nodes(out: Array, triangles: Triangles, local: Array) -> None:
    flat = triangles.ravel()
    for i in range(3):
        out[:, i] += np.bincount(flat, local[:, :, i].ravel(), minlength=len(out))
