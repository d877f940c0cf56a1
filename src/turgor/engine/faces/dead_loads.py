"""Dead loads: weight, body forces and tractions, whose nodal forces do not change with the deformation."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.engine.cells.reference import side_tables
from turgor.errors import TurgorError
from turgor.model.history import History, share_at
from turgor.model.loads import BodyForce, Gravity, Traction
from turgor.model.model import Model

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class DeadForces:
    """Scaled nodal forces (n, 3) of the dead loads, those with the same history together."""

    parts: Sequence[tuple[History, Array]]
    rest: Array

    def at(self, load_factor: float) -> Array:
        """Sum (n, 3) at a load factor."""
        return self.rest + sum(share_at(history, load_factor) * forces for history, forces in self.parts)


def dead_forces(model: Model, points: Array, dV: Array, N: Array, scales: tuple[float, float]) -> DeadForces:
    """Scaled nodal forces of the dead loads.

    Points and volumes ``dV`` (c, q) come scaled by the first of the two scales, length and stress; ``N`` (q, n) are the
    shape functions at the integration points.
    """
    length, stress = scales
    by_history: dict[History, Array] = {}
    for load in model.loads:
        if not isinstance(load, Traction | Gravity | BodyForce):
            continue
        forces = by_history.setdefault(load.history, np.zeros_like(points))
        if isinstance(load, Traction):
            forces += _traction(points, model.mesh.face(load.face), np.asarray(load.vector) / stress)
        elif isinstance(load, Gravity):
            density = _density(model)[:, None, None] * _acceleration(load)
            forces += _volume(model, points, dV, N, np.broadcast_to(density, (*dV.shape, 3)) * length / stress)
        else:
            where = np.einsum("qa,cai->cqi", N, model.mesh.points[model.mesh.cells])
            value = np.asarray(load.value(where.reshape(-1, 3))).reshape(where.shape)
            forces += _volume(model, points, dV, N, value * length / stress)
    return DeadForces(tuple(by_history.items()), np.zeros_like(points))


def _acceleration(load: Gravity) -> Array:
    direction = np.asarray(load.direction, dtype=np.float64)
    size = float(np.linalg.norm(direction))
    if not size > 0:
        raise TurgorError("gravity: the direction is a zero vector; give for example (0, 0, -1).")
    return direction / size * load.acceleration


def _density(model: Model) -> Array:
    density = np.empty(len(model.mesh.cells))
    for name, material in model.region_materials.items():
        density[model.mesh.regions[name]] = material.density
    return density


def _volume(model: Model, points: Array, dV: Array, N: Array, force_density: Array) -> Array:
    local = np.einsum("cq,qa,cqi->cai", dV, N, force_density)
    return _sum_at_nodes(model.mesh.cells, local, len(points))


def _traction(points: Array, triangles: NDArray[np.int64], vector: Array) -> Array:
    reference = side_tables(triangles.shape[1])
    tangents = np.einsum("qad,fai->fqid", reference.dN, points[triangles])
    area = np.linalg.norm(np.cross(tangents[..., 0], tangents[..., 1]), axis=2) * reference.weights
    local = np.einsum("fq,qa->fa", area, reference.N)[:, :, None] * vector
    return _sum_at_nodes(triangles, local, len(points))


def _sum_at_nodes(nodes: NDArray[np.int64], local: Array, count: int) -> Array:
    flat = nodes.ravel()
    return np.stack([np.bincount(flat, local[..., i].ravel(), minlength=count) for i in range(3)], axis=1)
