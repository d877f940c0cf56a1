"""Mooney and Rivlin's law."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from turgor.core.materials.laws.common import make_floats, require_finite, require_positive_shear_modulus
from turgor.foundation.given import Quantity


@dataclass(frozen=True, slots=True, kw_only=True)
class MooneyRivlin:
    """Mooney–Rivlin law W = C10 (Ī₁ − 3) + C01 (Ī₂ − 3), good to strains of about 200 %.

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

    max_stretch_hint = 3.0  # Xavier, Fleming and Yong 2021, section 3.2: strains of 200 %

    if TYPE_CHECKING:

        def __init__(self, *, C10: Quantity, C01: Quantity) -> None: ...

    def __post_init__(self) -> None:
        make_floats(self)
        require_positive_shear_modulus(self)
        require_finite(self, (("C10", self.C10), ("C01", self.C01)))

    def energy(self, I1: Any, I2: Any) -> Any:
        """Strain energy density [Pa]: Xavier, Fleming and Yong 2021, Eq. 12."""
        return self.C10 * (I1 - 3) + self.C01 * (I2 - 3)

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ = 2 (C10 + C01) [Pa]."""
        return 2 * (self.C10 + self.C01)
