"""Blatz and Ko's law of foamed rubber."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from turgor.core.materials.laws.common import make_floats, require_finite, require_positive_shear_modulus
from turgor.foundation.given import Quantity


@dataclass(frozen=True, slots=True, kw_only=True)
class BlatzKo:
    """Blatz–Ko law of foamed rubber W = ½ μ (λ₁⁻² + λ₂⁻² + λ₃⁻² + 2 J − 5), of Poisson's ratio ¼.

    Blatz and Ko, Trans. Soc. Rheol. 6 (1962) 223, doi 10.1122/1.548937, Eq. 63, for a foam of polyurethane of 47 % air
    under tension. It is `Hyperfoam` with one term of α = −2 and ν = ¼.

    Parameters
    ----------
    mu : float [Pa]
        Initial shear modulus; the initial bulk modulus is 5/3 of it.

    Examples
    --------
    >>> round(BlatzKo(mu=30e3).bulk_modulus)
    50000
    """

    mu: float

    if TYPE_CHECKING:

        def __init__(self, *, mu: Quantity) -> None: ...

    def __post_init__(self) -> None:
        make_floats(self)
        require_positive_shear_modulus(self)
        require_finite(self, (("mu", self.mu),))

    def energy_of_stretches(self, l1: Any, l2: Any, l3: Any) -> Any:
        """Strain energy density [Pa] of stretches that change the volume, too."""
        return 0.5 * self.mu * (l1**-2 + l2**-2 + l3**-2 + 2 * l1 * l2 * l3 - 5)

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ [Pa]."""
        return self.mu

    @property
    def bulk_modulus(self) -> float:
        """Initial bulk modulus κ = 5/3 μ [Pa]."""
        return 5 / 3 * self.mu
