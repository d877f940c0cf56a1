"""Permanent set: rubber that stays longer after it was stretched, by plasticity with isotropic hardening.

F = Fₑ F_p, and the law acts on Fₑ. The log plastic strain ε_p grows where the Mises stress q of the Kirchhoff stress
exceeds all stresses before, in the direction of the stress (associated flow):

    ε_p = ((q − q₀)/K)^n

Stress softening does not count in q. It is the form of Abaqus, ``*PLASTIC`` besides ``*HYPERELASTIC``, with a power for
its table (S. M. Govindarajan, J. A. Hurtado, W. V. Mars, Constitutive Models for Rubber V, 2007). After a cycle of
uniaxial tension up to a Cauchy stress σ the specimen is exp(((σ − q₀)/K)^n) times as long as before.
"""

from dataclasses import dataclass
from math import isfinite

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.materials.history.resistance import Resistance
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class PermanentSet:
    """Plastic strain of rubber, ((q − onset)/stress)^exponent at a Mises stress q.

    Parameters
    ----------
    stress : float [Pa]
        Mises stress above the onset at which the log plastic strain would be 1; positive.
    exponent : float [-]
        Power n, 1 or more.
    onset : float [Pa]
        Mises stress below which no set remains; 0 or more.

    Examples
    --------
    >>> PermanentSet(stress=10e6, exponent=2.0).residual_stretch(2e6).round(4)
    np.float64(1.0408)
    """

    stress: float
    exponent: float
    onset: float = 0.0

    def __post_init__(self) -> None:
        for name, least, fits in (
            ("stress", "more than 0", self.stress > 0),
            ("exponent", "1 or more", self.exponent >= 1),
            ("onset", "0 or more", self.onset >= 0),
        ):
            value = getattr(self, name)
            if not (isfinite(value) and fits):
                raise TurgorError(f"PermanentSet: {name} is {value:g}; it must be {least} and finite.")

    def resistance(self, hardened: Array) -> Resistance:
        """What the network opposes to flow after a plastic strain [-] of the same shape."""
        return Resistance(np.full(hardened.shape, self.stress), self.exponent, self.onset, hardened)

    def residual_stretch(self, cauchy_stress: ArrayLike) -> Array:
        """Stretch after a cycle of uniaxial tension that went up to a Cauchy stress.

        Parameters
        ----------
        cauchy_stress : (...) array [Pa]
        """
        above = np.maximum(np.asarray(cauchy_stress, dtype=np.float64) - self.onset, 0.0)
        return np.asarray(np.exp((above / self.stress) ** self.exponent))

    def work(self, strain: Array) -> Array:
        """Energy density [Pa] dissipated up to a plastic strain."""
        return np.asarray(
            self.onset * strain + self.stress * strain ** (1 + 1 / self.exponent) / (1 + 1 / self.exponent)
        )
