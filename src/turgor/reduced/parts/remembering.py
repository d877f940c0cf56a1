"""Remembering: internal variables of rubber that relaxes or softens, at the sampled points alone."""

from collections.abc import Sequence
from dataclasses import replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.internal_variables import Memory, RegionMemory
from turgor.core.engine.cells.known_stress import add_known_stress
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
    S, energy = memory.own_stress(F[:, None])
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
