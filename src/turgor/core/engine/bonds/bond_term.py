"""BondTerm: tractions of a bond between the doubled nodes of two bodies, which fall as it is damaged."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.bonds.law import BondLaw
from turgor.core.engine.bonds.opening import Opening
from turgor.core.engine.bonds.settings import BOND
from turgor.core.engine.cells.reference import ReferenceCell, side_tables
from turgor.core.engine.term import Configuration, Setting, Term, add_at_nodes, displacements, lower
from turgor.core.meshing.bodies.parted import parted_faces, partners
from turgor.core.model.bonds import Bond
from turgor.core.model.model import Model

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class _Answer:
    """What a bond does at a position, at all points one after another (p,).

    Parameters
    ----------
    opening : Opening
    squares : ((p,) array, (p,) array)
        n² and s² of `turgor.core.engine.bonds.law`.
    damage, by_peel, by_shear : (p,) array
    """

    opening: Opening
    squares: tuple[Array, Array]
    damage: Array
    by_peel: Array
    by_shear: Array


@dataclass(frozen=True, slots=True, eq=False)
class BondTerm(Term):
    """Energy (1 − d) E0 (n² + s²) per reference area, and ½ K g² where the sides are pressed together.

    Parameters
    ----------
    name : str
    sides, partners : (k, n) int array
        Nodes of each side on the first body, and those opposite on the second one.
    law : BondLaw
    weights : (k, q) array
        Scaled reference area of each point.
    start : (k, q) array
        Damage at rest: 1 where nothing is bonded.
    clearance : (k, q) array
        Scaled depth at which the sides begin to press on each other.
    table : ReferenceCell
        Of a side.
    unit : float [J/m²]
        Of an energy per area.
    """

    name: str
    sides: Ints
    partners: Ints
    law: BondLaw
    weights: Array
    start: Array
    clearance: Array
    table: ReferenceCell
    unit: float

    @property
    def memory_key(self) -> str:
        """Name of the bond."""
        return self.name

    @property
    def couples(self) -> bool:
        """Nodes of two bodies are tied."""
        return True

    @property
    def unknowns(self) -> Ints:
        """Displacements of both sides, (k, 6 n)."""
        return displacements(np.concatenate([self.sides, self.partners], axis=1))

    @property
    def _rows(self) -> Array:
        """How u, a, b follow from the positions of the nodes of both sides, (q, 3, 2 n)."""
        N, dN = self.table.N[:, None], 0.5 * self.table.dN.swapaxes(1, 2)
        return np.concatenate([np.concatenate([-N, dN], axis=1), np.concatenate([N, dN], axis=1)], axis=2)

    def _answer(self, position: Array, history: Array | None) -> _Answer:
        nodes = np.concatenate([self.sides, self.partners], axis=1)
        z = np.einsum("qrj,fji->fqri", self._rows, position[nodes])
        opening = Opening.at(z.reshape(-1, 3, 3))
        squares = (np.maximum(opening.across, 0.0) / self.law.onset[0]) ** 2, opening.along / self.law.onset[1] ** 2
        before = (self.start if history is None else history[0]).ravel()
        return _Answer(opening, squares, *self.law.damage(*squares, before))

    def _rates(self, at: _Answer) -> tuple[Array, Array]:
        """∂n² and ∂s² by u, a, b, (p, 3, 3)."""
        opening, (across, along) = at.opening, self.law.onset
        pulled = np.maximum(opening.across, 0.0)[:, None, None]
        return 2 * pulled * opening.across_rate / across**2, opening.along_rate / along**2

    def _depth(self, at: _Answer) -> Array:
        """How deep the sides are pressed into each other (p,), negative; zero where they are not."""
        return np.minimum(at.opening.across + self.clearance.ravel(), 0.0)

    def _gradient(self, at: _Answer) -> tuple[Array, Array]:
        """∂ of the energy that damage reduces, undamaged, and of that of pressing."""
        peel, shear = self._rates(at)
        pressed = self._depth(at)[:, None, None]
        return self.law.elastic * (peel + shear), self.law.stiffness * pressed * at.opening.across_rate

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the tractions on both sides."""
        answer = self._answer(at.position, at.bonds.get(self.name))
        bonded, pressed = self._gradient(answer)
        local = ((1 - answer.damage)[:, None, None] * bonded + pressed).reshape(*self.weights.shape, 3, 3)
        forces = np.einsum("fq,qrj,fqri->fji", self.weights, self._rows, local)
        add_at_nodes(out, np.concatenate([self.sides, self.partners], axis=1), forces)

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Symmetric part of the consistent tangent."""
        answer = self._answer(at.position, at.bonds.get(self.name))
        growth = self._growth(answer)
        local = self._elastic(answer) - 0.5 * (growth + growth.swapaxes(1, 2))
        whole, unknowns = self._assembled(local), self.unknowns
        same = (unknowns[:, :, None] == unknowns[:, None, :]) & ~np.eye(unknowns.shape[1], dtype=bool)
        return lower(np.where(same, 2 * whole, whole))  # an end of the bond is one node, which a row lists twice

    def unsymmetric(self, at: Configuration, size: int) -> sp.csc_matrix | None:
        """Rest of the tangent where damage grows and peel and shear take different energies."""
        if not self.law.depends_on_mode:
            return None
        growth = self._growth(self._answer(at.position, at.bonds.get(self.name)))
        skew = 0.5 * (growth.swapaxes(1, 2) - growth)
        which = np.abs(skew).reshape(len(self.sides), -1).max(axis=1) > 0
        if not which.any():
            return None
        local, unknowns = self._assembled(skew)[which], self.unknowns[which]
        count = unknowns.shape[1]
        places = (np.repeat(unknowns, count, axis=1).ravel(), np.tile(unknowns, (1, count)).ravel())
        return sp.csc_matrix((local.ravel(), places), shape=(size, size))

    def _elastic(self, at: _Answer) -> Array:
        """Second derivatives (p, 9, 9) by u, a, b while the damage stays."""
        opening, law = at.opening, self.law
        across = opening.across_rate.reshape(-1, 9)
        outer, bent = across[:, :, None] * across[:, None, :], opening.second_rate()
        g, slip = opening.across[:, None, None], np.zeros((9, 9))
        slip[:3, :3] = 2 * np.eye(3)
        square = 2 * (outer + g * bent)
        peel = np.where(g >= 0, square, 0.0) / law.onset[0] ** 2
        shear = (slip - square) / law.onset[1] ** 2
        depth = self._depth(at)[:, None, None]
        pressed = np.where(depth < 0, law.stiffness * (outer + depth * bent), 0.0)
        return np.asarray((1 - at.damage)[:, None, None] * law.elastic * (peel + shear) + pressed)

    def _growth(self, at: _Answer) -> Array:
        """∂(undamaged energy) ⊗ ∂(damage), (p, 9, 9)."""
        peel, shear = (rate.reshape(-1, 9) for rate in self._rates(at))
        damage = at.by_peel[:, None] * peel + at.by_shear[:, None] * shear
        return np.asarray(self.law.elastic * (peel + shear)[:, :, None] * damage[:, None, :])

    def _assembled(self, local: Array) -> Array:
        """Matrices (k, 6 n, 6 n) of the sides from those of the points (p, 9, 9) by u, a, b."""
        k, q = self.weights.shape
        weighted = self.weights.reshape(k, q, 1, 1, 1, 1) * local.reshape(k, q, 3, 3, 3, 3)
        half = np.einsum("fqrisl,qrj->fqjisl", weighted, self._rows, optimize=True)
        out = np.einsum("fqjisl,qsm->fjiml", half, self._rows, optimize=True)
        return np.asarray(out.reshape(k, 3 * out.shape[1], -1))

    def stored(self, position: Array, history: Array | None) -> float:
        """Scaled energy that the bond gives back."""
        at = self._answer(position, history)
        elastic = (1 - at.damage) * self.law.elastic * sum(at.squares)
        pressed = 0.5 * self.law.stiffness * self._depth(at) ** 2
        return float((self.weights.ravel() * (elastic + pressed)).sum())

    def remembered(self, at: Configuration) -> Array:
        """Damage, and energy per area [J/m²] that it has taken, at the end of a step, (2, k, q)."""
        before = at.bonds.get(self.name, np.stack([self.start, np.zeros_like(self.start)]))
        answer = self._answer(at.position, before)
        taken = self.unit * self.law.dissipated(*answer.squares, before[0].ravel(), answer.damage)
        shape = self.weights.shape
        return np.stack([answer.damage.reshape(shape), before[1] + taken.reshape(shape)])

    def use(self, position: Array) -> tuple[Array, Array]:
        """λ of `turgor.core.engine.bonds.law`, and the scaled distance across the bond, zero where closed; (k, q)."""
        at, shape = self._answer(position, None), self.weights.shape
        gap = np.maximum(at.opening.across, 0.0)
        return np.sqrt(at.squares[0] + at.squares[1]).reshape(shape), gap.reshape(shape)


def bond_terms(setting: Setting) -> Sequence[BondTerm]:
    """One for each bond of a model."""
    return [_term(setting, bond) for bond in setting.model.bonds]


def _term(setting: Setting, bond: Bond) -> BondTerm:
    mesh, points = setting.model.mesh, setting.points
    faces = parted_faces(bond.name, bond.between)
    sides, (first, second) = mesh.carrying_sides(faces[0]), partners(mesh, faces)
    opposite = second[np.searchsorted(first, sides)]
    table = side_tables(sides.shape[1])
    tangent = np.einsum("qad,fai->fqid", table.dN, points[sides])
    weights = np.linalg.norm(np.cross(tangent[..., 0], tangent[..., 1]), axis=-1) * table.weights
    at = np.einsum("qa,fai->fqi", table.N, mesh.points[sides])
    edge = float(np.sqrt(weights.sum(axis=1)).mean()) * setting.length
    law = BondLaw.of(bond, stiffness_of(setting.model, bond, edge), setting.length, setting.stress)
    start = bond.flawed(at).astype(np.float64)
    clearance = BOND.clearance * edge / setting.length * start
    return BondTerm(bond.name, sides, opposite, law, weights, start, clearance, table, setting.stress * setting.length)


def stiffness_of(model: Model, bond: Bond, edge: float) -> float:
    """Stiffness [Pa/m] of an undamaged bond whose sides have edges of a length [m]."""
    if bond.stiffness is not None:
        return bond.stiffness
    softer = min(model.region_materials[name].law.shear_modulus for name in bond.between)
    return max(BOND.stiffness * 3 * softer / edge, BOND.brittleness * bond.least_stiffness)
