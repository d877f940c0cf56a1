"""Dead loads: weight, forces and tractions, whose nodal forces do not change with the deformation."""

from collections.abc import Callable, Sequence
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
from turgor.core.meshing.nodes.node_shares import node_shares
from turgor.core.model.history import History, share_at
from turgor.core.model.loads.load import Vector
from turgor.core.model.model import Model
from turgor.core.model.places import NodesAt

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
    by_history: dict[History, Array] = {}
    nodal = ScaledNodalForces(setting)
    for load in setting.model.loads:
        forces = load.dead_forces(nodal)
        if forces is not None:
            by_history[load.history] = by_history.get(load.history, 0.0) + forces
    return [DeadTerm(tuple(by_history.items()))] if by_history else []


class ScaledNodalForces:
    """Nodal forces in the units of the equations; see `turgor.core.model.loads.load.NodalForces`.

    Parameters
    ----------
    setting : Setting
    """

    def __init__(self, setting: Setting) -> None:
        self.setting = setting
        self.carriers = {each.point.name: each for each in carriers_of(setting.model)}

    def on_face(self, face: str, traction: ArrayLike) -> Array:
        """Forces of a constant traction (3,) [Pa] on the reference area of a face."""
        return self._spread(self._sides(face), np.asarray(traction) / self.setting.stress)

    def of_total(self, place: str | NodesAt, force: ArrayLike) -> Array:
        """Forces of a total (3,) [N] on the whole actuator, spread over a face or place, or at a reference point."""
        if isinstance(place, NodesAt):
            mesh, forces = self.setting.model.mesh, np.zeros_like(self.setting.points)
            forces[: len(mesh.points)] = np.outer(node_shares(mesh, place.nodes(mesh)), self._of_part(force))
            return forces
        if place in self.carriers:
            forces = np.zeros_like(self.setting.points)
            forces[self.carriers[place].node] = self._of_part(force)
            return forces
        sides = self._sides(place)
        return self._spread(sides, self._of_part(force) / surfaces.area(self.setting.points, sides))

    def per_volume(self, value: Callable[[Array], Array]) -> Array:
        """Forces of ``value(points) -> (n, 3) force per reference volume [N/m³]``."""
        element = element_of(self.setting.model)
        where = np.einsum("qa,cai->cqi", element.tables.N, self.setting.model.mesh.points[element.cells])
        return self._in_cells(np.asarray(value(where.reshape(-1, 3))).reshape(where.shape))

    def per_mass(self, value: Callable[[Array], Array]) -> Array:
        """Forces of ``value(points) -> (n, 3) acceleration [m/s²]`` of all regions and sheets."""
        model = self.setting.model
        density = np.repeat(cell_density(model), self.setting.dV.shape[1])[:, None]
        forces = self.per_volume(lambda points: density * np.asarray(value(points)))
        for name, mass in model.sheet_masses.items():
            sides = self._sides(name)
            where = np.einsum("qa,fai->fqi", side_tables(sides.shape[1]).N, model.mesh.points[sides])
            there = np.asarray(value(where.reshape(-1, 3))).reshape(where.shape)
            forces += self._spread(sides, mass / self.setting.stress * there)
        return forces

    def of_weight(self, acceleration: ArrayLike) -> Array:
        """Forces of one acceleration (3,) [m/s²] of all regions, sheets and reference points."""
        per_cell = cell_density(self.setting.model)[:, None, None] * np.asarray(acceleration)
        forces = self._in_cells(np.broadcast_to(per_cell, (*self.setting.dV.shape, 3)))
        for name, mass in self.setting.model.sheet_masses.items():
            forces += self.on_face(name, mass * np.asarray(acceleration))
        for each in self.carriers.values():
            forces[each.node + np.arange(4)] += weights_of(each)[:, None] * self._of_part(acceleration)
        return forces

    def at_point(self, at: Vector, force: Vector) -> Array:
        """Forces of a force (3,) [N] at a point of the surface."""
        return self._on_mesh(point_force(self.setting.model.mesh, at, force))

    def along_edge(self, faces: tuple[str, str], force: Vector) -> Array:
        """Forces of a force per length (3,) [N/m] along the edge between two faces."""
        return self._on_mesh(line_force(self.setting.model.mesh, faces, force))

    def _sides(self, face: str) -> NDArray[np.int64]:
        return self.setting.model.mesh.face(face)

    def _of_part(self, force: ArrayLike) -> Array:
        """Scaled share of a force [N] that the modeled part carries."""
        whole = self.setting.stress * self.setting.length**2 * self.setting.model.mesh.symmetry_factor
        return np.asarray(force) / whole

    def _on_mesh(self, forces: Array) -> Array:
        """Scaled forces of those on the nodes of the mesh [N]."""
        out = np.zeros_like(self.setting.points)
        out[: len(forces)] = forces / (self.setting.stress * self.setting.length**2)
        return out

    def _in_cells(self, per_volume: Array) -> Array:
        """Scaled forces of a force per volume (c, q, 3) [N/m³] at the quadrature points."""
        setting, element = self.setting, element_of(self.setting.model)
        scaled = per_volume * setting.length / setting.stress
        local = np.einsum("cq,qa,cqi->cai", setting.dV, element.tables.N, scaled)
        return _sum_at_nodes(element.cells, local, len(setting.points))

    def _spread(self, sides: NDArray[np.int64], vector: Array) -> Array:
        """Forces of a scaled traction (3,), or of those (f, q, 3) at the quadrature points."""
        points, reference = self.setting.points, side_tables(sides.shape[1])
        tangents = np.einsum("qad,fai->fqid", reference.dN, points[sides])
        area = np.linalg.norm(np.cross(tangents[..., 0], tangents[..., 1]), axis=2) * reference.weights
        if vector.ndim == 1:  # the same at all points: forces as symmetric as the sides, to the last digit
            local = np.einsum("fq,qa->fa", area, reference.N)[:, :, None] * vector
        else:
            local = np.einsum("fq,qa,fqi->fai", area, reference.N, vector)
        return _sum_at_nodes(sides, local, len(points))


def cell_density(model: Model) -> Array:
    """Density of each cell, (c,) [kg/m³]."""
    density = np.empty(len(model.mesh.cells))
    for name, material in model.region_materials.items():
        density[model.mesh.regions[name]] = material.density
    return density


def _sum_at_nodes(nodes: NDArray[np.int64], local: Array, count: int) -> Array:
    flat = nodes.ravel()
    parts = [np.bincount(flat, local[..., i].ravel(), minlength=count) for i in range(3)]
    return np.stack(parts, axis=1).astype(np.float64)  # without sides the sums are integers
