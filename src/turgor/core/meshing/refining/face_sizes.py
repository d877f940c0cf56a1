"""Sizes of faces of hexahedra: whole sheets of cells are cut until the edges on a face are short enough."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.refining.split_hexahedra import CELL_EDGES, SIDE_EDGES, refine_hexahedra, sheets
from turgor.core.meshing.sizing.settings import SIZING
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Unknowns of each hexahedron in a large mesh: eight nodes with three displacements, and a mean stress.
UNKNOWNS_PER_CELL = 25


def with_face_sizes(mesh: Mesh, face_sizes: Mapping[str, float]) -> Mesh:
    """Cut hexahedra until no edge on a face is longer than the size of the face.

    A hexahedron cannot be cut alone: the cut goes on through the whole sheet of cells, across the section or along the
    sweep, until it leaves the body. Cells elsewhere in the sheet get shorter too. Edges are halved, so that they may
    be up to half as long as requested.

    Parameters
    ----------
    mesh : Mesh
        27-node hexahedra. In a revolved mesh, edges around the axis stay as they are.
    face_sizes : mapping of str to float [m]
        Longest edges by the name of the face.

    Returns
    -------
    Mesh
        The same mesh where all edges are short enough.

    Raises
    ------
    TurgorError
        If this makes more unknowns than one machine can solve.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> coarse = mesh(FastPneuNet(chambers=2, length=20e-3).build(), size=4e-3, cells="hexahedra")
    >>> len(coarse.cells), len(with_face_sizes(coarse, {"tip": 2e-3}).cells)
    (373, 463)
    """
    while face_sizes:
        edges, name = _long_edges(mesh, face_sizes)
        if not len(edges):
            break
        of_cell = sheets(mesh)
        chosen = _crossing(mesh, of_cell, edges)
        unknowns = UNKNOWNS_PER_CELL * float((2.0 ** np.isin(of_cell, chosen).sum(axis=1)).sum())
        if unknowns > SIZING.most_unknowns:
            raise TurgorError(
                f"mesh size of face '{name}' is {face_sizes[name] / mm:.4g} mm, which makes more than "
                f"{unknowns / 1e6:.2g} million unknowns: hexahedra are cut in whole sheets through the part. Use a "
                'larger size, or cells = "tetrahedra".'
            )
        mesh = refine_hexahedra(mesh, chosen).mesh
    return mesh


def _long_edges(mesh: Mesh, face_sizes: Mapping[str, float]) -> tuple[Ints, str]:
    """Edges on the faces that are too long (e, 2), and the face whose edges are too long by the largest factor."""
    long_edges, factors = [np.zeros((0, 2), dtype=np.int64)], {}
    for name, size in face_sizes.items():
        sides = mesh.face(name)
        edges = np.concatenate([sides[:, list(edge)] for group in SIDE_EDGES for edge in group])
        edges = edges[~_around(mesh, edges)]
        length = np.linalg.norm(mesh.points[edges[:, 1]] - mesh.points[edges[:, 0]], axis=1)
        long_edges.append(edges[length > (1 + TOLERANCE.round_off) * size])
        factors[name] = float(length.max(initial=0.0)) / size
    return np.unique(np.sort(np.concatenate(long_edges), axis=1), axis=0), max(factors, key=factors.__getitem__)


def _around(mesh: Mesh, edges: Ints) -> NDArray[np.bool_]:
    """Which edges of a revolved mesh lead around the axis."""
    if not mesh.revolved:
        return np.zeros(len(edges), dtype=bool)
    along = mesh.points[:, "xyz".index(mesh.revolved)]
    place = np.stack([along, mesh.radii], axis=1)
    apart = np.abs(place[edges[:, 1]] - place[edges[:, 0]]).max(axis=1)
    return np.asarray(apart < TOLERANCE.round_off * np.ptp(along))


def _crossing(mesh: Mesh, of_cell: Ints, edges: Ints) -> Ints:
    """Numbers of the sheets that these edges cross."""
    count = len(mesh.points)
    requested = edges[:, 0] * count + edges[:, 1]
    directions = [np.zeros(0, dtype=np.int64)]
    for direction, group in enumerate(CELL_EDGES):
        ends = np.sort(mesh.cells[:, np.array(group)], axis=2)
        hit = np.isin(ends[..., 0] * count + ends[..., 1], requested).any(axis=1)
        directions.append(of_cell[hit, direction])
    return np.unique(np.concatenate(directions))
