"""A mold: its parts, its dimensions, and what to know about it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.packing import packed
from turgor.core.geometry.rules import check_angle, check_length
from turgor.core.geometry.shapes.solids import volume
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding
from turgor.units import deg, mm

#: Draft below which faces are listed where none is requested, and the largest that can be requested [rad].
USUAL_DRAFT, LARGEST_DRAFT = 1 * deg, 10 * deg


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
        Draft of the walls along the pull of halves and cores: plane walls, and round ones about the pull, are tapered
        from the parting plane, or from the opening of a core. 0 leaves the part. The notes list the faces that have
        less, or less than 1° where it is 0.
    smallest_wall : float [m]
        Thinnest wall that the draft may leave without a finding.
    """

    wall: float = 8 * mm
    pin_diameter: float = 3 * mm
    pin_height: float = 3 * mm
    clearance: float = 0.2 * mm
    pour_diameter: float = 4 * mm
    undercut: float = 1 * mm**2
    draft: float = 0.0
    smallest_wall: float = 1 * mm

    def __post_init__(self) -> None:
        check_length("wall", self.wall, low=2 * mm, high=100 * mm)
        check_length("clearance", self.clearance, low=0.0, high=2 * mm)
        high = self.wall - 2 * self.clearance - 1 * mm
        check_length("pin_diameter", self.pin_diameter, low=0.5 * mm, high=high, why="so that the rim holds the pins")
        check_length("pin_height", self.pin_height, low=0.5 * mm, high=self.wall)
        check_length("pour_diameter", self.pour_diameter, low=0.5 * mm, high=50 * mm)
        if not self.undercut >= 0:
            raise TurgorError(f"undercut is {self.undercut / mm**2:g} mm²; it must be 0 or more.")
        check_angle("draft", self.draft, low=0.0, high=LARGEST_DRAFT, why="so that walls stay walls")
        check_length("smallest_wall", self.smallest_wall, high=100 * mm)

    @property
    def listed_draft(self) -> float:
        """Draft [rad] below which the notes list a face."""
        return self.draft or USUAL_DRAFT


@dataclass(frozen=True, slots=True, kw_only=True)
class Mold:
    """Parts of a mold, in place around the casting.

    Parameters
    ----------
    parts : mapping of str to Geometry
        Parts by their names; write them with `write_step` or `write_stl`.
    notes : tuple of str
        How the mold opens, and what a caster has to know.
    casting : Geometry, optional
        The part with draft, which can be computed; None without draft.
    findings : tuple of Finding
        D09 where the draft leaves a thin wall.
    """

    parts: Mapping[str, Geometry]
    notes: tuple[str, ...] = ()
    casting: Geometry | None = None
    findings: tuple[Finding, ...] = ()


def mold_part(title: str, name: str, shape: Any) -> Geometry:
    """Return a copy of a CAD shape as a geometry with one region and one face.

    Faces that the kernel has taken from the part have the name of those of the part: without a copy the part would
    lose its names.
    """
    shape = packed(shape).shape()
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
