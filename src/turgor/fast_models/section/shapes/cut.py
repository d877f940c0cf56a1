"""Cuts: the section of a CAD part or of a mesh at a place along x."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from turgor.core.geometry.cad.planes.plane_cut import PlaneCut, plane_cut
from turgor.core.geometry.extrusion import Layer, Sweep
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import cell_sides, corner_keys
from turgor.fast_models.section.shapes.slices import meshed, slice_of_mesh

Ints = NDArray[np.int64]


def cut(shape: Geometry | Mesh, at: float | None = None) -> PlaneCut | Mesh:
    """Cut a CAD part or a mesh of hexahedra across x, for a `Section`.

    Parameters
    ----------
    shape : Geometry or Mesh
        A part whose cross-section there is that of most of its length, or a mesh of 27-node hexahedra in layers.
    at : float or None [m]
        Where along x; the middle by default.

    Returns
    -------
    PlaneCut or Mesh
        What `Section` takes.

    Raises
    ------
    TurgorError
        If there is nothing at that place.

    Examples
    --------
    >>> import turgor as tg
    >>> cut(tg.actuators.EccentricBender().build(), at=40e-3).regions
    ('body',)
    """
    return slice_of_mesh(shape, at) if isinstance(shape, Mesh) else plane_cut(shape, at)


def slice_of_cut(cut: PlaneCut, size: float | None) -> Mesh:
    """Mesh one layer of a cut part, with the names of the faces on its edges."""
    layer = Layer(start=0.0, end=1.0, fill=cut.fill)
    mesh = meshed(cut.name, cut.regions, Sweep(layers=(layer,)), layer, size)
    return replace(mesh, faces=_named(mesh, cut))


def _named(mesh: Mesh, cut: PlaneCut) -> dict[str, Ints]:
    """Sides on the surface and between regions, by the edges that lie nearest to their middles."""
    sides = cell_sides(mesh.cells)
    keys = corner_keys(sides, len(mesh.points))
    _, first, group = np.unique(keys, return_index=True, return_inverse=True)
    count = np.bincount(group)
    region = np.empty(len(mesh.cells), dtype=np.int64)
    for number, cells in enumerate(mesh.regions.values()):
        region[cells] = number
    own = np.repeat(region, len(mesh.cell_type.sides))
    last = np.empty(len(first), dtype=np.int64)
    last[group] = np.arange(len(keys))
    chosen = first[(count == 1) | (own[first] != own[last])]
    thickness = np.ptp(mesh.points[:, 0])
    chosen = chosen[np.ptp(mesh.points[sides[chosen], 0], axis=1) > thickness / 2]
    owner = np.repeat([name for name, _ in cut.edges], [len(line) for _, line in cut.edges])
    _, nearest = cKDTree(np.concatenate([line for _, line in cut.edges])).query(mesh.points[sides[chosen, -1], 1:])
    return {str(name): sides[chosen[owner[nearest] == name]] for name in np.unique(owner[nearest])}
