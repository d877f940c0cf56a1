"""A mold: its parts, its dimensions, and what to know about it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.rules import check_length
from turgor.core.geometry.shapes.solids import volume
from turgor.foundation.errors import TurgorError
from turgor.units import deg, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class MoldSettings:
    """Dimensions of a mold.

    Parameters
    ----------
    wall : float [m]
        Thickness of the mold around the casting; pins stand in its middle.
    pin_diameter, pin_height : float [m]
        Four pins that hold the parts in place.
    clearance : float [m]
        Radial clearance between a pin and its hole.
    pour_diameter : float [m]
        Two holes above the casting, one to pour in and one for the air to leave. Molds of PneuNets have none.
    undercut : float [m²]
        Area of the casting that may look away from the pull of its half: rubber is peeled off small undercuts.
    draft : float [rad]
        Draft of the walls along the pull of halves and cores; the notes list the faces that have less.
    """

    wall: float = 8 * mm
    pin_diameter: float = 3 * mm
    pin_height: float = 3 * mm
    clearance: float = 0.2 * mm
    pour_diameter: float = 4 * mm
    undercut: float = 1 * mm**2
    draft: float = 1 * deg

    def __post_init__(self) -> None:
        check_length("wall", self.wall, low=2 * mm, high=100 * mm)
        check_length("clearance", self.clearance, low=0.0, high=2 * mm)
        high = self.wall - 2 * self.clearance - 1 * mm
        check_length("pin_diameter", self.pin_diameter, low=0.5 * mm, high=high, why="so that the rim holds the pins")
        check_length("pin_height", self.pin_height, low=0.5 * mm, high=self.wall)
        check_length("pour_diameter", self.pour_diameter, low=0.5 * mm, high=50 * mm)
        if not self.undercut >= 0:
            raise TurgorError(f"undercut is {self.undercut / mm**2:g} mm²; it must be 0 or more.")
        if not 0 < self.draft < 45 * deg:
            raise TurgorError(f"draft is {self.draft / deg:g}°; it must be above 0° and below 45°.")


@dataclass(frozen=True, slots=True, kw_only=True)
class Mold:
    """Parts of a mold, in place around the casting.

    Parameters
    ----------
    parts : mapping of str to Geometry
        Parts by their names; write them with `write_step` or `write_stl`.
    notes : tuple of str
        How the mold opens, and what a caster has to know.
    """

    parts: Mapping[str, Geometry]
    notes: tuple[str, ...] = ()


def mold_part(title: str, name: str, shape: Any) -> Geometry:
    """Return a CAD shape as a geometry with one region and one face."""
    for solid in shape.solids:
        solid.name = name
    shape.faces.name = "outside"
    return Geometry(
        name=title,
        smallest_wall=1 * mm,
        cavity_volumes={},
        solid_volume=volume(shape),
        regions=(name,),
        faces=("outside",),
        shape=shape,
    )
