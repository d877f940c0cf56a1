"""Ducts: round air inlets that lead from a cavity straight up through the wall above it."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, pi, sin
from typing import Any

from turgor.core.geometry import occ
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.rules import check_option
from turgor.core.geometry.shapes.arcs import split_edge
from turgor.core.geometry.shapes.sections import Outline
from turgor.core.geometry.shapes.solids import union
from turgor.foundation.errors import TurgorError

#: Sides at which an inlet can open: the fixed end, or the top.
SIDES = ("fixed", "top")

#: Points of the Gauss–Chebyshev quadrature over the duct; the walls are smooth, so it is exact to rounding.
POINTS = 40


@dataclass(frozen=True, slots=True, kw_only=True)
class Duct:
    """A round hole along z, from the top of a cavity to the top of the actuator.

    Parameters
    ----------
    name : str
        Face of the connected cavity.
    x : float [m]
        Position of its axis, which lies in the plane y = 0.
    diameter : float [m]
        Its diameter, less than the width of the cavity.
    below : Outline
        Section of the cavity.
    above : Outline
        Section of the whole actuator, the cavity filled.
    """

    name: str
    x: float
    diameter: float
    below: Outline
    above: Outline

    @property
    def volume(self) -> float:
        """Volume between the two outlines [m³], by Gauss–Chebyshev quadrature of the second kind."""
        radius, total = self.diameter / 2, 0.0
        for i in range(1, POINTS + 1):
            angle = i * pi / (POINTS + 1)
            height = top(self.above, radius * cos(angle)) - top(self.below, radius * cos(angle))
            total += pi / (POINTS + 1) * sin(angle) ** 2 * height
        return 2 * radius**2 * total

    def solid(self, around: Sequence[Any], cavity: Any) -> Any:
        """Build the CAD shape: the part of the hole within the solids around it and outside the cavity."""
        scale, low = METERS_PER_CAD_UNIT, self.below.centroid[1]
        length = 2 * (top(self.above, 0.0) - low)
        hole = occ.Cylinder(
            occ.Pnt(self.x / scale, 0, low / scale), occ.Z, r=self.diameter / 2 / scale, h=length / scale
        )
        within = [part for part in (hole * solid for solid in around) if len(part.solids)]
        return union(within) - cavity


def top(outline: Outline, y: float) -> float:
    """Return the height of the upper side of an outline at a position across it.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.sections import disc
    >>> round(top(disc(5.0), 3.0), 12)
    4.0
    """
    heights = [corner[1] for corner in outline.corners if corner[0] == y]
    for start, end, arc in outline.edges:
        heights += [piece[1][1] for piece in split_edge(start, end, arc, 0, y)[:-1]]
    return max(heights)


def check_inlet(actuator: Any, *, end: float, above: float, inside: float, quarter: bool = False) -> None:
    """Raise an error for an inlet that does not end in the cavity, has an unknown side, or would be mirrored.

    Parameters
    ----------
    actuator : dataclass
        An actuator with the fields ``inlet_diameter`` and ``inlet_side``, for a quarter also ``symmetric``.
    end, above : float [m]
        Largest diameter at the fixed end and on top.
    inside : float [m]
        Length of the cavity.
    quarter : bool
        Whether a symmetric model is a quarter, which mirrors the top to the bottom.
    """
    if actuator.inlet_side not in SIDES:
        raise TurgorError(f"inlet_side is {actuator.inlet_side!r}; allowed: {', '.join(SIDES)}.")
    high = end if actuator.inlet_side == "fixed" else min(above, inside / 2)
    check_option("inlet_diameter", actuator.inlet_diameter, high=high, why="so that it ends in the cavity")
    if quarter and actuator.symmetric and actuator.inlet_diameter and actuator.inlet_side == "top":
        raise TurgorError(
            "inlet_side is 'top'; in a quarter the inlet would be at the bottom too: set symmetric to False, or "
            "inlet_side to 'fixed'."
        )
