"""The semicircular bender of V21: its section, its fibers, and slices or long actuators of it."""

from dataclasses import replace

import numpy as np

import bent_slice
import problems
import slices
import turgor as tg
from turgor.geometry import FiberReinforcedBender
from turgor.model.fibers import Fibers
from turgor.units import mm

#: Stiffness per width [N/m]: of the hoops around the contour, and of the base, in both directions.
CONTOUR, BASE = 257e3, 650e3
FLAT = "strain_limiting_layer"


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


def bend(fibers, pressures, wall: float = 2 * mm) -> list[bent_slice.Bent]:
    """Take a slice, far from the ends of a long actuator, to pressures [Pa]."""
    mesh = bent_slice.one_layer(swept(30 * mm, wall), 1 * mm, 15.1 * mm)
    return bent_slice.BentSlice(mesh, problems.NEO_HOOKE, fibers, max(pressures)).follow(pressures)


def actuator(layers) -> tg.Mesh:
    """Half of a whole actuator with end walls; ``layers`` [m]: cells along the void from one end to the middle."""
    mesh = swept(10 * mm + 2 * len(layers) * 8 * mm)
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
