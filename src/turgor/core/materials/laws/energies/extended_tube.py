"""The extended tube law: chains that are confined by their neighbors and have a limited length."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from turgor.core.materials.laws.common import make_floats, require_finite, require_positive_shear_modulus
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity


def _bounds(largest_invariant: float) -> tuple[float, float]:
    """Bounds of δ in a fit: the law must not lock within the range of the fit."""
    return 1e-3, min(0.7, 0.999 / (largest_invariant - 3.0) ** 0.5)


@dataclass(frozen=True, slots=True, kw_only=True)
class ExtendedTube:
    """Extended tube law W = ½ Gc ((1 − δ²) D/(1 − δ² D) + ln(1 − δ² D)) + (2 Ge/β²) Σ (λ̄ᵢ^(−β) − 1), D = Ī₁ − 3.

    Kaliske and Heinrich, Rubber Chem. Technol. 72 (1999) 602, doi 10.5254/1.3538822. With four constants it fits
    several modes at once: crosslinks (Gc) that lock at D = 1/δ², and entanglements (Ge) that weaken in tension. Beyond
    the locking stretch the energy is not a number, nor is any stress.

    Parameters
    ----------
    Gc : float [Pa]
        Modulus of the crosslinks, not negative.
    Ge : float [Pa]
        Modulus of the entanglements, not negative.
    delta : float [-]
        Inextensibility δ of the chains, from 0 to less than 0.707; often 0.05 to 0.2.
    beta : float [-]
        Exponent β of the release of entanglements, more than 0, at most 1.

    Examples
    --------
    >>> round(ExtendedTube(Gc=190e3, Ge=200e3, delta=0.1, beta=0.2).shear_modulus)
    386200
    """

    Gc: float
    Ge: float
    delta: float = field(metadata={"dimension": "number", "bounds": _bounds})
    beta: float = field(metadata={"dimension": "number", "bounds": (0.01, 0.999)})  # derivatives step a little beyond

    if TYPE_CHECKING:

        def __init__(self, *, Gc: Quantity, Ge: Quantity, delta: float, beta: float) -> None: ...

    def __post_init__(self) -> None:
        make_floats(self)
        for name in ("Gc", "Ge"):
            if getattr(self, name) < 0:
                raise TurgorError(f"ExtendedTube: {name} is {getattr(self, name):g} Pa; it must not be negative.")
        if not 0 <= self.delta < 0.5**0.5:
            raise TurgorError(f"ExtendedTube: delta is {self.delta:g}; allowed is 0 to less than 0.707, often 0.1.")
        if not 0 < self.beta <= 1:
            raise TurgorError(f"ExtendedTube: beta is {self.beta:g}; allowed is more than 0, up to 1.")
        require_positive_shear_modulus(self)
        require_finite(self, (("Gc", self.Gc), ("Ge", self.Ge)))

    def energy_of_stretches(self, l1: Any, l2: Any, l3: Any, log: Callable[[Any], Any] = np.log) -> Any:
        """Strain energy density [Pa]; ``log`` is NumPy's or SymPy's logarithm."""
        D, d2, b = l1**2 + l2**2 + l3**2 - 3, self.delta**2, self.beta
        crosslinks = (1 - d2) * D / (1 - d2 * D) + log(1 - d2 * D)
        return 0.5 * self.Gc * crosslinks + 2 * self.Ge / b**2 * (l1**-b + l2**-b + l3**-b - 3)

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus Gc (1 − 2δ²) + Ge [Pa]."""
        return self.Gc * (1 - 2 * self.delta**2) + self.Ge
