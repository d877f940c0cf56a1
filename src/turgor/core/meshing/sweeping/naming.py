"""From hexahedra that fill everything to a mesh of the solids with named faces."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.extrusion import Interface, PlaneName, RangeName, Sweep
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import corner_keys
from turgor.core.meshing.sweeping.hexahedra import Filling
from turgor.core.meshing.sweeping.section import SAME_LINE, is_solid

Ints = NDArray[np.int64]
Names = NDArray[np.object_]
Flags = NDArray[np.bool_]

#: What lies beyond a side where no cell is.
AIR = None


def assemble(filling: Filling, geometry: Geometry, sweep: Sweep) -> Mesh:
    """Keep the solid cells and name their sides.

    Parameters
    ----------
    filling : Filling
        Cells of solids, cavities and air.
    geometry : Geometry
        Its regions, in their order.
    sweep : Sweep
        The names of the faces.

    Returns
    -------
    Mesh
    """
    order = {name: i for i, name in enumerate(geometry.regions)}
    solids = np.array([i for i, name in enumerate(filling.names) if is_solid(name)], dtype=np.int64)
    rest = np.setdiff1d(np.arange(len(filling.cells)), solids)
    solids = solids[np.argsort([order[filling.names[i]] for i in solids], kind="stable")]
    cells, names = filling.cells[np.append(solids, rest)], filling.names[np.append(solids, rest)]
    sides = cells[:, np.array(HEXAHEDRON.sides)].reshape(-1, HEXAHEDRON.side.nodes)
    face = _face_names(filling.points, sides, names, len(solids), sweep)
    sides = sides[: 6 * len(solids)]
    corners = HEXAHEDRON.corners
    solid = cells[: len(solids)]
    nodes = np.concatenate([np.unique(solid[:, :corners]), np.unique(solid[:, corners:])])
    number = np.full(len(filling.points), -1, dtype=np.int64)
    number[nodes] = np.arange(len(nodes))
    return Mesh(
        points=filling.points[nodes],
        cells=number[solid],
        regions={name: np.flatnonzero(names[: len(solids)] == name) for name in geometry.regions},
        faces={name: number[sides[face == name]] for name in sorted({n for n in face if n is not None})},
        name=geometry.name,
    )


def _face_names(points: NDArray[np.float64], sides: Ints, names: Names, solids: int, sweep: Sweep) -> Names:
    """Name of the face that each side of the solid cells, which come first, belongs to; None inside a region."""
    beyond = _beyond(sides)[: 6 * solids]
    sides = sides[: 6 * solids]
    own, other = np.repeat(names[:solids], 6), names[beyond]
    other[beyond < 0] = AIR
    inner = (beyond >= 0) & (beyond < solids)
    hollow = np.array([isinstance(name, str) for name in other]) & ~inner
    outer = ~inner & ~hollow
    face = np.full(len(sides), None, dtype=object)
    face[outer] = "outside"
    face[hollow] = other[hollow]
    inner &= np.repeat(np.arange(solids), 6) < beyond  # of two sides in one place that of the first cell counts
    between = inner & (own != other)
    tolerance = SAME_LINE * float(np.ptp(points, axis=0).max())
    for rule in sweep.names:
        if isinstance(rule, Interface):
            there = between & np.isin(own, rule.regions) & np.isin(other, rule.regions)
        else:
            where = points[sides, rule.axis]
            there = _in_range(where, rule, tolerance) & (outer | (_named_inside(rule, inner, between)))
        face[there] = rule.name
    return face


def _named_inside(rule: PlaneName | RangeName, inner: Flags, between: Flags) -> Flags:
    """Which sides with solids on both sides a rule may name."""
    if isinstance(rule, RangeName):
        return np.zeros_like(inner)
    return inner if rule.within else between


def _in_range(where: NDArray[np.float64], rule: PlaneName | RangeName, tolerance: float) -> Flags:
    """Which sides lie in a plane or between two planes, from the coordinate of their nodes (f, 9)."""
    if isinstance(rule, PlaneName):
        return np.asarray((np.abs(where - rule.position) <= tolerance).all(axis=1))
    there = ((where >= rule.low - tolerance) & (where <= rule.high + tolerance)).all(axis=1)
    return np.asarray(there if rule.ends else there & (np.ptp(where, axis=1) > tolerance))


def _beyond(sides: Ints) -> Ints:
    """The cell beyond each side, row 6 k + i for side i of cell k; -1 where there is none."""
    keys = corner_keys(sides, int(sides.max()) + 1)
    order = np.argsort(keys, kind="stable")
    same = np.flatnonzero(keys[order[1:]] == keys[order[:-1]])
    a, b = order[same], order[same + 1]
    beyond = np.full(len(sides), -1, dtype=np.int64)
    beyond[a], beyond[b] = b // 6, a // 6
    return beyond
