"""Internal variables: of rubber that relaxes, softens or sets, at the Gauss points of each region, and of friction.

A step in time has a length Δt. A `History` holds the internal variables of the last converged state and what they
contribute to a step of that length. With it the response is a plain function of the deformation, whatever is tried:
Newton's method, predictors and line searches may evaluate it in any order. What a state will remember is computed from
its evaluation alone (`turgor.core.engine.system.System.remembered`). The formulas are in
`turgor.core.materials.history`.

Δt = 0 is a sudden step, and at a state it gives that state's own stress. Δt = ∞ is a step as slow as can be, to the
relaxed equilibrium.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import inf
from types import MappingProxyType
from typing import cast

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells import spectral
from turgor.core.engine.cells.states.flow_networks import FlowNetwork, flow_at_rest, flow_networks, flows
from turgor.core.engine.contact.friction import Friction
from turgor.core.materials.history.isochoric import scaled_stress
from turgor.core.materials.history.softening import (
    INVARIANT_PAIRS,
    softened_derivatives,
    softening,
    softening_dissipation,
)
from turgor.core.materials.history.viscoelastic import memory_at_rest, next_memory, remembered_stress, step_factor
from turgor.core.materials.laws.derivatives import STRETCH_PAIRS, energy_and_derivatives, stretch_derivatives
from turgor.core.materials.laws.laws import Law, StretchLaw
from turgor.core.materials.material import Material
from turgor.foundation.display import brief
from turgor.foundation.symmetric import COLUMNS, ROWS

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Pairs = Sequence[tuple[int, int]]

#: No internal variables.
NOTHING: Mapping[str, Array] = MappingProxyType({})


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Memory:
    """Internal variables of a state: at the Gauss points of each region that relaxes or softens, and of friction.

    Parameters
    ----------
    stress : mapping of str to (n + 1, c, q, 6) array [Pa]
        Of regions with a Prony series of n terms: the stress of the law, then the internal stresses.
    largest : mapping of str to (c, q) array [Pa]
        Of regions that soften: the largest energy density of its history.
    friction : tuple of (FrictionHistory or None)
        Of each part of the contact; empty without friction.
    flow : mapping of str to (k, c, q, 10) array
        Of regions with k networks that flow: F_v⁻¹, and the plastic strain.
    bonds : mapping of str to array
        Of each bond at the points of its k sides, (2, k, q): damage, and energy per area [J/m²] that it has taken. Of
        each cable, by ``"cable "`` and its name: the phases of a shape-memory wire, or the friction at its guides.
    """

    stress: Mapping[str, Array]
    largest: Mapping[str, Array]
    friction: Friction = ()
    flow: Mapping[str, Array] = field(default_factory=dict)
    bonds: Mapping[str, Array] = field(default_factory=dict)

    __repr__ = brief

    @property
    def without_friction(self) -> "Memory | None":
        """Without friction; None where nothing else remembers."""
        return joined_memory(self.stress, self.largest, flow=self.flow, bonds=self.bonds)


@dataclass(frozen=True, slots=True, eq=False)
class RegionMemory:
    """Internal variables of one region at the last converged state, and what they contribute to a step.

    Parameters
    ----------
    material : Material
        What it is made of.
    step : float [s]
        Length of the step; 0 is a sudden one, infinite an infinitely slow one.
    stress : (n + 1, c, q, 6) array or None [Pa]
        See `Memory`; None where the material does not relax.
    largest : (c, q) array or None [Pa]
        See `Memory`; None where the material does not soften.
    factor : float
        Of the stress of the law in the step.
    known : (c, q, 6) array or None [Pa]
        Scaled isochoric stress that is known before the step, None where there is none.
    flow : (k, c, q, 10) array or None
        See `Memory`; None where no network flows.
    networks : tuple of FlowNetwork
        The networks that flow; the first one replaces the law where the material has a permanent set.
    """

    material: Material
    step: float
    stress: Array | None = None
    largest: Array | None = None
    factor: float = 1.0
    known: Array | None = None
    flow: Array | None = None
    networks: tuple[FlowNetwork, ...] = ()

    @staticmethod
    def of(material: Material, shape: tuple[int, int], memory: Memory | None, name: str, step: float) -> "RegionMemory":
        """That of a region of (c, q) cells and points, by its name in a memory; at rest where that is None."""
        stress = None if memory is None else memory.stress.get(name)
        largest = None if memory is None else memory.largest.get(name)
        flow = None if memory is None else memory.flow.get(name)
        series, factor, known = material.prony, 1.0, None
        if series is not None:
            stress = memory_at_rest(series, shape) if stress is None else stress
            factor = step_factor(series, step)
            known = None if step == inf else remembered_stress(series, step, stress)
        if material.stress_softening is not None:
            largest = np.zeros(shape) if largest is None else largest
        if not flows(material):
            return RegionMemory(material, step, stress, largest, factor, known)
        flow = flow_at_rest(material, shape) if flow is None else flow
        networks = flow_networks(material, flow, largest, step)
        return RegionMemory(material, step, stress, largest, factor, known, flow, networks)

    def softened(self, values: Sequence[Array], pairs: Pairs) -> Sequence[Array] | Array:
        """First and second derivatives of the energy with softening; ``values`` are the law's, its energy first."""
        mullins = self.material.stress_softening
        if mullins is None or self.largest is None:
            return values[1:]
        return softened_derivatives(*softening(mullins, values[0], self.largest), values[1:], pairs)

    def response(self, values: Sequence[Array], pairs: Pairs) -> Sequence[Array] | Array:
        """Derivatives that the step has, besides `known`; ``values`` as in `softened`."""
        softened = self.softened(values, pairs)
        return softened if self.factor == 1.0 else self.factor * np.stack(list(softened))

    def own_stress(self, F: Array) -> tuple[Array, Array]:
        """Isochoric stress (c, q, 6) of the softened law and energy density (c, q) of the law [Pa]."""
        law = cast(Law, self.material.law)
        bar, directions, scale = spectral.principal_stretches(F)
        if isinstance(law, StretchLaw):
            values = stretch_derivatives(law, *bar)
            W = np.ascontiguousarray(self.softened(values, STRETCH_PAIRS))
            return spectral.spectral_response(bar, directions, scale, W[:3], W[3:])[0], values[0]
        I1 = (bar**2).sum(axis=0)
        I2 = (bar[0] * bar[1]) ** 2 + (bar[1] * bar[2]) ** 2 + (bar[0] * bar[2]) ** 2
        values = energy_and_derivatives(law, I1, I2)
        first = self.softened(values, INVARIANT_PAIRS)
        return invariant_stress(first[0], first[1], F), values[0]

    def add_flow(self, F: Array, rows: Ints, scale: float, out: tuple[Array, Array]) -> None:
        """Add stress and tangent of the networks that flow, over a scale, in place.

        ``rows`` (c,) are the places of the region in ``F`` (s, q, 3, 3) and in ``out`` (s, q, 6) and (s, q, 21).
        """
        for network in self.networks:
            for total, part in zip(out, network.response(F[rows]), strict=True):
                total[rows] += part / scale

    def next_stress(self, S: Array, F: Array) -> Array:
        """Memory of the stress at the end of the step; ``S`` (c, q, 6) [Pa] is that of the softened law."""
        series = self.material.prony
        assert series is not None and self.stress is not None
        return next_memory(series, self.step, self.stress, scaled_stress(S, right_cauchy_green(F)))

    def next_flow(self, F: Array) -> Array:
        """Internal variables (k, c, q, 10) of the networks at the end of the step."""
        return np.stack([network.end(F) for network in self.networks])

    def next_largest(self, energy: Array) -> Array:
        """Largest energy density at the end of the step."""
        assert self.largest is not None
        return np.maximum(self.largest, energy)

    def lost(self, memory: Memory, name: str) -> Array | float:
        """Energy density [Pa] that softening and permanent set take on the way to a memory of the region."""
        mullins, series, plastic = self.material.stress_softening, self.material.prony, self.material.permanent_set
        lost: Array | float = 0.0
        if mullins is not None and name in memory.largest:
            lost = softening_dissipation(mullins, memory.largest[name])
        if plastic is not None and name in memory.flow:
            lost = lost + plastic.work(memory.flow[name][0, ..., 9])
        return lost if series is None else series.instantaneous * series.relaxed * lost

    def recoverable(self, energy: Array) -> Array:
        """Energy density [Pa] that infinitely slow unloading gives back, of the law's energy density."""
        out, mullins, series = energy, self.material.stress_softening, self.material.prony
        if mullins is not None and self.largest is not None:
            top = np.maximum(self.largest, energy)
            out = energy - softening_dissipation(mullins, top) + _lost_above(self.material, energy, top)
        return out if series is None else np.asarray(series.instantaneous * series.relaxed * out)


