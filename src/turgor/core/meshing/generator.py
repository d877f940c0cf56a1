"""Call netgen: tetrahedra of ten nodes in a CAD shape, with sizes on its faces, along lines and at points."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from turgor.core.geometry.cad.symmetry.sector import cut_pairs, cut_turn
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing import netgen
from turgor.core.meshing.bodies.assemble import Raw
from turgor.core.meshing.silenced_output import captured_output
from turgor.core.meshing.sizing.local_sizes import LocalSizes
from turgor.core.meshing.sizing.small_features import SmallFeatures
from turgor.core.meshing.sizing.thin_walls import ThinWalls
from turgor.foundation.errors import TurgorError
from turgor.units import mm

#: Cells along an arc as long as its radius where netgen shall not look at curvature: its least is above zero.
NO_CURVATURE = 0.01


@dataclass(frozen=True, slots=True, kw_only=True)
class GeneratorSizes:
    """Sizes for the generator.

    Parameters
    ----------
    size : float [m]
        Size of all cells.
    grading : float [-]
        How fast cells grow away from smaller ones.
    local : LocalSizes
        Smaller sizes of faces and along lines.
    curvature : float [-]
        Cells along an arc as long as its radius.
    places : tuple of ThinWalls
        Points with smaller sizes, of each round of asking.
    features : SmallFeatures, optional
        Rounds that are left coarse; the sizes of the others take the place of ``curvature``.
    """

    size: float
    grading: float
    local: LocalSizes
    curvature: float
    places: tuple[ThinWalls, ...] = ()
    features: SmallFeatures | None = None


@contextmanager
def sizes_on_faces(geometry: Geometry, sizes: Mapping[int, float]) -> Iterator[None]:
    """Set sizes [m] on the faces of the shape while it is meshed, by their places, and remove them afterwards."""
    faces = {place: face for place, face in enumerate(geometry._cad.faces) if place in sizes}
    before = {place: face.maxh for place, face in faces.items()}
    try:
        for place, face in faces.items():
            face.maxh = sizes[place] / geometry.length_scale
        yield
    finally:
        for place, face in faces.items():
            face.maxh = before[place]


def join_cuts(geometry: Geometry) -> None:
    """Let the generator make the same triangles on both cut faces of a wedge, which are those of one turned."""
    if geometry.wedge is None:
        return
    turn = cut_turn(geometry.wedge, geometry.length_scale)
    for low, high in cut_pairs(geometry._cad, geometry.wedge, geometry.length_scale):
        low.Identify(high, "cyclic", netgen.IdentificationType.PERIODIC, turn)


def generated_cells(geometry: Geometry, sizes: GeneratorSizes) -> Raw:
    """Fill a CAD shape with tetrahedra of ten nodes, some of which may be turned inside out.

    Parameters
    ----------
    geometry : Geometry
    sizes : GeneratorSizes

    Raises
    ------
    TurgorError
        If the generator gives up, with its own words.
    """
    before = netgen.SetMessageImportance(0)
    with captured_output() as text:  # at level 0 its warnings and errors still go to stdout, line after line
        try:
            # the generator takes sizes from a triangulation stored with the shape; making it here gives the same mesh
            # whether or not the shape was meshed, measured or drawn before
            geometry._cad.MakeTriangulation()
            netgen_mesh = geometry._cad.GenerateMesh(
                mp=_local_sizes(sizes, geometry.length_scale),
                maxh=sizes.size / geometry.length_scale,
                grading=sizes.grading,
                curvaturesafety=sizes.curvature if sizes.features is None else NO_CURVATURE,
                parallel_meshing=False,  # the same mesh for half the work: its threads spin where a machine is busy
                ngs_mesh=False,
            )
            netgen_mesh.SecondOrder()
        except netgen.NgException as error:
            causes = [line.strip() for line in text().splitlines() if " error: " in line.lower()]
            raise TurgorError(
                f"'{geometry.name}' could not be meshed at size {sizes.size / mm:.4g} mm; use a smaller one. "
                f"The mesh generator says: {causes[-1] if causes else error}"
            ) from error
        finally:
            netgen.SetMessageImportance(before)
    return _read(netgen_mesh, geometry.length_scale)


def _local_sizes(sizes: GeneratorSizes, scale: float) -> Any:
    """Smaller sizes at points and along lines, as the generator takes them; None without any."""
    features = sizes.features
    if not sizes.places and not len(sizes.local.lines) and features is None:
        return None
    parameters = netgen.MeshingParameters()
    for start, end in sizes.local.lines / scale:
        parameters.RestrictHLine(netgen.Pnt(*start), netgen.Pnt(*end), sizes.local.line_size / scale)
    if features is not None:
        for (start, end), size in zip(features.lines / scale, features.line_sizes / scale, strict=True):
            parameters.RestrictHLine(netgen.Pnt(*start), netgen.Pnt(*end), size)
    for rounds, walls in enumerate(sizes.places):
        for (x, y, z), size in zip(walls.points / scale, walls.sizes(rounds) / scale, strict=True):
            parameters.RestrictH(x, y, z, size)
    return parameters


def _read(netgen_mesh: Any, scale: float) -> Raw:
    cells, triangles = netgen_mesh.Elements3D().NumPy(), netgen_mesh.Elements2D().NumPy()
    descriptors = netgen_mesh.FaceDescriptors()
    return Raw(
        points=np.array(netgen_mesh.Coordinates(), dtype=np.float64) * scale,
        cells=cells["nodes"][:, :10].astype(np.int64) - 1,
        cell_region=cells["index"].astype(np.int64) - 1,
        regions=tuple(netgen_mesh.GetMaterial(i + 1) for i in range(int(cells["index"].max(initial=0)))),
        corners=triangles["nodes"][:, :3].astype(np.int64) - 1,
        corner_face=triangles["index"].astype(np.int64) - 1,
        faces=tuple(descriptor.bcname for descriptor in descriptors),
    )
