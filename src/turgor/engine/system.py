"""System: the discrete equations of a model, residual and tangent.

Inside, lengths are divided by the mean edge length and stresses by the stiffest rubber's shear modulus, so that the
unknowns and the entries of the tangent are of the order of one whatever the units and the size of the actuator.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.engine import kernels
from turgor.engine.additions import Addition
from turgor.engine.boundary import held_components
from turgor.engine.cell_materials import CellMaterials, Isochoric
from turgor.engine.contact.couplings import Layout
from turgor.engine.contact.part import Look
from turgor.engine.contact.surface import whole_surface
from turgor.engine.contact.terms import Contacts, ContactTerms
from turgor.engine.dead_loads import dead_forces
from turgor.engine.element import element_of
from turgor.engine.faces import FaceStresses, FaceTerms
from turgor.engine.memory import Memory
from turgor.engine.pattern import Pattern, build_pattern, locate, scatter_add
from turgor.errors import TurgorError
from turgor.model.drive import extremes
from turgor.model.model import Model

Array = NDArray[np.float64]

#: Relative compressibility added to the tangent alone: keeps it regular where the mean stress is undetermined.
REGULARIZATION = 1e-9

#: Entries of cell matrices held at once when the tangent is formed; bounds the memory.
CHUNK_ENTRIES = 2_500_000


@dataclass(frozen=True, slots=True, eq=False)
class Stresses:
    """Second Piola–Kirchhoff stresses that enter the geometric stiffness, scaled.

    Parameters
    ----------
    cells : (c, q, 6) array
    faces : FaceStresses
        Those of membranes and fibers.
    """

    cells: Array
    faces: FaceStresses

    @staticmethod
    def combine(parts: "Sequence[tuple[float, Stresses]]") -> "Stresses":
        """Weighted sum, for extrapolation."""
        cells = sum(weight * part.cells for weight, part in parts)
        return Stresses(np.asarray(cells), FaceStresses.combine([(weight, part.faces) for weight, part in parts]))


@dataclass(frozen=True, slots=True, eq=False)
class Evaluation:
    """The equations at one point: what the residual computed and the tangent needs again.

    Parameters
    ----------
    unknowns : (size,) array
        Scaled displacement, node by node along the directions of each, then scaled mean stress.
    load_factor : float
    residual : (size,) array
        Internal minus external force; then the violation of the volume constraint.
    external : (size,) array
        External force alone.
    isochoric : Isochoric
        What the laws say at all points, scaled.
    contacts : Contacts
        What touches.
    contact_force : float
        Size of the contact forces on the free nodes.
    sought : (k,) array or None
        Scaled pressures of the controlled faces.
    """

    unknowns: Array
    load_factor: float
    residual: Array
    external: Array
    isochoric: Isochoric
    contacts: Contacts
    contact_force: float
    sought: Array | None = None


class System:
    """Residual and tangent of a model's equilibrium equations.

    Parameters
    ----------
    model : Model
        The question.
    controlled : tuple of str
        Faces whose pressure is sought: `evaluate` is told it.

    Attributes
    ----------
    size : int
        Number of unknowns, prescribed ones included.
    held : (size,) bool array
        Which unknowns are prescribed.
    length, stress : float [m], [Pa]
        Scales of the unknowns.
    mean_stress_volumes : (m,) array
        Scaled volume that belongs to each mean stress.
    contact : ContactTerms
        What may touch what.
    full_force : float
        Scaled size of the loads' forces on the free nodes at their largest, at rest: a measure of what is small.
    addition : Addition or None
        Forces besides those of the model, such as inertia; a procedure puts them here.
    """

    addition: Addition | None = None

    def __init__(self, model: Model, controlled: tuple[str, ...] = ()) -> None:
        mesh = model.mesh
        self.model = model
        self.controlled = controlled
        self.node_count = len(mesh.points)
        self.length = _mean_edge(mesh.points, mesh.cells)
        self.stress = max(m.law.shear_modulus for m in model.region_materials.values())
        self.points = np.ascontiguousarray(mesh.points / self.length)
        self.cells = np.ascontiguousarray(mesh.cells)
        self.element = element_of(model)
        r = self.element.tables
        self.Jinv, self.dV = kernels.reference_geometry(self.element.shape, self.points, self.cells, r.dN, r.weights)
        if not (self.dV > 0).all():
            bad = int((self.dV <= 0).any(axis=1).sum())
            raise TurgorError(f"mesh '{mesh.name}': {bad} cells are inside out; refine or straighten the mesh.")
        modes = len(self.element.modes)
        self.mean_stress_volumes = np.bincount(
            self.element.mean.ravel(), (self.dV @ r.M[:, :modes]).ravel(), minlength=self.element.mean_count
        )
        self.materials = CellMaterials(model, self.stress, len(r.weights))
        chosen = self.materials.gradient_cells
        self._gradient_Jinv = self.Jinv if len(chosen) == len(self.cells) else self.Jinv[chosen]
        supports = held_components(model)
        self._supports = supports
        self._frames = supports.frames
        self.contact = self._contact_terms()
        bodies = self.contact.bodies.held
        self.held = np.concatenate([supports.mask.ravel(), np.zeros(self.element.mean_count, dtype=bool), bodies])
        self.size = len(self.held)
        self.faces = FaceTerms(model, self.points, supports.along_axes, self.length, self.stress, controlled)
        self._dead = dead_forces(model, self.points, self.dV, r.N, (self.length, self.stress))
        self.full_force = max(self._applied(factor) for factor in extremes(model))
        self._cell_unknowns = _cell_unknowns(self.cells, self.element.mean, self.node_count)
        self._build_pattern()

    def _contact_terms(self) -> ContactTerms:
        scales = (self.length, self.stress)
        first = 3 * self.node_count + self.element.mean_count
        surface = whole_surface(self.model, self.points, self.dV.sum(axis=1), self.stress)
        return ContactTerms(self.model, surface, self.points, scales, first)

    def _applied(self, load_factor: float) -> float:
        """Size of the loads' forces on the free nodes at rest; pressures that are sought count as the modulus."""
        _, external = self.faces.forces(self.points, load_factor, np.ones(len(self.controlled)))
        forces = self._frames.to_local(external + self._dead.at(load_factor))
        return float(np.linalg.norm(forces.ravel()[~self.held[: 3 * self.node_count]]))

    def _build_pattern(self) -> None:
        unknowns = self._cell_unknowns
        base = build_pattern(unknowns, self.size, *self.faces.couplings)
        rows, columns = np.tril_indices(unknowns.shape[1])
        self._positions = np.empty((len(unknowns), len(rows)), dtype=np.int32)
        for chunk in self._chunks():
            self._positions[chunk] = locate(
                base.indptr,
                base.indices,
                unknowns[chunk][:, rows].ravel(),
                unknowns[chunk][:, columns].ravel(),
            ).reshape(-1, len(rows))
        self.faces.locate(base)
        self.layout = Layout(base, self.held)

    @property
    def pattern(self) -> Pattern:
        """The sparsity of the tangent at present; contact changes it."""
        return self.layout.pattern

    def _chunks(self) -> list[slice]:
        cells = max(1, CHUNK_ENTRIES // self._positions.shape[1])
        return [slice(start, start + cells) for start in range(0, len(self.cells), cells)]

    def split(self, unknowns: Array) -> tuple[Array, Array]:
        """Scaled displacement (n, 3) and scaled mean stress (m,)."""
        nodes = 3 * self.node_count
        components = unknowns[:nodes].reshape(-1, 3)
        return self._frames.to_global(components), unknowns[nodes : nodes + self.element.mean_count]

    def springs(self, unknowns: Array) -> Array:
        """Scaled displacements (b, 3) of sprung obstacles from their places."""
        return unknowns[3 * self.node_count + self.element.mean_count :].reshape(-1, 3)

    def joined(self, by_node: Array) -> Array:
        """Forces (n, 3) or their like as a vector (size,) along the directions of each node; none on mean stresses."""
        out = np.zeros(self.size)
        out[: 3 * self.node_count] = self._frames.to_local(by_node).ravel()
        return out

    def external(self, unknowns: Array, load_factor: float, sought: Array | None = None) -> Array:
        """Scaled external forces (size,) on a body that is held still, whatever is inside out."""
        _, forces = self.faces.forces(self.points + self.split(unknowns)[0], load_factor, sought)
        return self.joined(forces + self._dead.at(load_factor))

    def physical(self, unknowns: Array) -> tuple[Array, Array]:
        """Displacement (n, 3) [m] and mean stress (m,) [Pa]."""
        u, p = self.split(unknowns)
        return u * self.length, p * self.stress

    def unknowns(self, displacement: Array, mean_stress: Array) -> Array:
        """Scaled unknowns (size,) of a displacement (n, 3) [m] and mean stress (m,) [Pa]; inverse of `physical`."""
        components = self._frames.to_local(displacement / self.length)
        return np.concatenate([components.ravel(), mean_stress / self.stress])

    @property
    def cell_size(self) -> int:
        """Unknowns of a cell, displacements node by node first."""
        return self._cell_unknowns.shape[1]

    def scattered(self, entries: NDArray[np.int64], values: Array) -> Array:
        """Sum chosen entries (k,) of the lower triangles of cell matrices, values (c, k), into that of the tangent."""
        data = np.zeros(len(self.layout.base.indices))
        for chunk in self._chunks():
            scatter_add(data, self._positions[chunk][:, entries].ravel(), values[chunk].ravel())
        self._frames.turn_tangent(self.layout.base, data, self.node_count)
        return data

    def gathered(self, by_cell: Array) -> Array:
        """Sum nodal forces of the cells (c, 3 nodes) into forces along the directions of the nodes (size,)."""
        places = self._cell_unknowns[:, : by_cell.shape[1]]
        out: Array = np.bincount(places.ravel(), by_cell.ravel(), minlength=self.size).astype(np.float64)
        components = out[: 3 * self.node_count].reshape(-1, 3)
        out[: 3 * self.node_count] = self._frames.to_local(components).ravel()
        return out

    def prescribed(self, load_factor: float) -> Array:
        """Scaled values of the held unknowns at a load factor."""
        values = np.zeros(self.size)
        moved = self._supports.values(self.model.mesh.points, load_factor) / self.length
        values[: 3 * self.node_count] = moved.ravel()
        return values[self.held]

    def evaluate(
        self,
        unknowns: Array,
        load_factor: float,
        sought: Array | None = None,
        known: Contacts | None = None,
        how: Look = Look.FOLLOW,
    ) -> Evaluation | None:
        """Residual at a point; None where a cell is turned inside out.

        ``sought`` are scaled pressures of the controlled faces; `ContactTerms.look` explains ``known`` and ``how``.
        """
        u, p = self.split(unknowns)
        e, r = self.element, self.element.tables
        I1, I2, _ = kernels.kinematics(e.shape, self.cells, u, r.dN, self.Jinv)
        if not np.isfinite(I1).all():
            return None
        rubber = self.materials
        F = kernels.deformation_gradients(e.shape, self.cells[rubber.gradient_cells], u, r.dN, self._gradient_Jinv)
        laws = rubber.isochoric(I1, I2, F)
        by_cell = kernels.residual(
            e.shape,
            e.modes,
            self.cells,
            e.mean,
            u,
            p,
            r.dN,
            r.M,
            self.Jinv,
            self.dV,
            laws.derivatives[0],
            laws.derivatives[1],
            rubber.rows,
            laws.stress,
            rubber.compliance,
        )
        internal: Array = np.bincount(self._cell_unknowns.ravel(), by_cell.ravel(), minlength=self.size).astype(float)
        position = self.points + u
        forces, external = self.faces.forces(position, load_factor, sought)
        springs = self.springs(unknowns)
        contacts = self.contact.look(position, springs, load_factor, known, how)
        pressing, bodies = self.contact.forces(contacts, springs)
        by_node = internal[: 3 * self.node_count].reshape(-1, 3) + forces + pressing
        internal[self.size - bodies.size :] = bodies.ravel()
        internal[: 3 * self.node_count] = self._frames.to_local(by_node).ravel()
        outer = np.zeros(self.size)
        outer[: 3 * self.node_count] = self._frames.to_local(external + self._dead.at(load_factor)).ravel()
        if self.addition is not None:
            internal += self.addition.forces(unknowns)
        total = internal - outer
        if not np.isfinite(total).all():
            return None
        free = ~self.held[: 3 * self.node_count]
        pressed = float(np.linalg.norm(self._frames.to_local(pressing).ravel()[free]))
        return Evaluation(unknowns, load_factor, total, outer, laws, contacts, pressed, sought)

    def remembered(self, at: Evaluation) -> Memory | None:
        """What the rubber remembers at the end of the step that has begun, None where nothing relaxes or softens.

        Put it into ``materials.memory`` to accept the step; `CellMaterials.begin_step` begins one.
        """
        if not self.materials.remembers:
            return None
        e = self.element
        u = self.split(at.unknowns)[0]
        return self.materials.remembered(kernels.deformation_gradients(e.shape, self.cells, u, e.tables.dN, self.Jinv))

    def tangent_data(self, at: Evaluation, geometric: Stresses | None = None) -> Array:
        """Values of the symmetric tangent's lower triangle, supports not yet applied."""
        u, p = self.split(at.unknowns)
        e, r = self.element, self.element.tables
        compliance = np.maximum(self.materials.compliance, REGULARIZATION)
        data = np.zeros(len(self.layout.base.indices))
        nothing = np.zeros((1, 1, 6))
        for chunk in self._chunks():
            packed = kernels.tangent(
                e.shape,
                e.modes,
                self.cells[chunk],
                e.mean[chunk],
                u,
                p,
                r.dN,
                r.M,
                self.Jinv[chunk],
                self.dV[chunk],
                np.ascontiguousarray(at.isochoric.derivatives[:, chunk]),
                self.materials.rows[chunk],
                at.isochoric.stress,
                at.isochoric.tangent,
                compliance[chunk],
                nothing if geometric is None else geometric.cells[chunk],
                geometric is not None,
            )
            scatter_add(data, self._positions[chunk].ravel(), packed.ravel())
        given = None if geometric is None else geometric.faces
        self.faces.add_tangents(data, self.points + u, at.load_factor, given, at.sought)
        self.contact.prepare(self.layout, at.contacts)
        data = self.layout.spread(data)
        self.contact.add_tangents(data, self.layout, at.contacts)
        self._frames.turn_tangent(self.pattern, data, self.node_count)
        if self.addition is not None:
            data += self.layout.spread(self.addition.data(at.unknowns))
        return data

    def skew_matrix(self, at: Evaluation) -> sp.csc_matrix | None:
        """Skew part of the tangent from pressure on open surfaces; None where every pressure has a potential."""
        u, _ = self.split(at.unknowns)
        matrix = self.faces.skew_matrix(self.points + u, at.load_factor, self.size, at.sought)
        return None if matrix is None else self._frames.turn_matrix(matrix)

    def apply_supports(self, data: Array) -> None:
        """Replace the equations of held unknowns by identities, in place."""
        self.layout.apply_supports(data)

    def stresses(self, at: Evaluation, update: Array | None = None) -> Stresses:
        """Stresses at an evaluation, linearized for an update where one is given; see `kernels.extrapolated_stress`."""
        u, p = self.split(at.unknowns)
        du, dp = self.split(np.zeros(self.size) if update is None else update)
        e, r = self.element, self.element.tables
        laws = at.isochoric
        cells = kernels.extrapolated_stress(
            e.shape,
            e.modes,
            self.cells,
            e.mean,
            u,
            p,
            du,
            dp,
            r.dN,
            r.M,
            self.Jinv,
            laws.derivatives,
            self.materials.rows,
            laws.stress,
            laws.tangent,
            self.materials.compliance,
        )
        return Stresses(cells, self.faces.stresses(self.points + u, du))

    def residual(self, unknowns: Array, load_factor: float) -> Array:
        """Residual (size,) at a point, for checks of the tangent."""
        evaluation = self.evaluate(unknowns, load_factor)
        if evaluation is None:
            raise TurgorError("a cell is turned inside out at these unknowns.")
        return evaluation.residual

    def tangent(self, unknowns: Array, load_factor: float) -> sp.csc_matrix:
        """Full tangent (size, size) at a point without supports, skew part included."""
        evaluation = self.evaluate(unknowns, load_factor)
        if evaluation is None:
            raise TurgorError("a cell is turned inside out at these unknowns.")
        data = self.tangent_data(evaluation)  # first: contact may change the pattern
        matrix = self.pattern.full(data)
        skew = self.skew_matrix(evaluation)
        return matrix if skew is None else (matrix + skew).tocsc()


def _mean_edge(points: Array, cells: NDArray[np.int64]) -> float:
    return float(np.linalg.norm(points[cells[:, 0]] - points[cells[:, 1]], axis=1).mean())


def _cell_unknowns(cells: NDArray[np.int64], mean: NDArray[np.int64], node_count: int) -> NDArray[np.int64]:
    displacement = (3 * cells[:, :, None] + np.arange(3)).reshape(len(cells), -1)
    return np.ascontiguousarray(np.hstack([displacement, 3 * node_count + mean]))
