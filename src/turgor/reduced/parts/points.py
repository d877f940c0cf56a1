"""Points: Gauss points with weights, at which the isochoric energy of the rubber is evaluated."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from typing import cast

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells import spectral
from turgor.core.engine.cells.internal_variables import RegionMemory
from turgor.core.materials.history.softening import INVARIANT_PAIRS
from turgor.core.materials.laws.derivatives import STRETCH_PAIRS, energy_and_derivatives, stretch_derivatives
from turgor.core.materials.laws.laws import InvariantLaw, Law
from turgor.core.materials.material import Material
from turgor.foundation.store.codec import SIX_DIGITS
from turgor.reduced.parts import kernels
from turgor.reduced.parts.remembering import advanced, recoverable, remembered, slow_memories, stepped

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Points:
    """Gauss points, those of one law one after the other.

    Parameters
    ----------
    gradients : (p, 9, r) array
        Displacement gradients of the modes.
    weights : (p,) array
        Scaled volumes.
    laws : tuple of Law
    starts : (laws + 1,) int array
        Where the points of each law begin, and the end.
    stress : float [Pa]
        Scale of stresses.
    materials : tuple of (Material or None)
        Of each law, where it relaxes or softens; empty where none does.
    memories : tuple of (RegionMemory or None)
        What the points of each law bring into a step; empty for an infinitely slow one from rest.
    """

    gradients: Array = field(metadata=SIX_DIGITS)
    weights: Array
    laws: tuple[Law, ...]
    starts: Ints
    stress: float
    materials: tuple[Material | None, ...] = ()
    memories: tuple[RegionMemory | None, ...] = ()

    def chosen(self, which: Ints, weights: Array) -> "Points":
        """Return some of the points in rising order with other weights."""
        starts = np.searchsorted(which, self.starts)
        return Points(
            np.ascontiguousarray(self.gradients[which]), weights, self.laws, starts, self.stress, self.materials
        )

    def at(self, q: Array) -> "PointsAt | None":
        """Evaluate the laws at reduced coordinates; None where a point is turned inside out or beyond its law."""
        F = (self.gradients.reshape(-1, len(q)) @ q).reshape(-1, 3, 3)
        F += np.eye(3)
        I1, I2 = kernels.invariants(F)
        if not np.isfinite(I1).all():
            return None
        S, D = self._stresses(F, I1, I2)
        return PointsAt(self, F, S, D) if np.isfinite(S).all() else None

    def _stresses(self, F: Array, I1: Array, I2: Array) -> tuple[Array, Array]:
        W, rows = np.zeros((5, len(F))), np.full(len(F), -1, dtype=np.int64)
        more: list[tuple[Array, Array]] = [(np.empty((0, 6)), np.empty((0, spectral.TANGENT)))]
        for (law, here), memory in zip(self.groups, self.brought, strict=True):
            if _in_invariants(law):  # type: ignore[arg-type]
                given = energy_and_derivatives(cast(InvariantLaw, law), I1[here], I2[here])
                for k, values in enumerate(_response(memory, given, INVARIANT_PAIRS)):
                    W[k, here] = values / self.stress
                if memory is None or memory.known is None:
                    continue
                S, D = np.zeros((len(F[here]), 1, 6)), np.zeros((len(F[here]), 1, spectral.TANGENT))
            else:
                bar, directions, scale = spectral.principal_stretches(F[here][:, None])
                in_stretches = _response(memory, stretch_derivatives(law, *bar), STRETCH_PAIRS)
                slopes = np.ascontiguousarray(in_stretches) / self.stress
                S, D = spectral.spectral_response(bar, directions, scale, slopes[:3], slopes[3:])
            if memory is not None:
                remembered(memory, F[here], self.stress, S, D)
            rows[here] = sum(len(each[0]) for each in more) + np.arange(len(S))
            more.append((S[:, 0], D[:, 0]))
        stress, moduli = (np.ascontiguousarray(np.concatenate(each)) for each in zip(*more, strict=True))
        return kernels.stresses(F, W, rows, stress, moduli)

    @property
    def brought(self) -> tuple[RegionMemory | None, ...]:
        """What the points of each law that has points bring into the step."""
        if not self.materials:
            return (None,) * len(self.groups)
        counts = np.diff(self.starts)
        every = self.memories or slow_memories(self.materials, counts.tolist())
        return tuple(memory for memory, count in zip(every, counts, strict=True) if count)

    def stepped(self, step: float) -> "Points":
        """The same points and memory for a step of a length [s]."""
        every = self.memories or slow_memories(self.materials, np.diff(self.starts).tolist())
        return replace(self, memories=tuple(None if each is None else stepped(each, step) for each in every))

    @property
    def groups(self) -> Sequence[tuple[Law, slice]]:
        """Each law with its points."""
        ends = zip(self.laws, self.starts[:-1], self.starts[1:], strict=True)
        return [(law, slice(a, b)) for law, a, b in ends if b > a]

    @cached_property
    def short(self) -> NDArray[np.float32]:
        """The gradients with seven digits, enough for a tangent and twice as fast."""
        return self.gradients.astype(np.float32)

    @property
    def whole(self) -> Ints:
        """One group of all points."""
        return np.array([0, len(self.weights)])


def _response(
    memory: RegionMemory | None, values: Sequence[Array], pairs: Sequence[tuple[int, int]]
) -> Sequence[Array] | Array:
    """Derivatives (p,) of the energy in the step, first and second; ``values`` are the law's, its energy first."""
    if memory is None:
        return values[1:]
    if values[0].ndim > 1:
        return memory.response(values, pairs)
    return np.stack(list(memory.response([each[:, None] for each in values], pairs)))[..., 0]


