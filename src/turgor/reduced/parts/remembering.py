"""Remembering: internal variables of rubber that relaxes or softens, at the sampled points alone."""

from collections.abc import Sequence
from dataclasses import replace
from math import inf
from typing import cast

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells import spectral
from turgor.core.engine.cells.internal_variables import Memory, RegionMemory, invariant_stress
from turgor.core.engine.cells.known_stress import add_known_stress
from turgor.core.materials.history.softening import INVARIANT_PAIRS
from turgor.core.materials.laws.derivatives import STRETCH_PAIRS, energy_and_derivatives, stretch_derivatives
from turgor.core.materials.laws.laws import InvariantLaw, Law
from turgor.core.materials.material import Material

Array = NDArray[np.float64]


def slow_memories(materials: Sequence[Material | None], counts: Sequence[int]) -> tuple[RegionMemory | None, ...]:
    """What points at rest bring into an infinitely slow step; None where the rubber remembers nothing."""
    return tuple(
        None if material is None else RegionMemory.of(material, (count, 1), None, "", inf)
        for material, count in zip(materials, counts, strict=True)
    )


def stepped(memory: RegionMemory, step: float) -> RegionMemory:
    """The same memory for a step of a length [s]."""
    its = Memory(
        stress={} if memory.stress is None else {"": memory.stress},
        largest={} if memory.largest is None else {"": memory.largest},
    )
    return RegionMemory.of(memory.material, (0, 1), its, "", step)


def advanced(memory: RegionMemory, F: Array) -> RegionMemory:
    """Memory (p, 1) at the end of a step, at deformation gradients (p, 3, 3)."""
    S, energy = _own_stress(memory, F[:, None])
    stress = None if memory.stress is None else memory.next_stress(S, F[:, None])
    largest = None if memory.largest is None else memory.next_largest(energy)
    return replace(memory, stress=stress, largest=largest)


def recoverable(memory: RegionMemory, density: Array) -> Array:
    """Energy density (p,) that infinitely slow unloading gives back, of that of the law."""
    return memory.recoverable(density[:, None])[:, 0]


def remembered(memory: RegionMemory, F: Array, scale: float, S: Array, D: Array) -> None:
    """Add the scaled stress (p, 1, 6) and tangent (p, 1, 21) that are known before a step, in place."""
    if memory.known is not None:
        add_known_stress(F[:, None], np.arange(len(F)), memory.known, scale, S, D)


def _own_stress(memory: RegionMemory, F: Array) -> tuple[Array, Array]:
    """Isochoric stress (p, 1, 6) of the softened law and energy density (p, 1) of the law [Pa]."""
    law = cast(Law, memory.material.law)
    bar, directions, scale = spectral.principal_stretches(F)
    if not isinstance(law, InvariantLaw):
        values = stretch_derivatives(law, *bar)
        W = np.ascontiguousarray(memory.softened(values, STRETCH_PAIRS))
        return spectral.spectral_response(bar, directions, scale, W[:3], W[3:])[0], values[0]
    I1 = (bar**2).sum(axis=0)
    I2 = (bar[0] * bar[1]) ** 2 + (bar[1] * bar[2]) ** 2 + (bar[0] * bar[2]) ** 2
    values = energy_and_derivatives(law, I1, I2)
    first = memory.softened(values, INVARIANT_PAIRS)
    return invariant_stress(first[0], first[1], F), values[0]
