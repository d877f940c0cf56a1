"""SpringTerm: springs between a reference point and its place at rest."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.points.point_unknowns import Carrier, carriers_of
from turgor.core.engine.term import Configuration, Setting, Term, displacements, lower

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Below this 1 − cos θ the angle is taken from its series.
SMALL = 1e-4


@dataclass(frozen=True, slots=True, eq=False)
class SpringTerm(Term):
    """½ Σ kᵢ uᵢ² + ½ k θ², with the angle θ of the rotation: cos θ = (tr R − 1) / 2, from 0 to half a turn.

    Parameters
    ----------
    carrier : Carrier
    stiffness : (3,) array
        Scaled, along x, y and z, of the modeled part.
    turning : float
        Scaled moment per angle, of the modeled part.
    rest : (3,) array
        Scaled position of the point at rest.
    radius : float
        Scaled length r of the arrows.
    """

    carrier: Carrier
    stiffness: Array
    turning: float
    rest: Array
    radius: float

    @property
    def unknowns(self) -> Ints:
        """Place and arrows, (1, 12)."""
        return displacements(self.carrier.node + np.arange(4)[None])

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the forces of the stretched and twisted springs."""
        out[self.carrier.node] += self.stiffness * (at.position[self.carrier.node] - self.rest)
        slope = angle_squared(self._less(at.position))[1]
        out[self.carrier.arrows] -= 0.5 * self.turning * slope * np.eye(3) / (2 * self.radius)

    def energy(self, position: Array) -> float:
        """Energy of the springs."""
        u = position[self.carrier.node] - self.rest
        return float(0.5 * self.stiffness @ u**2 + 0.5 * self.turning * angle_squared(self._less(position))[0])

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Second derivative of the energy."""
        local = np.zeros((12, 12))
        local[:3, :3] = np.diag(self.stiffness)
        along = np.eye(3).ravel() / (2 * self.radius)
        local[3:, 3:] = 0.5 * self.turning * angle_squared(self._less(at.position))[2] * np.outer(along, along)
        return lower(local[None])

    def _less(self, position: Array) -> float:
        """1 − cos θ."""
        return -float(np.trace(position[self.carrier.arrows] - self.rest)) / (2 * self.radius)


def angle_squared(less: float) -> tuple[float, float, float]:
    """θ² of 1 − cos θ, and its first two derivatives; continued where a trace exceeds that of a rotation.

    Examples
    --------
    >>> [round(value, 6) for value in angle_squared(1.0)]  # a quarter turn
    [2.467401, 3.141593, 2.0]
    """
    v = min(less, 2.0)
    if abs(v) < SMALL:
        return 2 * v + v**2 / 3 + 4 * v**3 / 45, 2 + 2 * v / 3 + 4 * v**2 / 15, 2 / 3 + 8 * v / 15
    square = v * (2 - v)  # sin² θ
    if v > 0:
        angle, sine = float(np.arccos(1 - v)), float(np.sqrt(max(square, 1e-12)))
        return angle**2, 2 * angle / sine, (2 - 2 * angle * (1 - v) / sine) / max(square, 1e-12)
    angle, sine = float(np.arccosh(1 - v)), float(np.sqrt(-square))
    return -(angle**2), 2 * angle / sine, (2 - 2 * angle * (1 - v) / sine) / square


def spring_terms(setting: Setting) -> Sequence[SpringTerm]:
    """One for each reference point with springs."""
    terms, shared = [], setting.model.mesh.symmetry_factor
    for each in carriers_of(setting.model):
        stiffness = np.array(each.point.stiffness) / (setting.stress * setting.length * shared)
        turning = each.point.rotational_spring / (setting.stress * setting.length**3 * shared)
        if stiffness.any() or turning:
            radius = each.radius / setting.length
            terms.append(SpringTerm(each, stiffness, turning, setting.points[each.node], radius))
    return terms
