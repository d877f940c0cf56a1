"""write_stl: the surface of a geometry or a mesh, or of one of its cavities, as an STL file."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from turgor.core.geometry.child_process import in_child
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.geometry.wedge import Wedge
from turgor.core.meshing import netgen
from turgor.core.meshing.cells import six_node_triangles
from turgor.core.meshing.child_meshing import meshing
from turgor.core.meshing.exchange.formats.raw import Array, Ints
from turgor.core.meshing.exchange.formats.stl import Triangles, stl_bytes
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.silenced_output import captured_output
from turgor.core.meshing.surface import outer_triangles
from turgor.foundation.errors import TurgorError, unknown
from turgor.units import mm

#: Corners of the four flat triangles that cover a six-node one.
_QUARTERS = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))

#: Triangles of a CAD shape are at most this share of the part long.
LONGEST_SHARE = 0.1


@dataclass(slots=True, eq=False)
class _Surface:
    """Flat triangles by the face that they belong to; normals point out of the solid."""

    name: str
    points: Array
    faces: dict[str, Ints]
    rest: Ints
    mirrors: tuple[str, ...]
    wedge: Wedge | None = None


def write_stl(source: Geometry | Mesh, path: str | Path, *, face: str | None = None, whole: bool = True) -> Triangles:
    """Write the closed surface of a body, or of one of its cavities, as a binary STL file in millimeters.

    Corners of a mesh's file are nodes of the mesh, so that cavity and body fit each other exactly; quadratic sides
    give four triangles for each six-node one.

    Parameters
    ----------
    source : Geometry or Mesh
        What to write.
    path : str or Path
        The file.
    face : str, optional
        A cavity, such as ``"cavity"``, wound so that it encloses a positive volume; the whole body with the insides
        of its cavities by default.
    whole : bool
        Whether a half or a quarter is mirrored to the whole part.

    Returns
    -------
    Triangles
        What was written [m].

    Raises
    ------
    TurgorError
        If there is no such face or the surface is not closed.
    """
    closed = closed_surface(source, face, whole)
    Path(path).write_bytes(stl_bytes(closed.points / mm, closed.triangles))
    return closed


def closed_surface(source: Geometry | Mesh, face: str | None = None, whole: bool = True) -> Triangles:
    """Return the triangles [m] that `write_stl` writes; see there."""
    if isinstance(source, Mesh):
        surface = _of_mesh(source)
    elif source.file:
        surface = in_child(meshing(source.name), _of_geometry, source)
    else:
        surface = _of_geometry(source)
    if face is not None and face not in surface.faces:
        raise unknown("face", face, surface.faces)
    mirrors = surface.mirrors if whole else ()
    if face is None:
        chosen = [t for name, t in surface.faces.items() if name not in mirrors]
        triangles = np.unique(np.concatenate([surface.rest[:0], *chosen, surface.rest]), axis=0)
    else:
        triangles = surface.faces[face][:, ::-1]
    closed = _mirrored(surface, triangles, mirrors)
    if closed.open_edges:
        raise TurgorError(
            f"the surface {f'of face {face!r} ' if face else ''}of '{surface.name}' is open: {closed.open_edges} of "
            "its edges have not two triangles; a cavity must be closed, and a half be written whole; a part in "
            "plane strain has no ends."
        )
    return closed


def _of_mesh(mesh: Mesh) -> _Surface:
    outer = _flat(outer_triangles(mesh))
    keys = {tuple(sorted(triangle)) for triangle in outer.tolist()}
    faces = {}
    for name, sides in mesh.faces.items():
        flat = _flat(sides)
        on = np.array([tuple(sorted(triangle)) in keys for triangle in flat.tolist()], dtype=bool)
        faces[name] = flat[on]
    faces = {name: flat for name, flat in faces.items() if len(flat)}
    named = {tuple(sorted(t)) for flat in faces.values() for t in flat.tolist()}
    unnamed = [t for t in outer.tolist() if tuple(sorted(t)) not in named]
    rest = np.array(unnamed, dtype=np.int64).reshape(-1, 3)
    return _Surface(mesh.name, _without_pinhole(mesh), faces, rest, mesh.cut_faces, mesh.wedge)


def _without_pinhole(mesh: Mesh) -> Array:
    """Nodes (n, 3) with those around the thin hole of a body of revolution on its axis, where the hole vanishes."""
    if not mesh.revolved:
        return mesh.points
    points = mesh.points.copy()
    for axis, level in mesh.mirror_planes:
        if "xyz"[axis] != mesh.revolved:
            points[mesh.on_axis, axis] = level
    return points


def _flat(sides: Ints) -> Ints:
    triangles = six_node_triangles(sides)
    return np.asarray(triangles[:, np.array(_QUARTERS)].reshape(-1, 3))


def _of_geometry(geometry: Geometry) -> _Surface:
    before = netgen.SetMessageImportance(0)
    with captured_output():
        try:
            size = LONGEST_SHARE * geometry.extent / geometry.length_scale
            mesh = geometry._cad.GenerateMesh(
                maxh=size, curvaturesafety=3.0, grading=0.9, perfstepsend=netgen.MeshingStep.MESHSURFACE, ngs_mesh=False
            )
        finally:
            netgen.SetMessageImportance(before)
    table, descriptors = mesh.Elements2D().NumPy(), mesh.FaceDescriptors()
    triangles, place = table["nodes"][:, :3].astype(np.int64) - 1, table["index"].astype(np.int64) - 1
    faces: dict[str, list[Ints]] = {}
    for number, descriptor in enumerate(descriptors):
        if (descriptor.domin == 0) == (descriptor.domout == 0):
            continue  # between two solids, or of none
        own = triangles[place == number]
        faces.setdefault(descriptor.bcname, []).append(own if descriptor.domout == 0 else own[:, ::-1])
    joined = {name: np.concatenate(parts) for name, parts in faces.items()}
    mirrors = tuple(name for name in joined if name.startswith(("symmetry_", "cyclic_")))
    points = np.array(mesh.Coordinates(), dtype=np.float64) * geometry.length_scale
    return _Surface(geometry.name, points, joined, np.zeros((0, 3), dtype=np.int64), mirrors, geometry.wedge)


def _mirrored(surface: _Surface, triangles: Ints, mirrors: Iterable[str]) -> Triangles:
    """Add the mirror or turned images and make corners at the same place one."""
    corners = surface.points[triangles]
    if surface.wedge is not None and mirrors:
        corners = np.concatenate([surface.wedge.images(corners, k) for k in range(surface.wedge.fold)])
    for name in mirrors if surface.wedge is None else ():
        plane = surface.points[np.unique(surface.faces[name])]
        axis = int(np.ptp(plane, axis=0).argmin())
        image = corners[:, ::-1].copy()
        image[:, :, axis] = 2 * plane[:, axis].mean() - image[:, :, axis]
        corners = np.concatenate([corners, image])
    points = corners.reshape(-1, 3)
    pairs = cKDTree(points).query_pairs(
        TOLERANCE.round_off * float(np.ptp(points, axis=0).max()), output_type="ndarray"
    )
    number = np.arange(len(points))
    np.minimum.at(number, pairs[:, 1], pairs[:, 0])
    unique, place = np.unique(number, return_inverse=True)
    rows = np.asarray(place).reshape(-1, 3)
    return Triangles(points=points[unique], triangles=rows[(rows != np.roll(rows, 1, axis=1)).all(axis=1)])
