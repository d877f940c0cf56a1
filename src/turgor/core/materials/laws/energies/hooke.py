"""Hooke's law, of stiff parts."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from turgor.core.materials.laws.common import make_floats
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity


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
    nu: float = field(metadata={"dimension": "number"})

    if TYPE_CHECKING:

        def __init__(self, *, E: Quantity, nu: float) -> None: ...

    def __post_init__(self) -> None:
        make_floats(self)
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
