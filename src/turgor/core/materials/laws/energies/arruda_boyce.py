"""Arruda and Boyce's law of chains of limited length."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from turgor.core.materials.laws.common import make_floats, require_finite, require_positive_shear_modulus
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity

#: Coefficients of the inverse Langevin function's series in the energy, Arruda and Boyce (1993), Eq. 22.
_SERIES = (1 / 2, 1 / 20, 11 / 1050, 19 / 7000, 519 / 673750)


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrudaBoyce:
    """Eight-chain law W = μ Σ cᵢ λm^(2−2i) (Ī₁ⁱ − 3ⁱ), the series of five terms in common use.

    Arruda and Boyce, J. Mech. Phys. Solids 41 (1993) 389, Eq. 22: c = 1/2, 1/20, 11/1050, 19/7000, 519/673750.

    Parameters
    ----------
    mu : float [Pa]
        Rubbery modulus n k T; the initial shear modulus is μ (1 + 3/(5λm²) + 99/(175λm⁴) + …).
    locking_stretch : float [-]
        λm, the stretch at which the chains are straight, more than 1.

    Examples
    --------
    >>> round(ArrudaBoyce(mu=80e3, locking_stretch=4.0).shear_modulus, 1)
    83189.0
    """

    mu: float
    locking_stretch: float = field(metadata={"dimension": "number", "bounds": (1.05, 50.0)})

    if TYPE_CHECKING:

        def __init__(self, *, mu: Quantity, locking_stretch: float) -> None: ...

    def __post_init__(self) -> None:
        make_floats(self)
        if not self.locking_stretch > 1:
            raise TurgorError(
                f"ArrudaBoyce: locking_stretch is {self.locking_stretch:g}; it must be more than 1, often 2 to 8."
            )
        require_positive_shear_modulus(self)
        require_finite(self, (("mu", self.mu), ("locking_stretch", self.locking_stretch)))

    def energy(self, I1: Any, I2: Any) -> Any:
        """Strain energy density [Pa], Eq. 22 of Arruda and Boyce (1993)."""
        m = self.locking_stretch
        return self.mu * sum(c * m ** (2 - 2 * i) * (I1**i - 3**i) for i, c in enumerate(_SERIES, 1))

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus 2 dW/dĪ₁ at rest [Pa]."""
        m = self.locking_stretch
        return 2 * self.mu * sum(i * c * m ** (2 - 2 * i) * 3 ** (i - 1) for i, c in enumerate(_SERIES, 1))
