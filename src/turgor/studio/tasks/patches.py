"""Patches: the surface of a shape as flat triangles in named faces, without a mesh."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.facets import RoundFacets, faces_between, round_facets
from turgor.core.geometry.cad.inspection import Inspection
from turgor.core.geometry.cad.surface.grouping import grouped
from turgor.core.geometry.cad.symmetry.whole import Image, MirrorPlane, images_of
from turgor.core.geometry.directions import FileAxes, rotation_to
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.film_shape import FilmShape
from turgor.core.meshing.cells import six_node_triangles
from turgor.core.meshing.exchange.mesh_file import MeshedShape
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import corner_keys, outer_triangles
from turgor.core.model.obstacles import Obstacle
from turgor.views.viewer.packing import pack_index, pack_steps

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Beginnings of the names of cut faces, which are no surface of the whole.
CUTS = ("symmetry_", "cyclic_")

#: An obstacle whose ends are this near to symmetric about a mirror plane is its own image, relative to its size.
OWN_IMAGE = 1e-3

#: Corners of each side of a triangle, as the viewer names them; triangles without middles do not need them.
_SIDES = ((0, 1), (1, 2), (2, 0))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Patch:
    """One face: its name, its triangles (t, 3, 3) [m], and whether it lies between two bodies."""

    name: str
    triangles: Array
    inner: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Patches:
    """The faces of a modeled part, and what makes it the whole.

    Parameters
    ----------
    faces : tuple of Patch
    mirrors : tuple of MirrorPlane
    images : tuple of Image
        Maps of the modeled part onto all parts of the whole.
    """

    faces: tuple[Patch, ...]
    mirrors: tuple[MirrorPlane, ...]
    images: tuple[Image, ...]

    def box(self) -> Array:
        """Return the lowest and the highest corner of the box around the whole, (2, 3) [m]."""
        corners = np.concatenate([face.triangles.reshape(-1, 3) for face in self.faces])
        points = np.concatenate([image.of(corners) for image in self.images])
        return np.stack([points.min(axis=0), points.max(axis=0)])

    def scene(self, obstacles: Sequence[Obstacle] = ()) -> dict[str, Any]:
        """Return what the viewer draws: one step without fields, names of faces, and obstacles at their start."""
        shown = [face for face in self.faces if len(self.images) == 1 or not face.name.startswith(CUTS)]
        points, triangles, face = _joined(shown)
        inner = np.array([each.inner for each in shown])[face]
        names = sorted({each.name for each in shown})
        part = np.array([names.index(each.name) for each in shown])[face]
        cut = np.zeros(len(points), dtype=np.int64)
        reach = 1e-6 * float(np.ptp(points, axis=0).max())
        for k, plane in enumerate(self.mirrors):
            cut |= (np.abs(points[:, plane.axis] - plane.position) < reach).astype(np.int64) << k
        return {
            "steps": [{"state": 0, "label": ""}],
            "surface": {
                "triangles": pack_index(triangles[~inner]),
                "sides": _SIDES,
                "cut": pack_index(cut),
                "centers": pack_index(np.empty(0, dtype=np.int64)),
                "mirrors": [plane.axis for plane in self.mirrors],
                "positions": pack_steps(points[None]),
            },
            "images": [image.matrix for image in self.images],
            "fields": [],
            "obstacles": self._drawn(obstacles) if obstacles else None,
            "parts": {
                "names": names,
                "of": pack_index(part[~inner]),
                "face": pack_index(face[~inner]),
                "inner": pack_index(triangles[inner]),
                "innerOf": pack_index(part[inner]),
            },
        }

    def _drawn(self, obstacles: Sequence[Obstacle]) -> dict[str, Any]:
        """Obstacles and their images in the mirror planes, except those that are their own image."""
        points: list[Array] = []
        triangles: list[Ints] = []
        for obstacle in obstacles:
            own, corners = obstacle.shape.outline(np.zeros(3), self.box())
            copies = [(own, corners)]
            for plane in self.mirrors:
                across = own[:, plane.axis] - plane.position
                if abs(across.min() + across.max()) > OWN_IMAGE * np.ptp(own, axis=0).max():
                    copies += [(plane.image().of(each), index[:, ::-1]) for each, index in copies]
            for each, index in copies:
                triangles.append(index + sum(map(len, points)))
                points.append(each)
        return {
            "triangles": pack_index(np.concatenate(triangles)),
            "positions": pack_steps(np.concatenate(points)[None]),
        }


def _joined(faces: Sequence[Patch]) -> tuple[Array, Ints, Ints]:
    """Points, triangles, and the face of each triangle; corners are shared within a face, so that it looks smooth."""
    points, triangles, face = [], [], []
    count = 0
    for number, each in enumerate(faces):
        own, index = np.unique(each.triangles.reshape(-1, 3).round(9), axis=0, return_inverse=True)
        points.append(own)
        triangles.append(index.reshape(-1, 3) + count)
        face.append(np.full(len(each.triangles), number))
        count += len(own)
    return np.concatenate(points), np.concatenate(triangles), np.concatenate(face)


def patches_of(geometry: Geometry) -> Patches:
    """Return the faces of a geometry from dimensions or from a mesh."""
    faces = _mesh_faces(geometry.shape.mesh) if isinstance(geometry.shape, MeshedShape) else _cad_faces(geometry)
    film = isinstance(geometry._cad, FilmShape)
    mirrors = _film_mirrors(geometry._cad) if film else _mirrors(faces)
    wedge = geometry.shape.mesh.wedge if isinstance(geometry.shape, MeshedShape) else geometry.wedge
    return Patches(faces=faces, mirrors=mirrors, images=images_of(mirrors, wedge))


def patches_of_file(inspection: Inspection, axes: FileAxes | None) -> Patches:
    """Return the faces of a CAD file, of the whole part as it lies in the file or along stated axes."""
    turn = np.eye(3) if axes is None else rotation_to(axes)
    faces = tuple(
        Patch(name=face.name, triangles=face.triangles @ turn.T, inner=face.between) for face in inspection.faces
    )
    return Patches(faces=faces, mirrors=(), images=images_of((), None))


def _cad_faces(geometry: Geometry) -> tuple[Patch, ...]:
    shape, scale = geometry._cad, geometry.length_scale
    if hasattr(shape, "corners"):  # facets, whose normals point out already
        parts = [(face.name, shape.corners[shape.face == i], False) for i, face in enumerate(shape.faces)]
    else:
        facets = round_facets(shape)
        corners = _outward(facets)
        pairs = enumerate(zip(facets.faces, faces_between(shape), strict=True))
        parts = [(str(face.name), corners[facets.face == i], inner) for i, (face, inner) in pairs]
    return tuple(Patch(name=name, triangles=own * scale, inner=inner) for name, own, inner in parts if len(own))


def _outward(facets: RoundFacets) -> Array:
    """Triangles of the display, turned to the side of the normals of the true surface; the kernel leaves that open."""
    corners = facets.corners
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    wrong = np.einsum("ti,ti->t", across, facets.normals.sum(axis=1)) < 0
    return np.asarray(np.where(wrong[:, None, None], corners[:, ::-1], corners))


def _mesh_faces(mesh: Mesh) -> tuple[Patch, ...]:
    """Faces of a mesh, each cut where it has an edge."""
    count = len(mesh.points)
    outer = corner_keys(outer_triangles(mesh), count)
    patches = []
    for name, sides in mesh.faces.items():
        inner = not np.isin(corner_keys(sides, count), outer).all()
        corners = six_node_triangles(sides)[:, :3]
        group = grouped(mesh.points, corners)
        for k in range(int(group.max(initial=-1)) + 1):
            patches.append(Patch(name=name, triangles=mesh.points[corners[group == k]], inner=inner))
    return tuple(patches)


def _film_mirrors(shape: FilmShape) -> tuple[MirrorPlane, ...]:
    """Mirror planes of a film, from its edges named ``symmetry_x`` and so on."""
    edges = {name: patch.corners[k] for patch in shape.patches for k, name in enumerate(patch.edges)}
    edges |= {name: patch.corners[0] for patch in shape.patches for name in patch.faces}
    names = [name for name in sorted(edges) if name.startswith(CUTS[0])]
    return tuple(MirrorPlane(axis := "xyz".index(name[-1]), edges[name][axis]) for name in names)


def _mirrors(faces: Iterable[Patch]) -> tuple[MirrorPlane, ...]:
    """Mirror planes of a part, from its faces named ``symmetry_``."""
    planes: dict[str, MirrorPlane] = {}
    for face in faces:
        if face.name.startswith(CUTS[0]):
            axis = int(np.ptp(face.triangles.reshape(-1, 3), axis=0).argmin())
            planes[face.name] = MirrorPlane(axis, float(face.triangles[..., axis].mean()))
    return tuple(planes.values())
