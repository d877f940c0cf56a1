"""MovableMesh: a mesh of tetrahedra whose nodes follow its CAD shape when a dimension changes."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh
from turgor.core.meshing.moving.extension import Extension, over_cells, over_triangles
from turgor.core.meshing.moving.node_entities import OnFace, Placed, placed
from turgor.core.meshing.moving.parts import Parts, parts_of
from turgor.core.meshing.moving.shape_matching import matched
from turgor.core.meshing.wedge import with_wedge
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class MovableMesh:
    """A mesh of tetrahedra with the CAD shape that it fills, and the nodes on its parts.

    The shape of another dimension has the same vertices, edges and faces, which are matched (`matched`). Nodes on
    vertices follow these, nodes on edges keep their share of the parameter, those on faces follow the edges by a
    harmonic extension and are put on the moved surface, and those inside follow the surface by another. What the
    geometry says where nothing moves is where nodes are.

    Parameters
    ----------
    mesh : Mesh
    parts : Parts
        Of the shape that it fills.
    placed : Placed

    Examples
    --------
    >>> import numpy as np
    >>> from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
    >>> from turgor.core.meshing.generate import mesh
    >>> from turgor.core.meshing.quality.cell_quality import cell_volumes
    >>> tube, wider = (ExtendingCylinder(length=20e-3, wall=wall).build() for wall in (2e-3, 2.1e-3))
    >>> known = mesh(tube, size=4e-3, cells="tetrahedra")
    >>> moved = movable(known, tube).at(wider)
    >>> np.array_equal(moved.cells, known.cells)
    True
    >>> bool(abs(cell_volumes(moved).sum() / wider.solid_volume - 1) < 1e-3)
    True
    """

    mesh: Mesh
    parts: Parts
    placed: Placed

    def at(self, geometry: Geometry) -> Mesh:
        """Return the mesh with its nodes where a geometry with other dimensions takes them.

        Parameters
        ----------
        geometry : Geometry
            Built as that of the mesh.

        Returns
        -------
        Mesh

        Raises
        ------
        TurgorError
            If its shape has other vertices, edges or faces, or none.
        """
        parts = matched(self.parts, parts_of(geometry), geometry.name)
        motion = self._on_edges(parts)
        even = self._affine(motion)
        motion[self._face_nodes] = self._over_faces.extended(motion - even) + even[self._face_nodes]
        for known, surface in zip(self.placed.faces, parts.surfaces, strict=True):
            targets = known.points + motion[known.nodes]
            motion[known.nodes] = surface.nearest(targets, known.uv)[1] - known.points
        motion[self._inside] = self._through.extended(motion[: self.mesh.vertex_count])
        ends, middles = self._inner_edges
        motion[middles] = motion[ends].mean(axis=1)
        moved = replace(self.mesh, points=self.mesh.points + motion, wedge=None)
        return with_wedge(moved, self.mesh, geometry.wedge)

    def _on_edges(self, parts: Parts) -> Array:
        """Motions (n, 3) of nodes on CAD vertices and edges."""
        motion = np.zeros_like(self.mesh.points)
        motion[self.placed.corners] = parts.vertices - self.parts.vertices
        for known, before, after in zip(self.placed.edges, self.parts.curves, parts.curves, strict=True):
            motion[known.nodes] = after.points(known.shares) - before.points(known.shares)
        return motion

    def _affine(self, motion: Array) -> Array:
        """The affine motion (n, 3) nearest to that of the nodes on CAD edges.

        A harmonic extension over a curved face does not keep it, so that only what differs from it is extended.
        """
        nodes = np.unique(np.concatenate([self.placed.corners, *(edge.nodes for edge in self.placed.edges)]))
        basis = np.column_stack([self.mesh.points / np.ptp(self.mesh.points), np.ones(len(motion))])
        return np.asarray(basis @ np.linalg.lstsq(basis[nodes], motion[nodes], rcond=1e-9)[0])

    @cached_property
    def _face_nodes(self) -> Ints:
        """Nodes inside of CAD faces."""
        return np.concatenate([face.nodes for face in self.placed.faces])

    @cached_property
    def _on_surface(self) -> NDArray[np.bool_]:
        """Which nodes lie on a CAD face, its edges included."""
        on = np.zeros(len(self.mesh.points), dtype=bool)
        on[_triangles(self.placed.faces)] = True
        return on

    @cached_property
    def _over_faces(self) -> Extension:
        return over_triangles(self.mesh.points, _triangles(self.placed.faces), self._face_nodes)

    @cached_property
    def _inside(self) -> Ints:
        """Vertices inside of the body."""
        return np.flatnonzero(~self._on_surface[: self.mesh.vertex_count])

    @cached_property
    def _through(self) -> Extension:
        vertices = self.mesh.vertex_count
        return over_cells(self.mesh.points[:vertices], self.mesh.cells[:, :4], self._inside)

    @cached_property
    def _inner_edges(self) -> tuple[Ints, Ints]:
        """Ends (m, 2) and mid-side nodes (m,) of the edges inside of the body."""
        ends = np.concatenate([self.mesh.cells[:, pair] for pair in TETRAHEDRON_EDGES])
        middles, first = np.unique(self.mesh.cells[:, 4:].T.ravel(), return_index=True)
        inner = ~self._on_surface[middles]
        return ends[first[inner]], middles[inner]


def movable(mesh: Mesh, geometry: Geometry) -> MovableMesh:
    """Find where the nodes of a mesh of tetrahedra lie on the CAD shape that it fills.

    Parameters
    ----------
    mesh : Mesh
    geometry : Geometry
        From which it was generated.

    Returns
    -------
    MovableMesh

    Raises
    ------
    TurgorError
        If the geometry has no CAD shape, or nodes do not lie on it.
    """
    if mesh.cells.shape[1] != 10:
        raise TurgorError(f"mesh '{mesh.name}' has hexahedra, which are swept again; only tetrahedra can be moved.")
    parts = parts_of(geometry)
    return MovableMesh(mesh, parts, placed(mesh, parts))


def _triangles(faces: tuple[OnFace, ...]) -> Ints:
    return np.concatenate([face.triangles for face in faces])
