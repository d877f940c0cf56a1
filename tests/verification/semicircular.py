"""The semicircular bender of V21: its fibers, its section, and long actuators of it."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

import problems
import slices
import turgor as tg
from turgor.core.geometry.actuators.fiber_reinforced_bender import FiberReinforcedBender
from turgor.core.model.fibers import Fibers
from turgor.units import mm

#: Stiffness per width [N/m]: of the hoops around the contour, and of the base, in both directions.
CONTOUR, BASE = 257e3, 650e3
FLAT = "strain_limiting_layer"


class Bent(NamedTuple):
    """What a section does at a pressure: rotation [1/m] and volume of the void [m²] for each reference length."""

    curvature: float
    volume: float


def base(compression: float = 1.0) -> list[Fibers]:
    """Fibers along and across the flat side."""
    more = {"axis": (1.0, 0.0, 0.0), "face": FLAT, "compression": compression}
    return [slices.family(BASE, angle, **more) for angle in (0.0, np.pi / 2)]


def hoops(compression: float = 1.0) -> Fibers:
    """Fibers around the whole contour."""
    return slices.family(CONTOUR, 0.0, face=("outside", FLAT), axis=(1.0, 0.0, 0.0), compression=compression)


def swept(length: float, wall: float = 2 * mm) -> tg.Mesh:
    """Half of the actuator without a skin, of hexahedra; the outer contour stays where the wall is thinner."""
    actuator = FiberReinforcedBender(radius=10 * mm - wall, wall=wall, skin=0.0, length=length)
    return tg.mesh(actuator.build(), size=min(8 * mm, 4 * wall), cells="hexahedra")


def bend(fibers, pressures, wall: float = 2 * mm) -> list[Bent]:
    """Solve the section of a long actuator at pressures [Pa]."""
    outline = FiberReinforcedBender(radius=10 * mm - wall, wall=wall, skin=0.0)
    section = tg.Section(outline, {"body": problems.rubber(problems.NEO_HOOKE)}, reinforcements=fibers, size=wall / 4)
    response = section.solve(pressures, mesh_error=False).response
    columns = response["curvature_y"], response["cavity_volume_per_length"]
    return [Bent(float(curvature), float(volume)) for curvature, volume in zip(*columns, strict=True)]


def actuator(layers) -> tg.Mesh:
    """Half of a whole actuator with end walls; ``layers`` [m]: cells along the void from one end to the middle."""
    mesh = swept(10 * mm + 2 * (len(layers) - 1) * 8 * mm)  # a short cell beside each end wall is one of them
    planes = np.unique(np.round(mesh.points[:, 0], 8))
    count = round(np.searchsorted(planes, 5 * mm - 1e-9) / 2)  # layers of an end wall
    assert len(planes) == 4 * (len(layers) + count) + 1
    sizes = [*[5 * mm / count] * count, *layers]
    ends = np.concatenate([[0.0], np.cumsum(np.repeat([*sizes, *sizes[::-1]], 2) / 2)])
    points = mesh.points.copy()
    points[:, 0] = np.interp(points[:, 0], planes, ends)
    return replace(mesh, points=points)


def turn_between(state: tg.solutions.State, low: float, high: float) -> float:
    """Rotation for each reference length [1/m] between the sections nearest to two shares of the length."""
    points, x = state.model.mesh.points, problems.current(state)
    planes = np.unique(np.round(points[:, 0], 8))
    chosen = [planes[np.abs(planes - share * planes[-1]).argmin()] for share in (low, high)]
    turns = []
    for plane in chosen:
        nodes = np.flatnonzero(np.abs(points[:, 0] - plane) < 1e-7)
        turns.append(np.arctan(np.polyfit(x[nodes, 2], x[nodes, 0], 1)[0]))
    return float((turns[1] - turns[0]) / (chosen[1] - chosen[0]))
