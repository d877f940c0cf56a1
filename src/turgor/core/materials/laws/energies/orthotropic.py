"""A law of printed bodies: a rubber that is stiffer along the three directions of the print."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from turgor.core.materials.laws.common import InvariantLaw, make_floats, require_finite, require_positive_shear_modulus
from turgor.core.materials.laws.energies.yeoh import Yeoh
from turgor.core.materials.laws.fiber_family import Family
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity


@dataclass(frozen=True, slots=True, kw_only=True)
class Orthotropic:
    """Law of printed bodies W = Σ Cᵢ₀ (Ī₁ − 3)ⁱ + ½ Σ aₖ (Ī₄ₖ − 1)².

    Ī₄ₖ is the squared isochoric stretch along direction k. Each aₖ is a standard reinforcing term; see Qiu and Pence,
    J. Elasticity 49 (1997) 1, doi 10.1023/A:1007410321319. Young's modulus at rest along a direction that alone is
    reinforced is 6 C10 + 4 aₖ. The `Orientation` of the material says where the directions lie: in a print along the
    strands, across them in the layer, and across the layers.

    Parameters
    ----------
    C10 : float [Pa]
        Yeoh's first coefficient; the initial shear modulus of the rubber is 2 C10.
    C20, C30 : float [Pa]
        Yeoh's other coefficients.
    a1, a2, a3 : float [Pa]
        Reinforcement along the first, second and third direction, not negative.

    Examples
    --------
    >>> Orthotropic(C10=1e6, a1=0.5e6).shear_modulus
    2000000.0
    """

    C10: float
    C20: float = 0.0
    C30: float = 0.0
    a1: float = 0.0
    a2: float = 0.0
    a3: float = 0.0

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            C10: Quantity,
            C20: Quantity = 0.0,
            C30: Quantity = 0.0,
            a1: Quantity = 0.0,
            a2: Quantity = 0.0,
            a3: Quantity = 0.0,
        ) -> None: ...

    def __post_init__(self) -> None:
        make_floats(self)
        require_positive_shear_modulus(self)
        require_finite(self, ((name, getattr(self, name)) for name in ("C10", "C20", "C30", "a1", "a2", "a3")))
        for name in ("a1", "a2", "a3"):
            if getattr(self, name) < 0:
                raise TurgorError(f"Orthotropic: {name} is {getattr(self, name):g} Pa; it must not be negative.")

    @property
    def matrix(self) -> InvariantLaw:
        """The rubber that is reinforced."""
        return Yeoh(C10=self.C10, C20=self.C20, C30=self.C30)

    def families(self, angle: float) -> tuple[Family, ...]:
        """The reinforced directions; a print has no fibers at an angle."""
        if angle:
            raise TurgorError("Orthotropic has no fibers at an angle; leave the angle of the orientation out.")
        directions = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
        stiffness = (self.a1, self.a2, self.a3)
        return tuple(Family(direction=d, k1=a) for d, a in zip(directions, stiffness, strict=True) if a > 0)

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus 2 C10 of the rubber [Pa]."""
        return 2 * self.C10
