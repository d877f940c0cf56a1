"""Tolerances of shapes, sections and meshes: what differs by less is the same."""

from dataclasses import dataclass
from math import cos

from turgor.units import deg


@dataclass(frozen=True, slots=True)
class ToleranceSettings:
    """Differences that are rounding.

    Parameters
    ----------
    round_off : float
        Lengths below this share of the size of a part are zero, as are sines and shares of volumes. The display of the
        CAD kernel has seven digits, and files round their numbers (`test_symmetry`, `test_exchange_decks`). It must
        stay below 5e-6, the shortest length that is allowed over the longest part.
    length : float [CAD units]
        Shorter lengths are zero: ten times the tolerance of the CAD kernel.
    volume : float
        Two volumes or areas are the same up to this share: the kernel's volumes of free forms are that exact. A small
        inlet on one side of a part has more (`test_symmetry`).
    built_volume : float
        A family has the volume of its dimensions up to this share (`test_dimension_rules`): planar and cylindrical
        parts reach 1e-13, a cylinder that is cut close to its axis 2e-9. A face lost in a boolean changes far more.
    direction : float
        Directions are the same if the cosine of their angle is above this: 1°.
    square : float
        Stated axes may be off unit length and right angles by this much: they are written with four digits.
    """

    round_off: float = 2e-6
    length: float = 1e-6
    volume: float = 1e-4
    built_volume: float = 1e-8
    direction: float = cos(1 * deg)
    square: float = 1e-3


TOLERANCE = ToleranceSettings()
