"""Tension field: a sheet that wrinkles instead of bearing compression.

The wrinkles of a thin sheet are too small for a mesh, and they shorten it at hardly any cost. The energy per area is
therefore the least that any added shortening A reaches, with Green's strain E and a positive semidefinite A (Pipkin
1986, doi 10.1093/imamat/36.1.85; Steigmann 1990, doi 10.1098/rspa.1990.0055):

    W(E) = min ½ h (E + A) : ℂ : (E + A)
         = ½ Y h ⟨e₁⟩² + ½ Y h / (1 − ν²) ⟨e₂ + ν e₁⟩²

for an isotropic sheet of Young's modulus Y with principal strains e₁ ≥ e₂; ⟨x⟩ = max(x, 0). Where e₂ + ν e₁ ≥ 0 the
sheet is taut. Below that it is wrinkled, with the uniaxial tension Y h e₁ along its wrinkles. Where e₁ ≤ 0 it is slack.
W is convex in E, so wrinkles as short as the edges of the mesh gain nothing.

Two small numbers keep Newton's method regular. The stiffness of a sheet that is a million times stiffer than the rubber
would jump between its states, and the updates would cycle among them: it rises over a toe of strains instead, as that
of crimped fibers does. ⟨x⟩² becomes ⟨x⟩³/(3 t) up to the toe t, and ⟨x⟩² − t ⟨x⟩ + t²/3 beyond it. A toe of (1 + ν) t
for the second term keeps the sheet isotropic. And a share of the usual energy is added.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.settings import TENSION_FIELD
from turgor.core.engine.faces.sheet_moduli import strain_turn
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class TensionField:
    """An isotropic sheet that wrinkles.

    Parameters
    ----------
    moduli : (3, 3) array
        Plane-stress moduli times thickness, between E₁₁, E₂₂, 2 E₁₂ and the stresses.
    share : float
        Share of the stiffness that works in compression, 0 to 1.
    toe : float
        Strain over which the stiffness rises from zero, more than 0.
    """

    moduli: Array
    share: float
    toe: float

    def stress(self, strain: Array) -> Array:
        """Second Piola–Kirchhoff stress times thickness (..., 3) of Green's strain E₁₁, E₂₂, 2 E₁₂ (..., 3)."""
        e1, e2, turn = _principal(strain)
        s1, s2 = self._principal_stresses(e1, e2)
        relaxed = s1[..., None] * turn[..., 0, :] + s2[..., None] * turn[..., 1, :]
        return np.asarray((1 - self.share) * relaxed + self.share * strain @ self.moduli)

    def energy(self, strain: Array) -> Array:
        """Energy per area (...) of a strain (..., 3)."""
        e1, e2, _ = _principal(strain)
        along, across = _Ramp(e1, self.toe), _Ramp(e2 + self._poisson * e1, self._toe_across)
        relaxed = self._young * along.energy + self.moduli[0, 0] * across.energy
        whole = 0.5 * np.einsum("...i,ij,...j->...", strain, self.moduli, strain)
        return np.asarray((1 - self.share) * relaxed + self.share * whole)

    def tangent(self, strain: Array) -> Array:
        """Derivative (..., 3, 3) of the stress by the strain (..., 3): symmetric, positive definite with a share."""
        e1, e2, turn = _principal(strain)
        nu, s1, s2 = self._poisson, *self._principal_stresses(e1, e2)
        along = self._young * _Ramp(e1, self.toe).slope
        across = self.moduli[0, 0] * _Ramp(e2 + nu * e1, self._toe_across).slope
        by_strain = np.zeros((*e1.shape, 3, 3))
        by_strain[..., 0, 0] = along + nu**2 * across
        by_strain[..., 0, 1] = by_strain[..., 1, 0] = nu * across
        by_strain[..., 1, 1] = across
        apart = e1 - e2
        alike = apart <= ROUND_OFF.same * (np.abs(e1) + self.toe)
        shear = self.moduli[2, 2] * along / self._young  # the limit of equal strains
        by_strain[..., 2, 2] = np.where(alike, shear, 0.5 * (s1 - s2) / np.where(alike, 1.0, apart))
        relaxed = np.swapaxes(turn, -1, -2) @ by_strain @ turn
        return np.asarray((1 - self.share) * relaxed + self.share * self.moduli)

    def linearized_about(self, stress: Array, strain: Array) -> Array:
        """Strain to linearize about, where linearized stress and strain no longer belong to each other.

        The strain ε with S(ε) + a ℂ : ε = stress + a ℂ : strain, from a small weight a. A stiff sheet is judged by its
        stress, as where tension is released; a slack one by its strain. Each principal direction has a closed form.

        Parameters
        ----------
        stress, strain : (..., 3) arrays
            Stress times thickness, and Green's strain.

        Returns
        -------
        (..., 3) array
            E₁₁, E₂₂, 2 E₁₂. A pair that lies on the curve is returned unchanged.
        """
        weight, rest, nu = TENSION_FIELD.strain_weight / self.moduli[0, 0], 1 - self.share, self._poisson
        slope = (self.share + weight) / rest
        s1, s2, turn = _principal((stress + weight * strain @ self.moduli) / rest * (1, 1, 2))
        e1 = _Ramp.solved((s1 - nu * s2) / self._young, slope, self.toe)
        e2 = _Ramp.solved(s2 / self.moduli[0, 0], slope, self._toe_across) - nu * e1
        return np.asarray((e1[..., None] * turn[..., 0, :] + e2[..., None] * turn[..., 1, :]) * (1, 1, 2))

    def _principal_stresses(self, e1: Array, e2: Array) -> tuple[Array, Array]:
        across = self.moduli[0, 0] * _Ramp(e2 + self._poisson * e1, self._toe_across).value
        return self._young * _Ramp(e1, self.toe).value + self._poisson * across, across

    @property
    def _poisson(self) -> float:
        return float(self.moduli[0, 1] / self.moduli[0, 0])

    @property
    def _young(self) -> float:
        """Young's modulus times thickness."""
        return float(self.moduli[0, 0] * (1 - self._poisson**2))

    @property
    def _toe_across(self) -> float:
        return self.toe * (1 + self._poisson)


