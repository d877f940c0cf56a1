"""Placed: which CAD vertex, edge or face every node on the surface of a mesh belongs to, found by where nodes are."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.moving.node_parameters import located
from turgor.core.meshing.moving.parts import Parts
from turgor.core.meshing.moving.settings import MOVING
from turgor.core.meshing.moving.sides import Sides, sides_of
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class OnEdge:
    """Nodes on a CAD edge, its ends left out.

    Parameters
    ----------
    nodes : (n,) int array
    shares : (n,) array
        Of the range of the parameter of its curve.
    """

    nodes: Ints
    shares: Array


@dataclass(frozen=True, slots=True, eq=False)
class OnFace:
    """Nodes on a CAD face, those on its edges left out.

    Parameters
    ----------
    triangles : (f, 6) int array
        All triangles of the face.
    nodes : (n,) int array
    uv : (n, 2) array
        Parameters of its surface.
    points : (n, 3) array [m]
        Of the surface; a mid-side node that was straightened is a little off.
    """

    triangles: Ints
    nodes: Ints
    uv: Array
    points: Array


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """Nodes of a mesh on the parts of a CAD shape.

    Parameters
    ----------
    corners : (v,) int array
        Node of each CAD vertex.
    edges : tuple of OnEdge
    faces : tuple of OnFace
    """

    corners: Ints
    edges: tuple[OnEdge, ...]
    faces: tuple[OnFace, ...]


def placed(mesh: Mesh, parts: Parts) -> Placed:
    """Find the CAD vertex, edge or face of every node on the surface of a mesh, and between its regions.

    Nodes on a CAD edge follow each other along it and edges of the mesh join them; what these edges enclose is a face.

    Parameters
    ----------
    mesh : Mesh
        Of tetrahedra.
    parts : Parts
        Of the shape that it was generated from.

    Returns
    -------
    Placed

    Raises
    ------
    TurgorError
        If nodes do not lie on the shape, as those of a mesh within an envelope of facets.
    """
    sides = sides_of(mesh)
    corners = _corners(mesh, sides, parts)
    paths = [_path(mesh, sides, parts, corners, number) for number in range(len(parts.curves))]
    chains = [_chain(mesh, sides, path) for path in paths]
    edges = []
    for curve, path, chain in zip(parts.curves, paths, chains, strict=True):
        nodes = np.concatenate([path[1:-1], sides.edges[chain, 2]])
        edges.append(OnEdge(nodes, curve.shares(mesh.points[nodes])))
    return Placed(corners, tuple(edges), _faces(mesh, sides, parts, chains))


def _off_shape(mesh: Mesh, what: str) -> TurgorError:
    return TurgorError(
        f"the nodes of the mesh of '{mesh.name}' do not lie on its CAD {what}, so they cannot follow its dimensions; "
        "take hexahedra, or a size of the cells that needs no repair."
    )


def _corners(mesh: Mesh, sides: Sides, parts: Parts) -> Ints:
    """Node of each CAD vertex."""
    nodes = np.flatnonzero(np.isfinite(sides.shortest[: mesh.vertex_count]))
    away, nearest = cKDTree(mesh.points[nodes]).query(parts.vertices)
    if (away > MOVING.near * sides.shortest[nodes[nearest]]).any() or len(np.unique(nearest)) < len(nearest):
        raise _off_shape(mesh, "vertices")
    return np.asarray(nodes[nearest])


def _path(mesh: Mesh, sides: Sides, parts: Parts, corners: Ints, number: int) -> Ints:
    """Vertices of the mesh along a CAD edge, both ends included."""
    curve, ends = parts.curves[number], corners[list(parts.ends[number])]
    reach = float(np.linalg.norm(np.diff(curve.samples, axis=0), axis=1).max())
    low, high = curve.samples.min(axis=0) - reach, curve.samples.max(axis=0) + reach
    vertices, shortest = mesh.points[: mesh.vertex_count], sides.shortest[: mesh.vertex_count]
    near = np.isfinite(shortest) & ((vertices >= low) & (vertices <= high)).all(axis=1)
    near[corners] = False
    nodes = np.flatnonzero(near)
    shares = curve.shares(vertices[nodes])
    on = np.linalg.norm(vertices[nodes] - curve.points(shares), axis=1) <= MOVING.near * shortest[nodes]
    return np.concatenate([ends[:1], nodes[on][np.argsort(shares[on])], ends[-1:]])


def _chain(mesh: Mesh, sides: Sides, path: Ints) -> Ints:
    """Edges of the mesh along a path of vertices, as rows of `Sides.edges`."""
    rows = sides.rows(np.stack([path[:-1], path[1:]], axis=1))
    if (rows < 0).any():
        raise _off_shape(mesh, "edges")
    return rows


def _faces(mesh: Mesh, sides: Sides, parts: Parts, chains: list[Ints]) -> tuple[OnFace, ...]:
    """Triangles and nodes of each CAD face: what edges of the mesh on the CAD edges enclose."""
    on = np.full(len(sides.edges), -1)
    for number, chain in enumerate(chains):
        on[chain] = number
    owner = _enclosed(sides, on < 0)
    rims: dict[int, set[int]] = {int(number): set() for number in np.unique(owner)}
    for column in sides.edge_of.T:
        for number, edge in zip(owner.tolist(), on[column].tolist(), strict=True):
            if edge >= 0:
                rims[number].add(edge)
    rim_nodes = np.unique(sides.edges[on >= 0])
    placed_faces: dict[int, OnFace] = {}
    for number, rim in rims.items():
        triangles = sides.triangles[owner == number]
        nodes = np.setdiff1d(triangles, rim_nodes)
        for face in (i for i, known in enumerate(parts.rims) if known == rim and rim and i not in placed_faces):
            on_surface = located(parts.surfaces[face], mesh.points, triangles, nodes)
            if on_surface is not None and _close(mesh, sides, nodes, on_surface[1]):
                placed_faces[face] = OnFace(triangles, nodes, *on_surface)
                break
        else:
            raise _off_shape(mesh, "faces")
    if len(placed_faces) < len(parts.surfaces):
        raise _off_shape(mesh, "faces")
    return tuple(placed_faces[face] for face in range(len(placed_faces)))


def _enclosed(sides: Sides, crossed: NDArray[np.bool_]) -> Ints:
    """Number (f,) of the face of each triangle: those that share an edge that may be crossed are of one face."""
    count = len(sides.triangles)
    triangle, edge = np.repeat(np.arange(count), 3), sides.edge_of.ravel()
    inner = crossed[edge]
    joined = coo_array((np.ones(inner.sum()), (triangle[inner], edge[inner])), shape=(count, len(sides.edges))).tocsr()
    return np.asarray(connected_components(joined @ joined.T, directed=False)[1], dtype=np.int64)


def _close(mesh: Mesh, sides: Sides, nodes: Ints, points: Array) -> bool:
    """Whether nodes are close to the points of a surface that are nearest to them."""
    allowed = np.where(nodes < mesh.vertex_count, MOVING.near, MOVING.straightened) * sides.shortest[nodes]
    return bool((np.linalg.norm(mesh.points[nodes] - points, axis=1) <= allowed).all())
