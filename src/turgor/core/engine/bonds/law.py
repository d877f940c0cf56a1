"""Law of a bond: traction by opening, bilinear, with damage that stays (Camanho and Dávila 2002; Turon et al. 2006).

With the opening across the bond n ≥ 0 and the slip s, both over their values at the strength, λ² = n² + s², the
elastic energy is E0 λ² and the share of shear B = s²/λ². Damage begins at λ = 1, which is the quadratic criterion
(σ/N)² + (τ/S)² = 1, and ends at λ_f(B), where the area below the curve is the fracture energy G(B). In pressing the
bond is elastic and stays undamaged.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.bonds import POWER, Bond

Array = NDArray[np.float64]

#: Below this share of the opening at the strength nothing is damaged, and no share of shear is defined.
SMALL = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class BondLaw:
    """Law of a bond in scaled units.

    Parameters
    ----------
    stiffness : float
        Traction per opening across the undamaged bond.
    onset : (float, float)
        Opening and slip at which damage begins.
    energies : (float, float)
        Fracture energy in peel and in shear.
    power : bool
        Whether the fracture energy follows the power law, not that of Benzeggagh and Kenane.
    exponent : float
    """

    stiffness: float
    onset: tuple[float, float]
    energies: tuple[float, float]
    power: bool
    exponent: float

    @staticmethod
    def of(bond: Bond, stiffness: float, length: float, stress: float) -> "BondLaw":
        """That of a bond with a stiffness [Pa/m], in units of a length [m] and a stress [Pa]."""
        strength, energy = bond.shear
        opening = bond.peel_strength / stiffness
        slip = bond.peel_strength * opening / strength  # the same energy at the strength in peel and in shear
        unit = stress * length
        energies = (bond.energy_peel / unit, energy / unit)
        onset = (opening / length, slip / length)
        return BondLaw(stiffness * length / stress, onset, energies, bond.mixed_mode == POWER, bond.exponent)

    @property
    def elastic(self) -> float:
        """Energy E0 per area at the strength."""
        return 0.5 * self.stiffness * self.onset[0] ** 2

    @property
    def depends_on_mode(self) -> bool:
        """Whether peel and shear take different energies, so that the tractions have no potential."""
        return self.energies[0] != self.energies[1]

    def fracture(self, share: Array) -> tuple[Array, Array]:
        """Fracture energy by the share of shear, and its derivative."""
        peel, shear = self.energies
        if not self.power:
            growth = (shear - peel) * share ** (self.exponent - 1)
            return peel + growth * share, self.exponent * growth
        e, b, a = self.exponent, np.clip(share, 0.0, 1.0), np.clip(1 - share, 0.0, 1.0)
        total = (a / peel) ** e + (b / shear) ** e
        slope = e * (b ** (e - 1) / shear**e - a ** (e - 1) / peel**e)
        energy = total ** (-1 / e)
        return energy, -slope * energy / (e * total)

    def ends(self, share: Array) -> tuple[Array, Array]:
        """λ_f by the share of shear, and its derivative."""
        energy, slope = self.fracture(share)
        return energy / self.elastic, slope / self.elastic

    def damage(self, peel: Array, shear: Array, before: Array) -> tuple[Array, Array, Array]:
        """Damage by n² and s², at least that before, and its derivatives by both."""
        square = np.maximum(peel + shear, SMALL)
        size, share = np.sqrt(square), shear / square
        end, slope = self.ends(share)
        now = np.where(size >= end, 1.0, end * (size - 1) / (size * (end - 1)))
        grows = (now > before) & (size > 1) & (size < end)
        by_size = end / ((end - 1) * square) / (2 * size)
        by_share = -slope * (size - 1) / (size * (end - 1) ** 2)
        by_peel = np.where(grows, by_size - by_share * shear / square**2, 0.0)
        by_shear = np.where(grows, by_size + by_share * peel / square**2, 0.0)
        return np.where(size > 1, np.maximum(now, before), before), by_peel, by_shear

    def dissipated(self, peel: Array, shear: Array, before: Array, now: Array) -> Array:
        """Energy per area that growing damage takes at n² and s², those at which it grows."""
        energy, _ = self.fracture(shear / np.maximum(peel + shear, SMALL))
        end = energy / self.elastic
        spent = [energy * damage / (end - damage * (end - 1)) for damage in (before, now)]
        return np.asarray(np.where(now > before, spent[1] - spent[0], 0.0))
