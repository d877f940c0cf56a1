"""Generate a mesh: curved ten-node tetrahedra from a geometry, with its names."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from types import MappingProxyType
from typing import Protocol, cast

from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.geometry.child_process import in_child
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.film_shape import FilmShape
from turgor.core.meshing.bodies.assemble import Raw, assemble
from turgor.core.meshing.child_meshing import meshing
from turgor.core.meshing.default_settings import chosen_settings
from turgor.core.meshing.generator import GeneratorSizes, generated_cells, join_cuts, sizes_on_faces
from turgor.core.meshing.generator_override import INSTEAD
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes, refuse_inverted
from turgor.core.meshing.quality.straightening import mended
from turgor.core.meshing.refining.face_sizes import with_face_sizes
from turgor.core.meshing.revolved.axisymmetric import axisymmetric_mesh
from turgor.core.meshing.revolved.meridian import is_revolved
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.default_size import default_size
from turgor.core.meshing.sizing.local_sizes import local_sizes
from turgor.core.meshing.sizing.settings import FEATURES, QUALITIES, SIZING
from turgor.core.meshing.sizing.sizes import is_tube, size_range, wall_size
from turgor.core.meshing.sizing.small_features import (
    coarse_edges,
    coarse_features,
    has_tiny_edges,
    small_features,
)
from turgor.core.meshing.sizing.thin_walls import find_thin_walls, section_finer, thin_walls_remain
from turgor.core.meshing.sizing.wall_refinement import refine_walls
from turgor.core.meshing.sizing.wall_sizes import fitted_to_walls
from turgor.core.meshing.sweeping.films import film_mesh
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import is_grid_row, swept_mesh
from turgor.core.meshing.tetwild.faceted import faceted, meshed_by_facets
from turgor.core.meshing.tetwild.tetrahedra import enveloped_cells
from turgor.core.meshing.wedge import with_wedge
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.given import Quantity, number, one

__all__ = ["default_size", "mesh", "size_range"]

#: A finished mesh fills the geometry; quadratic cells may miss this share of it at curved faces.
LOST_VOLUME = 0.01


class Builds(Protocol):
    """Builder of a geometry: an actuator family, a CAD file."""

    def build(self) -> Geometry:
        """Build it."""


def mesh(
    geometry: Geometry | Builds,
    *,
    size: Quantity | None = None,
    quality: str = "normal",
    grading: float = 0.5,
    face_sizes: Mapping[str, Quantity] = MappingProxyType({}),
    wall_cells: int = 1,
    cells: str | None = None,
    ignore_features_below: float | None = None,
) -> Mesh:
    """Generate quadratic cells that fill the geometry and carry its names: tetrahedra, or hexahedra for a sweep.

    Mid-side nodes lie on the true surface, so curved faces stay curved; where that would turn a cell inside out, its
    edges are straightened and ``mesh.findings`` says so. The same geometry and settings give the same mesh on the same
    version of the mesh generator; for parts that are given by facets, on the same machine
    (`turgor.core.meshing.tetwild`).

    Parameters
    ----------
    geometry : Geometry
        What to mesh; an actuator family, such as ``FastPneuNet(...)``, is built first.
    size : float [m], optional
        Largest edge length aimed at; cells get smaller near short edges, and along walls that are thinner than a
        quarter of it (G09). `default_size` if it is not given: about twice the thinnest wall, for hexahedra three
        times.
    quality : str
        What the default size is made for: ``"draft"`` a mesh error of 10 %, ``"normal"`` 2 %, ``"fine"`` 0.5 %. A
        stated ``size`` comes first.
    grading : float [-]
        How fast cells may grow away from small ones: 0.1 slowly (more cells), 1 at once.
    face_sizes : mapping of str to float [m]
        Smaller sizes for some faces, by name; hexahedra are cut in whole sheets through the part until the edges on
        the face are as short. A face named here keeps its size where its wall is thin. Tetrahedra on curved faces get
        at least two cells along an arc as long as its radius. Corners of cavities about which thin walls bend
        (`turgor.core.geometry.thin_corners`) get a third of ``size``, and curved walls that end there 0.7 of it,
        unless the cavity is named here.
    wall_cells : int
        Cells at least through every wall, 1 to 4: 1 leaves them as they come; 2 cuts cells in two that reach through
        a wall; more cut them again.
    cells : str, optional
        ``"tetrahedra"`` of ten nodes, for any geometry; ``"hexahedra"`` of 27 nodes, for families that are a section
        moved along a line or turned about an axis; ``"axisymmetric"``, for a quarter of a body of revolution whose
        loads are the same all around. By default hexahedra where they fit, no ``size`` or ``face_sizes`` is given and
        the quality is no draft, but for chambers in a row.
    ignore_features_below : float [m], optional
        Fillets and other rounds of a smaller radius make cells no smaller. 0 follows all of them. By default half the
        size for parts of CAD files whose rounds would make more unknowns than all the rest; G11 says which these are.

    Returns
    -------
    Mesh

    Raises
    ------
    TurgorError
        If the size is no positive length, larger than the part or so small that nothing could solve the mesh, if a
        face is unknown, or if the generator fails or makes cells that cannot be mended.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> finger = FastPneuNet(chambers=2, length=20e-3).build()
    >>> sorted(mesh(finger, size=3e-3).faces)
    ['cavity', 'fixed', 'outside', 'strain_limiting_layer', 'symmetry_y', 'tip']
    >>> mesh(finger, size=0)
    Traceback (most recent call last):
    turgor.TurgorError: mesh size is 0 mm; allowed is 0.291 mm to 20 mm (the whole part).
    """
    shape = _built(geometry)
    settings = MeshSettings(
        size=None if size is None else number(size, "mesh size", "length"),
        quality=quality,
        grading=grading,
        face_sizes=_sizes_of_faces(face_sizes),
        wall_cells=wall_cells,
        cells=cells,
        ignore_features_below=ignore_features_below,
    )
    return mesh_with(shape, settings)


def _sizes_of_faces(given: object) -> dict[str, float]:
    if not isinstance(given, Mapping):
        raise TurgorError(f"mesh face_sizes is {given!r}; sizes by face are needed, such as {{'tip': 1e-3}}.")
    return {name: number(each, f"size of the face '{name}'", "length") for name, each in given.items()}


def _built(given: object) -> Geometry:
    """Build what is not built yet."""
    build = getattr(given, "build", None)
    built = build() if callable(build) and not isinstance(given, type) else given
    needed = "an actuator is needed, such as FastPneuNet(), or a Geometry"
    return cast(Geometry, one(built, Geometry, "geometry", needed))


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
    instead = INSTEAD.get()
    if instead is not None:
        return instead(geometry, settings)
    chosen = chosen_settings(geometry, settings)
    if not geometry.file:
        return _meshed(geometry, chosen)
    chosen = replace(chosen, face_sizes=dict(chosen.face_sizes))
    try:
        return in_child(meshing(geometry.name), _meshed, geometry, chosen)
    except TurgorError as error:
        if geometry.wedge is not None or isinstance(geometry.shape, SurfaceShape) or chosen.cells != "tetrahedra":
            raise
        if len(geometry.regions) > 1:
            raise
        try:
            result = in_child(meshing(geometry.name), _meshed_by_facets, geometry, chosen)
        except TurgorError:
            raise error from None
        return _noting(result, meshed_by_facets(error, result, geometry))


def _meshed_by_facets(geometry: Geometry, chosen: MeshSettings) -> Mesh:
    return _meshed(faceted(geometry), chosen)


def _meshed(geometry: Geometry, chosen: MeshSettings) -> Mesh:
    assert chosen.size is not None  # chosen where it was not given
    size, grading = chosen.size, float(chosen.grading)
    if isinstance(geometry.shape, FilmShape):
        return film_mesh(geometry, size)
    if chosen.cells in ("hexahedra", "axisymmetric"):
        row = QUALITIES[chosen.quality].row if is_grid_row(geometry, Fineness(size=size)) else 1.0
        wide = min(size, max(row * wall_size(geometry), size_range(geometry)[0]))  # walls of a section bend
        walls, curvature = chosen.wall_cells, SIZING.cells_per_radius
        fine = Fineness(
            size=wide, along=size, wall_cells=walls, curvature=curvature, grading=grading, row=SIZING.row / row**2
        )
        make = swept_mesh if chosen.cells == "hexahedra" else axisymmetric_mesh
        result = with_face_sizes(make(geometry, fine), chosen.face_sizes)
        _check_result(result, geometry)
        refuse_inverted(result)
        if wide < size and chosen.wall_cells == 1 and not (chosen.cells == "hexahedra" and is_tube(geometry)):
            result = _noting(result, section_finer(size, wide, geometry.smallest_wall))
        return result
    if isinstance(geometry.shape, SurfaceShape):
        return refine_walls(_enveloped(geometry, chosen, size), chosen.wall_cells)
    result = _following(geometry, chosen, size)
    if chosen.ignore_features_below and has_tiny_edges(geometry, chosen.ignore_features_below):
        result = _with_fewer_cells(result, geometry, chosen)
    return refine_walls(result, chosen.wall_cells)


def _with_fewer_cells(result: Mesh, geometry: Geometry, chosen: MeshSettings) -> Mesh:
    """The mesh within an envelope of the facets, which keeps no small edge, if it has far fewer unknowns."""
    if len(geometry.regions) > 1 or geometry.wedge is not None:
        return result  # facets are those of one body, and their cuts do not match
    try:
        coarse = _sound(faceted(geometry), partial(enveloped_cells, faceted(geometry), chosen))
    except TurgorError:
        return result
    if coarse.unknown_count > FEATURES.fewer * result.unknown_count:
        return result
    filled = float(cell_volumes(coarse).sum()) / geometry.solid_volume
    finding = coarse_edges(chosen.ignore_features_below or 0.0, 1 - coarse.unknown_count / result.unknown_count, filled)
    return _noting(coarse, finding)


def _following(geometry: Geometry, chosen: MeshSettings, size: float) -> Mesh:
    """A mesh of a CAD shape: small features coarse at first, and more cells along arcs where this fails."""
    local = local_sizes(geometry, size, chosen.face_sizes)
    plain = GeneratorSizes(size=size, grading=float(chosen.grading), local=local, curvature=SIZING.cells_per_radius)
    features = small_features(geometry, size, chosen.ignore_features_below)
    attempts = [plain, replace(plain, curvature=2 * plain.curvature)]  # most failures come from arcs with too few cells
    if features is not None:
        attempts.insert(0, replace(plain, features=features))
    first: TurgorError | None = None
    join_cuts(geometry)
    with sizes_on_faces(geometry, local.faces):
        for sizes in attempts:
            try:
                result = fitted_to_walls(geometry, chosen, sizes, lambda each: _generated(geometry, each))
            except TurgorError as error:
                first = first or error
                continue
            if sizes.features is not None:
                filled = float(cell_volumes(result).sum()) / geometry.solid_volume
                stated = chosen.ignore_features_below is not None
                finding = coarse_features(sizes.features, stated, filled, is_revolved(geometry))
                result = _noting(result, finding)
            return result if first is None else _noting(result, _meshed_finer(first))
    assert first is not None
    raise first from None


def _generated(geometry: Geometry, sizes: GeneratorSizes) -> Mesh:
    return _sound(geometry, partial(generated_cells, geometry, sizes))


def _enveloped(geometry: Geometry, chosen: MeshSettings, size: float) -> Mesh:
    """A mesh of a part that is given by facets; its cells do not follow the walls, so long ones are noted."""
    result = _sound(geometry, partial(enveloped_cells, geometry, chosen))
    if size <= wall_size(geometry) * (1 + 1e-9):
        return result
    walls = find_thin_walls(result, size)
    return _noting(result, thin_walls_remain(walls)) if len(walls.points) else result


def _noting(result: Mesh, finding: Finding) -> Mesh:
    return replace(result, findings=(*result.findings, finding))


def _sound(geometry: Geometry, generate: Callable[[], Raw]) -> Mesh:
    """A valid mesh, or the reason why there is none."""
    raw = assemble(generate(), geometry)
    result = with_wedge(mended(raw), raw, geometry.wedge)
    _check_result(result, geometry)
    refuse_inverted(result)
    return result


def _meshed_finer(error: TurgorError) -> Finding:
    cause = str(error).split(";")[0]
    return Finding(
        code="G08",
        severity=Severity.NOTE,
        message=f"Curved faces were meshed with more cells along their arcs, because at first {cause}.",
        advice="A smaller size does the same with fewer surprises.",
    )


def _check_result(result: Mesh, geometry: Geometry) -> None:
    """Refuse a mesh that lost names or volume on the way."""
    for kind, expected, faces in (
        ("region", geometry.regions, result.regions),
        ("face", geometry.faces, result.faces),
    ):
        lost = [name for name in expected if name not in faces or not len(faces[name])]
        if lost:
            raise TurgorError(f"the mesh of '{geometry.name}' lost the {kind} {', '.join(lost)}; try a smaller size.")
    volume = float(cell_volumes(result).sum())
    if abs(volume - geometry.solid_volume) > LOST_VOLUME * geometry.solid_volume:
        raise TurgorError(
            f"the mesh of '{geometry.name}' fills {volume * 1e9:.6g} mm³ of {geometry.solid_volume * 1e9:.6g} mm³; "
            "try a smaller size."
        )
