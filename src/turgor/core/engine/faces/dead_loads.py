"""Dead loads: weight, forces and tractions, whose nodal forces do not change with the deformation."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.engine.cells.element import element_of
from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.faces import surfaces
from turgor.core.engine.faces.concentrated import line_force, point_force
from turgor.core.engine.points.point_mass import weights_of
from turgor.core.engine.points.point_unknowns import carriers_of
from turgor.core.engine.term import Configuration, Setting, Term
from turgor.core.model.history import History, share_at
from turgor.core.model.loads import Force, Gravity, Hanging, LineForce, Load, Moment, PointForce, Pressure, Traction
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class DeadTerm(Term):
    """All dead loads.

    Parameters
    ----------
    parts : sequence of (History, (n, 3) array)
        Scaled nodal forces at a share of one, those with the same history together.
    """

    external = True

    parts: Sequence[tuple[History, Array]]

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the share of each that acts."""
        out += sum(share_at(history, at.load_factor) * forces for history, forces in self.parts)


def dead_terms(setting: Setting) -> list[DeadTerm]:
    """One, or none without dead loads."""
    model, points, length, stress = setting.model, setting.points, setting.length, setting.stress
    by_history: dict[History, Array] = {}
    N = element_of(model).tables.N
    carriers = {each.point.name: each for each in carriers_of(model)}
    for load in model.loads:
        if isinstance(load, Pressure | Moment) or _follows(load):
            continue
        forces = by_history.setdefault(load.history, np.zeros_like(points))
        if isinstance(load, Traction):
            forces += _traction(points, model.mesh.face(load.face), np.asarray(load.vector) / stress)
        elif isinstance(load, Hanging):
            forces[carriers[load.point].node] += _resultant(setting, load.force)
        elif isinstance(load, Force) and load.face in carriers:
            forces[carriers[load.face].node] += _resultant(setting, load.vector)
        elif isinstance(load, PointForce | LineForce):
            mesh = model.mesh
            nodal = point_force(mesh, load) if isinstance(load, PointForce) else line_force(mesh, load)
            forces[: len(nodal)] += nodal / (stress * length**2)
        elif isinstance(load, Force):
            sides = model.mesh.face(load.face)
            forces += _traction(points, sides, _resultant(setting, load.vector) / surfaces.area(points, sides))
        elif isinstance(load, Gravity):
            density = _density(model)[:, None, None] * _acceleration(load)
            forces += _volume(setting, N, np.broadcast_to(density, (*setting.dV.shape, 3)) * length / stress)
            for each in carriers.values():
                falling = weights_of(each)[:, None] * _resultant(setting, _acceleration(load))
                forces[each.node + np.arange(4)] += falling
        else:
            where = np.einsum("qa,cai->cqi", N, model.mesh.points[model.mesh.cells])
            value = np.asarray(load.value(where.reshape(-1, 3))).reshape(where.shape)
            forces += _volume(setting, N, value * length / stress)
    return [DeadTerm(tuple(by_history.items()))] if by_history else []


def _follows(load: Load) -> bool:
    return isinstance(load, Force) and load.follower


def _resultant(setting: Setting, force: ArrayLike) -> Array:
    """Scaled share of a force [N] that the modeled part carries."""
    return np.asarray(force) / (setting.stress * setting.length**2 * setting.model.mesh.symmetry_factor)


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


def _volume(setting: Setting, N: Array, force_density: Array) -> Array:
    local = np.einsum("cq,qa,cqi->cai", setting.dV, N, force_density)
    return _sum_at_nodes(setting.model.mesh.cells, local, len(setting.points))


def _traction(points: Array, triangles: NDArray[np.int64], vector: Array) -> Array:
    reference = side_tables(triangles.shape[1])
    tangents = np.einsum("qad,fai->fqid", reference.dN, points[triangles])
    area = np.linalg.norm(np.cross(tangents[..., 0], tangents[..., 1]), axis=2) * reference.weights
    local = np.einsum("fq,qa->fa", area, reference.N)[:, :, None] * vector
    return _sum_at_nodes(triangles, local, len(points))


def _sum_at_nodes(nodes: NDArray[np.int64], local: Array, count: int) -> Array:
    flat = nodes.ravel()
    return np.stack([np.bincount(flat, local[..., i].ravel(), minlength=count) for i in range(3)], axis=1)
