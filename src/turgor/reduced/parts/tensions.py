"""Tensions: fibers that work in compression as in tension, by a few modes of their tension.

The modes of the displacement miss a little of each state, and stiff fibers resist every such miss: the whole model
would bend too little. So the second Piola–Kirchhoff tension S is a combination of modes, like the mean stress, and a
fiber fulfills its law as far as these modes see it (Hellinger and Reissner's principle):

    S = Σ σₖ θₖ,        ∫ θₖ (E(q) − E(S)) = 0,        E(q) = ½ (|t|² − 1),   E(S) = ½ (λ² − 1),   λ = 1 / (1 − S / k)

The left term of the condition is quadratic in q, so it is exact; the tension N = k (λ − 1) and S = N / λ.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.store.codec import SEVEN_DIGITS
from turgor.reduced.parts import kernels
from turgor.reduced.settings import TENSIONS

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Tensions:
    """Modes of the tension of fibers.

    Parameters
    ----------
    forms : (m, R, R) array
        ∫ θₖ E(q) is half of q̂ᵀ Fₖ q̂, with q̂ = (1, q).
    modes : (m, k) array
        θ at each piece.
    weights : (k,) array
        Reference length or area of each piece.
    stiffness : (k,) array
        Scaled.
    """

    forms: Array
    modes: Array = field(metadata=SEVEN_DIGITS)
    weights: Array = field(metadata=SEVEN_DIGITS)
    stiffness: Array = field(metadata=SEVEN_DIGITS)

    def at(self, q: Array) -> "TensionsAt | None":
        """Evaluate at coordinates (r,); None where no tension fits."""
        one = np.concatenate([[1.0], q])
        rows = self.forms @ one
        solved = self._solved(0.5 * rows @ one)
        return None if solved is None else TensionsAt(self, rows[:, 1:], *solved)

    def _solved(self, strains: Array) -> tuple[Array, Array, Array] | None:
        """Coordinates σ (m,) of the tension for ∫ θₖ E (m,), stretches (k,), and the inverse of ∂strains/∂σ.

        It is the smallest value of a convex function, which Newton's method finds while all stretches are finite.
        """
        shares, at_rest = self._at_rest
        own, share, change = np.zeros(len(strains)), np.zeros(len(self.weights)), at_rest @ strains
        for _ in range(TENSIONS.iterations):
            step = change @ shares
            last = np.abs(step).max() <= TENSIONS.tolerance
            while (share + step).max() >= TENSIONS.largest:
                change, step = 0.5 * change, 0.5 * step
            own, share = own + change, share + step
            stretch, own_strains, slopes = kernels.fiber_strains(share, shares, self.modes, self.weights)
            inverse = np.linalg.inv(slopes).astype(np.float64)
            if last:
                return own, stretch, inverse
            change = inverse @ (strains - own_strains)
            if not np.isfinite(change).all():
                return None
        return None

    @cached_property
    def _at_rest(self) -> tuple[Array, Array]:
        """Shares (m, k) of the stiffness that the modes are, and ∂σ/∂strains (m, m) without tension."""
        shares = self.modes / self.stiffness
        return shares, np.linalg.inv((shares * self.weights) @ self.modes.T).astype(np.float64)


@dataclass(frozen=True, slots=True, eq=False)
class TensionsAt:
    """Fibers at some coordinates: slopes (m, r) of the strains, σ (m,), stretches (k,), ∂σ/∂strains (m, m)."""

    tensions: Tensions
    slopes: Array
    own: Array
    stretch: Array
    stiff: Array

    def forces(self) -> Array:
        """Forces (r,)."""
        return np.asarray(self.own @ self.slopes)

    def energy(self) -> float:
        """½ k (λ − 1)² of every piece."""
        t = self.tensions
        return 0.5 * float((t.weights * t.stiffness) @ (self.stretch - 1) ** 2)

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r, r), with σ (m,) in its geometric part where it is given."""
        own = self.own if geometric is None else geometric
        turning = np.tensordot(own, self.tensions.forms[:, 1:, 1:], 1)
        return np.asarray(self.slopes.T @ self.stiff @ self.slopes + turning)

    def linearized(self, update: Array) -> Array:
        """σ (m,) linearized for an update (r,)."""
        return np.asarray(self.own + self.stiff @ (self.slopes @ update))
