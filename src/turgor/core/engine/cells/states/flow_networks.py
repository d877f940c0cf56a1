"""Networks that flow at the points of a region: permanent set of the law, and Bergström and Boyce's second network.

A network has the gradient F_r = F G of its trial with G = F_v⁻¹ at the last converged state, and flows in the step as
`turgor.core.materials.history.flow` says. The step has a potential, so that stress and tangent are symmetric and exact.
"""

from dataclasses import dataclass
from math import inf
from typing import cast

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells import spectral
from turgor.core.engine.cells.states.networks import turned
from turgor.core.materials.history.flow import Flowed, flowed
from turgor.core.materials.history.permanent_set import PermanentSet
from turgor.core.materials.history.resistance import Resistance
from turgor.core.materials.history.softening import Mullins, softened_derivatives, softening
from turgor.core.materials.laws.derivatives import STRETCH_PAIRS
from turgor.core.materials.laws.laws import Law
from turgor.core.materials.material import Material

Array = NDArray[np.float64]

#: Internal variables of a network at a point: the nine components of G, and the plastic strain.
VARIABLES = 10


@dataclass(frozen=True, slots=True, eq=False)
class FlowNetwork:
    """One network of one region in a step.

    Parameters
    ----------
    law : Law
    share : float
        Factor on its energy.
    reference : (c, q, 3, 3) array
        G at the beginning of the step.
    resistance : Resistance or None
        None where the step is infinitely slow: then all of the stress relaxes.
    plastic : PermanentSet or None
        The set of the law; None for a network that flows with time.
    softening : (Mullins, (c, q) array) or None
        Stress softening with the largest energy density so far.
    """

    law: Law
    share: float
    reference: Array
    resistance: Resistance | None
    plastic: PermanentSet | None = None
    softening: tuple[Mullins, Array] | None = None

    def response(self, F: Array) -> tuple[Array, Array]:
        """Second Piola–Kirchhoff stress (c, q, 6) and moduli (c, q, 21) [Pa] at gradients F (c, q, 3, 3)."""
        if self.resistance is None:
            return np.zeros((*F.shape[:2], 6)), np.zeros((*F.shape[:2], spectral.TANGENT))
        bar, directions, size = self._trial(F)
        step = flowed(self.law, self.share, bar, self.resistance)
        first, second = step.derivatives(bar)
        if self.softening is not None:
            mullins, largest = self.softening
            eta, slope = softening(mullins, self._potential(step), largest)
            W = softened_derivatives(eta, slope, np.concatenate([first, second]), STRETCH_PAIRS)
            first, second = W[:3], W[3:]
        S, packed = spectral.spectral_response(
            bar, directions, size, np.ascontiguousarray(first), np.ascontiguousarray(second)
        )
        return turned(self.reference, S, packed)

    def energy(self, F: Array) -> Array:
        """Elastic energy density (c, q) [Pa] at the end of the step."""
        if self.resistance is None:
            return np.zeros(F.shape[:2])
        return flowed(self.law, self.share, self._trial(F)[0], self.resistance).energy

    def end(self, F: Array) -> Array:
        """Internal variables (c, q, 10) at the end of the step."""
        out = np.zeros((*F.shape[:2], VARIABLES))
        if self.resistance is None:
            size = np.cbrt(np.linalg.det(F))[..., None, None]
            out[..., :9] = np.linalg.inv(F / size).reshape(*F.shape[:2], 9)
            return out
        bar, directions, _ = self._trial(F)
        step = flowed(self.law, self.share, bar, self.resistance)
        less = np.einsum("cqik,kcq,cqjk->cqij", directions, np.exp(-step.strain), directions)
        out[..., :9] = (self.reference @ less).reshape(*F.shape[:2], 9)
        out[..., 9] = self.resistance.hardened + step.amount if self.plastic is not None else 0.0
        return out

    def _trial(self, F: Array) -> tuple[Array, Array, Array]:
        return spectral.principal_stretches(np.ascontiguousarray(F @ self.reference))

    def _potential(self, step: Flowed) -> Array:
        """Energy density whose derivatives the step has: the elastic one, and the plastic work in the step."""
        assert self.plastic is not None and self.resistance is not None
        before = self.resistance.hardened
        return np.asarray(step.energy + self.plastic.work(before + step.amount) - self.plastic.work(before))


def flows(material: Material) -> bool:
    """Whether a material has networks that flow."""
    return material.permanent_set is not None or material.flowing_network is not None


def flow_at_rest(material: Material, shape: tuple[int, int]) -> Array:
    """Internal variables (k, c, q, 10) of the k networks of points that were never stretched."""
    count = (material.permanent_set is not None) + (material.flowing_network is not None)
    out = np.zeros((count, *shape, VARIABLES))
    out[..., :9] = np.eye(3).ravel()
    return out


def flow_networks(material: Material, flow: Array, largest: Array | None, step: float) -> tuple[FlowNetwork, ...]:
    """Return the networks of a region in a step: that of the law if it has a permanent set, then the one that flows.

    Parameters
    ----------
    material : Material
    flow : (k, c, q, 10) array
        Internal variables at the beginning of the step.
    largest : (c, q) array or None [Pa]
        Largest energy density so far, where the material softens.
    step : float [s]
        Length of the step.
    """
    law, out = cast(Law, material.law), []
    references = flow[..., :9].reshape(*flow.shape[:3], 3, 3)
    plastic, mullins, network = material.permanent_set, material.stress_softening, material.flowing_network
    if plastic is not None:
        softens = None if mullins is None or largest is None else (mullins, largest)
        resistance = plastic.resistance(np.ascontiguousarray(flow[0, ..., 9]))
        out.append(FlowNetwork(law, 1.0, references[0], resistance, plastic, softens))
    if network is not None:
        slow = None if step == inf else network.resistance(step, references[-1])
        out.append(FlowNetwork(law, network.stiffness, references[-1], slow))
    return tuple(out)
