"""Law of woven sheets, with yarns along warp and weft."""

from dataclasses import dataclass
from math import cos, sin
from typing import TYPE_CHECKING

from turgor.core.materials.laws.common import make_floats
from turgor.core.materials.laws.energies.hooke import Hooke
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity


@dataclass(frozen=True, slots=True, kw_only=True)
class Woven(Hooke):
    """Linear elastic fabric with warp, weft and shear, small strains, any rotation (orthotropic plane stress).

    Tests of fabrics give a force per width and strain. Its quotient by the thickness of the sheet is the modulus; only
    their product counts.

    Parameters
    ----------
    E : float [Pa]
        Young's modulus along the warp.
    nu : float [-]
        Contraction along the weft of a pull along the warp, over the strain along the warp; its size is below the root
        of E / E_weft, so it may be above 0.5.
    E_weft : float [Pa]
        Young's modulus along the weft.
    G : float [Pa]
        Shear modulus between warp and weft; far below both Young's moduli, because yarns turn at their crossings.

    Examples
    --------
    >>> fabric = Woven(E=400e6, E_weft=200e6, G=5e6, nu=0.2)
    >>> round(fabric.modulus_along(0.785398) / 1e6, 1)  # on the bias, shear counts most
    19.4
    """

    E_weft: float
    G: float

    if TYPE_CHECKING:

        def __init__(self, *, E: Quantity, nu: float, E_weft: Quantity, G: Quantity) -> None: ...

    def __post_init__(self) -> None:
        make_floats(self)
        for name, value in (("E", self.E), ("E_weft", self.E_weft), ("G", self.G)):
            if not value > 0:
                raise TurgorError(f"Woven: {name} is {value:g} Pa; it must be positive.")
        if self.nu**2 >= self.E / self.E_weft:
            largest = (self.E / self.E_weft) ** 0.5
            raise TurgorError(
                f"Woven: nu is {self.nu:g}; its size must lie below {largest:.3g}, the root of E / E_weft, or the "
                "fabric would store negative energy."
            )

    @property
    def shear_modulus(self) -> float:
        """Shear modulus between warp and weft [Pa]."""
        return self.G

    def modulus_along(self, angle: float) -> float:
        """Young's modulus [Pa] of a pull at an angle [rad] from the warp."""
        c, s = cos(angle) ** 2, sin(angle) ** 2
        return 1 / (c**2 / self.E + s**2 / self.E_weft + c * s * (1 / self.G - 2 * self.nu / self.E))
