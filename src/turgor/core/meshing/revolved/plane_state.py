"""What a plane mesh of a file stands for: plane strain, or a body of revolution."""

from dataclasses import dataclass
from math import isfinite
from typing import TypeAlias

from turgor.foundation.errors import TurgorError, unknown
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class PlaneStrain:
    """A plane mesh is the section of a part that is the same all along its thickness and cannot become thicker.

    Parameters
    ----------
    thickness : float [m]
        Thickness across the plane. Forces and volumes are those of the whole thickness.

    Raises
    ------
    TurgorError
        If it is not positive.

    Examples
    --------
    >>> PlaneStrain(thickness=0.0)
    Traceback (most recent call last):
    turgor.TurgorError: thickness of plane strain is 0 mm; it must be positive.
    """

    thickness: float

    def __post_init__(self) -> None:
        if not (isfinite(self.thickness) and self.thickness > 0):
            raise TurgorError(f"thickness of plane strain is {self.thickness / mm:g} mm; it must be positive.")


@dataclass(frozen=True, slots=True, kw_only=True)
class Axisymmetric:
    """A plane mesh is the meridian of a body of revolution, whose states are the same all around.

    Parameters
    ----------
    axis : str
        The axis in the file, ``"x"``, ``"y"`` or ``"z"``; it goes through the origin.

    Raises
    ------
    TurgorError
        If there is no such axis.

    Examples
    --------
    >>> Axisymmetric(axis="r")
    Traceback (most recent call last):
    turgor.TurgorError: unknown axis of a body of revolution 'r'. Known: x, y, z.
    """

    axis: str = "y"

    def __post_init__(self) -> None:
        if self.axis not in ("x", "y", "z"):
            raise unknown("axis of a body of revolution", self.axis, ("x", "y", "z"))


#: What a plane mesh stands for.
PlaneState: TypeAlias = PlaneStrain | Axisymmetric
