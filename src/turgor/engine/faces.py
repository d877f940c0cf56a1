"""Terms on named faces: follower pressures and membranes."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.engine import membranes, surfaces
from turgor.engine.pattern import Pattern, locate, scatter_add
from turgor.engine.reference import SURFACE_QUADRATURE_DEGREE, reference_cell
from turgor.model.model import Model

Array = NDArray[np.float64]
Triangles = NDArray[np.int64]
_LOWER = np.tril_indices(18)


@dataclass(slots=True, eq=False)
class _Pressed:
    """Faces under the same pressure: triangles, scaled pressure, whether the load has a potential."""

    triangles: Triangles
    pressure: float
    symmetric: bool
    positions: NDArray[np.int32]


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
            term.positions = locate(
                pattern.indptr, pattern.indices, unknowns[:, _LOWER[0]].ravel(), unknowns[:, _LOWER[1]].ravel()
            )

    def forces(self, position: Array, load_factor: float) -> tuple[Array, Array]:
        """Internal forces of the membranes and external forces of the pressures, (n, 3) each."""
        internal, external = np.zeros_like(position), np.zeros_like(position)
        for group in self._pressed:
            local = surfaces.pressure_forces(position, group.triangles, *_tables())
            _add_at_nodes(external, group.triangles, -load_factor * group.pressure * local)
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
            local = surfaces.pressure_tangents(position, group.triangles, *_tables())
            local *= load_factor * group.pressure
            local = 0.5 * (local + local.transpose(0, 2, 1))
            scatter_add(data, group.positions, local[:, _LOWER[0], _LOWER[1]].ravel())
        if stresses is None:
            stresses = self.membrane_stresses(position)
        for sheet, stress in zip(self._sheets, stresses, strict=True):
            local = membranes.membrane_tangents(
                position, sheet.triangles, sheet.gradients, sheet.areas, sheet.moduli, stress
            )
            scatter_add(data, sheet.positions, local[:, _LOWER[0], _LOWER[1]].ravel())

    def skew_matrix(self, position: Array, load_factor: float, size: int) -> sp.csc_matrix | None:
        """Skew part of the tangents of pressures without potential; None where there are none."""
        total: sp.csc_matrix | None = None
        for group in self._pressed:
            if group.symmetric:
                continue
            local = surfaces.pressure_tangents(position, group.triangles, *_tables())
            local *= load_factor * group.pressure
            local = 0.5 * (local - local.transpose(0, 2, 1))
            unknowns = _unknowns(group.triangles)
            rows = np.repeat(unknowns, 18, axis=1).ravel()
            columns = np.tile(unknowns, (1, 18)).ravel()
            part = sp.csc_matrix((local.ravel(), (rows, columns)), shape=(size, size))
            total = part if total is None else (total + part).tocsc()
        return total


def _group_pressures(model: Model, points: Array, held: NDArray[np.bool_], stress: float) -> list[_Pressed]:
    """Join faces under equal pressure: together they may be closed where each alone is open."""
    by_value: dict[float, list[Triangles]] = {}
    for load in model.pressures:
        by_value.setdefault(load.pressure, []).append(model.mesh.face(load.face))
    groups = []
    for value, parts in by_value.items():
        triangles = np.ascontiguousarray(np.concatenate(parts))
        symmetric = surfaces.has_potential(points, triangles, held)
        groups.append(_Pressed(triangles, value / stress, symmetric, np.empty(0, np.int32)))
    return groups


def _tables() -> tuple[Array, Array, Array]:
    reference = reference_cell(2, SURFACE_QUADRATURE_DEGREE)
    return reference.N, reference.dN, reference.weights


def _unknowns(triangles: Triangles) -> NDArray[np.int64]:
    return (3 * triangles[:, :, None] + np.arange(3)).reshape(len(triangles), 18)


def _add_at_nodes(out: Array, triangles: Triangles, local: Array) -> None:
    flat = triangles.ravel()
    for i in range(3):
        out[:, i] += np.bincount(flat, local[:, :, i].ravel(), minlength=len(out))
