"""The neo-Hookean law of rubber-like solids that change their volume."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from turgor.core.materials.laws.common import make_floats, require_finite, require_positive_shear_modulus
from turgor.core.materials.laws.energies.hyperfoam import RATIOS
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity


@dataclass(frozen=True, slots=True, kw_only=True)
class CompressibleNeoHooke:
    """Neo-Hookean law W = ½ μ (I₁ − 3) − μ ln J + ½ λ (ln J)² of soft solids that change their volume.

    Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed. 2008, chapter 6; the
    material ``neo-Hookean`` of FEBio. Its energy has the change of volume; a material of it states no bulk modulus.
    For rubber, which hardly changes its volume, take `NeoHooke`.

    Parameters
    ----------
    mu : float [Pa]
        Initial shear modulus.
    nu : float [-]
        Initial Poisson's ratio, more than −1 and less than 0.5; λ = 2 μν/(1 − 2ν).

    Examples
    --------
    >>> round(CompressibleNeoHooke(mu=30e3, nu=0.25).bulk_modulus)
    50000
    """

    mu: float
    nu: float = field(metadata={"dimension": "number"})

    if TYPE_CHECKING:

        def __init__(self, *, mu: Quantity, nu: float) -> None: ...

    def __post_init__(self) -> None:
        make_floats(self)
        require_positive_shear_modulus(self)
        if not RATIOS[0] < self.nu < RATIOS[1]:
            raise TurgorError(f"CompressibleNeoHooke: nu is {self.nu:g}; it must be more than −1 and less than 0.5.")
        require_finite(self, (("mu", self.mu),))

    def energy_of_stretches(self, l1: Any, l2: Any, l3: Any, log: Callable[[Any], Any] = np.log) -> Any:
        """Strain energy density [Pa] of stretches that change the volume, too; ``log`` is NumPy's or SymPy's."""
        volume = log(l1 * l2 * l3)
        lame = 2 * self.mu * self.nu / (1 - 2 * self.nu)
        return 0.5 * self.mu * (l1**2 + l2**2 + l3**2 - 3) - self.mu * volume + 0.5 * lame * volume**2

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ [Pa]."""
        return self.mu

    @property
    def bulk_modulus(self) -> float:
        """Initial bulk modulus κ = ⅔ μ (1 + ν)/(1 − 2ν) [Pa]."""
        return 2 / 3 * self.mu * (1 + self.nu) / (1 - 2 * self.nu)
