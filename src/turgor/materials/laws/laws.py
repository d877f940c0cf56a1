"""Laws: each is its strain energy, written once; every stress and tangent is derived from it.

Energies are per reference volume, in the isochoric invariants Ī₁, Ī₂ or the isochoric principal stretches, which equal
I₁, I₂ and the stretches of an incompressible solid. They use only arithmetic and a logarithm that is passed in, so
NumPy arrays and SymPy symbols go through them alike. All laws may be imported from here.
"""

from dataclasses import dataclass
from typing import Any

from turgor.errors import TurgorError
from turgor.materials.laws.common import InvariantLaw as InvariantLaw
from turgor.materials.laws.common import Law as Law
from turgor.materials.laws.common import StretchLaw as StretchLaw
from turgor.materials.laws.common import require_finite, require_positive_shear_modulus
from turgor.materials.laws.locking import ArrudaBoyce as ArrudaBoyce
from turgor.materials.laws.locking import Gent as Gent
from turgor.materials.laws.polynomial import GeneralizedRivlin as GeneralizedRivlin
from turgor.materials.laws.polynomial import YeohN as YeohN
from turgor.materials.laws.stretch import Ogden as Ogden


@dataclass(frozen=True, slots=True, kw_only=True)
class NeoHooke:
    """Neo-Hookean law W = C10 (Ī₁ − 3), good to strains of about 50 %; review Eq. 15.

    Parameters
    ----------
    C10 : float [Pa]
        Half of the initial shear modulus.

    Examples
    --------
    >>> NeoHooke(C10=0.12e6).shear_modulus
    240000.0
    """

    C10: float

    def __post_init__(self) -> None:
        require_positive_shear_modulus(self)
        require_finite(self, (("C10", self.C10),))

    def energy(self, I1: Any, I2: Any) -> Any:
        """Strain energy density [Pa], review Eq. 15."""
        return self.C10 * (I1 - 3)

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ = 2 C10 [Pa]."""
        return 2 * self.C10


@dataclass(frozen=True, slots=True, kw_only=True)
class MooneyRivlin:
    """Mooney–Rivlin law W = C10 (Ī₁ − 3) + C01 (Ī₂ − 3), good to strains of about 200 %; review Eq. 12.

    Parameters
    ----------
    C10, C01 : float [Pa]
        Coefficients; μ = 2 (C10 + C01).

    Examples
    --------
    >>> MooneyRivlin(C10=0.10e6, C01=0.02e6).shear_modulus
    240000.0
    """

    C10: float
    C01: float

    def __post_init__(self) -> None:
        require_positive_shear_modulus(self)
        require_finite(self, (("C10", self.C10), ("C01", self.C01)))

    def energy(self, I1: Any, I2: Any) -> Any:
        """Strain energy density [Pa], review Eq. 12."""
        return self.C10 * (I1 - 3) + self.C01 * (I2 - 3)

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ = 2 (C10 + C01) [Pa]."""
        return 2 * (self.C10 + self.C01)


@dataclass(frozen=True, slots=True, kw_only=True)
class Yeoh:
    """Yeoh law W = C10 (Ī₁ − 3) + C20 (Ī₁ − 3)² + C30 (Ī₁ − 3)³, good to strains of 400 % and more; review Eq. 14.

    Parameters
    ----------
    C10, C20, C30 : float [Pa]
        Coefficients; μ = 2 C10.

    Examples
    --------
    >>> Yeoh(C10=0.11e6, C20=0.02e6).shear_modulus
    220000.0
    """

    C10: float
    C20: float
    C30: float = 0.0

    def __post_init__(self) -> None:
        require_positive_shear_modulus(self)
        require_finite(self, (("C10", self.C10), ("C20", self.C20), ("C30", self.C30)))

    def energy(self, I1: Any, I2: Any) -> Any:
        """Strain energy density [Pa], review Eq. 14."""
        x = I1 - 3
        return self.C10 * x + self.C20 * x**2 + self.C30 * x**3

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ = 2 C10 [Pa]."""
        return 2 * self.C10


@dataclass(frozen=True, slots=True, kw_only=True)
class Hooke:
    """Linear elastic stiff part (paper, fiber), small strains, any rotation (St. Venant–Kirchhoff).

    Parameters
    ----------
    E : float [Pa]
        Young's modulus.
    nu : float [-]
        Poisson's ratio, between -1 and 0.5.

    Examples
    --------
    >>> round(Hooke(E=6.5e9, nu=0.2).shear_modulus / 1e9, 4)
    2.7083
    """

    E: float
    nu: float

    def __post_init__(self) -> None:
        if not self.E > 0:
            raise TurgorError(f"Hooke: E is {self.E:g} Pa; it must be positive.")
        if not -1 < self.nu < 0.5:
            raise TurgorError(f"Hooke: nu is {self.nu:g}; it must lie between -1 and 0.5.")

    @property
    def shear_modulus(self) -> float:
        """Shear modulus E / (2 (1 + ν)) [Pa]."""
        return self.E / (2 * (1 + self.nu))

    @property
    def bulk_modulus(self) -> float:
        """Bulk modulus E / (3 (1 − 2ν)) [Pa]."""
        return self.E / (3 * (1 - 2 * self.nu))
