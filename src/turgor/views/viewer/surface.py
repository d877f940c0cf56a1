"""Surface: the skin of the modeled part as six-node triangles, for the viewer."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.meshing.mesh import TRIANGLE_EDGES
from turgor.core.results.fields.state_fields import StateFields
from turgor.views.pictures.settings import RENDERING
from turgor.views.pictures.skin import drawn_triangles, visible_skin

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Surface:
    """Triangles with their vertices; a node of the mesh has a vertex for each smooth patch and each region.

    Parameters
    ----------
    triangles : (f, 6) int array
        Vertices of each triangle: three corners, then the middles of its sides. Without middles (f, 3).
    node : (v,) int array
        Node of the mesh of each vertex.
    row : (v,) int array
        Row of the nodal fields of each vertex, see `turgor.core.meshing.refining.region_nodes.RegionNodes`.
    cut : (v,) int array
        Bit k is set where the vertex lies on the k-th cut face of the mesh.
    count : int
        Nodes of the mesh.
    centers : (c,) int array
        Vertices in the middle of a four-sided side of a cell; no edge of a cell goes through them.
    """

    triangles: Ints
    node: Ints
    row: Ints
    cut: Ints
    count: int
    centers: Ints

    @property
    def coarse(self) -> bool:
        """Whether the triangles are straight."""
        return self.triangles.shape[1] == 3

    def pick(self, values: Array) -> Array:
        """Values at the vertices, (v, …), from values at the nodes of the mesh or of its regions."""
        return np.asarray(values[self.node if len(values) == self.count else self.row])


def surface_of(rest: StateFields) -> Surface:
    """Find the surface that the viewer draws: the skin without cuts, of the modeled part.

    Parameters
    ----------
    rest : StateFields
        The state at rest, whose sharp edges part the patches.
    """
    mesh, count = rest.mesh, len(rest.mesh.points)
    nodes, region = drawn_triangles(mesh)
    skin = visible_skin(rest, np.zeros(count))
    pieces = len(skin.triangles) // (len(nodes) * len(rest.facts.images))
    patch = skin.patch[: len(nodes) * pieces : pieces]
    surface = _numbered(rest, nodes, patch, region)
    if len(surface.node) > RENDERING.triangles:  # straight triangles have a quarter of the vertices
        surface = _numbered(rest, nodes[:, :3], patch, region)
    return surface


def _numbered(rest: StateFields, nodes: Ints, patch: Ints, region: Ints) -> Surface:
    """Number the vertices in the order in which the triangles use them, so that their numbers shrink well."""
    count, mesh = len(rest.mesh.points), rest.mesh
    key = (patch[:, None] * count + nodes).ravel()
    _, first, same = np.unique(key, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    used = first[order]
    node = nodes.ravel()[used]
    behind = np.repeat(region, nodes.shape[1])[used]
    cut = np.zeros(len(node), dtype=np.int64)
    for k, name in enumerate(mesh.cut_faces):
        cut |= np.isin(node, mesh.face_nodes(name)).astype(np.int64) << k
    return Surface(
        triangles=rank[same.ravel()].reshape(nodes.shape),
        node=node,
        row=rest.facts.region_nodes.of(node, behind),
        cut=cut,
        count=count,
        centers=np.flatnonzero(np.isin(node, mesh.cells[:, HEXAHEDRON.corners + len(HEXAHEDRON.edges) :])),
    )


#: Corners of each side of a triangle, in the order of its middle nodes.
SIDES = tuple(tuple(int(corner) for corner in edge[:2]) for edge in TRIANGLE_EDGES)
