"""Generate a mesh: curved ten-node tetrahedra from a geometry, with its names."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import partial
from types import MappingProxyType
from typing import Any

import numpy as np
from netgen.meshing import MeshingParameters, NgException, Pnt, SetMessageImportance
from numpy.typing import NDArray

from turgor.errors import TurgorError
from turgor.finding import Finding, Severity
from turgor.geometry.cad.facets import find_facets
from turgor.geometry.cad.surface.shape import SurfaceFace, SurfaceShape
from turgor.geometry.child import in_child
from turgor.geometry.geometry import Geometry
from turgor.meshing.bodies.assemble import Raw, assemble
from turgor.meshing.chosen import chosen_settings
from turgor.meshing.enveloped.tetrahedra import enveloped_cells
from turgor.meshing.foreign import meshing
from turgor.meshing.mesh import Mesh
from turgor.meshing.quality.cell_quality import cell_volumes, refuse_inverted
from turgor.meshing.quality.mend import mended
from turgor.meshing.quiet import captured_output
from turgor.meshing.revolved.axisymmetric import axisymmetric_mesh
from turgor.meshing.settings import MeshSettings
from turgor.meshing.sizing.default_size import default_size
from turgor.meshing.sizing.local_sizes import LocalSizes, local_sizes
from turgor.meshing.sizing.sizes import (
    CELLS_PER_RADIUS,
    LARGEST_SIZE_PER_WALL,
    size_range,
)
from turgor.meshing.sizing.thin_walls import ThinWalls, find_thin_walls, thin_walls_left
from turgor.meshing.sizing.walls import refine_walls
from turgor.meshing.sweeping.section import Fineness
from turgor.meshing.sweeping.swept import swept_mesh
from turgor.units import mm

Ints = NDArray[np.int64]

__all__ = ["default_size", "mesh", "size_range"]

#: How often a mesh is made again with smaller sizes at thin walls.
ROUNDS = 3

#: A finished mesh fills the geometry; quadratic cells may miss this share of it at curved faces.
LOST_VOLUME = 0.01


def mesh(
    geometry: Geometry,
    *,
    size: float | None = None,
    grading: float = 0.5,
    face_sizes: Mapping[str, float] = MappingProxyType({}),
    wall_cells: int = 1,
    cells: str | None = None,
) -> Mesh:
    """Generate quadratic cells that fill the geometry and carry its names: tetrahedra, or hexahedra for a sweep.

    Mid-side nodes lie on the true surface, so curved faces stay curved; where that would turn a cell inside out, its
    edges are straightened and ``mesh.findings`` says so. The same geometry and settings give the same mesh, node for
    node, on the same version of the mesh generator.

    Parameters
    ----------
    geometry : Geometry
        What to mesh.
    size : float [m], optional
        Largest edge length aimed at; cells get smaller near short edges. At most four times the thinnest wall, unless
        ``wall_cells`` is 2; `default_size` if it is not given: about twice the thinnest wall, for hexahedra
        three times.
    grading : float [-]
        How fast cells may grow away from small ones: 0.1 slowly (more cells), 1 at once.
    face_sizes : mapping of str to float [m]
        Smaller sizes for some faces, by name. Curved faces get at least two cells along an arc as long as its radius.
        Corners of cavities about which thin walls bend (`turgor.geometry.thin_corners`) get a third of ``size``, and
        curved walls that end there 0.7 of it, unless the cavity is named here.
    wall_cells : int
        Cells at least through every wall: 1 leaves them as they come; 2 gives smaller sizes to walls that are thinner
        than a quarter of ``size``, and cuts cells in two that still reach through a wall.
    cells : str, optional
        ``"tetrahedra"`` of ten nodes, for any geometry, or ``"hexahedra"`` of 27 nodes, for families that are a section
        moved along a line or turned about an axis; these need several times fewer unknowns for the same error where
        walls are thin; or ``"axisymmetric"``, for a quarter of a body of revolution whose loads are the same all
        around: its states have the degrees of freedom of its meridian alone. Where it is not given, hexahedra fill
        the families that are swept at their default size; a ``size`` or ``face_sizes`` mean tetrahedra.

    Returns
    -------
    Mesh

    Raises
    ------
    TurgorError
        If the size is no positive length, too coarse for the walls or so small that nothing could solve the mesh,
        if a face is unknown, or if the generator fails or makes cells that cannot be mended.

    Examples
    --------
    >>> from turgor.geometry import FastPneuNet
    >>> finger = FastPneuNet(chambers=2, length=20e-3).build()
    >>> sorted(mesh(finger, size=3e-3).faces)
    ['cavity', 'fixed', 'outside', 'strain_limiting_layer', 'symmetry_y', 'tip']
    >>> mesh(finger, size=0)
    Traceback (most recent call last):
    turgor.errors.TurgorError: mesh size is 0 mm; allowed is 0.291 mm to 4 mm (four times the thinnest wall, 1 mm).
    """
    settings = MeshSettings(size=size, grading=grading, face_sizes=face_sizes, wall_cells=wall_cells, cells=cells)
    return mesh_with(geometry, settings)


def mesh_with(geometry: Geometry, settings: MeshSettings) -> Mesh:
    """Mesh a geometry as settings say; `mesh` takes them as keywords.

    The shape of a CAD file is meshed in a child process, because it may crash the mesh generator.

    Parameters
    ----------
    geometry : Geometry
    settings : MeshSettings

    Returns
    -------
    Mesh
    """
    chosen = chosen_settings(geometry, settings)
    if not geometry.file:
        return _meshed(geometry, chosen)
    chosen = replace(chosen, face_sizes=dict(chosen.face_sizes))
    try:
        return in_child(meshing(geometry.name), _meshed, geometry, chosen)
    except TurgorError as error:
        if len(geometry.regions) > 1 or isinstance(geometry._shape, SurfaceShape) or chosen.cells != "tetrahedra":
            raise
        try:
            result = in_child(meshing(geometry.name), _meshed_by_facets, geometry, chosen)
        except TurgorError:
            raise error from None
        return replace(result, findings=(*result.findings, _by_facets(error, result, geometry)))


def _meshed_by_facets(geometry: Geometry, chosen: MeshSettings) -> Mesh:
    """Mesh the facets of a CAD shape of one body, whose faces are too small or too odd for the mesh generator."""
    shape = geometry._shape
    faces = list(dict.fromkeys(shape.faces))
    facets = find_facets(shape, faces)
    surface = SurfaceShape(
        points=facets.points,
        triangles=facets.triangles,
        face=facets.face,
        faces=tuple(SurfaceFace(name=str(face.name), mass=float(face.mass)) for face in faces),
    )
    filled = surface.mass * geometry.length_scale**3
    return _meshed(replace(geometry, _shape=surface, solid_volume=filled), chosen)


def _by_facets(error: TurgorError, result: Mesh, geometry: Geometry) -> Finding:
    lost = 1 - float(cell_volumes(result).sum()) / geometry.solid_volume
    return Finding(
        code="G10",
        severity=Severity.NOTE,
        message="The part was meshed from flat facets of its faces, because the faces themselves could not be meshed: "
        f"{str(error).split(';')[0].rstrip('.')}. The cells fill {abs(lost):.2%} {'less' if lost > 0 else 'more'} than "
        "the part.",
        advice="Faces far smaller than the cells are the usual cause; leave them out in the CAD program to get cells "
        "on the true faces.",
    )


def _meshed(geometry: Geometry, chosen: MeshSettings) -> Mesh:
    assert chosen.size is not None  # chosen where it was not given
    size, grading = chosen.size, float(chosen.grading)
    if chosen.cells in ("hexahedra", "axisymmetric"):
        fine = Fineness(size=size, wall_cells=chosen.wall_cells, curvature=CELLS_PER_RADIUS, grading=grading)
        made = swept_mesh if chosen.cells == "hexahedra" else axisymmetric_mesh
        result = made(geometry, fine)
        _check_result(result, geometry)
        refuse_inverted(result)
        return result
    if isinstance(geometry._shape, SurfaceShape):
        return refine_walls(_sound(geometry, partial(enveloped_cells, geometry, chosen)), chosen.wall_cells)
    sizes = _Sizes(size=size, grading=grading, local=local_sizes(geometry, size, chosen.face_sizes))
    with _sizes_on_faces(geometry, sizes.local.faces):
        try:
            result = _fitting_walls(geometry, sizes)
        except TurgorError as error:
            try:  # most failures come from arcs with too few cells
                finer = _fitting_walls(geometry, replace(sizes, curvature=2 * sizes.curvature))
            except TurgorError:
                raise error from None
            result = replace(finer, findings=(*finer.findings, _meshed_finer(error)))
    return refine_walls(result, chosen.wall_cells)


@dataclass(frozen=True, slots=True)
class _Sizes:
    """Sizes for the generator [m]: one for all, how fast cells grow, smaller ones at some points."""

    size: float
    grading: float
    local: LocalSizes
    curvature: float = field(default_factory=lambda: CELLS_PER_RADIUS)
    places: tuple[ThinWalls, ...] = ()


def _fitting_walls(geometry: Geometry, sizes: _Sizes) -> Mesh:
    """A valid mesh whose cells suit their walls: made again with smaller sizes at walls that are too thin."""
    result = _sound(geometry, partial(_generate, geometry, sizes))
    if sizes.size <= LARGEST_SIZE_PER_WALL * geometry.smallest_wall * (1 + 1e-9):
        return result  # the size suits every wall
    for _ in range(ROUNDS):
        walls = find_thin_walls(result, sizes.size)
        if not len(walls.points):
            return result
        sizes = replace(sizes, places=(*sizes.places, walls))
        result = _sound(geometry, partial(_generate, geometry, sizes))
    walls = find_thin_walls(result, sizes.size)
    if len(walls.points):
        result = replace(result, findings=(*result.findings, thin_walls_left(walls)))
    return result


def _sound(geometry: Geometry, generate: Callable[[], Raw]) -> Mesh:
    """A valid mesh, or the reason why there is none."""
    result = mended(assemble(generate(), geometry))
    _check_result(result, geometry)
    refuse_inverted(result)
    return result


def _meshed_finer(error: TurgorError) -> Finding:
    cause = str(error).split(";")[0]
    return Finding(
        code="G08",
        severity=Severity.NOTE,
        message=f"Curved faces were meshed with twice the cells along their arcs, because at first {cause}.",
        advice="A smaller size does the same with fewer surprises.",
    )


@contextmanager
def _sizes_on_faces(geometry: Geometry, sizes: Mapping[int, float]) -> Iterator[None]:
    """Set sizes on the faces of the shape while it is meshed, and remove them afterwards."""
    faces = {place: face for place, face in enumerate(geometry._shape.faces) if place in sizes}
    before = {place: face.maxh for place, face in faces.items()}
    try:
        for place, face in faces.items():
            face.maxh = sizes[place] / geometry.length_scale
        yield
    finally:
        for place, face in faces.items():
            face.maxh = before[place]


def _generate(geometry: Geometry, sizes: _Sizes) -> Raw:
    before = SetMessageImportance(0)
    with captured_output() as text:  # at level 0 its warnings and errors still go to stdout, line after line
        try:
            # the generator takes sizes from a triangulation stored with the shape; making it here gives the same mesh
            # whether or not the shape was meshed, measured or drawn before
            geometry._shape.MakeTriangulation()
            netgen_mesh = geometry._shape.GenerateMesh(
                mp=_local_sizes(sizes, geometry.length_scale),
                maxh=sizes.size / geometry.length_scale,
                grading=sizes.grading,
                curvaturesafety=sizes.curvature,
                parallel_meshing=False,  # the same mesh for half the work: its threads spin where a machine is busy
                ngs_mesh=False,
            )
            netgen_mesh.SecondOrder()
        except NgException as error:
            causes = [line.strip() for line in text().splitlines() if " error: " in line.lower()]
            raise TurgorError(
                f"'{geometry.name}' could not be meshed at size {sizes.size / mm:.4g} mm; use a smaller one. "
                f"The mesh generator says: {causes[-1] if causes else error}"
            ) from error
        finally:
            SetMessageImportance(before)
    return _read(netgen_mesh, geometry.length_scale)


def _local_sizes(sizes: _Sizes, scale: float) -> MeshingParameters | None:
    """Smaller sizes at points and along lines, as the generator takes them."""
    if not sizes.places and not len(sizes.local.lines):
        return None
    parameters = MeshingParameters()
    for start, end in sizes.local.lines / scale:
        parameters.RestrictHLine(Pnt(*start), Pnt(*end), sizes.local.line_size / scale)
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


def _check_result(result: Mesh, geometry: Geometry) -> None:
    """Refuse a mesh that lost names or volume on the way."""
    for kind, wanted, found in (
        ("region", geometry.regions, result.regions),
        ("face", geometry.faces, result.faces),
    ):
        lost = [name for name in wanted if name not in found or not len(found[name])]
        if lost:
            raise TurgorError(f"the mesh of '{geometry.name}' lost the {kind} {', '.join(lost)}; try a smaller size.")
    volume = float(cell_volumes(result).sum())
    if abs(volume - geometry.solid_volume) > LOST_VOLUME * geometry.solid_volume:
        raise TurgorError(
            f"the mesh of '{geometry.name}' fills {volume * 1e9:.6g} mm³ of {geometry.solid_volume * 1e9:.6g} mm³; "
            "try a smaller size."
        )
