"""Serendipity: a mesh of 20-node hexahedra as one of 27 nodes whose middles follow, with the same shape functions."""

from dataclasses import replace

import numpy as np

from turgor.core.meshing.cells import HEXAHEDRON_20
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import corner_keys


def with_middles(mesh: Mesh) -> Mesh:
    """Add middles that follow to 20-node hexahedra; any other mesh stays as it is.

    Parameters
    ----------
    mesh : Mesh
        Neither revolved nor a wedge where it has 20-node hexahedra.

    Returns
    -------
    Mesh
        Its nodes are those of the mesh, then middles.
    """
    if mesh.cell_type is not HEXAHEDRON_20:
        return mesh
    count = len(mesh.points)
    sides = mesh.cells[:, np.array(HEXAHEDRON_20.sides)]
    keys, place = np.unique(corner_keys(sides.reshape(-1, sides.shape[2]), count), return_inverse=True)
    of_sides = count + place.reshape(len(mesh.cells), -1)
    of_cells = count + len(keys) + np.arange(len(mesh.cells))
    faces = {
        name: np.column_stack([face, count + np.searchsorted(keys, corner_keys(face, count))])
        for name, face in mesh.faces.items()
    }
    points = np.vstack([mesh.points, np.zeros((len(keys) + len(mesh.cells), 3))])  # the mesh places its middles
    cells = np.column_stack([mesh.cells, of_sides, of_cells])
    return replace(mesh, points=points, cells=cells, faces=faces, serendipity=True)