@cache
def _in_invariants(law: Law) -> bool:
    """Whether the energy of a law is one of invariants; the look at its protocol takes as long as a tangent."""
    return isinstance(law, InvariantLaw)


@dataclass(frozen=True, slots=True, eq=False)
class PointsAt:
    """Isochoric stresses at the points.

    Parameters
    ----------
    points : Points
    F : (p, 3, 3) array
    S, D : (p, 6), (p, 6, 6) arrays
        Second Piola–Kirchhoff stress and 4 ∂²W/∂C².
    """

    points: Points
    F: Array
    S: Array
    D: Array

    def energy(self) -> float:
        """Isochoric energy."""
        p, out = self.points, 0.0
        I1, I2 = kernels.invariants(self.F)
        for (law, here), memory in zip(p.groups, p.brought, strict=True):
            if _in_invariants(law):  # type: ignore[arg-type]
                density = energy_and_derivatives(cast(InvariantLaw, law), I1[here], I2[here])[0]
            else:
                bar, _, _ = spectral.principal_stretches(self.F[here][:, None])
                density = stretch_derivatives(law, *bar)[0][:, 0]
            density = density if memory is None else recoverable(memory, density)
            out += float(p.weights[here] @ density) / p.stress
        return out

    def remembered(self) -> Points:
        """The points with their memory at the end of the step."""
        p, new = self.points, []
        for memory, start, end in zip(p.memories, p.starts[:-1], p.starts[1:], strict=True):
            new.append(memory if memory is None or start == end else advanced(memory, self.F[start:end]))
        return replace(p, memories=tuple(new))

    def forces(self, starts: Ints | None = None) -> Array:
        """Forces (r,) on the reduced coordinates, or (g, r) of groups of points."""
        p = self.points
        whole = np.asarray(
            kernels.forces(self.F, self.S, p.weights, p.gradients, p.whole if starts is None else starts)
        )
        return whole[0] if starts is None else whole

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r, r), with the stress (p, 6) in its geometric part where it is given."""
        S = self.S if geometric is None else geometric
        G = self.points.short
        out = kernels.stiffened(self.F, S, self.D, self.points.weights, G)
        return np.asarray(G.reshape(-1, G.shape[2]).T @ out.reshape(-1, G.shape[2]), dtype=np.float64)

    def linearized(self, update: Array) -> Array:
        """Stress (p, 6) linearized for an update (r,), for the next geometric part."""
        dF = (self.points.gradients.reshape(-1, len(update)) @ update).reshape(-1, 3, 3)
        return np.asarray(kernels.linearized(self.F, dF, self.S, self.D))
