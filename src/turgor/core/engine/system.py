"""System: the discrete equilibrium equations of a model, with their residual and tangent.

Inside, lengths are divided by the mean edge length and stresses by the stiffest rubber's shear modulus, so that the
unknowns and the entries of the tangent are of the order of one whatever the units and the size of the actuator.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.algebra.additions import Addition
from turgor.core.engine.algebra.boundary import prescribed_components
from turgor.core.engine.algebra.pattern import Pattern, build_pattern, locate, scatter_add
from turgor.core.engine.cells.cell_terms import CellTerms
from turgor.core.engine.cells.internal_variables import History, Memory, bonds_of, friction_of, joined_memory
from turgor.core.engine.cells.states.body_states import has_states
from turgor.core.engine.compiled import later
from turgor.core.engine.contact.couplings import Layout
from turgor.core.engine.contact.films import film_surface
from turgor.core.engine.contact.part import SearchMode
from turgor.core.engine.contact.surface import whole_surface
from turgor.core.engine.contact.terms import ContactMemory, Contacts, ContactTerms
from turgor.core.engine.evaluation import (
    Evaluation as Evaluation,  # what is handed out by this class comes from here, too
)
from turgor.core.engine.evaluation import Stresses as Stresses
from turgor.core.engine.fibers.thread_rest import threads_have_states
from turgor.core.engine.points.motion import PointMotion, carrier_displacement, carrier_velocity
from turgor.core.engine.points.point_unknowns import with_carrier_points
from turgor.core.engine.term import Configuration, Setting, displacements, lower
from turgor.core.engine.terms import Terms
from turgor.core.engine.ties import with_equations, with_middles
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.drive import extremes
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: Scaled stiffness and compliance that make the equations of reference points definite for the factorization.
DEFINITE = 1e-7


class System:
    """Residual and tangent of a model's equilibrium equations.

    Parameters
    ----------
    model : Model
        The question.
    controlled : tuple of str
        Faces whose pressure is an unknown, given to `evaluate`.
    like : System, optional
        One of a model that differs a little, whose scales are taken: the unknowns of both mean the same then.

    Attributes
    ----------
    size : int
        Number of degrees of freedom (unknowns), prescribed ones included.
    prescribed : (size,) bool array
        Which unknowns are prescribed.
    node_count : int
        Nodes of the mesh, and after them those of the reference points (``carriers``).
    rest, points : (n + e, 3) array
        Their positions at rest, in meters and scaled.
    moving : (size,) bool array
        Which unknowns are displacements: all of nodes but the ``multipliers`` of reference points.
    constraint_count : int
        Multipliers that are free, mean stresses among them: negative pivots of a stable tangent.
    length, stress : float [m], [Pa]
        Scales of the unknowns.
    rubber : CellTerms
        What the cells add; its ``cells``, ``element``, ``Jinv``, ``dV``, ``materials`` and ``mean_stress_volumes`` are
        attributes of the system, too.
    terms : Terms
        What loads, membranes and fibers add.
    contact : ContactTerms
        What may touch what.
    full_force : float
        Scaled size of the loads' forces on the free nodes at their largest, at rest: a measure of what is small.
    """

    def __init__(self, model: Model, controlled: tuple[str, ...] = (), like: "System | None" = None) -> None:
        mesh = model.mesh
        self.model = model
        self.controlled = controlled
        self.length: float = _mean_edge(mesh) if like is None else like.length
        self.stress_scale: float = _stiffest(model, self.length) if like is None else like.stress_scale
        supports = with_equations(with_middles(prescribed_components(model), mesh), model)
        self._supports, self._frames, self._ties = supports, supports.frames, supports.ties
        self.carriers = supports.carriers
        self.rest = with_carrier_points(mesh.points, self.carriers)
        self.points = np.ascontiguousarray(self.rest / self.length)
        self.node_count = len(self.points)
        self.rubber = CellTerms(model, self.points, self.length, self.stress_scale)
        self.cells, self.element, self.materials = self.rubber.cells, self.rubber.element, self.rubber.materials
        self.Jinv, self.dV = self.rubber.Jinv, self.rubber.dV
        self.mean_stress_volumes = self.rubber.mean_stress_volumes
        self.contact: ContactTerms = self._contact_terms(None if like is None else like.contact)
        bodies = self.contact.bodies.prescribed
        unused = np.ones(self.element.mean_count, dtype=bool)
        unused[self.element.mean] = False
        self.prescribed = np.concatenate([supports.mask.ravel(), unused, bodies])
        self.size = len(self.prescribed)
        self.multipliers = self._multipliers()
        self.moving = np.arange(self.size) < 3 * self.node_count
        self.moving[self.multipliers] = False
        self.constraint_count = int((~unused).sum() + (~self.prescribed[self.multipliers]).sum())
        scales, along_axes = (self.length, self.stress_scale), supports.along_axes
        self.terms = Terms(Setting(model, self.points, along_axes, self.dV, *scales, controlled))
        self.full_force = max(self._applied(factor) for factor in extremes(model))

    def _multipliers(self) -> NDArray[np.int64]:
        """Unknowns of the multipliers of reference points."""
        nodes = [each.multipliers for each in self.carriers]
        return displacements(np.concatenate([np.zeros(0, dtype=np.int64), *nodes])[None])[0]

    def _contact_terms(self, like: ContactTerms | None) -> ContactTerms:
        scales = (self.length, self.stress_scale)
        first = 3 * self.node_count + self.element.mean_count
        if len(self.model.mesh.cells):
            surface = whole_surface(self.model, self.points, self.dV.sum(axis=1), self.stress_scale)
        else:
            surface = film_surface(self.model, self.points, self.stress_scale)
        return ContactTerms(self.model, surface, self.points, scales, first, like)

    def _applied(self, load_factor: float) -> float:
        """Size of the loads' forces on the free nodes at rest; unknown pressures count as the modulus."""
        _, external = self.terms.forces(Configuration(self.points, load_factor, np.ones(len(self.controlled))))
        by_states = self.state_forces(np.zeros(self.size), load_factor) if self.has_states else 0.0
        return float(np.linalg.norm((self.joined(external) - by_states)[~self.prescribed]))

    @property
    def has_states(self) -> bool:
        """Whether a load changes the stress-free configuration or the stiffness of a body or a winding."""
        return has_states(self.model) or threads_have_states(self.model)

    def state_forces(self, unknowns: Array, load_factor: float) -> Array:
        """Scaled internal forces (size,) with the states of bodies and windings at a load factor, without memory."""
        (u, p), rubber = self.split(unknowns), self.rubber.at(load_factor)
        laws = rubber.laws(u, self.materials.rest)
        if laws is None:
            raise TurgorError("a cell is turned inside out at these unknowns.")
        by_terms, _ = self.terms.forces(Configuration(self.points + u, load_factor))
        return self.gathered(rubber.forces(u, p, laws)) + self.joined(by_terms)

    @cached_property
    def layout(self) -> Layout:
        """Where the entries of the tangent stand; made at first use, because a residual needs none."""
        pieces = (self.piece_unknowns, *self.terms.couplings)
        tied = [self._ties.extended(rows) for rows in pieces] if len(self._ties.followers) else []
        base = build_pattern(pieces[0], self.size, *pieces[1:], *tied)
        self.rubber.locate(base)
        self.terms.locate(base)
        return Layout(base, self.prescribed, self._ties)

    @property
    def supports_are_plain(self) -> bool:
        """Whether all components are along x, y and z, and none follows another."""
        return not len(self._frames.nodes) and not len(self._ties.followers)

    @property
    def pattern(self) -> Pattern:
        """The sparsity of the tangent at present; contact changes it."""
        return self.layout.pattern

    def split(self, unknowns: Array) -> tuple[Array, Array]:
        """Scaled displacement (n + e, 3), reference points included, and scaled mean stress (m,)."""
        nodes = 3 * self.node_count
        components = self._ties.fill(unknowns[:nodes]).reshape(-1, 3)
        return self._frames.to_global(components), unknowns[nodes : nodes + self.element.mean_count]

    def nodal_forces(self, at: Evaluation) -> Array:
        """Internal minus external force (n, 3) [N] on the nodes of the mesh; that of rigid faces is at their points."""
        return self.by_node(at.residual)[: len(self.model.mesh.points)] * self.stress_scale * self.length**2

    def rates(self, unknowns: Array, velocity: Array) -> Array:
        """Rates (size,) of the unknowns for a velocity (n, 3) [m/s] of the nodes of the mesh at some unknowns."""
        own = carrier_velocity(self.carriers, self.points, self.length, self.split(unknowns)[0], velocity)
        out = np.zeros(self.size)
        components = self._frames.to_local(np.concatenate([velocity / self.length, own])).ravel()
        out[: len(components)] = components
        out[self._ties.followers] = 0.0
        return out

    def by_node(self, forces: Array) -> Array:
        """Scaled forces on the nodes (n + e, 3) of those on the unknowns (size,); tied ones are at the leader."""
        return self._frames.to_global(forces[: 3 * self.node_count].reshape(-1, 3))

    def displacement(self, unknowns: Array) -> Array:
        """Scaled displacement of the nodes of the mesh (n, 3)."""
        return self.split(unknowns)[0][: len(self.model.mesh.points)]

    def springs(self, unknowns: Array) -> Array:
        """Scaled displacements (b, 3) of sprung obstacles from their places."""
        return unknowns[3 * self.node_count + self.element.mean_count :].reshape(-1, 3)

    def joined(self, by_node: Array) -> Array:
        """Forces (n + e, 3) as a vector (size,) along the directions of each node; none on mean stresses."""
        out = np.zeros(self.size)
        out[: 3 * self.node_count] = self._frames.to_local(by_node).ravel()
        return self._ties.gather(out)

    def external(self, unknowns: Array, load_factor: float, unknown_pressures: Array | None = None) -> Array:
        """Scaled external forces (size,) on a body that does not move, whatever is inside out."""
        position = self.points + self.split(unknowns)[0]
        _, forces = self.terms.forces(Configuration(position, load_factor, unknown_pressures))
        return self.joined(forces)

    def physical(self, unknowns: Array) -> tuple[Array, Array]:
        """Displacement (n, 3) [m] and mean stress (m,) [Pa]."""
        return self.displacement(unknowns) * self.length, self.split(unknowns)[1] * self.stress_scale

    def unknowns(
        self, displacement: Array, mean_stress: Array, points: Mapping[str, PointMotion] | None = None
    ) -> Array:
        """Scaled unknowns of a displacement (n, 3) [m] and mean stress (m,) [Pa], as `physical` and `motions` give.

        A reference point whose motion is not given has that of its face.
        """
        own = carrier_displacement(self.carriers, (self.length, self.stress_scale), displacement, points or {})
        components = self._frames.to_local(np.concatenate([displacement / self.length, own])).ravel()
        components[self._ties.followers] = 0.0
        return np.concatenate([components, mean_stress / self.stress_scale])

    @property
    def piece_unknowns(self) -> NDArray[np.int64]:
        """Unknowns that each cell ties, or each side of films where there are no cells; displacements first."""
        mesh = self.model.mesh
        return self.rubber.unknowns if len(mesh.cells) else displacements(mesh.film_sides)

    @property
    def cell_size(self) -> int:
        """Unknowns of a cell, displacements node by node first."""
        return self.rubber.unknowns.shape[1]

    def scattered(self, entries: NDArray[np.int64], values: Array) -> Array:
        """Sum chosen entries (k,) of the lower triangles of piece matrices, values (c, k), into that of the tangent."""
        base = self.layout.base
        data, (rows, columns) = np.zeros(len(base.indices)), np.tril_indices(self.piece_unknowns.shape[1])
        if len(self.cells):
            self.rubber.add_entries(data, entries, values)
        else:
            ends = (self.piece_unknowns[:, chosen[entries]].ravel() for chosen in (rows, columns))
            scatter_add(data, locate(base.indptr, base.indices, *ends), values.ravel())
        self._frames.turn_tangent(self.layout.base, data, self.node_count)
        self.layout.reduce_base(data)
        return data

    def scattered_sides(self, sides: NDArray[np.int64], local: Array) -> Array:
        """Sum matrices of sides (f, n, 3, n, 3) with nodes (f, n) into the lower triangle of the tangent."""
        base, unknowns = self.layout.base, displacements(sides)
        data, (rows, columns) = np.zeros(len(base.indices)), np.tril_indices(unknowns.shape[1])
        places = locate(base.indptr, base.indices, unknowns[:, rows].ravel(), unknowns[:, columns].ravel())
        square = local.reshape(len(sides), unknowns.shape[1], -1)
        scatter_add(data, places, lower(square))
        self._frames.turn_tangent(base, data, self.node_count)
        self.layout.reduce_base(data)
        return data

    def gathered(self, by_cell: Array) -> Array:
        """Sum nodal forces of the cells (c, 3 nodes) into forces along the directions of the nodes (size,)."""
        out = self._summed(by_cell)
        components = out[: 3 * self.node_count].reshape(-1, 3)
        out[: 3 * self.node_count] = self._frames.to_local(components).ravel()
        return self._ties.gather(out)

    def _summed(self, by_cell: Array) -> Array:
        """Sum the first entries of all cells (c, k) by unknown (size,)."""
        places = self.rubber.unknowns[:, : by_cell.shape[1]]
        out: Array = np.bincount(places.ravel(), by_cell.ravel(), minlength=self.size).astype(np.float64)
        return out

    def prescribed_values(self, load_factor: float) -> Array:
        """Scaled values of the prescribed unknowns at a load factor."""
        values = np.zeros(self.size)
        moved = self._supports.values(self.rest, load_factor) / self.length
        values[: 3 * self.node_count] = moved.ravel()
        return values[self.prescribed]

    def evaluate(
        self,
        unknowns: Array,
        load_factor: float,
        unknown_pressures: Array | None = None,
        known: Contacts | None = None,
        how: SearchMode = SearchMode.FOLLOW,
        history: History | None = None,
        addition: Addition | None = None,
    ) -> Evaluation | None:
        """Residual at a point; None where a cell is turned inside out.

        ``unknown_pressures`` are scaled pressures of the controlled faces; `ContactTerms.look` explains ``known`` and
        ``how``. ``history`` is what rubber and friction bring into the step, that of a sudden step from rest by
        default; ``addition`` are forces besides those of the model, such as inertia.
        """
        u, p = self.split(unknowns)
        history, rubber = history or self.materials.rest, self.rubber.at(load_factor)
        laws = rubber.laws(u, history)
        if laws is None:
            return None
        position = self.points + u
        place = Configuration(position, load_factor, unknown_pressures, history.bonds)
        of_terms = later(len(self.cells), self.terms.forces, place)
        internal = self._summed(rubber.forces(u, p, laws))
        forces, external = of_terms()
        springs = self.springs(unknowns)
        contacts = self.contact.look(position, springs, load_factor, known, how).with_friction(history.friction)
        pressing, bodies = self.contact.forces(contacts, springs)
        by_node = internal[: 3 * self.node_count].reshape(-1, 3) + forces + pressing
        internal[self.size - bodies.size :] = bodies.ravel()
        internal[: 3 * self.node_count] = self._frames.to_local(by_node).ravel()
        internal, outer = self._ties.gather(internal), self.joined(external)
        if addition is not None:
            internal += addition.forces(unknowns)
        total = internal - outer
        if not np.isfinite(total).all():
            return None
        pressed = float(np.linalg.norm(self.joined(pressing)[~self.prescribed]))
        return Evaluation(
            unknowns, load_factor, total, outer, laws, contacts, pressed, unknown_pressures, history, addition
        )

    def contacts(self, unknowns: Array, load_factor: float) -> Contacts:
        """Contacts at a point, followed from the last search."""
        position = self.points + self.split(unknowns)[0]
        return self.contact.look(position, self.springs(unknowns), load_factor)

    @property
    def remembers(self) -> bool:
        """Whether rubber, a bond or a cable remembers, so that a state depends on all before it."""
        return self.materials.remembers or bool(self.terms.remembering)

    def history(self, memory: Memory | None = None, step: float = 0.0) -> History:
        """Memory that a state brings into a step of a length [s]; None is the state at rest.

        0 is a sudden step, infinite an infinitely slow one.
        """
        return replace(self.materials.history(memory, step), friction=friction_of(memory), bonds=bonds_of(memory))

    def remembered(self, at: Evaluation) -> Memory | None:
        """Internal variables at the end of the step of an evaluation; None for materials and contact without memory."""
        friction, bonds = self.contact.remembered(at.contacts), self.terms.remembered(self.configuration(at))
        if not self.materials.remembers:
            return joined_memory({}, {}, friction, bonds=bonds)
        gradients = self.rubber.at(at.load_factor).gradients(self.split(at.unknowns)[0])
        memory = self.materials.remembered(gradients, at.history)
        return None if memory is None else replace(memory, friction=friction, bonds=bonds)

    def contact_memory(self) -> ContactMemory:
        """The memory of contact along the path."""
        return self.contact.memory(self.layout)

    def restore_contact(self, memory: ContactMemory) -> None:
        """Restore the memory of contact."""
        self.contact.restore(memory, self.layout)

    def lay_out(self, at: Evaluation) -> None:
        """Give the tangent the sparsity that walls which touch need."""
        self.contact.prepare(self.layout, at.contacts)

    def tangent_data(self, at: Evaluation, geometric: Stresses | None = None, exact: bool = False) -> Array:
        """Values of the symmetric tangent's lower triangle, supports not yet applied; to be factored unless exact."""
        u, p = self.split(at.unknowns)
        data = np.zeros(len(self.layout.base.indices))
        rubber, stresses = self.rubber.at(at.load_factor), None if geometric is None else geometric.cells
        given = None if geometric is None else geometric.terms
        terms = later(len(self.cells), self.terms.tangents, self.configuration(at), given)
        rubber.add_tangents(data, (u, p), at.isochoric, stresses, exact)
        self.terms.add(data, terms())
        self.lay_out(at)
        data = self.layout.spread(data)
        self.contact.add_tangents(data, self.layout, at.contacts)
        self._frames.turn_tangent(self.pattern, data, self.node_count)
        self.layout.reduce(data)
        if at.addition is not None:
            data += self.layout.spread(at.addition.data(at.unknowns))
        return data

    def configuration(self, at: Evaluation) -> Configuration:
        """Where the terms were evaluated."""
        position = self.points + self.split(at.unknowns)[0]
        return Configuration(position, at.load_factor, at.unknown_pressures, at.history.bonds)

    def skew_matrix(self, at: Evaluation) -> sp.csc_matrix | None:
        """Skew part of the tangent from pressure on open surfaces; None where every pressure has a potential."""
        matrix = self.terms.skew_matrix(self.configuration(at), self.size)
        return None if matrix is None else self._ties.reduce(self._frames.turn_matrix(matrix))

    def rubbing(self, at: Evaluation) -> sp.csc_matrix | None:
        """Unsymmetric part of the tangent, from friction, whose limits follow the pressure, and from moments."""
        parts = (
            self.contact.rubbing(at.contacts, self.size),
            self.terms.unsymmetric_matrix(self.configuration(at), self.size),
        )
        present = [part for part in parts if part is not None]
        return self._ties.reduce(self._frames.turn_matrix(sum(present[1:], present[0]).tocsc())) if present else None

    def apply_supports(self, data: Array) -> None:
        """Replace the equations of prescribed unknowns by identities, in place."""
        self.layout.apply_supports(data)

    def make_definite(self, data: Array) -> None:
        """Give free nodes of reference points a small stiffness, their multipliers a compliance, in place.

        Places, arrows and multipliers may have a zero on the diagonal, and solvers that pivot within a front cannot
        swap them. With small numbers there, the matrix can be factored in any order. It is that of the factors alone:
        the residual decides, and Newton's method makes up for it.
        """
        own = [3 * each.node + np.arange(3 * each.count) for each in self.carriers]
        for unknowns in own:
            free = unknowns[~self.prescribed[unknowns]]
            data[self.pattern.diagonal[free]] += np.where(self.moving[free], DEFINITE, -DEFINITE)

    def correction(self, at: Evaluation, geometric: Stresses) -> Array | None:
        """Forces (size,) beyond the residual, of the stresses that the tangent is linearized about; None for none."""
        by_node = self.terms.correction(self.configuration(at), geometric.terms)
        return None if by_node is None else self.joined(by_node)

    def stresses(self, at: Evaluation, update: Array | None = None, last: Stresses | None = None) -> Stresses:
        """Stresses at an evaluation, linearized for an update where one is given; ``last`` are those before it.

        See `kernels.extrapolated_stress`.
        """
        there = self.split(at.unknowns)
        change = self.split(np.zeros(self.size) if update is None else update)
        given = None if last is None else last.terms
        terms = later(len(self.cells), self.terms.stresses, self.configuration(at), change[0], given)
        return Stresses(self.rubber.at(at.load_factor).stresses(there, change, at.isochoric), terms())

    def residual(self, unknowns: Array, load_factor: float, history: History | None = None) -> Array:
        """Residual (size,) at a point, for checks of the tangent."""
        evaluation = self.evaluate(unknowns, load_factor, history=history)
        if evaluation is None:
            raise TurgorError("a cell is turned inside out at these unknowns.")
        return evaluation.residual

    def tangent(self, unknowns: Array, load_factor: float, history: History | None = None) -> sp.csc_matrix:
        """Full tangent (size, size) at a point without supports, its unsymmetric parts included."""
        evaluation = self.evaluate(unknowns, load_factor, history=history)
        if evaluation is None:
            raise TurgorError("a cell is turned inside out at these unknowns.")
        data = self.tangent_data(evaluation)  # first: contact may change the pattern
        matrix = self.pattern.full(data)
        for part in (self.skew_matrix(evaluation), self.rubbing(evaluation)):
            matrix = matrix if part is None else (matrix + part).tocsc()
        return matrix


def _mean_edge(mesh: Mesh) -> float:
    pieces = mesh.pieces
    return float(np.linalg.norm(mesh.points[pieces[:, 0]] - mesh.points[pieces[:, 1]], axis=1).mean())


def _stiffest(model: Model, length: float) -> float:
    """Largest shear modulus of the rubbers [Pa]; without any, that of a layer of an edge as stiff as the sheets."""
    rubbers = [material.law.shear_modulus for material in model.region_materials.values()]
    films = [sheet.material.law.shear_modulus * sheet.thickness / length for sheet in model.membranes.values()]
    return max(rubbers or films)
