"""Membrane: a thin sheet on a face."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from turgor.errors import TurgorError
from turgor.given import Quantity, number
from turgor.materials.laws.laws import Hooke
from turgor.materials.library.plain import as_material
from turgor.materials.material import Material


@dataclass(frozen=True, slots=True)
class Membrane:
    """A thin sheet on a face: stretches and shears like its material, and bends freely or like a plate.

    Parameters
    ----------
    material : Material
        Its law must be `Hooke`.
    thickness : float [m]
        Thickness of the sheet, in (0, 1 cm].
    bending : bool
        Whether it resists bending like a plate of its thickness (a shell); paper of 0.1 mm between layers of silicone
        hardly does, a sheet of 0.5 mm does.
    compression : float
        Share of the stiffness that works in compression: 1 for a sheet that bears compression, 0 for one that wrinkles
        and bears tension only (tension field). A sheet that resists bending keeps all of it.
    """

    material: Material
    thickness: float
    bending: bool = False
    compression: float = 1.0

    if TYPE_CHECKING:

        def __init__(
            self, material: Material | Hooke | str, thickness: Quantity, bending: bool = False, compression: float = 1.0
        ) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "material", as_material(self.material, "membrane", "membrane"))
        object.__setattr__(self, "thickness", number(self.thickness, "membrane thickness", "length"))
        if not isinstance(self.material.law, Hooke):
            raise TurgorError(
                f"membrane of '{self.material.name}': its law is {type(self.material.law).__name__}; "
                "a membrane needs Hooke (Young's modulus and Poisson's ratio)."
            )
        if not 0 < self.thickness <= 0.01:
            raise TurgorError(f"membrane thickness is {self.thickness * 1e3:g} mm; allowed is more than 0 up to 10 mm.")
        if not 0 <= self.compression <= 1:
            raise TurgorError(
                f"membrane compression is {self.compression:g}; allowed is 0 (it wrinkles) to 1 (as in tension)."
            )
        if self.bending and self.compression < 1:
            raise TurgorError(
                f"membrane compression is {self.compression:g}, but the sheet resists bending; a shell bears "
                "compression (1) and buckles by itself."
            )

    @property
    def wrinkles(self) -> bool:
        """Whether it bears less compression than tension."""
        return self.compression < 1
