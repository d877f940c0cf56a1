"""Moments of the lost volume, whose squares are penalized in hexahedra (`turgor.core.engine.cells.stabilization`).

A moment ∫ φ (J − 1 − p/κ) dV is a cubic polynomial of the coordinates q of the displacement, less a linear function of
those of the mean stress, s. The energy is half the sum of their squares over all cells. On states of one actuator these
moments are combinations of a few.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.store.codec import SEVEN_DIGITS
from turgor.reduced.parts.polynomials import Cubics, CubicsAt

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Moments:
    """Moments C(q̂) + L s, with the energy ½ Σ moment².

    Parameters
    ----------
    packed : (k, triples) array
        Coefficients of the cubic polynomials, i ≤ j ≤ k.
    slopes : (k, m) array
        L.
    """

    packed: Array = field(metadata=SEVEN_DIGITS)
    slopes: Array

    @cached_property
    def cubics(self) -> Cubics:
        """The cubic polynomials."""
        size = 1
        while size * (size + 1) * (size + 2) // 6 < self.packed.shape[1]:
            size += 1
        return Cubics(np.ascontiguousarray(self.packed), size)

    def at(self, y: Array) -> "MomentsAt":
        """Evaluate at unknowns (r + m,)."""
        split = len(y) - self.slopes.shape[1]
        cubics = self.cubics.at(y[:split])
        return MomentsAt(self, cubics, cubics.values + self.slopes @ y[split:])

    def combined(self, places: Sequence[Array], tolerance: float) -> "Moments":
        """Combine them into the few that make up nearly all of them, and of their gradients, at some unknowns.

        Parameters
        ----------
        places : sequence of (r + m,) arrays
        tolerance : float
            Share of moments and gradients that may be missed.
        """
        size = len(places[0])
        spread = np.abs(places).max(axis=0)
        columns = [np.column_stack([at.values, at.gradients * spread]) for at in map(self.at, places)]
        turns, values, _ = np.linalg.svd(np.hstack(columns), full_matrices=False)
        missed = 1.0 - np.cumsum(values**2) / max(float((values**2).sum()), 1e-300)
        count = min(len(values), int(np.searchsorted(-missed, -(tolerance**2))) + 1, 8 * size)
        turn = turns[:, :count].T
        return Moments(turn @ self.packed, turn @ self.slopes)


@dataclass(frozen=True, slots=True, eq=False)
class MomentsAt:
    """Moments at some unknowns: their polynomials, and their values (k,)."""

    moments: Moments
    cubics: CubicsAt
    values: Array

    @property
    def gradients(self) -> Array:
        """Derivatives (k, r + m) of the moments."""
        return np.hstack([self.cubics.gradients, self.moments.slopes])

    def forces(self) -> Array:
        """Forces (r + m,)."""
        return self.values @ self.gradients

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r + m, r + m), with given moments in its geometric part."""
        gradients, r = self.gradients, self.cubics.gradients.shape[1]
        out = gradients.T @ gradients
        out[:r, :r] += self.cubics.hessian(self.values if geometric is None else geometric)
        return out

    def linearized(self, update: Array) -> Array:
        """Moments (k,) linearized for an update (r + m,)."""
        return self.values + self.gradients @ update
