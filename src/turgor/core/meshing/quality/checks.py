"""Checks of a mesh before a solve; each returns findings."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.walls import WALLS, thinnest_wall
from turgor.core.meshing.cells import TETRAHEDRON, six_node_triangles
from turgor.core.meshing.mesh import TRIANGLE_EDGES, Mesh
from turgor.core.meshing.quality.facing_walls import edge_keys, unit_normals
from turgor.core.meshing.quality.quality_cache import once_per_mesh
from turgor.core.meshing.quality.settings import FACING
from turgor.core.meshing.surface import among, check_surface, outer_triangles
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Flat triangles between the nodes of one of six nodes.
_QUARTERS = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))


def check_mesh(mesh: Mesh) -> tuple[Finding, ...]:
    """Check for walls with fewer than two cells through them (G01) and for faces that do not fit the mesh (G02 to G04).

    Findings of the mesh generation (G08: repaired cells) come first.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    tuple of Finding
        Empty when nothing was noticed.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> [finding.code for finding in check_mesh(mesh(FastPneuNet(chambers=2, length=20e-3).build(), size=3e-3))]
    ['G01']
    """
    return (*mesh.findings, *_checked(mesh))


@once_per_mesh
def _checked(mesh: Mesh) -> tuple[Finding, ...]:
    return (*_thin_walls(mesh), *check_surface(mesh))


def crossings(mesh: Mesh) -> tuple[Ints, Array]:
    """Find the edges that connect the two surfaces of a wall; there the wall has one cell through its thickness.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    edges : (e, 2) int array
        Vertices at the two ends.
    thickness : (e,) array [m]
        Thickness of the wall at each edge: length of the edge along the surface normal.
    """
    surface = six_node_triangles(outer_triangles(mesh))
    surface = surface[~_on_cuts(mesh, surface)]
    n = len(mesh.points)
    on_surface = np.zeros(n, dtype=bool)
    on_surface[surface[:, :3]] = True
    edges = np.concatenate([mesh.cells[:, e] for e in mesh.cell_type.edges])
    keys = np.unique(edge_keys(edges[on_surface[edges].all(axis=1)], n))
    flat = np.sort(edge_keys(np.concatenate([surface[:, e] for e in TRIANGLE_EDGES]), n))
    edges = np.stack(np.divmod(keys[~among(keys, flat)], n), axis=1)
    # every triangle at the first end against every triangle at the second
    owner, first = _triangles_at(surface, edges[:, 0])
    pair, second = _triangles_at(surface, edges[owner, 1])
    owner, first = owner[pair], first[pair]
    normal, span = unit_normals(mesh.points, surface), mesh.points[edges[:, 1]] - mesh.points[edges[:, 0]]
    opposed = np.einsum("pi,pi->p", normal[first], normal[second]) < -FACING.opposed
    owner, first, second = owner[opposed], first[opposed], second[opposed]
    leaving = -np.einsum("pi,pi->p", span[owner], normal[first])
    arriving = np.einsum("pi,pi->p", span[owner], normal[second])
    depth = np.minimum(leaving, arriving)
    through = depth > 0
    thickness = np.full(len(edges), np.inf)
    np.minimum.at(thickness, owner[through], depth[through])
    crossing = np.isfinite(thickness)
    return edges[crossing], thickness[crossing]


def _triangles_at(surface: Ints, vertices: Ints) -> tuple[Ints, Ints]:
    """Pairs of (place in ``vertices``, triangle with a corner at that vertex)."""
    corners = surface[:, :3].ravel()
    order = np.argsort(corners, kind="stable")
    start, end = (np.searchsorted(corners[order], vertices, side=side) for side in ("left", "right"))
    place = np.repeat(np.arange(len(vertices)), end - start)
    offset = np.arange(len(place)) - np.repeat(np.cumsum(end - start) - (end - start), end - start)
    return place, order[start[place] + offset] // 3


def _thinnest(mesh: Mesh, edges: Ints, thickness: Array) -> tuple[float, Array]:
    """Thickness that 99 % of the walls exceed through which edges (e, 2) reach, and where, as `smallest_wall` has it.

    Single edges are no measure of it: at the rim of a wall they cut corners, and are shorter.
    """
    surface = six_node_triangles(outer_triangles(mesh))
    surface = surface[~_on_cuts(mesh, surface)]
    through = np.isin(surface[:, :3], edges).any(axis=1)
    parts = np.concatenate([surface[:, part] for part in _QUARTERS])  # closer to a curved surface than its corners
    thinnest, place = thinnest_wall(mesh.points[parts], np.tile(through, len(_QUARTERS)), WALLS.fewest)
    if place is None:
        return float(thickness.min()), mesh.points[edges[thickness.argmin()]].mean(axis=0)
    return thinnest, place


def _on_cuts(mesh: Mesh, surface: Ints) -> NDArray[np.bool_]:
    """Which triangles lie on a cut, which is no surface of the whole actuator."""
    on_faces = np.zeros(len(surface), dtype=bool)
    for name in mesh.cut_faces:
        on_faces |= np.isin(surface, mesh.face_nodes(name)).all(axis=1)
    return on_faces


def _thin_walls(mesh: Mesh) -> list[Finding]:
    edges, thickness = crossings(mesh)
    if not len(edges):
        return []
    thinnest, place = _thinnest(mesh, edges, thickness)
    x, y, z = place / mm
    tetrahedra = mesh.cell_type is TETRAHEDRON
    return [
        Finding(
            code="G01",
            severity=Severity.WARNING,
            message=f"One cell reaches through the wall in {len(edges)} places; the thinnest of these walls is "
            f"{thinnest / mm:.3g} mm thick, near ({x:.3g}, {y:.3g}, {z:.3g}) mm.",
            advice="One quadratic cell through a wall bends well, but compare with a finer mesh before trusting "
            "stresses; wall_cells = 2 puts two cells through every wall, and so does a size near "
            f"{thinnest / 2 / mm:.2g} mm."
            if tetrahedra
            else "One quadratic cell through a wall bends well, but before trusting stresses, or angles to better than "
            "10 %, compare with a finer mesh, such as wall_cells = 2 with a size of twice the wall thickness.",
        )
    ]
