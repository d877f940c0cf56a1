"""Holzapfel, Gasser and Ogden's law of soft bodies with two families of dispersed fibers."""

from dataclasses import dataclass, field
from math import cos, sin
from typing import TYPE_CHECKING

from turgor.core.materials.laws.common import InvariantLaw, make_floats, require_finite, require_positive_shear_modulus
from turgor.core.materials.laws.energies.neo_hooke import NeoHooke
from turgor.core.materials.laws.fiber_family import Family
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity


@dataclass(frozen=True, slots=True, kw_only=True)
class HolzapfelGasserOgden:
    """Law of fibers in a body W = C10 (Ī₁ − 3) + (k1/2k2) Σ (exp(k2 Eᵢ²) − 1), Eᵢ = κ (Ī₁ − 3) + (1 − 3κ) (Ī₄ᵢ − 1).

    Gasser, Ogden and Holzapfel, J. R. Soc. Interface 3 (2006) 15, doi 10.1098/rsif.2005.0073. Ī₄ᵢ is the squared
    isochoric stretch along the mean direction of a family. The `Orientation` of the material says where the directions
    lie: two families at its angle on both sides of the first one, one family where the angle is 0. Fibers that are
    compressed, Eᵢ < 0, bear nothing.

    Parameters
    ----------
    C10 : float [Pa]
        Of the body between the fibers; its initial shear modulus is 2 C10.
    k1 : float [Pa]
        Stiffness of a family, not negative.
    k2 : float [-]
        How the fibers stiffen, not negative; 0 for an energy ½ k1 E².
    kappa : float [-]
        Dispersion of a family, from 0, parallel fibers, to 1/3, all directions alike.

    Examples
    --------
    >>> HolzapfelGasserOgden(C10=3.8e3, k1=2.4e3, k2=0.84, kappa=0.1).shear_modulus
    7600.0
    """

    C10: float
    k1: float
    k2: float = field(metadata={"dimension": "number"})
    kappa: float = field(default=0.0, metadata={"dimension": "number"})

    if TYPE_CHECKING:

        def __init__(self, *, C10: Quantity, k1: Quantity, k2: float, kappa: float = 0.0) -> None: ...

    def __post_init__(self) -> None:
        make_floats(self)
        require_positive_shear_modulus(self)
        require_finite(self, (("C10", self.C10), ("k1", self.k1), ("k2", self.k2)))
        for name in ("k1", "k2"):
            if getattr(self, name) < 0:
                raise TurgorError(f"HolzapfelGasserOgden: {name} is {getattr(self, name):g}; it must not be negative.")
        if not 0 <= self.kappa <= 1 / 3:
            raise TurgorError(f"HolzapfelGasserOgden: kappa is {self.kappa:g}; allowed is 0 to 1/3.")

    @property
    def matrix(self) -> InvariantLaw:
        """The body between the fibers."""
        return NeoHooke(C10=self.C10)

    def families(self, angle: float) -> tuple[Family, ...]:
        """Families of fibers at an angle [rad] to the first direction of the material, on both sides."""
        sides = (1.0,) if sin(angle) == 0 else (1.0, -1.0)
        return tuple(
            Family(
                direction=(cos(angle), side * sin(angle), 0.0), k1=self.k1, k2=self.k2, kappa=self.kappa, tension=True
            )
            for side in sides
        )

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus 2 C10 of the body between the fibers [Pa]."""
        return 2 * self.C10
