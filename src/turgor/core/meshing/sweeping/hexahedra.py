"""Hexahedra between the sections of a sweep: their nodes on the true shape, and what fills each of them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.extrusion import Along, Sweep
from turgor.core.meshing.sweeping.section import Fineness, SectionMesh, divided, divided_turn, names_at

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Nodes of a hexahedron in the order of `turgor.core.meshing.cells.HEXAHEDRON`, as (station, node of the section): at
#: its start (0), in the middle (1), at its end (2).
PLACES = (
    *((0, i) for i in (0, 1, 2, 3)),
    *((2, i) for i in (0, 1, 2, 3)),
    *((0, i) for i in (4, 5, 6, 7)),
    *((2, i) for i in (4, 5, 6, 7)),
    *((1, i) for i in (0, 1, 2, 3)),
    *((1, i) for i in (7, 5, 4, 6)),
    (0, 8),
    (2, 8),
    (1, 8),
)

#: The same quadrilateral seen from the other side.
TURNED_OVER = [0, 3, 2, 1, 7, 6, 5, 4, 8]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Filling:
    """Hexahedra that fill everything a sweep passes: solids, cavities and the air around them.

    Parameters
    ----------
    points : (n, 3) array [m]
        Positions of the nodes.
    cells : (c, 27) int array
        Nodes of each hexahedron.
    names : (c,) object array
        Region, cavity, or None for air.
    """

    points: Array
    cells: Ints
    names: NDArray[np.object_]


def fill(sweep: Sweep, section: SectionMesh, fine: Fineness, multiple: int = 1) -> Filling:
    """Move a section along its path.

    Parameters
    ----------
    sweep : Sweep
        Layers and path.
    section : SectionMesh
        The section, cut into quadrilaterals.
    fine : Fineness
    multiple : int
        The number of cells around each layer of a turn is a multiple of this.

    Returns
    -------
    Filling
        Cells in the order of the path, section after section.
    """
    along, layer_of = _stations(sweep, section, fine, multiple)
    count = len(along) - sweep.is_closed
    points = _place(sweep, np.repeat(section.points, count, axis=0), np.tile(along[:count], len(section.points)))
    quads = section.quads
    if isinstance(sweep.path, Along) and sweep.path.axis == 1:
        quads = quads[:, TURNED_OVER]  # (x, z, y) is left-handed
    step = np.arange(len(layer_of))
    nodes = [quads[None, :, i] * count + ((2 * step + station) % count)[:, None] for station, i in PLACES]
    return Filling(
        points=points,
        cells=np.stack([n.ravel() for n in nodes], axis=1),
        names=names_at(sweep.layers, section.centers)[layer_of].ravel(),
    )


def _stations(sweep: Sweep, section: SectionMesh, fine: Fineness, multiple: int) -> tuple[Array, Ints]:
    """Where the nodes lie along the path, and the layer of each interval between two of every second of them."""
    ends = np.array([sweep.layers[0].start, *(layer.end for layer in sweep.layers)])
    if isinstance(sweep.path, Along):
        along = divided(ends, fine.of_path)
    else:
        along = divided_turn(ends, float(section.points[:, 1].max()), fine, multiple)
    return along, np.searchsorted(ends, along[1::2]) - 1


def _place(sweep: Sweep, section: Array, along: Array) -> Array:
    """Positions (n, 3) of points given in the section and along the path."""
    u, v = section.T
    if isinstance(sweep.path, Along):
        return np.insert(section, sweep.path.axis, along, axis=1)
    return np.stack([u, v * np.cos(along), v * np.sin(along)], axis=1)
