"""RigidTerm: multipliers that keep the arrows of a reference point orthonormal."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.points.point_unknowns import Carrier, carriers_of
from turgor.core.engine.points.prescribed_motion import PAIRS
from turgor.core.engine.term import Configuration, Setting, Term, displacements, lower

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class RigidTerm(Term):
    """W = Σ s_ij (yᵢ·yⱼ − r² δ_ij) / r, half of that for i = j: the multipliers s are the stress of a rigid body.

    Parameters
    ----------
    carrier : Carrier
    rest : (3,) array
        Scaled position of the point at rest, from which its nodes are counted.
    radius : float
        Scaled length r of the arrows.
    """

    couples = True

    carrier: Carrier
    rest: Array
    radius: float

    @property
    def unknowns(self) -> Ints:
        """All nodes of the point (1, 3 k): a solver that pivots finds them in one front."""
        return displacements(self.carrier.node + np.arange(self.carrier.count)[None])

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the derivative of W."""
        arrows, stress = self._parts(at.position)
        out[self.carrier.arrows] += stress @ arrows / self.radius
        out[self.carrier.stress] += self.violation(at.position).reshape(2, 3)

    def violation(self, position: Array) -> Array:
        """How far the products of the arrows are from those of unit vectors (6,), as scaled lengths."""
        arrows, _ = self._parts(position)
        products = arrows @ arrows.T - self.radius**2 * np.eye(3)
        return np.array([products[i, j] * (0.5 if i == j else 1.0) for i, j in PAIRS]) / self.radius

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Second derivative of W."""
        arrows, stress = self._parts(at.position)
        local = np.zeros((3 * self.carrier.count, 3 * self.carrier.count))
        local[3:12, 3:12] = np.kron(stress, np.eye(3)) / self.radius
        for row, (i, j) in enumerate(PAIRS):
            slope = np.zeros((3, 3))
            slope[i] += arrows[j] * (0.5 if i == j else 1.0)
            slope[j] += arrows[i] * (0.5 if i == j else 1.0)
            local[12 + row, 3:12] = local[3:12, 12 + row] = slope.ravel() / self.radius
        return lower(local[None])

    def _parts(self, position: Array) -> tuple[Array, Array]:
        """Arrows (3, 3) in rows, and the symmetric matrix (3, 3) of the multipliers."""
        arrows = position[self.carrier.arrows] - self.rest + self.radius * np.eye(3)
        values = (position[self.carrier.stress] - self.rest).ravel()
        stress = np.zeros((3, 3))
        for value, (i, j) in zip(values, PAIRS, strict=True):
            stress[i, j] = stress[j, i] = value
        return arrows, stress


def rigid_terms(setting: Setting) -> Sequence[RigidTerm]:
    """One for each reference point."""
    return [
        RigidTerm(each, setting.points[each.node], each.radius / setting.length) for each in carriers_of(setting.model)
    ]
