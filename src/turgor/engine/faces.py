"""Terms on named faces: follower pressures and membranes."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.engine import membranes, surfaces
from turgor.engine.pattern import Pattern, locate, scatter_add
from turgor.engine.reference import side_tables
from turgor.model.loads import History, Pressure
from turgor.model.model import Model

Array = NDArray[np.float64]
Triangles = NDArray[np.int64]


@dataclass(slots=True, eq=False)
class _Pressed:
    """Faces under the same pressure: triangles, the load of one of them, scale, whether it has a potential."""

    triangles: Triangles
    load: Pressure
    stress: float
    symmetric: bool
    positions: NDArray[np.int32]

    def at(self, load_factor: float) -> float:
        """Scaled pressure at a load factor."""
        return self.load.share(load_factor) * (self.load.pressure / self.stress)


@dataclass(slots=True, eq=False)
class _Sheet:
    """A membrane: triangles, gradients, areas, scaled moduli times thickness."""

    triangles: Triangles
    gradients: Array
    areas: Array
    moduli: Array
    positions: NDArray[np.int32]


class FaceTerms:
    """Forces and tangents of pressures and membranes, in scaled units.

    Parameters
    ----------
    model : Model
    points : (n, 3) array
        Scaled reference positions.
    held : (n, 3) bool array
        Prescribed components.
    length, stress : float
        Scales.
    """

    def __init__(self, model: Model, points: Array, held: NDArray[np.bool_], length: float, stress: float) -> None:
        self._pressed = _group_pressures(model, points, held, stress)
        self._sheets = []
        for name, membrane in model.membranes.items():
            triangles = np.ascontiguousarray(model.mesh.face(name))
            gradients, areas = membranes.surface_gradients(points, triangles)
            law = membrane.material.law
            moduli = membranes.plane_stress_moduli(law) * membrane.thickness / (length * stress)  # type: ignore[arg-type]
            self._sheets.append(_Sheet(triangles, gradients, areas, moduli, np.empty(0, np.int32)))

    @property
    def symmetric(self) -> bool:
        """Whether all pressures derive from a potential."""
        return all(group.symmetric for group in self._pressed)

    def locate(self, pattern: Pattern) -> None:
        """Find where the entries of the triangles go in the tangent."""
        terms: list[_Pressed | _Sheet] = [*self._pressed, *self._sheets]
        for term in terms:
            unknowns = _unknowns(term.triangles)
            rows, columns = np.tril_indices(unknowns.shape[1])
            term.positions = locate(
                pattern.indptr, pattern.indices, unknowns[:, rows].ravel(), unknowns[:, columns].ravel()
            )

    def forces(self, position: Array, load_factor: float) -> tuple[Array, Array]:
        """Internal forces of the membranes and external forces of the pressures, (n, 3) each."""
        internal, external = np.zeros_like(position), np.zeros_like(position)
        for group in self._pressed:
            local = surfaces.pressure_forces(position, group.triangles, *_tables(group.triangles))
            _add_at_nodes(external, group.triangles, -group.at(load_factor) * local)
        for sheet, stress in zip(self._sheets, self.membrane_stresses(position), strict=True):
            local = membranes.membrane_forces(position, sheet.triangles, sheet.gradients, sheet.areas, stress)
            _add_at_nodes(internal, sheet.triangles, local)
        return internal, external

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
            strain = stress @ np.linalg.inv(sheet.moduli)
            total += 0.5 * float((sheet.areas[..., None] * stress * strain).sum())
        return total

    def add_tangents(self, data: Array, position: Array, load_factor: float, stresses: list[Array] | None) -> None:
        """Add the symmetric parts of all tangents to the lower triangle; ``stresses`` enter the geometric stiffness."""
        for group in self._pressed:
            local = surfaces.pressure_tangents(position, group.triangles, *_tables(group.triangles))
            local *= group.at(load_factor)
            local = 0.5 * (local + local.transpose(0, 2, 1))
            scatter_add(data, group.positions, _lower(local))
        if stresses is None:
            stresses = self.membrane_stresses(position)
        for sheet, stress in zip(self._sheets, stresses, strict=True):
            local = membranes.membrane_tangents(
                position, sheet.triangles, sheet.gradients, sheet.areas, sheet.moduli, stress
            )
            scatter_add(data, sheet.positions, _lower(local))

    def skew_matrix(self, position: Array, load_factor: float, size: int) -> sp.csc_matrix | None:
        """Skew part of the tangents of pressures without potential; None where there are none."""
        total: sp.csc_matrix | None = None
        for group in self._pressed:
            if group.symmetric:
                continue
            local = surfaces.pressure_tangents(position, group.triangles, *_tables(group.triangles))
            local *= group.at(load_factor)
            local = 0.5 * (local - local.transpose(0, 2, 1))
            unknowns = _unknowns(group.triangles)
            count = unknowns.shape[1]
            rows = np.repeat(unknowns, count, axis=1).ravel()
            columns = np.tile(unknowns, (1, count)).ravel()
            part = sp.csc_matrix((local.ravel(), (rows, columns)), shape=(size, size))
            total = part if total is None else (total + part).tocsc()
        return total


def _group_pressures(model: Model, points: Array, held: NDArray[np.bool_], stress: float) -> list[_Pressed]:
    """Join faces under equal pressure at all times: together they may be closed where each alone is open."""
    alike: dict[tuple[float, History], list[Pressure]] = {}
    for load in model.pressures:
        alike.setdefault((load.pressure, load.history), []).append(load)
    groups = []
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