@dataclass(frozen=True, slots=True, eq=False)
class History:
    """Converged history: what a state brings into a step, an argument of `System.evaluate`.

    `turgor.core.engine.system.System.history` makes one.

    Parameters
    ----------
    regions : mapping of str to RegionMemory
        Of each region that relaxes or softens.
    friction : tuple of (FrictionHistory or None)
        Of each part of the contact, from which its points slip; empty without friction.
    bonds : mapping of str to array
        Of each bond and cable; see `Memory`.
    """

    regions: Mapping[str, RegionMemory]
    friction: Friction = ()
    bonds: Mapping[str, Array] = field(default_factory=dict)

    @property
    def memory(self) -> Memory | None:
        """Internal variables of the state from which the step goes; None where there are none."""
        return joined_memory(
            {name: each.stress for name, each in self.regions.items() if each.stress is not None},
            {name: each.largest for name, each in self.regions.items() if each.largest is not None},
            self.friction,
            {name: each.flow for name, each in self.regions.items() if each.flow is not None},
            self.bonds,
        )


def joined_memory(
    stress: Mapping[str, Array],
    largest: Mapping[str, Array],
    friction: Friction = (),
    flow: Mapping[str, Array] = NOTHING,
    bonds: Mapping[str, Array] = NOTHING,
) -> Memory | None:
    """The memory of all regions, contacts and bonds, None where there is none."""
    if not (stress or largest or friction or flow or bonds):
        return None
    return Memory(stress=stress, largest=largest, friction=friction, flow=flow, bonds=bonds)


