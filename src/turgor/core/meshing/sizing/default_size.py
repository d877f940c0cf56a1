"""default_size: the mesh size of a geometry where none is given."""

from math import floor, log10

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.film_shape import FilmShape
from turgor.core.meshing.sizing.settings import QUALITIES, SIZING
from turgor.core.meshing.sizing.sizes import extent_of, size_for, size_range, wall_size
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import is_grid_row, swept_mesh
from turgor.foundation.errors import TurgorError
from turgor.units import mm


def default_size(geometry: Geometry, cells: str = "tetrahedra", quality: str = "normal") -> float:
    """Mesh size for a geometry where none is given [m]: twice the thinnest wall, for hexahedra three times; two digits.

    It is larger where this would make more than about 150,000 unknowns, up to four times the wall, and never more
    than an eighth of the part. Where four times the wall would make more unknowns than can be solved for, it is larger
    still, and only thin walls get smaller cells. A draft is 1.25 times as coarse, with hexahedra of chambers in a row
    twice, a fine mesh half as coarse.

    Parameters
    ----------
    geometry : Geometry
    cells : str
        ``"tetrahedra"``, ``"hexahedra"``, which are shorter near walls by themselves, or ``"axisymmetric"``.
    quality : str
        ``"draft"``, ``"normal"`` or ``"fine"``.

    Returns
    -------
    float [m]

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> finger = FastPneuNet().build()
    >>> default_size(finger), default_size(finger, "hexahedra")
    (0.002, 0.003)
    >>> default_size(finger, quality="draft"), default_size(finger, "hexahedra", quality="fine")
    (0.0025, 0.0015)
    >>> default_size(finger, "hexahedra", quality="draft")
    0.006
    """
    if isinstance(geometry.shape, FilmShape):
        return geometry.extent / SIZING.film_sides * QUALITIES[quality].size
    low, high = size_range(geometry)[0], wall_size(geometry)
    if high < low and cells != "axisymmetric":
        high = size_for(geometry, SIZING.default_unknowns)
    high = min(high, extent_of(geometry) / SIZING.cells_per_extent)
    per_wall = SIZING.hexahedra_per_wall if cells == "hexahedra" else SIZING.tetrahedra_per_wall
    chosen = QUALITIES[quality]
    unknowns = chosen.unknowns * SIZING.default_unknowns
    size = chosen.size * min(per_wall * geometry.smallest_wall, high)
    if cells == "hexahedra" and geometry._sweep is not None and wall_size(geometry) >= low:
        size = _fewer(geometry, min(size, high), unknowns)
    elif cells != "axisymmetric":  # few unknowns whatever the size
        size = max(size, size_for(geometry, unknowns))
    size = min(size, high)
    if cells == "hexahedra" and is_grid_row(geometry, Fineness(size=size)):
        size *= chosen.row
    digits = 1 - floor(log10(size / mm))
    rounded = floor(round(size / mm * 10**digits, 6)) / 10**digits * mm
    return rounded if rounded >= low else low


def _fewer(geometry: Geometry, size: float, unknowns: float) -> float:
    """A size whose hexahedra have few enough unknowns, counted on a mesh; they fall about as the size rises."""
    try:
        mesh = swept_mesh(geometry, Fineness(size=size))
    except TurgorError:
        return size  # the mesh itself says what is wrong
    return size * max(1.0, mesh.unknown_count / unknowns)
