"""The neo-Hookean law."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from turgor.core.materials.laws.common import make_floats, require_finite, require_positive_shear_modulus
from turgor.foundation.given import Quantity


@dataclass(frozen=True, slots=True, kw_only=True)
class NeoHooke:
    """Neo-Hookean law W = C10 (Ī₁ − 3), good to strains of about 50 %.

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

    max_stretch_hint = 1.5  # Xavier, Fleming and Yong 2021, section 3.2: strains of 50 %

    if TYPE_CHECKING:

        def __init__(self, *, C10: Quantity) -> None: ...

    def __post_init__(self) -> None:
        make_floats(self)
        require_positive_shear_modulus(self)
        require_finite(self, (("C10", self.C10),))

    def energy(self, I1: Any, I2: Any) -> Any:
        """Strain energy density [Pa]: Xavier, Fleming and Yong 2021, Eq. 15."""
        return self.C10 * (I1 - 3)

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ = 2 C10 [Pa]."""
        return 2 * self.C10
