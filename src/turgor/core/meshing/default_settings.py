"""chosen_settings: mesh settings with the size and the kind of cells that suit a geometry, where none is given."""

from dataclasses import replace
from math import inf

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.film_shape import FilmShape
from turgor.core.meshing.quality.cell_quality import refuse_inverted
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.default_size import default_size
from turgor.core.meshing.sizing.settings import QUALITIES, SIZING
from turgor.core.meshing.sizing.sizes import (
    check_face_sizes,
    check_features,
    check_quality,
    check_settings,
    is_block,
    size_range,
    wall_size,
)
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import check_cells, is_grid_row, is_lattice, swept_mesh
from turgor.foundation.errors import TurgorError

#: Cells whose sides are those of films without a solid.
FILM_CELLS = "hexahedra"


def chosen_settings(geometry: Geometry, settings: MeshSettings) -> MeshSettings:
    """Fill in what mesh settings leave open, once the geometry allows the rest.

    Where neither size nor cells nor sizes of faces are given, a geometry that is a swept section gets hexahedra. On the
    truth set (docs/truth.md) their default size is within 1.4 % of the references, that of tetrahedra up to 7 % off. A
    size alone means tetrahedra, as it always did, so that files with a size keep their mesh. So does a draft
    unless hexahedra have few unknowns or fill chambers in a row: elsewhere coarse ones have hardly fewer than those of
    the default size.

    Parameters
    ----------
    geometry : Geometry
    settings : MeshSettings
        As a user gave them.

    Returns
    -------
    MeshSettings
        With a size and a kind of cells.

    Raises
    ------
    TurgorError
        If the geometry does not allow one of the settings: what it is, and what is allowed.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> finger = FastPneuNet(chambers=2, length=20e-3).build()
    >>> chosen = chosen_settings(finger, MeshSettings())
    >>> chosen.cells, chosen.size
    ('hexahedra', 0.0025)
    >>> chosen_settings(finger, MeshSettings(size=2e-3)).cells
    'tetrahedra'
    """
    check_quality(settings.quality)
    if isinstance(geometry.shape, FilmShape):
        return _of_films(geometry, settings)
    cells = chosen_cells(geometry, settings)
    size = default_size(geometry, cells, settings.quality) if settings.size is None else settings.size
    check_settings(geometry, replace(settings, size=size, cells=cells))
    check_face_sizes(geometry, settings.face_sizes, float(size))
    check_features(geometry, settings.ignore_features_below, float(size), cells)
    return replace(settings, size=float(size), cells=check_cells(geometry, cells))


def _of_films(geometry: Geometry, settings: MeshSettings) -> MeshSettings:
    """Settings of films without a solid, which have quadrilaterals of one size whatever cells are stated."""
    size = default_size(geometry, quality=settings.quality) if settings.size is None else settings.size
    chosen = replace(settings, size=size, cells=FILM_CELLS)
    check_settings(geometry, chosen)
    return chosen


def chosen_cells(geometry: Geometry, settings: MeshSettings) -> str:
    """Return the kind of cells that settings ask for, or the one that suits the geometry; see `chosen_settings`."""
    if isinstance(geometry.shape, FilmShape):
        return FILM_CELLS
    if settings.cells is not None:
        return settings.cells
    free = settings.size is None and not settings.face_sizes and settings.ignore_features_below is None
    most = QUALITIES[settings.quality].hexahedra
    return "hexahedra" if free and _fillable(geometry, most) else "tetrahedra"


def _fillable(geometry: Geometry, most: float) -> bool:
    """Whether hexahedra of the default size suit a geometry and have at most so many unknowns.

    In few sections of odd dimensions some turn over, and some sections need too many.
    """
    if geometry._sweep is None or wall_size(geometry) < size_range(geometry)[0]:
        return False  # hexahedra suit every wall, also one that is too thin for that
    fine = Fineness(size=default_size(geometry, "hexahedra"))
    try:
        mesh = swept_mesh(geometry, fine)
        refuse_inverted(mesh)
        count, hinges = mesh.unknown_count, bool(geometry._sweep.hinges)
        few = count <= SIZING.unknowns_of_pairs or hinges or is_lattice(geometry, fine)
        large = mesh.serendipity and most < inf and not is_block(geometry)  # a large mesh is no draft
        small = count <= most and not large
        return few and (small or is_grid_row(geometry, fine))
    except TurgorError:
        return False
