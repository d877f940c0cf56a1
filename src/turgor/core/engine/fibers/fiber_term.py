"""Fibers on faces: pieces of thread with a tension along them, and the joints of threads that resist bending."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers import fiber_kernels as fibers
from turgor.core.engine.fibers import truss_bending as bending
from turgor.core.engine.fibers.fiber_trusses import FiberTrusses, lay
from turgor.core.engine.fibers.settings import FIBERS
from turgor.core.engine.fibers.thread_rest import ThreadRest
from turgor.core.engine.term import Configuration, Setting, Term, add_at_nodes, displacements, lower
from turgor.core.model.loads import Load

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class FiberTerm(Term):
    """The pieces of one winding, in scaled units, and the states that change their rest."""

    pieces: fibers.Pieces
    states: tuple[Load, ...] = ()

    def at(self, load_factor: float) -> "FiberTerm":
        """Return the pieces with their rest at a load factor."""
        return FiberTerm(ThreadRest.of(self.states, load_factor).pieces(self.pieces)) if self.states else self

    @property
    def unknowns(self) -> Ints:
        """Displacements of the sides that carry the pieces."""
        return displacements(self.pieces.sides)

    def _stretched(self, position: Array, update: Array | None = None) -> tuple[Array, Array]:
        """Stretch and tension of the pieces."""
        p, update = self.pieces, np.zeros_like(position) if update is None else update
        stretch, tension = fibers.fiber_tensions(position, update, p.sides, p.along, p.stiffness, p.pushed)
        return stretch, tension

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the internal forces of the tensions."""
        p, (_, tension) = self.pieces, self._stretched(at.position)
        add_at_nodes(out, p.sides, fibers.fiber_forces(at.position, p.sides, p.along, p.weights, tension))

    def energy(self, position: Array) -> float:
        """½ N (λ − 1) for each reference length."""
        stretch, tension = self._stretched(position)
        return 0.5 * float((self.pieces.weights * tension * (stretch - 1)).sum())

    def stresses(self, position: Array, update: Array) -> Array:
        """Tensions (k,) of the pieces."""
        return self._stretched(position, update)[1]

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Stiffness along the pieces, little of it where a thread is slack, and the tension as the pieces turn."""
        p, (stretch, _) = self.pieces, self._stretched(at.position)
        stiffness = np.where(stretch >= 1, 1.0, np.maximum(p.pushed, FIBERS.slack_tangent)) * p.stiffness
        return lower(fibers.fiber_tangents(at.position, p.sides, p.along, p.weights, stiffness, stresses))


@dataclass(frozen=True, slots=True, eq=False)
class BendingTerm(Term):
    """Joints of threads that resist bending, in scaled units; a joint ties nodes of two cells."""

    couples = True

    joints: bending.Joints
    states: tuple[Load, ...] = ()

    def at(self, load_factor: float) -> "BendingTerm":
        """Return the joints with the length and stiffness of their threads at a load factor."""
        if not self.states:
            return self
        rest = ThreadRest.of(self.states, load_factor)
        return BendingTerm(replace(self.joints, stiffness=self.joints.stiffness * rest.stiffness / rest.length))

    @property
    def unknowns(self) -> Ints:
        """Displacements of the sides on both sides of each joint."""
        return self.joints.unknowns

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the internal forces of the bending moments."""
        add_at_nodes(out, self.joints.nodes, bending.bending_forces(self.joints, at.position))

    def energy(self, position: Array) -> float:
        """Energy of all joints."""
        return bending.bending_energy(self.joints, position)

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Lower triangles, all of it at the position; degrees of freedom that a joint lists twice count once."""
        return bending.lower_of_doubled(bending.bending_tangents(self.joints, at.position), self.joints.unknowns)


def fiber_terms(setting: Setting) -> list[FiberTerm | BendingTerm]:
    """One for each winding, then one for each whose threads resist bending."""
    model, along, bent = setting.model, [], []
    for each in model.reinforcements:
        laid = lay(model.mesh, each)
        pieces = laid.pieces if isinstance(laid, FiberTrusses) else laid
        states = model.states_of(each.name)
        along.append(FiberTerm(_scaled(pieces, setting.length, setting.stress), states))
        if each.bending and isinstance(laid, FiberTrusses):
            joints = bending.joints_of(laid, each, model.mesh.points)
            bent.append(BendingTerm(joints.scaled(setting.length, setting.stress), states))
    return [*along, *bent]


def _scaled(pieces: fibers.Pieces, length: float, stress: float) -> fibers.Pieces:
    """Pieces in scaled units: the product of weight and stiffness is a force times a length, along is 1 / length."""
    return replace(
        pieces,
        along=np.ascontiguousarray(pieces.along * length),
        weights=pieces.weights,
        stiffness=pieces.stiffness / (stress * length**3),
    )
