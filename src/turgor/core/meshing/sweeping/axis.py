"""Sections that reach the axis about which they are turned: a core of squares replaces collapsed cells."""

from math import pi

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.extrusion import Sweep, Turned
from turgor.core.geometry.shapes.sections import Outline, rectangle
from turgor.core.meshing.coinciding_points import same_places
from turgor.core.meshing.sweeping.hexahedra import PLACES, Filling
from turgor.core.meshing.sweeping.polar import core_section
from turgor.core.meshing.sweeping.section import SAME_LINE, Fineness, SectionMesh, is_solid, names_at
from turgor.core.meshing.sweeping.settings import SECTION
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def reaches_axis(sweep: Sweep, section: SectionMesh) -> bool:
    """Whether a solid cell of a turned section lies on the axis."""
    if not isinstance(sweep.path, Turned):
        return False
    r = section.points[section.quads, 1]
    touching = r.min(axis=1) <= SAME_LINE * float(np.ptp(section.points, axis=0).max())
    return any(is_solid(name) for name in names_at(sweep.layers, section.centers[touching]).ravel())


def core_radius(sweep: Sweep) -> float:
    """Radius within which the core lies [m]."""
    radii = [r for outline in sweep.outlines for _, r in outline.corners]
    return SECTION.core * min(r for r in radii if r > SAME_LINE * max(radii))


def without_core(section: SectionMesh, radius: float) -> SectionMesh:
    """Take away the cells of the core."""
    return SectionMesh(points=section.points, quads=section.quads[section.centers[:, 1] > radius])


def with_core(filling: Filling, sweep: Sweep, section: SectionMesh, radius: float, fine: Fineness) -> Filling:
    """Fill the core of a turned section whose cells begin at ``radius``; each part is what lies around it."""
    layer = sweep.layers[0]
    quarters = [layer.start / (pi / 2), layer.end / (pi / 2)]
    if len(sweep.layers) > 1 or any(abs(q - round(q)) > 1e-9 for q in quarters):
        raise TurgorError("a section that reaches its axis can be turned in one layer of whole quarters only.")
    count = len(filling.cells) // len(section.quads) // round(quarters[1] - quarters[0]) // 2
    disc = core_section(radius, count, fine, range(round(quarters[0]), round(quarters[1])))
    edges, owner = _edges_at(section, radius)
    x = section.points[edges, 0]  # start, middle, end of each edge
    steps = len(edges)
    points = np.concatenate([np.insert(disc.points, 0, at, axis=1) for at in x.ravel()])
    base = (3 * np.arange(steps)[:, None] + np.arange(3)) * len(disc.points)
    nodes = [base[:, [station]] + disc.quads[:, i][None, :] for station, i in PLACES]
    cells = np.stack([n.ravel() for n in nodes], axis=1) + len(filling.points)
    names = np.repeat(names_at(sweep.layers, section.centers[owner])[0], len(disc.quads))
    everything = np.concatenate([filling.points, points])
    number, first = same_places(everything)
    return Filling(
        points=everything[first],
        cells=number[np.concatenate([filling.cells, cells])],
        names=np.concatenate([filling.names, names]),
    )


def core_outline(sweep: Sweep) -> Outline:
    """The core as an outline of the section, so that cells end at it."""
    x = [x for outline in sweep.outlines for x, _ in outline.corners]
    return rectangle((min(x), max(x)), (0.0, core_radius(sweep)))


def _edges_at(section: SectionMesh, radius: float) -> tuple[Ints, Ints]:
    """Edges (e, 3) of the section at a radius, in the direction of x, and the quadrilateral of each."""
    tolerance = SAME_LINE * float(np.ptp(section.points, axis=0).max())
    edges, owner = [], []
    for i in range(4):
        edge = section.quads[:, [i, 4 + i, (i + 1) % 4]]
        there = np.flatnonzero((np.abs(section.points[edge, 1] - radius) <= tolerance).all(axis=1))
        edges.append(edge[there])
        owner.append(there)
    on_axis = np.concatenate(edges)
    backwards = section.points[on_axis[:, 0], 0] > section.points[on_axis[:, 2], 0]
    on_axis[backwards] = on_axis[backwards][:, ::-1]
    return on_axis, np.concatenate(owner)