def tension_field(moduli: Array, compression: float, *, alone: bool = False) -> TensionField:
    """Make the tension field of scaled moduli times thickness, and of the share that works in compression.

    It is ``alone`` where the mesh has no rubber.
    """
    if alone:
        return TensionField(moduli, max(compression, TENSION_FIELD.film_share), TENSION_FIELD.film_toe)
    stiffness = float(moduli[0, 0])
    share = max(compression, min(TENSION_FIELD.largest_share, TENSION_FIELD.slack_stiffness / stiffness))
    return TensionField(moduli, share, min(TENSION_FIELD.toe_per_stiffness * stiffness, TENSION_FIELD.longest_toe))


class _Ramp:
    """⟨x⟩ with a toe: ½ ⟨x⟩² as an energy, its derivative and its second one."""

    __slots__ = ("_inside", "_positive", "_toe")

    def __init__(self, x: Array, toe: float) -> None:
        self._positive, self._toe = np.maximum(x, 0.0), toe
        self._inside = self._positive < toe

    @staticmethod
    def solved(value: Array, slope: float, toe: float) -> Array:
        """The x whose ramp is ``value`` − slope x, for a slope above 0."""
        beyond = (value + 0.5 * toe) / (1 + slope)
        inside = 2 * value / (slope + np.sqrt(slope**2 + 2 * np.maximum(value, 0.0) / toe))
        return np.where(value <= 0, value / slope, np.where(beyond > toe, beyond, inside))

    @property
    def energy(self) -> Array:
        x, t = self._positive, self._toe
        return np.where(self._inside, x**3 / (6 * t), 0.5 * x**2 - 0.5 * t * x + t**2 / 6)

    @property
    def value(self) -> Array:
        x, t = self._positive, self._toe
        return np.where(self._inside, x**2 / (2 * t), x - 0.5 * t)

    @property
    def slope(self) -> Array:
        return np.where(self._inside, self._positive / self._toe, 1.0)


def _principal(strain: Array) -> tuple[Array, Array, Array]:
    """Principal strains e₁ ≥ e₂ (...), and the matrices (..., 3, 3) that turn strains into the principal directions."""
    mean, half, shear = 0.5 * (strain[..., 0] + strain[..., 1]), 0.5 * (strain[..., 0] - strain[..., 1]), strain[..., 2]
    radius = np.hypot(half, 0.5 * shear)
    angle = 0.5 * np.arctan2(0.5 * shear, half)
    return mean + radius, mean - radius, strain_turn(np.cos(angle), np.sin(angle))
