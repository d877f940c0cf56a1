"""Plane: the cross-section of a slice, a mesh of one layer of hexahedra along x."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from turgor.core.engine.cells.reference import CELL_QUADRATURE_DEGREE, ReferenceCell, reference_cell
from turgor.core.meshing.cells import HEXAHEDRON, QUADRILATERAL
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.sweeping.hexahedra import PLACES
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Nodes of a hexahedron in its near side, in the order of a quadrilateral.
NEAR = tuple(PLACES.index((0, i)) for i in range(QUADRILATERAL.nodes))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Plane:
    """Nine-node quadrilaterals of a section, and how the nodes of the slice lie above its nodes.

    Parameters
    ----------
    points : (n, 3) array
        Positions of the nodes of the section, x = 0, from its `origin`; scaled.
    quads : (c, 9) int array
        Nodes of each quadrilateral; the row is that of the hexahedron.
    node_of : (s,) int array
        Node of the section above which each node of the slice lies.
    height : (s,) array
        Its distance from the near plane, scaled.
    origin : (3,) array [m]
        Where the reference line passes: the centroid of the solids, on every mirror plane.
    length : float [m]
        Length by which positions are divided.
    """

    points: Array
    quads: Ints
    node_of: Ints
    height: Array
    origin: Array
    length: float

    @property
    def thickness(self) -> float:
        """Thickness of the slice, scaled."""
        return float(self.height.max())


def plane_of(mesh: Mesh) -> Plane:
    """Read the section of a slice.

    Parameters
    ----------
    mesh : Mesh
        One layer of 27-node hexahedra between two planes across x, straight along x.

    Raises
    ------
    TurgorError
        If it is no such slice.
    """
    if mesh.cell_type is not HEXAHEDRON:
        raise TurgorError(f"mesh '{mesh.name}': a section needs hexahedra of 27 nodes, not {mesh.cell_type.name}s.")
    near = mesh.cells[:, list(NEAR)]
    nodes = np.unique(near)
    number = np.full(len(mesh.points), -1)
    number[nodes] = np.arange(len(nodes))
    node_of, level = np.full(len(mesh.points), -1), np.zeros(len(mesh.points))
    for place, (station, i) in enumerate(PLACES):
        node_of[mesh.cells[:, place]] = number[near[:, i]]
        level[mesh.cells[:, place]] = station / 2
    x = mesh.points[:, 0] - mesh.points[:, 0].min()
    size = float(np.ptp(mesh.points[:, 1:], axis=0).max())
    aside = mesh.points[:, 1:] - mesh.points[nodes][node_of][:, 1:]
    if (
        np.abs(aside).max() > ROUND_OFF.mesh_digits * size
        or np.abs(x - level * x.max()).max() > ROUND_OFF.mesh_digits * size
    ):
        raise TurgorError(f"mesh '{mesh.name}' is no slice: its cells are not one layer straight along x.")
    flat = mesh.points[nodes] * [0.0, 1.0, 1.0]
    quads = number[near]
    area, table = area_weights(flat, quads), tables()
    at = np.einsum("qa,cai->cqi", table.N, flat[quads])
    origin = np.einsum("cq,cqi->i", area, at) / area.sum()
    for axis, position in mesh.mirror_planes:
        origin[axis] = position
    _check_connected(mesh, quads)
    length = float(np.sqrt(area.sum() / len(quads)))
    return Plane(
        points=(flat - origin) / length, quads=quads, node_of=node_of, height=x / length, origin=origin, length=length
    )


def near_nodes(plane: Plane) -> Ints:
    """Node of the slice in its near plane that each node of the section is, (n,)."""
    near = np.flatnonzero(plane.height < 0.25 * plane.thickness)
    place = np.empty(len(plane.points), dtype=np.int64)
    place[plane.node_of[near]] = near
    return place


def _check_connected(mesh: Mesh, quads: Ints) -> None:
    """Refuse a section of several pieces: what joins them at the ends makes them bend each other on the way."""
    links = coo_array(
        (np.ones(8 * len(quads)), (quads[:, :8].ravel(), quads[:, 1:].ravel())), shape=(quads.max() + 1,) * 2
    )
    pieces, _ = connected_components(links, directed=False)
    if pieces > 1:
        raise TurgorError(
            f"'{mesh.name}' falls into {pieces} pieces, which only the ends of the actuator join: no section holds "
            "them together. Analyze one of them with a Sketch, or solve the whole actuator."
        )


def tables() -> ReferenceCell:
    """Shape functions of the quadrilaterals at their 3 × 3 integration points."""
    return reference_cell(QUADRILATERAL.nodes, CELL_QUADRATURE_DEGREE)


def gradients(points: Array, quads: Ints) -> tuple[Array, Array]:
    """Derivatives (c, q, 9, 2) of the shape functions along y and z, and the areas (c, q) of the points."""
    table = tables()
    jacobian = np.einsum("qad,cai->cqid", table.dN, points[quads][..., 1:])
    det = np.linalg.det(jacobian)
    if not (det > 0).all():
        raise TurgorError("cells of the section are inside out; take another size.")
    return np.einsum("qad,cqdi->cqai", table.dN, np.linalg.inv(jacobian)), det * table.weights


def area_weights(points: Array, quads: Ints) -> Array:
    """Areas (c, q) of the integration points."""
    return gradients(points, quads)[1]


def boundary_edges(plane: Plane) -> Ints:
    """Edges (e, 3) of the section that belong to one quadrilateral: both ends, then the middle; solids on the left."""
    edges = np.concatenate([plane.quads[:, [i, (i + 1) % 4, 4 + i]] for i in range(4)])
    key = np.sort(edges[:, :2], axis=1) @ np.array([len(plane.points), 1])
    _, first, count = np.unique(key, return_index=True, return_counts=True)
    return np.asarray(edges[np.sort(first[count == 1])])


def face_edges(plane: Plane, sides: Ints) -> Ints:
    """Edges (e, 3) in the near plane of sides (f, 9) of the slice, each in the direction in which its side has it."""
    edges = []
    for i in range(4):
        edge = sides[:, [i, (i + 1) % 4, 4 + i]]
        near = (plane.height[edge] < 0.25 * plane.thickness).all(axis=1)
        edges.append(plane.node_of[edge[near]])
    return np.concatenate(edges)
