"""Polynomials of the reduced coordinates: volumes of cavities, the volume constraint, Hooke's sheets.

Positions are linear in the coordinates q, so with q̂ = (1, q) a volume is the cubic Σ Tᵢⱼₖ q̂ᵢ q̂ⱼ q̂ₖ, and so is
∫ ψ (J − 1) dV for each mode ψ of the mean stress. The strain of a sheet is quadratic, its energy quartic: half a
quadratic form of the products q̂ᵢ q̂ⱼ.
"""

from dataclasses import dataclass, field
from functools import cached_property
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.store.codec import SEVEN_DIGITS

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Cubics:
    """Cubic polynomials.

    Parameters
    ----------
    packed : (p, triples) array
        Entries i ≤ j ≤ k of the symmetric coefficients T, one row of i and j after another.
    size : int
        R, one more than there are coordinates.
    """

    packed: Array = field(metadata=SEVEN_DIGITS)
    size: int

    def at(self, q: Array) -> "CubicsAt":
        """Values and derivatives at coordinates (r,)."""
        one = np.concatenate([[1.0], q])
        upper, place = self._rows
        twice = (one @ upper).reshape(-1, len(self.packed))[place]
        once = one @ twice
        return CubicsAt(one @ once, 3.0 * once[1:].T, twice)

    @cached_property
    def _rows(self) -> tuple[Array, Ints]:
        """Coefficients (R, pairs i ≤ j times p), and the pair (R, R) of any i and j."""
        R = self.size
        i, j, k = triples(R)
        at = np.empty((R, R, R), dtype=np.int64)
        for a, b, c in permutations((i, j, k)):
            at[a, b, c] = np.arange(len(i))
        upper = np.triu_indices(R)
        place = np.empty((R, R), dtype=np.int64)
        place[upper] = place.T[upper] = np.arange(len(upper[0]))
        return np.ascontiguousarray(self.packed.T[at[upper].T].reshape(R, -1)), place


@dataclass(frozen=True, slots=True, eq=False)
class CubicsAt:
    """Values (p,) and gradients (p, r) of cubic polynomials, and Σₖ Tᵢⱼₖ q̂ₖ (R, R, p)."""

    values: Array
    gradients: Array
    twice: Array

    def hessian(self, factors: Array) -> Array:
        """Σ factorₚ times the Hessian of polynomial p, (r, r)."""
        return 6.0 * (self.twice @ factors)[1:, 1:]


@dataclass(frozen=True, eq=False)
class Sheets:
    """Energy ½ zᵀ D z of sheets, z the products q̂ᵢ q̂ⱼ with i ≤ j.

    Parameters
    ----------
    form : (n, n) array
        D.
    size : int
        R, one more than there are coordinates.
    """

    form: Array
    size: int

    def at(self, q: Array) -> "SheetsAt":
        """Stress and its derivatives at coordinates (r,)."""
        i, j = self.pairs
        one = np.concatenate([[1.0], q])
        stress = self.form @ (one[i] * one[j])
        return SheetsAt(self, one, stress, self.slopes(one))

    def slopes(self, one: Array) -> Array:
        """Derivatives (n, r) of the products by the coordinates, for q̂ (R,)."""
        i, j = self.pairs
        slopes = np.zeros((len(i), self.size))
        slopes[np.arange(len(i)), i] += one[j]
        slopes[np.arange(len(i)), j] += one[i]
        return np.ascontiguousarray(slopes[:, 1:])

    @cached_property
    def pairs(self) -> tuple[Ints, Ints]:
        """Which i and j each product has."""
        return np.triu_indices(self.size)

    def full(self, stress: Array) -> Array:
        """Symmetric (R, R) matrix Σ whose quadratic form q̂ᵀ Σ q̂ is zᵀ stress."""
        out = np.zeros((self.size, self.size))
        out[self.pairs] = stress
        return 0.5 * (out + out.T)


@dataclass(frozen=True, slots=True, eq=False)
class SheetsAt:
    """Sheets at coordinates: q̂, the stress D z, and the slopes ∂z/∂q."""

    sheets: Sheets
    one: Array
    stress: Array
    slopes: Array

    def energy(self) -> float:
        """Energy."""
        i, j = self.sheets.pairs
        return 0.5 * float(self.stress @ (self.one[i] * self.one[j]))

    def forces(self) -> Array:
        """Forces (r,)."""
        return self.stress @ self.slopes

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r, r), with the stress (n,) in its geometric part where it is given."""
        stress = self.stress if geometric is None else geometric
        return self.slopes.T @ (self.sheets.form @ self.slopes) + 2.0 * self.sheets.full(stress)[1:, 1:]

    def linearized(self, update: Array) -> Array:
        """Stress (n,) linearized for an update (r,)."""
        return self.stress + self.sheets.form @ (self.slopes @ update)


def triples(R: int) -> Ints:
    """Numbers (3, triples) i ≤ j ≤ k below R, in the order of the entries of cubic polynomials."""
    return np.array([(i, j, k) for i in range(R) for j in range(i, R) for k in range(j, R)]).T


def packed(forms: Array) -> Array:
    """Entries (p, triples) of symmetric forms (p, R, R, R)."""
    i, j, k = triples(forms.shape[1])
    return np.ascontiguousarray(forms[:, i, j, k])
