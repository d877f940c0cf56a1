"""Gent's law of chains of limited length, which stiffens without bound."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from turgor.core.materials.laws.common import make_floats, require_finite, require_positive_shear_modulus
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity


def _bounds(largest_invariant: float) -> tuple[float, float]:
    """Bounds of Jm in a fit: the law must not lock within the range of the fit."""
    low = 1.001 * (largest_invariant - 3.0)
    return low, max(1000.0, 100 * low)


@dataclass(frozen=True, slots=True, kw_only=True)
class Gent:
    """Gent law W = −½ μ Jm ln(1 − (Ī₁ − 3)/Jm), which locks at Ī₁ = 3 + Jm.

    Gent, A new constitutive relation for rubber, Rubber Chem. Technol. 69 (1996) 59. Beyond the locking stretch the
    energy is not a number, nor is any stress.

    Parameters
    ----------
    mu : float [Pa]
        Initial shear modulus.
    Jm : float [-]
        Largest value of Ī₁ − 3, positive.

    Examples
    --------
    >>> Gent(mu=80e3, Jm=90.0).shear_modulus
    80000.0
    """

    mu: float
    Jm: float = field(metadata={"dimension": "number", "bounds": _bounds})

    if TYPE_CHECKING:

        def __init__(self, *, mu: Quantity, Jm: float) -> None: ...

    def __post_init__(self) -> None:
        make_floats(self)
        require_positive_shear_modulus(self)
        if not self.Jm > 0:
            raise TurgorError(f"Gent: Jm is {self.Jm:g}; it must be positive, the largest Ī₁ − 3.")
        require_finite(self, (("mu", self.mu), ("Jm", self.Jm)))

    def energy(self, I1: Any, I2: Any, log: Callable[[Any], Any] = np.log) -> Any:
        """Strain energy density [Pa]; ``log`` is NumPy's or SymPy's logarithm."""
        return -0.5 * self.mu * self.Jm * log(1 - (I1 - 3) / self.Jm)

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ [Pa]."""
        return self.mu
