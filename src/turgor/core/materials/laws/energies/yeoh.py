"""Yeoh's law."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from turgor.core.materials.laws.common import make_floats, require_finite, require_positive_shear_modulus
from turgor.foundation.given import Quantity


@dataclass(frozen=True, slots=True, kw_only=True)
class Yeoh:
    """Yeoh law W = C10 (Ī₁ − 3) + C20 (Ī₁ − 3)² + C30 (Ī₁ − 3)³, good to strains of 400 % and more.

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

    if TYPE_CHECKING:

        def __init__(self, *, C10: Quantity, C20: Quantity, C30: Quantity = 0.0) -> None: ...

    def __post_init__(self) -> None:
        make_floats(self)
        require_positive_shear_modulus(self)
        require_finite(self, (("C10", self.C10), ("C20", self.C20), ("C30", self.C30)))

    def energy(self, I1: Any, I2: Any) -> Any:
        """Strain energy density [Pa]: Xavier, Fleming and Yong 2021, Eq. 14."""
        x = I1 - 3
        return self.C10 * x + self.C20 * x**2 + self.C30 * x**3

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ = 2 C10 [Pa]."""
        return 2 * self.C10
