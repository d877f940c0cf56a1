"""Skin: the visible surface of the whole actuator as small flat triangles, ready to be drawn."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from math import cos
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import reference_nodes, tables_at
from turgor.core.geometry.cad.symmetry.whole import Image
from turgor.core.meshing.bodies.groups import groups_of
from turgor.core.meshing.cells import six_node_triangles
from turgor.core.meshing.mesh import TRIANGLE_EDGES, Mesh
from turgor.core.meshing.surface import corner_keys, outer_triangles
from turgor.core.results.fields.state_fields import MeshFacts
from turgor.views.pictures.settings import RENDERING

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


class Drawn(Protocol):
    """Interface of what can be drawn: a state, or an undeformed mesh."""

    @property
    def mesh(self) -> Mesh:
        """The mesh."""

    @property
    def points(self) -> Array:
        """Current positions of all nodes, (n, 3) [m]."""

    @property
    def facts(self) -> MeshFacts:
        """Facts about the mesh, such as its mirror planes."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Skin:
    """Flat triangles with normals, values, and the number of the smooth patch of each.

    Parameters
    ----------
    points : (p, 3) array [m]
        Current positions.
    normals : (p, 3) array
        Outward unit normals, continuous within a patch.
    values : (p,) array
        The field to color by.
    triangles : (t, 3) int array
        Corners of each triangle.
    patch : (t,) int array
        Patches end at sharp edges and where two regions meet; a line is drawn between them.
    blocks : ((q, 6) array, (6,) int array) or None
        Where each side of a cell has q points in a row: their shape functions, and which of them are its nodes.
    side : (t,) int array or None
        Number of the side of a cell that each triangle is a part of.
    """

    points: Array
    normals: Array
    values: Array
    triangles: Ints
    patch: Ints
    blocks: tuple[Array, Ints] | None = None
    side: Ints | None = None

    def part(self, chosen: NDArray[np.bool_]) -> "Skin":
        """Return the skin of some of the triangles (t,)."""
        side = None if self.side is None else self.side[chosen]
        return replace(self, triangles=self.triangles[chosen], patch=self.patch[chosen], side=side)

    @property
    def areas(self) -> Array:
        """Area of each triangle, (t,) [m²]."""
        a, b, c = (self.points[self.triangles[:, k]] for k in range(3))
        return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2)


