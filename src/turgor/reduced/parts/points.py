"""Points: Gauss points with weights, at which the isochoric energy of the rubber is evaluated."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import cast

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells import spectral
from turgor.core.materials.laws.derivatives import energy_and_derivatives, stretch_derivatives
from turgor.core.materials.laws.laws import InvariantLaw, Law
from turgor.reduced.parts import kernels

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
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
    """

    gradients: Array
    weights: Array
    laws: tuple[Law, ...]
    starts: Ints
    stress: float

    def chosen(self, which: Ints, weights: Array) -> "Points":
        """Return some of the points in rising order with other weights."""
        starts = np.searchsorted(which, self.starts)
        return Points(np.ascontiguousarray(self.gradients[which]), weights, self.laws, starts, self.stress)

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
        for law, here in self.groups:
            if _in_invariants(law):  # type: ignore[arg-type]
                for k, values in enumerate(energy_and_derivatives(cast(InvariantLaw, law), I1[here], I2[here])[1:]):
                    W[k, here] = values / self.stress
                continue
            bar, directions, scale = spectral.principal_stretches(F[here][:, None])
            slopes = np.ascontiguousarray(stretch_derivatives(law, *bar)[1:]) / self.stress
            S, D = spectral.spectral_response(bar, directions, scale, slopes[:3], slopes[3:])
            rows[here] = sum(len(each[0]) for each in more) + np.arange(len(S))
            more.append((S[:, 0], D[:, 0]))
        stress, moduli = (np.ascontiguousarray(np.concatenate(each)) for each in zip(*more, strict=True))
        return kernels.stresses(F, W, rows, stress, moduli)

    @property
    def groups(self) -> Sequence[tuple[Law, slice]]:
        """Each law with its points."""
        ends = zip(self.laws, self.starts[:-1], self.starts[1:], strict=True)
        return [(law, slice(a, b)) for law, a, b in ends if b > a]

    @property
    def whole(self) -> Ints:
        """One group of all points."""
        return np.array([0, len(self.weights)])


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
        for law, here in p.groups:
            if _in_invariants(law):  # type: ignore[arg-type]
                density = energy_and_derivatives(cast(InvariantLaw, law), I1[here], I2[here])[0]
            else:
                bar, _, _ = spectral.principal_stretches(self.F[here][:, None])
                density = stretch_derivatives(law, *bar)[0][:, 0]
            out += float(p.weights[here] @ density) / p.stress
        return out

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
        G = self.points.gradients
        out = kernels.stiffened(self.F, S, self.D, self.points.weights, G)
        return np.asarray(G.reshape(-1, G.shape[2]).T @ out.reshape(-1, G.shape[2]))

    def linearized(self, update: Array) -> Array:
        """Stress (p, 6) linearized for an update (r,), for the next geometric part."""
        dF = (self.points.gradients.reshape(-1, len(update)) @ update).reshape(-1, 3, 3)
        return np.asarray(kernels.linearized(self.F, dF, self.S, self.D))
