"""Patches: the surface of a shape as flat triangles in named faces, without a mesh."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.facets import faces_between, named_facets
from turgor.core.geometry.cad.inspection import Inspection
from turgor.core.geometry.cad.surface.grouping import grouped
from turgor.core.geometry.directions import FileAxes, rotation_to
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.whole import Image, MirrorPlane, images_of
from turgor.core.meshing.cells import six_node_triangles
from turgor.core.meshing.exchange.mesh_file import MeshedShape
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import outer_triangles
from turgor.views.viewer.packing import pack_index, pack_steps

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Beginnings of the names of cut faces, which are no surface of the whole.
CUTS = ("symmetry_", "cyclic_")

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

    def size(self) -> list[float]:
        """Return the sides of the box around the whole [m]."""
        corners = np.concatenate([face.triangles.reshape(-1, 3) for face in self.faces])
        points = np.concatenate([image.of(corners) for image in self.images])
        return [float(side) for side in np.ptp(points, axis=0)]

    def scene(self) -> dict[str, Any]:
        """Return what the viewer draws: one step without fields, and the names of the faces."""
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
            "parts": {
                "names": names,
                "of": pack_index(part[~inner]),
                "face": pack_index(face[~inner]),
                "inner": pack_index(triangles[inner]),
                "innerOf": pack_index(part[inner]),
            },
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
    mirrors = _mirrors(faces)
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
    scale, shape = geometry.length_scale, geometry._cad
    pairs = zip(named_facets(shape), faces_between(shape), strict=True)
    return tuple(Patch(name=name, triangles=c * scale, inner=inner) for (name, c), inner in pairs if len(c))


def _mesh_faces(mesh: Mesh) -> tuple[Patch, ...]:
    """Faces of a mesh, each cut where it has an edge."""
    outer = {tuple(side) for side in np.sort(outer_triangles(mesh), axis=1).tolist()}
    patches = []
    for name, sides in mesh.faces.items():
        inner = len(sides) > 0 and tuple(sorted(sides[0].tolist())) not in outer
        corners = six_node_triangles(sides)[:, :3]
        group = grouped(mesh.points, corners)
        for k in range(int(group.max(initial=-1)) + 1):
            patches.append(Patch(name=name, triangles=mesh.points[corners[group == k]], inner=inner))
    return tuple(patches)


def _mirrors(faces: Iterable[Patch]) -> tuple[MirrorPlane, ...]:
    """Mirror planes of a part, from its faces named ``symmetry_``."""
    planes: dict[str, MirrorPlane] = {}
    for face in faces:
        if face.name.startswith(CUTS[0]):
            axis = int(np.ptp(face.triangles.reshape(-1, 3), axis=0).argmin())
            planes[face.name] = MirrorPlane(axis, float(face.triangles[..., axis].mean()))
    return tuple(planes.values())