def visible_skin(
    at: Drawn, values: Array, *, chosen: NDArray[np.bool_] | None = None, parts: int | None = None
) -> Skin:
    """Build the skin of a state: outer surface without the cuts, mirrored or turned to the whole actuator.

    Parameters
    ----------
    at : Drawn
        The state.
    values : (n,) or (d,) array
        Values at the nodes of the mesh, or at the nodes of its regions. In the second case a triangle takes the values
        of the region behind it.
    chosen : (f,) bool array, optional
        Which of `drawn_triangles` to take; all by default.
    parts : int, optional
        Parts of each edge of a side; as many as the picture needs by default.
    """
    mesh = at.mesh
    triangles, region = drawn_triangles(mesh)
    shared = len(values) == len(mesh.points)
    corners = values[triangles if shared else at.facts.region_nodes.of(triangles, np.tile(region[:, None], 6))]
    smooth = _smooth_patches(mesh, triangles)
    normals = _nodal_normals(at, triangles, smooth)
    patch = np.unique(np.stack([smooth, region], axis=1), axis=0, return_inverse=True)[1].ravel()
    if chosen is not None:
        triangles, patch = triangles[chosen], patch[chosen]
        corners, normals = corners[chosen], normals[chosen]
    many = len(triangles) * RENDERING.parts**2 * mesh.symmetry_factor > RENDERING.triangles
    parts = parts or (2 if many else RENDERING.parts)
    N, pieces = _subdivision(parts)
    count = len(N)
    fine_values = np.einsum("qa,fa->fq", N, corners)
    low, high = corners.min(axis=1, keepdims=True), corners.max(axis=1, keepdims=True)
    fine_normals = np.einsum("qa,fai->fqi", N, normals).reshape(-1, 3)
    fine_normals /= np.maximum(np.linalg.norm(fine_normals, axis=1, keepdims=True), 1e-30)
    skin = Skin(
        points=np.einsum("qa,fai->fqi", N, at.points[triangles]).reshape(-1, 3),
        normals=fine_normals,
        values=np.clip(fine_values, low, high).ravel(),  # a quadratic interpolation overshoots between its nodes
        triangles=(pieces + count * np.arange(len(triangles))[:, None, None]).reshape(-1, 3),
        patch=np.repeat(patch, len(pieces)),
        side=np.repeat(np.arange(len(triangles)) // len(mesh.cell_type.side.triangles), len(pieces)),
        blocks=(N, N.argmax(axis=0))
        if parts % 2 == 0
        else None,  # a shape function is 1 at its node, which is on the lattice
    )
    return with_images(skin, at.facts.images)


def cavity_parts(at: Drawn, skin: Skin) -> NDArray[np.bool_]:
    """Return which triangles (t,) of the skin of a state are walls of a cavity."""
    triangles, _ = drawn_triangles(at.mesh)
    count = len(at.mesh.points)
    walls = [six_node_triangles(at.mesh.face(name)) for name in at.mesh.cavities]
    inside = np.isin(corner_keys(triangles, count), corner_keys(np.concatenate(walls), count)) if walls else None
    if inside is None:
        return np.zeros(len(skin.triangles), dtype=bool)
    images = len(at.facts.images)
    return np.tile(np.repeat(inside, len(skin.triangles) // (images * len(triangles))), images)


def drawn_triangles(mesh: Mesh) -> tuple[Ints, Ints]:
    """Return the outer triangles that lie in no cut, and the number of the region behind each.

    The images in two parallel mirror planes end, and their ends are drawn: images of the plane that is mirrored last.

    Of films without a solid these are all, turned so that their normals point out of the cavity.
    """
    triangles = six_node_triangles(outer_triangles(mesh))
    if not len(mesh.cells):
        return triangles[:, [0, 2, 1, 5, 4, 3]], np.zeros(len(triangles), dtype=np.int64)
    count = len(mesh.points)
    axes = [axis for axis, _ in mesh.mirror_planes]
    ends = [name for k, name in enumerate(mesh.symmetry_faces) if axes[k] in axes[:k]]
    for name in [face for face in mesh.cut_faces if face not in ends]:
        plane = six_node_triangles(mesh.face(name))
        on_plane = np.isin(corner_keys(triangles, count), corner_keys(plane, count))
        triangles = triangles[~on_plane]
    touching = np.zeros((len(mesh.regions), count), dtype=bool)
    for number, cells in enumerate(mesh.regions.values()):
        touching[number, mesh.cells[cells]] = True
    # the region behind a triangle holds all six nodes; if several do, the first of them counts
    return triangles, touching[:, triangles].all(axis=2).argmax(axis=0)


def _smooth_patches(mesh: Mesh, triangles: Ints) -> Ints:
    """Number of the smooth patch of each triangle, (f,); patches end at sharp edges."""
    leaders = mesh.leaders[triangles]  # a patch of a wedge goes on in the next sector
    edges = np.concatenate([leaders[:, [a, b]] for a, b in TRIANGLE_EDGES])
    owner = np.tile(np.arange(len(triangles)), 3)
    # normals at the midside nodes, where two curved triangles of one smooth face agree
    normals = _unit_normals(mesh.points, triangles)
    normals[leaders != triangles] = normals[leaders != triangles] @ _turn(mesh)
    normals = normals[:, 3:].transpose(1, 0, 2).reshape(-1, 3)
    key = np.sort(edges, axis=1)
    order = np.lexsort((key[:, 1], key[:, 0]))
    same = (key[order[1:]] == key[order[:-1]]).all(axis=1)
    first, second = order[:-1][same], order[1:][same]
    smooth = np.einsum("ei,ei->e", normals[first], normals[second]) > cos(RENDERING.sharp_edge)
    a, b = owner[first[smooth]], owner[second[smooth]]
    return groups_of(len(triangles), a, b)


def _turn(mesh: Mesh) -> Array:
    """Rotation (3, 3) to the next sector of a wedge."""
    return np.eye(3) if mesh.wedge is None else mesh.wedge.turn()


def _unit_normals(points: Array, triangles: Ints) -> Array:
    """Unit normals at the six nodes of every triangle, (f, 6, 3)."""
    nodes = reference_nodes(6)
    dN = tables_at(6, nodes, np.ones(len(nodes))).dN
    tangents = np.einsum("qad,fai->fqid", dN, points[triangles])
    normals = np.cross(tangents[..., 0], tangents[..., 1])
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-30))


def _nodal_normals(at: Drawn, triangles: Ints, patch: Ints) -> Array:
    """Current normals at the nodes of every triangle, averaged within each patch, (f, 6, 3)."""
    own, leaders = _unit_normals(at.points, triangles), at.mesh.leaders
    turned = leaders[triangles] != triangles  # the surface of a wedge goes on in the next sector
    turn = _turn(at.mesh)
    own[turned] = own[turned] @ turn
    key = (patch[:, None] * len(at.mesh.points) + leaders[triangles]).ravel()
    _, group = np.unique(key, return_inverse=True)
    total = np.stack([np.bincount(group, own[..., i].ravel()) for i in range(3)], axis=1)
    normals = total[group].reshape(own.shape)
    normals[turned] = normals[turned] @ turn.T
    for face, plane in zip(at.mesh.symmetry_faces, at.facts.mirrors, strict=True):
        on_plane = np.isin(triangles, at.mesh.face_nodes(face))
        on_plane &= ~on_plane.all(axis=1, keepdims=True)  # the plane itself is an end
        normals[on_plane, plane.axis] = 0.0  # the surface continues smoothly into its mirror image
    return normals / np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-30)


@cache
def _subdivision(parts: int) -> tuple[Array, Ints]:
    """Shape functions (q, 6) at a lattice on the triangle, and the small triangles between its points, (parts², 3)."""
    number = {(i, j): k for k, (i, j) in enumerate((i, j) for i in range(parts + 1) for j in range(parts + 1 - i))}
    pieces = []
    for i in range(parts):
        for j in range(parts - i):
            pieces.append((number[i, j], number[i + 1, j], number[i, j + 1]))
            if i + j < parts - 1:
                pieces.append((number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]))
    lattice = np.array(list(number), dtype=np.float64) / parts
    return tables_at(6, lattice, np.ones(len(lattice))).N, np.array(pieces)


def with_images(skin: Skin, images: Sequence[Image]) -> Skin:
    """Return the images of a skin together; its own place is one of them."""
    count = len(skin.points)
    turned = [skin.triangles[:, ::-1] if image.flips else skin.triangles for image in images]
    return Skin(
        points=np.concatenate([image.of(skin.points) for image in images]),
        normals=np.concatenate([skin.normals @ image.turn.T for image in images]),
        values=np.tile(skin.values, len(images)),
        triangles=np.concatenate([triangles + k * count for k, triangles in enumerate(turned)]),
        patch=np.tile(skin.patch, len(images)),
        blocks=skin.blocks,
        side=None if skin.side is None else np.tile(skin.side, len(images)),
    )
