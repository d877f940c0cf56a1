"""Sheets: paper, film and fabric on a face, as shells that bend or as membranes that do not."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from turgor.core.materials.laws.laws import Hooke, Woven
from turgor.core.materials.library.accepted_forms import as_material
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, Quantity, number, vector
from turgor.units import mm


@dataclass(frozen=True, slots=True)
class Shell:
    """A thin sheet on a face, such as paper, a film or a fabric: it stretches, shears and bends.

    It bends like a plate of its thickness, E h³ / (12 (1 − ν²)), or with the bending stiffness of its material.

    Parameters
    ----------
    material : Material
        Its law must be `Hooke` or `Woven`. A woven fabric bends far more easily than a plate; its material states a
        ``bending_stiffness``, that along the warp.
    thickness : float [m]
        Thickness of the sheet, in (0, 1 cm].
    compression : float
        Share of the stiffness in its surface that works in compression: 1 for a sheet that buckles by itself, 0 for one
        whose wrinkles are finer than the cells (tension field). It bends with its whole stiffness.
    warp : (3,) floats, optional
        Direction of the warp at rest, as seen on the face; for the law `Woven`, which needs it.

    Examples
    --------
    >>> from turgor.core.materials.library.records import from_library
    >>> paper = Shell(from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1e-3)
    >>> f"{paper.bending_stiffness:.3g} N m"
    '0.000564 N m'
    """

    material: Material
    thickness: float
    compression: float = 1.0
    warp: tuple[float, float, float] | None = None

    if TYPE_CHECKING:

        def __init__(
            self,
            material: Material | Hooke | str,
            thickness: Quantity,
            compression: float = 1.0,
            warp: Quantities | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        _check(self, "shell")

    @property
    def wrinkles(self) -> bool:
        """Whether it bears less compression than tension."""
        return self.compression < 1

    @property
    def bending_stiffness(self) -> float:
        """Moment per width that bends it by a curvature of one, while its width stays flat [N m]."""
        return _plate_modulus(self.material) * self.second_moment

    @property
    def second_moment(self) -> float:
        """Second moment of area per width [m³]: its bending stiffness over E / (1 − ν²)."""
        own = self.material.bending_stiffness
        return self.thickness**3 / 12 if own is None else own / _plate_modulus(self.material)


@dataclass(frozen=True, slots=True)
class Membrane:
    """A thin sheet on a face that bends freely: it stretches and shears only.

    A sheet that is compressed wrinkles. A membrane that bears compression does so in waves as short as the cells; make
    the sheet a `Shell`, or let it bear tension only.

    Parameters
    ----------
    material : Material
        Its law must be `Hooke` or `Woven`.
    thickness : float [m]
        Thickness of the sheet, in (0, 1 cm].
    compression : float
        Share of the stiffness that works in compression: 1 for a sheet that bears compression, 0 for one that wrinkles
        and bears tension only (tension field).
    warp : (3,) floats, optional
        Direction of the warp at rest, as seen on the face; for the law `Woven`, which needs it.
    """

    material: Material
    thickness: float
    compression: float = 1.0
    warp: tuple[float, float, float] | None = None

    if TYPE_CHECKING:

        def __init__(
            self,
            material: Material | Hooke | str,
            thickness: Quantity,
            compression: float = 1.0,
            warp: Quantities | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        _check(self, "membrane")

    @property
    def wrinkles(self) -> bool:
        """Whether it bears less compression than tension."""
        return self.compression < 1


#: What may lie on a face.
Sheet = Shell | Membrane


def _check(sheet: Sheet, what: str) -> None:
    material = as_material(sheet.material, what, what)
    thickness = number(sheet.thickness, f"{what} thickness", "length")
    object.__setattr__(sheet, "material", material)
    object.__setattr__(sheet, "thickness", thickness)
    if not isinstance(material.law, Hooke):
        raise TurgorError(
            f"{what} of '{material.name}': its law is {type(material.law).__name__}; "
            f"a {what} needs Hooke (Young's modulus and Poisson's ratio), or Woven (of warp and weft)."
        )
    if not 0 < thickness <= 0.01:
        raise TurgorError(f"{what} thickness is {thickness / mm:g} mm; allowed is more than 0 up to 10 mm.")
    if not 0 <= sheet.compression <= 1:
        raise TurgorError(
            f"{what} compression is {sheet.compression:g}; allowed is 0 (it wrinkles) to 1 (as in tension)."
        )
    _check_warp(sheet, what)


def _check_warp(sheet: Sheet, what: str) -> None:
    """Require the warp of a woven sheet, and of no other."""
    name, woven = sheet.material.name, isinstance(sheet.material.law, Woven)
    if sheet.warp is None:
        if woven:
            raise TurgorError(f"{what} of '{name}': warp is missing, the direction of its warp, such as (1, 0, 0).")
        return
    if sheet.wrinkles:
        raise TurgorError(
            f"{what} of '{name}': compression is {sheet.compression:g}, but a woven sheet bears compression (1) here; "
            "leave one of both out."
        )
    if not woven:
        raise TurgorError(f"{what} of '{name}': warp is for the law Woven; Hooke's is the same in all directions.")
    warp = vector(sheet.warp, f"{what} of '{name}': warp")
    if not any(warp):
        raise TurgorError(f"{what} of '{name}': warp is a zero vector; give a direction, such as (1, 0, 0).")
    object.__setattr__(sheet, "warp", warp)


def _plate_modulus(material: Material) -> float:
    """E / (1 − ν²), along the warp of a woven sheet."""
    law = material.law
    assert isinstance(law, Hooke)
    both = law.nu**2 * (law.E_weft / law.E if isinstance(law, Woven) else 1.0)
    return law.E / (1 - both)
