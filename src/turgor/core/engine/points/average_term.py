"""AverageTerm: multipliers that tie a reference point to the mean motion of its face."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.points.point_unknowns import Carrier, carriers_of
from turgor.core.engine.term import Configuration, Setting, Term, add_at_nodes, displacements, lower

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Permutation symbol: a·(b × c) = ε_ijk aᵢ bⱼ cₖ.
EPSILON = np.array([[[(i - j) * (j - k) * (k - i) / 2 for k in range(3)] for j in range(3)] for i in range(3)])


@dataclass(frozen=True, slots=True, eq=False)
class AverageTerm(Term):
    """W = λ·(∫ x da − Σ A (P + R X̄)) + μ·∫ R (X − X̄) × x da / r, over the area A of the face at rest.

    The point has the mean displacement of the face, and the rotation R of least squares: ∫ |x − x̄ − R (X − X̄)|² da is
    stationary where ∫ R (X − X̄) × x da vanishes. λ is the force of the point, μ a moment over r. The nodal forces are
    those of a traction that is linear in X, so that what acts on the point bends a straight bar without disturbance.

    Parameters
    ----------
    carrier : Carrier
    rest : (3,) array
        Scaled position of the point at rest.
    length : float [m]
        Scale.
    """

    couples = True

    carrier: Carrier
    rest: Array
    length: float

    @property
    def unknowns(self) -> Ints:
        """A node of the face and all n of the point (k, 3 + 3 n): a solver that pivots finds these in one front."""
        return displacements(self._nodes)

    @property
    def _nodes(self) -> Ints:
        own = np.tile(self.carrier.node + np.arange(self.carrier.count), (len(self.carrier.nodes), 1))
        return np.concatenate([self.carrier.nodes[:, None], own], axis=1)

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the derivative of W."""
        x, place, arrows, force, moment = self._parts(at.position)
        w, along, turning = self._shares
        turned = turning @ arrows
        local = np.zeros((len(x), 1 + self.carrier.count, 3))
        local[:, 0] = w[:, None] * force + np.cross(moment, turned)
        local[:, 1] = -w[:, None] * force
        local[:, 2:5] = turning[:, :, None] * np.cross(x, moment)[:, None] - along[:, :, None] * force
        local[:, 7] = w[:, None] * (x - place) - along @ arrows
        local[:, 8] = np.cross(turned, x)
        add_at_nodes(out, self._nodes, local)

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Second derivative of W, node by node."""
        x, _, arrows, _, moment = self._parts(at.position)
        w, along, turning = self._shares
        count, each, one = len(x), 1 + self.carrier.count, np.eye(3)
        local = np.zeros((count, each, 3, each, 3))
        local[:, 7, :, 0] = w[:, None, None] * one
        local[:, 7, :, 1] = -w[:, None, None] * one
        for j in range(3):
            local[:, 7, :, 2 + j] = -along[:, j, None, None] * one
            # μ·(y × x) = ε_kmn μ_k y_m x_n
            local[:, 2 + j, :, 0] = turning[:, j, None, None] * np.einsum("kmn,k->mn", EPSILON, moment)
            local[:, 8, :, 2 + j] = turning[:, j, None, None] * np.einsum("kmn,an->akm", EPSILON, x)
        local[:, 8, :, 0] = np.einsum("kmn,am->akn", EPSILON, turning @ arrows)
        flat = local.reshape(count, 3 * each, 3 * each)
        return lower(flat + flat.transpose(0, 2, 1))

    @property
    def _shares(self) -> tuple[Array, Array, Array]:
        """Of each node: its weight, the weight times X̄ / r, and ∫ N (X − X̄) da / (A r), over the scaled r."""
        c = self.carrier
        along = c.weights[:, None] * c.center / c.radius
        return c.weights, along, c.moments / c.radius * (self.length / c.radius)

    def _parts(self, position: Array) -> tuple[Array, Array, Array, Array, Array]:
        c = self.carrier
        arrows = position[c.arrows] - self.rest + c.radius / self.length * np.eye(3)
        force, moment = position[c.ties] - self.rest
        # counted from the point at rest: small products have small rounding errors
        return position[c.nodes] - self.rest, position[c.node] - self.rest, arrows, force, moment


def average_terms(setting: Setting) -> Sequence[AverageTerm]:
    """One for each averaging reference point."""
    return [
        AverageTerm(each, setting.points[each.node], setting.length)
        for each in carriers_of(setting.model)
        if not each.rigid
    ]
