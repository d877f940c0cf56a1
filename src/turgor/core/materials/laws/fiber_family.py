"""Fibers in a body: the energy of a family of them, and its stress and tangent.

A family is a constant tensor H = κ 1 + (1 − 3κ) a⊗a of the body at rest, with a mean direction a and a dispersion κ.
Its energy is a function of E = H : C̄ − 1 with C̄ = J^(−2/3) C. For κ = 0 this is the squared isochoric stretch along a,
less 1.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.history.isochoric import isochoric_stress, isochoric_tangent
from turgor.foundation.symmetric import COLUMNS, ROWS

Array = NDArray[np.float64]

_TWICE = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])


@dataclass(frozen=True, slots=True, kw_only=True)
class Family:
    """A family of fibers of energy (k₁/2k₂) (exp(k₂ E²) − 1), or ½ k₁ E² where k₂ is 0.

    Parameters
    ----------
    direction : (float, float, float) [-]
        Unit vector by the three directions of the material.
    k1 : float [Pa]
        Stiffness.
    k2 : float [-]
        Stiffening.
    kappa : float [-]
        Dispersion: 0 for parallel fibers, 1/3 for those of all directions alike.
    tension : bool
        Whether the fibers bear tension only: nothing where E < 0.
    """

    direction: tuple[float, float, float]
    k1: float
    k2: float = 0.0
    kappa: float = 0.0
    tension: bool = False

    def tensor(self, frames: Array) -> Array:
        """H (..., 6), components 11 22 33 12 23 13, in frames (..., 3, 3) whose rows are the directions."""
        a = np.einsum("i,...ij->...j", np.array(self.direction), frames)
        H = (1 - 3 * self.kappa) * a[..., :, None] * a[..., None, :] + self.kappa * np.eye(3)
        return np.ascontiguousarray(H[..., ROWS, COLUMNS])

    def energy(self, E: Array) -> tuple[Array, Array, Array]:
        """Energy [Pa] and its first two derivatives by E."""
        if self.k2 == 0:
            W, slope, bend = 0.5 * self.k1 * E**2, self.k1 * E, np.full_like(E, self.k1)
        else:
            with np.errstate(over="ignore"):  # a trial far away; its stress is infinite, and the step is rejected
                grown = np.exp(self.k2 * E**2)
                W, slope = self.k1 / (2 * self.k2) * (grown - 1), self.k1 * E * grown
                bend = self.k1 * (1 + 2 * self.k2 * E**2) * grown
        if not self.tension:
            return W, slope, bend
        pulled = E > 0
        return np.where(pulled, W, 0.0), np.where(pulled, slope, 0.0), np.where(pulled, bend, 0.0)


def elongation(H: Array, C: Array) -> Array:
    """E = H : C̄ − 1 (...) of tensors (..., 6)."""
    determinant = (
        C[..., 0] * (C[..., 1] * C[..., 2] - C[..., 4] ** 2)
        - C[..., 3] * (C[..., 3] * C[..., 2] - C[..., 4] * C[..., 5])
        + C[..., 5] * (C[..., 3] * C[..., 4] - C[..., 1] * C[..., 5])
    )
    return np.asarray((H * C) @ _TWICE / np.cbrt(determinant) - 1)


def family_response(family: Family, H: Array, C: Array) -> tuple[Array, Array]:
    """Second Piola–Kirchhoff stress (..., 6) and tangent 4 ∂²W/∂C², lower triangles (..., 21), of a family [Pa].

    Parameters
    ----------
    family : Family
    H : (..., 6) array [-]
        Its tensors.
    C : (..., 6) array [-]
        Right Cauchy–Green tensors.

    Examples
    --------
    >>> along_x, stretched = np.array([1.0, 0, 0, 0, 0, 0]), np.array([4.0, 0.5, 0.5, 0, 0, 0])  # E = 3
    >>> S, _ = family_response(Family(direction=(1, 0, 0), k1=10.0), along_x, stretched)
    >>> S  # 2 k₁ E (1 − ⅓) along, −2 k₁ E ⅓ λ²/λ₂² across
    array([  40., -160., -160.,    0.,    0.,    0.])
    """
    _, slope, bend = family.energy(elongation(H, C))
    by_C = isochoric_stress(H, C)
    tangent = 2.0 * slope[..., None] * isochoric_tangent(H, C)
    at = 0
    for v in range(6):
        for w in range(v + 1):
            tangent[..., at] += 4.0 * bend * by_C[..., v] * by_C[..., w]
            at += 1
    return 2.0 * slope[..., None] * by_C, tangent
