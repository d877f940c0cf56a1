"""Tetrahedra in a part that is given by facets, by fTetWild (Hu, Schneider, Wang, Zorin and Panozzo 2020).

fTetWild fills any surface: its boundary stays within an envelope around the facets, so that it need not keep each of
them. The nodes are then drawn onto the facets, sharp edges onto edges, and the sides are curved like the surface.
"""

from collections.abc import Mapping
from contextlib import chdir
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.bodies.assemble import Raw
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.tetwild.background import background
from turgor.core.meshing.tetwild.boundary import boundary_of, faces_of
from turgor.core.meshing.tetwild.mesh_cache import cached_cells
from turgor.core.meshing.tetwild.nearest import NearestPlaces, sharp_edges
from turgor.core.meshing.tetwild.settings import TETWILD
from turgor.core.meshing.tetwild.snapping import faces_at, on_mirrors, pressed_flat, snapped, unspoiled
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def enveloped_cells(geometry: Geometry, settings: MeshSettings) -> Raw:
    """Fill a part that is given by facets with ten-node tetrahedra.

    Parameters
    ----------
    geometry : Geometry
        Whose shape is a `SurfaceShape`.
    settings : MeshSettings
        With a size.

    Returns
    -------
    Raw
        Nodes on the surface; mid-side nodes may turn cells inside out, which the caller mends.

    Raises
    ------
    TurgorError
        If no cells were made.
    """
    shape, scale = geometry._cad, geometry.length_scale
    assert isinstance(shape, SurfaceShape) and settings.size is not None
    size = settings.size / scale
    envelope = min(TETWILD.envelope_per_size * size, TETWILD.envelope_per_wall * geometry.smallest_wall / scale)
    points, cells = _filled(shape, settings, size, envelope, geometry.name)
    surface, edges = NearestPlaces(shape, size / 2), sharp_edges(shape)
    while True:
        sides = boundary_of(points, cells)
        face = faces_of(points, sides, surface)
        around = faces_at(sides, face)
        drawn = snapped(points, around, surface, edges, envelope)
        flat = pressed_flat(points, drawn, cells, sides, around)
        if not len(flat):
            break
        points, cells = _used(points, np.delete(cells, flat, axis=0))
    points = unspoiled(points, drawn, cells)
    points = on_mirrors(points, sides, face, shape)
    points, cells, middles = _quadratic(points, cells)
    on_edge = np.sort(sides[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    of_edge = np.array([middles[a, b] for a, b in on_edge.tolist()], dtype=np.int64).reshape(-1, 3)
    points = snapped(points, faces_at(of_edge, face), surface, edges, envelope + size / 20)
    points = on_mirrors(points, of_edge, face, shape)
    return Raw(
        points=points * scale,
        cells=cells,
        cell_region=np.zeros(len(cells), dtype=np.int64),
        regions=geometry.regions,
        corners=sides,
        corner_face=face,
        faces=tuple(each.name for each in shape.faces),
    )


def _filled(shape: SurfaceShape, settings: MeshSettings, size: float, envelope: float, name: str) -> tuple[Array, Ints]:
    """Corners and cells of fTetWild, of positive volume, in one piece."""
    inputs: dict[str, object] = {}
    if settings.face_sizes:
        sizes = {face: value / mm for face, value in settings.face_sizes.items()}
        field = background(shape, size, sizes, float(settings.grading))
        inputs |= {"bg_vertices": field.points, "bg_tets": field.cells.astype(np.int32), "bg_values": field.values}
    inputs |= {
        "vertices": shape.points,
        "faces": shape.triangles.astype(np.int32),
        "edge_length_abs": size,
        "epsilon": envelope / float(np.linalg.norm(np.ptp(shape.points, axis=0))),
        "stop_energy": TETWILD.stop_energy,
        "coarsen": not settings.face_sizes,
    }
    points, cells = cached_cells(inputs, lambda: _tetrahedralized(inputs))
    if not len(cells):
        raise TurgorError(f"'{name}' could not be meshed: nothing lies within its surface; is the STL file closed?")
    return _whole(points, cells)


def _tetrahedralized(inputs: Mapping[str, object]) -> tuple[Array, Ints]:
    """Call fTetWild; the cells have positive volumes."""
    from pytetwild import tetrahedralize  # imports pyvista where that is installed: half a second

    with TemporaryDirectory() as folder, chdir(folder):  # fTetWild leaves a file where it runs
        points, cells = tetrahedralize(**inputs, num_threads=1, quiet=True)
    cells = np.asarray(cells, dtype=np.int64).reshape(-1, 4)[:, [0, 2, 1, 3]]
    return np.asarray(points, dtype=np.float64), cells


def _whole(points: Array, cells: Ints) -> tuple[Array, Ints]:
    """Drop crumbs: cells that hang together with nothing and are few."""
    count = len(cells)
    links = coo_array((np.ones(4 * count), (np.repeat(np.arange(count), 4), cells.ravel())), shape=(count, len(points)))
    piece = connected_components((links.tocsr() @ links.tocsr().T), directed=False)[1]
    large = np.bincount(piece)[piece] >= TETWILD.crumb * count
    return _used(points, cells[large])


def _used(points: Array, cells: Ints) -> tuple[Array, Ints]:
    """Drop the points of no cell."""
    nodes, places = np.unique(cells, return_inverse=True)
    return points[nodes], places.reshape(-1, 4).astype(np.int64)


def _quadratic(points: Array, cells: Ints) -> tuple[Array, Ints, dict[tuple[int, int], int]]:
    """Add straight mid-side nodes; return points, cells of ten nodes, and the node of each edge by its sorted ends."""
    ends = np.sort(cells[:, np.array(TETRAHEDRON_EDGES)].reshape(-1, 2), axis=1)
    edges, number = np.unique(ends, axis=0, return_inverse=True)
    nodes = len(points) + np.asarray(number).reshape(-1, 6)
    middles = {(a, b): len(points) + i for i, (a, b) in enumerate(edges.tolist())}
    return np.vstack([points, points[edges].mean(axis=1)]), np.hstack([cells, nodes]), middles