def bonds_of(memory: Memory | None) -> Mapping[str, Array]:
    """The internal variables of bonds and cables in a memory; empty where there are none."""
    return NOTHING if memory is None else memory.bonds


def friction_of(memory: Memory | None) -> Friction:
    """The friction history in a memory; empty where there is none."""
    return () if memory is None else memory.friction


def _lost_above(material: Material, energy: Array, top: Array) -> Array:
    """(1/r) ∫ erf((W_m − W)/(m + β W_m)) dW from W to W_m."""
    from scipy.special import erf

    mullins = material.stress_softening
    assert mullins is not None
    width, gap = mullins.m + mullins.beta * top, top - energy
    x = np.divide(gap, width, out=np.zeros_like(gap), where=width > 0)
    return np.asarray((gap * erf(x) + width / np.sqrt(np.pi) * np.expm1(-(x**2))) / mullins.r)


def right_cauchy_green(F: Array) -> Array:
    """C = Fᵀ F as components 11 22 33 12 23 13, (..., 6)."""
    C = F.swapaxes(-1, -2) @ F
    return np.ascontiguousarray(C[..., ROWS, COLUMNS])


def invariant_stress(W1: Array, W2: Array, F: Array) -> Array:
    """Isochoric second Piola–Kirchhoff stress (..., 6) of a law in invariants, from its first derivatives."""
    C = F.swapaxes(-1, -2) @ F
    J = np.linalg.det(F)
    j = J ** (-2.0 / 3.0)
    inverse, identity = np.linalg.inv(C), np.eye(3)
    I1 = np.trace(C, axis1=-2, axis2=-1)
    I2 = 0.5 * (I1**2 - np.einsum("...ij,...ij->...", C, C))
    first = identity - (I1 / 3.0)[..., None, None] * inverse
    second = I1[..., None, None] * identity - C - (2.0 * I2 / 3.0)[..., None, None] * inverse
    S = 2.0 * ((W1 * j)[..., None, None] * first + (W2 * j * j)[..., None, None] * second)
    return np.ascontiguousarray(S[..., ROWS, COLUMNS])
