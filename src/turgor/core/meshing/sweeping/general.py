"""Sections of any outlines: triangles of the mesh generator, paired and cut into quadrilaterals."""

from collections.abc import Sequence
from math import hypot
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.shapes.planar import planar_faces
from turgor.core.geometry.shapes.sections import Outline
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing import netgen
from turgor.core.meshing.coinciding_points import same_places
from turgor.core.meshing.silenced_output import captured_output
from turgor.core.meshing.sweeping.pairing import corner_sines, paired
from turgor.core.meshing.sweeping.section import Fineness, SectionMesh, circle_of, joined
from turgor.core.meshing.sweeping.settings import SECTION
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Where a nine-node quadrilateral has its nodes, as weights of its corners.
NINE = np.array(
    [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    + [[0.5, 0.5, 0, 0], [0, 0.5, 0.5, 0], [0, 0, 0.5, 0.5], [0.5, 0, 0, 0.5], [0.25] * 4]
)

#: Corners of the three quadrilaterals in a triangle, in barycentric coordinates, and of the four in a quadrilateral.
THIRDS = np.array([[np.roll(c, k) for c in ([6, 0, 0], [3, 3, 0], [2, 2, 2], [3, 0, 3])] for k in range(3)]) / 6
QUARTERS = np.array([[[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]] for x, y in ((-1, -1), (0, -1), (0, 0), (-1, 0))])


def general_section(outlines: Sequence[Outline], fine: Fineness) -> SectionMesh:
    """Mesh everything within outlines of straight edges and arcs.

    The generator makes triangles of twice the size, pairs of them become quadrilaterals, and everything is cut in the
    middle of its sides, which leaves quadrilaterals only: two at least through a wall. Nodes on arcs lie on them.

    Parameters
    ----------
    outlines : sequence of Outline
        They may overlap; cells end at every edge.
    fine : Fineness

    Raises
    ------
    TurgorError
        If the mesh generator fails.
    """
    coarse = _quadrilaterals(outlines, fine, close=False)
    if corner_sines(coarse.points, coarse.quads[:, :4]).min() >= SECTION.flat_corner:
        return coarse
    finer = _quadrilaterals(outlines, fine, close=True)
    return max(coarse, finer, key=lambda section: float(corner_sines(section.points, section.quads[:, :4]).min()))


def _quadrilaterals(outlines: Sequence[Outline], fine: Fineness, close: bool) -> SectionMesh:
    points, triangles, segments = _generate(outlines, fine, close)
    triangles, quads = paired(points, triangles, segments)
    bends = _bends(points, segments, outlines)
    parts = []
    if len(triangles):
        N = _triangle_shapes(np.einsum("na,qad->qnd", NINE, THIRDS).reshape(-1, 3))
        parts.append(_cut(_with_mids(points, triangles, bends), N))
    if len(quads):
        N = _quadrilateral_shapes(np.einsum("na,qad->qnd", NINE, QUARTERS).reshape(-1, 2))
        parts.append(_cut(_with_mids(points, quads, bends), N))
    whole = joined(parts)
    return SectionMesh(points=_on_arcs(whole.points, points, bends), quads=whole.quads)


def _generate(outlines: Sequence[Outline], fine: Fineness, close: bool) -> tuple[Array, Ints, Ints]:
    """Points [m], triangles, counterclockwise, and the segments of the outlines."""
    options = {"closeedgefac": 1 / SECTION.longest_per_gap} if close else {}
    before = netgen.SetMessageImportance(0)
    with captured_output():
        try:
            mesh: Any = planar_faces(outlines).GenerateMesh(
                dim=2,
                mp=_sizes_at_corners(fine),
                maxh=2 * fine.size / METERS_PER_CAD_UNIT,
                grading=fine.grading,
                curvaturesafety=max(fine.curvature / 2, 1.0),
                parallel_meshing=False,
                ngs_mesh=False,
                **options,
            )
        except netgen.NgException as error:
            size = f"{fine.size / mm:.4g} mm"
            raise TurgorError(f"a section could not be meshed at size {size}; use a smaller one.") from error
        finally:
            netgen.SetMessageImportance(before)
    points = np.array(mesh.Coordinates(), dtype=np.float64)[:, :2] * METERS_PER_CAD_UNIT
    triangles = mesh.Elements2D().NumPy()["nodes"][:, :3].astype(np.int64) - 1
    clockwise = corner_sines(points, triangles)[:, 0] < 0
    triangles[clockwise] = triangles[clockwise, ::-1]
    segments = mesh.Elements1D().NumPy()["nodes"][:, :2].astype(np.int64) - 1
    return points, triangles, np.unique(np.sort(segments, axis=1), axis=0)


def _sizes_at_corners(fine: Fineness) -> Any:
    """Smaller triangles at corners, as the generator takes them; None without any."""
    if not fine.corners or fine.edge is None:
        return None
    parameters = netgen.MeshingParameters()
    for y, z in fine.corners:
        parameters.RestrictH(y / METERS_PER_CAD_UNIT, z / METERS_PER_CAD_UNIT, 0.0, 2 * fine.edge / METERS_PER_CAD_UNIT)
    return parameters


#: Center and radius of the arc that each curved segment of the outlines lies on.
Bends = dict[tuple[int, int], tuple[Array, float]]


def _bends(points: Array, segments: Ints, outlines: Sequence[Outline]) -> Bends:
    """Find the segments that lie on an arc and on no straight edge."""
    edges = [edge for outline in outlines for edge in outline.edges]
    scale = float(np.ptp(points, axis=0).max())
    bends: Bends = {}
    on = np.zeros(len(segments), dtype=bool)
    for a, b, arc in edges:
        if not arc:
            on |= _near_line(points, np.array(a), np.array(b), TOLERANCE.round_off * scale)[segments].all(axis=1)
    for a, b, arc in edges:
        if arc:
            center, radius = circle_of(a, b, arc)
            near = np.abs(np.hypot(*(points - center).T) - radius) < TOLERANCE.round_off * scale
            angle = np.arctan2(points[:, 1] - center[1], points[:, 0] - center[0])
            first = np.arctan2(a[1] - center[1], a[0] - center[0])
            turned = (np.sign(arc) * (angle - first) + 1e-6) % (2 * np.pi)
            near &= turned <= abs(arc) + 2e-6
            for i, j in segments[near[segments].all(axis=1) & ~on]:
                bends[int(i), int(j)] = np.array(center), radius
    return bends


def _near_line(points: Array, a: Array, b: Array, tolerance: float) -> NDArray[np.bool_]:
    span = (b - a) / hypot(*(b - a))
    along, off = (points - a) @ span, (points - a) @ np.array([-span[1], span[0]])
    return (np.abs(off) < tolerance) & (along > -tolerance) & (along < hypot(*(b - a)) + tolerance)


def _with_mids(points: Array, cells: Ints, bends: Bends) -> Array:
    """Positions of corners and mid-side nodes of each cell, (c, 6 or 8, 2)."""
    corners = points[cells]
    mids = (corners + np.roll(corners, -1, axis=1)) / 2
    count = cells.shape[1]
    for k, cell in enumerate(cells.tolist()):
        for i in range(count):
            bend = bends.get((min(cell[i], cell[(i + 1) % count]), max(cell[i], cell[(i + 1) % count])))
            if bend:
                mids[k, i] = _projected(mids[k, i], *bend)
    return np.concatenate([corners, mids], axis=1)


def _projected(point: Array, center: Array, radius: float) -> Array:
    away = point - center
    return np.asarray(center + radius * away / hypot(*away))


def _cut(nodes: Array, N: Array) -> SectionMesh:
    """Evaluate curved cells (c, a, 2) at the nodes of the quadrilaterals in them, by shape functions (9 k, a)."""
    points = np.einsum("pa,cad->cpd", N, nodes).reshape(-1, 2)
    number, first = same_places(points)
    return SectionMesh(points=points[first], quads=number.reshape(-1, 9))


def _triangle_shapes(L: Array) -> Array:
    """Shape functions of the six-node triangle, (p, 6)."""
    corners = L * (2 * L - 1)
    return np.concatenate([corners, 4 * L * np.roll(L, -1, axis=1)], axis=1)


def _quadrilateral_shapes(at: Array) -> Array:
    """Shape functions of the eight-node quadrilateral, (p, 8)."""
    x, y = at[:, :1], at[:, 1:]
    X, Y = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
    corners = (1 + x * X) * (1 + y * Y) * (x * X + y * Y - 1) / 4
    mids = [(1 - x**2) * (1 - y) / 2, (1 + x) * (1 - y**2) / 2, (1 - x**2) * (1 + y) / 2, (1 - x) * (1 - y**2) / 2]
    return np.concatenate([corners, *mids], axis=1)


def _on_arcs(mids: Array, points: Array, bends: Bends) -> Array:
    """Move the nodes halfway between corners and mid-side nodes of curved segments onto their arcs."""
    moved = mids.copy()
    for (i, j), bend in bends.items():
        a, b, middle = points[i], points[j], _projected((points[i] + points[j]) / 2, *bend)
        for t in (0.25, 0.75):
            place = a * (1 - t) * (1 - 2 * t) + b * t * (2 * t - 1) + middle * 4 * t * (1 - t)
            nearest = np.hypot(*(mids - place).T).argmin()
            moved[nearest] = _projected(place, *bend)
    return moved
