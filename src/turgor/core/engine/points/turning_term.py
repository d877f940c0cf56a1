"""TurningTerm: moments and follower forces on reference points, whose work depends on the way of the rotation."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.points.point_unknowns import Carrier, carriers_of
from turgor.core.engine.term import Configuration, Setting, Term, displacements
from turgor.core.model.history import History, share_at
from turgor.core.model.loads.load import Turning

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class TurningTerm(Term):
    """A moment m, or a force that turns with its point.

    The moment is the forces ½ m × yᵢ / r² on the arrows: their work in a small rotation δθ, in which δyᵢ = δθ × yᵢ, is
    m·δθ. What is stated at rest and turns with the point is Σ mᵢ yᵢ / r. Neither has a potential; the whole derivative
    is handed to the solver as the unsymmetric part of a few unknowns.

    Parameters
    ----------
    carrier : Carrier
    turning : Turning
        The moment or the force.
    history : History
    vector : (3,) array
        Scaled force or moment on the modeled part.
    rest : (3,) array
        Scaled position of the point at rest.
    radius : float
        Scaled length r of the arrows.
    """

    external = True

    carrier: Carrier
    turning: Turning
    history: History
    vector: Array
    rest: Array
    radius: float

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the forces on the place or on the arrows."""
        arrows, acting = self._arrows(at.position), self._acting(at)
        if self.turning.is_moment:
            out[self.carrier.arrows] += 0.5 * np.cross(acting, arrows) / self.radius**2
        else:
            out[self.carrier.node] += acting

    def unsymmetric(self, at: Configuration, size: int) -> sp.csc_matrix | None:
        """Derivative of minus the forces (size, size)."""
        local = np.zeros((4, 3, 4, 3))
        share = share_at(self.history, at.load_factor) * self.vector / self.radius
        if not self.turning.is_moment:
            for j in range(3):
                local[0, :, 1 + j] = share[j] * np.eye(3)
        else:
            arrows, acting = self._arrows(at.position), self._acting(at)
            for i in range(3):
                local[1 + i, :, 1 + i] += 0.5 / self.radius**2 * _cross(acting)
                for j in range(3) if self.turning.follower else ():
                    local[1 + i, :, 1 + j] -= 0.5 / self.radius**2 * share[j] * _cross(arrows[i])
        unknowns = displacements(self.carrier.node + np.arange(4)[None])[0]
        places = (np.repeat(unknowns, 12), np.tile(unknowns, 12))
        return sp.csc_matrix((-local.ravel(), places), shape=(size, size))

    def _arrows(self, position: Array) -> Array:
        return np.asarray(position[self.carrier.arrows] - self.rest + self.radius * np.eye(3))

    def _acting(self, at: Configuration) -> Array:
        """The force or moment at a place and a load factor (3,)."""
        vector = share_at(self.history, at.load_factor) * self.vector
        return vector @ self._arrows(at.position) / self.radius if self.turning.follower else vector


def _cross(a: Array) -> Array:
    """The matrix (3, 3) of a × ."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def turning_terms(setting: Setting) -> Sequence[TurningTerm]:
    """One for each moment and each follower force on a reference point."""
    model, terms = setting.model, []
    carriers = {each.point.name: each for each in carriers_of(model)}
    for load in model.loads:
        turning = load.turning
        if turning is None:
            continue
        carrier, unit = carriers[turning.point], setting.stress * setting.length ** (3 if turning.is_moment else 2)
        vector = np.array(turning.vector) / (unit * model.mesh.symmetry_factor)
        rest, radius = setting.points[carrier.node], carrier.radius / setting.length
        terms.append(TurningTerm(carrier, turning, load.history, vector, rest, radius))
    return terms
