"""Halves of a mold: where they meet, their pins, and the holes to pour."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.molds.cores import Plug
from turgor.core.geometry.molds.mold import MoldSettings
from turgor.core.geometry.molds.parting import Parting

Array = NDArray[np.float64]

#: How far the holes to pour reach into the casting's top, for tops that are round [CAD units].
REACH = 0.3

#: Share of the height below its top in which a casting is poured from.
TOP = 0.02


def block(low: Array, high: Array) -> Any:
    """Make a box between two corners [CAD units]."""
    return occ.Box(occ.Pnt(*map(float, low)), occ.Pnt(*map(float, high)))


def lower_side(parting: Parting, plugs: list[Plug], low: Array, high: Array, rim: float) -> Any:
    """Space of the lower half: below the plane, with steps, wider by a rim, to the middle of plugs across the pull."""
    top, axis = high.copy(), parting.axis
    top[axis] = parting.height
    side = block(low, top) if parting.height > low[axis] else None
    for plug in (each for each in plugs if each.axis != axis):
        near, far = (np.array([corner[i] for i in range(3)]) for corner in plug.shape.bounding_box)
        middle = (near[axis] + far[axis]) / 2
        near[axis], far[axis] = sorted((middle, parting.height))
        if far[axis] - near[axis] < 1e-6:
            continue
        aside = 3 - axis - plug.axis
        near[aside], far[aside] = near[aside] - rim, far[aside] + rim
        step = block(near, far)
        side = side - step if middle < parting.height else side + step
    return side


def pins(parting: Parting, low: Array, high: Array, settings: MoldSettings) -> tuple[list[Any], list[Any]]:
    """Pins on the lower half, in the corners of the parting plane, and their holes in the upper one."""
    across = [i for i in range(3) if i != parting.axis]
    radius, tall, clear = (
        each / METERS_PER_CAD_UNIT for each in (settings.pin_diameter / 2, settings.pin_height, settings.clearance)
    )
    rods, holes = [], []
    for a in (low[across[0]], high[across[0]]):
        for b in (low[across[1]], high[across[1]]):
            foot = np.zeros(3)
            foot[parting.axis], foot[across[0]], foot[across[1]] = parting.height, a, b
            rods.append(_rod(foot, parting.axis, radius, tall))
            holes.append(_rod(foot, parting.axis, radius + clear, tall + clear))
    return rods, holes


def pouring_holes(outside: Array, parting: Parting, high: Array, settings: MoldSettings) -> list[Any]:
    """Two holes from the ends of the casting's top out of the upper half: to pour in, and for the air."""
    axis, points = parting.axis, outside.reshape(-1, 3)
    level = points[:, axis].max()
    top = points[points[:, axis] > level - TOP * np.ptp(points[:, axis])]
    longest = max((i for i in range(3) if i != axis), key=lambda i: float(np.ptp(points[:, i])))
    radius = settings.pour_diameter / 2 / METERS_PER_CAD_UNIT
    holes = []
    for end in (top[:, longest].min(), top[:, longest].max()):
        near = top[np.abs(top[:, longest] - end) < 2 * radius + 1e-6]
        foot = (near.min(axis=0) + near.max(axis=0)) / 2
        foot[axis] = level - REACH
        holes.append(_rod(foot, axis, radius, float(high[axis] - foot[axis])))
    return holes


def _rod(foot: Array, axis: int, radius: float, height: float) -> Any:
    return occ.Cylinder(occ.Pnt(*map(float, foot)), (occ.X, occ.Y, occ.Z)[axis], r=radius, h=height)
