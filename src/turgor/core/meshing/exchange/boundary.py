"""The boundary of imported cells: its sides, its connected parts, and which of them close a cavity."""

from dataclasses import dataclass, field, replace

import numpy as np

from turgor.core.meshing.bodies.groups import groups_of
from turgor.core.meshing.cells import CellType
from turgor.core.meshing.exchange.formats.raw import Array, Ints
from turgor.core.meshing.exchange.solids import Solids, side_numbers

#: The same side seen from behind.
_TURNED = {6: (0, 2, 1, 5, 4, 3), 9: (0, 3, 2, 1, 7, 6, 5, 4, 8)}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sides:
    """All sides of all cells, and which of them are the boundary.

    Parameters
    ----------
    points : (n, 3) array [m]
    kind : CellType
        Kind of the cells.
    nodes : (s, m) int array
        Nodes of each side, normals pointing out of its cell; of two equal sides the one of the earlier cell.
    outer : (s,) bool array
        Whether no other cell shares it.
    on_axis : (a,) int array
        Nodes around the pinhole of a revolved mesh, where a surface may end.
    """

    points: Array
    kind: CellType
    nodes: Ints
    outer: np.ndarray
    on_axis: Ints = field(default_factory=lambda: np.zeros(0, dtype=np.int64))

    @property
    def corners(self) -> Ints:
        """The corners of each side, (s, 3) or (s, 4)."""
        return self.nodes[:, : self.kind.side.corners]

    @property
    def positions(self) -> Array:
        """Where the corners of each side are, (s, k, 3) [m]."""
        return np.asarray(self.points[self.corners])

    @property
    def normals(self) -> Array:
        """Unit normals of the flat sides between the corners, (s, 3)."""
        areas = self.vector_areas
        return np.asarray(areas / np.linalg.norm(areas, axis=1, keepdims=True))

    @property
    def vector_areas(self) -> Array:
        """Vector areas of the flat sides between the corners, (s, 3) [m²]."""
        p = self.positions
        if p.shape[1] == 3:
            return np.asarray(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]) / 2)
        return np.asarray(np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]) / 2)


def sides_of(solids: Solids) -> Sides:
    """List the sides of the cells once each.

    Parameters
    ----------
    solids : Solids
        Finished cells.

    Returns
    -------
    Sides
    """
    kind = solids.kind
    nodes = solids.cells[:, np.array(kind.sides)].reshape(-1, kind.side.nodes)
    number = side_numbers(nodes, kind.side.corners)
    _, first = np.unique(number, return_index=True)
    first = np.sort(first)
    sides = Sides(points=solids.points, kind=kind, nodes=nodes[first], outer=np.bincount(number)[number[first]] == 1)
    return _facing_alike(sides) if len(solids.overlapping) else sides


def _facing_alike(sides: Sides) -> Sides:
    """Turn boundary sides of folded cells so that they face like their neighbors on the surface."""
    outer = np.flatnonzero(sides.outer)
    count = len(outer)
    ends = sides.nodes[outer][:, np.array(sides.kind.side.edges)].reshape(-1, 2)
    owner, upward = np.repeat(np.arange(count), len(sides.kind.side.edges)), ends[:, 0] < ends[:, 1]
    edges = np.sort(ends, axis=1)
    _, place, shared = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
    order = np.argsort(np.asarray(place).ravel(), kind="stable")
    order = order[shared[np.asarray(place).ravel()[order]] == 2]
    first, second = order[0::2], order[1::2]
    other = np.where(upward[first] == upward[second], count, 0)  # neighbors run along their edge in opposite senses
    first, second = owner[first], owner[second]
    # every side stands here twice, as it is and turned over; what faces alike hangs together
    one, two = np.concatenate([first, first + count]), np.concatenate([second + other, second + count - other])
    label = groups_of(2 * count, one, two)
    area = np.linalg.norm(sides.vector_areas[outer], axis=1)
    weight = np.bincount(label[:count], weights=area, minlength=int(label.max()) + 1)
    turned = outer[weight[label[:count]] < weight[label[count:]]]
    nodes = sides.nodes.copy()
    nodes[turned] = nodes[turned][:, _TURNED[sides.nodes.shape[1]]]
    return replace(sides, nodes=nodes)


def find_sides(sides: Sides, corners: Ints) -> Ints:
    """Find sides by their corners in any order.

    Parameters
    ----------
    sides : Sides
    corners : (q, 3) or (q, 4) int array
        Requested corners. Those of another number of corners than the sides have give no row.

    Returns
    -------
    (q,) int array
        Row of each in ``sides.nodes``, -1 where there is none.
    """
    count = sides.kind.side.corners
    if corners.shape[1] != count or not len(corners):
        return np.full(len(corners), -1, dtype=np.int64)
    number = side_numbers(np.concatenate([sides.corners, corners]), count)
    place = np.full(number.max() + 1, -1, dtype=np.int64)
    place[number[: len(sides.nodes)]] = np.arange(len(sides.nodes))
    return np.asarray(place[number[len(sides.nodes) :]])


def components(sides: Sides, rows: Ints) -> list[Ints]:
    """Split sides into parts that hang together over edges.

    Parameters
    ----------
    sides : Sides
    rows : (f,) int array
        Rows of ``sides.nodes``.

    Returns
    -------
    list of int arrays
        Rows of each part, in the order of its first side.
    """
    if not len(rows):
        return []
    edges, owner = _edges(sides, rows)
    number = np.asarray(np.unique(edges, axis=0, return_inverse=True)[1]).ravel()
    label = groups_of(len(rows) + int(number.max()) + 1, owner, len(rows) + number)[: len(rows)]
    return [rows[label == part] for part in np.unique(label)]


def _edges(sides: Sides, rows: Ints) -> tuple[Ints, Ints]:
    """Edges of sides, ends sorted, and the place in ``rows`` that each belongs to."""
    pairs = np.array(sides.kind.side.edges)
    edges = np.sort(sides.nodes[rows][:, pairs], axis=2).reshape(-1, 2)
    return edges, np.repeat(np.arange(len(rows)), len(pairs))


def rim(sides: Sides, rows: Ints) -> Ints:
    """Edges (e, 2) that belong to one of the sides only, but for those around the pinhole of a revolved mesh."""
    edges, _ = _edges(sides, rows)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    return np.asarray(unique[(count == 1) & ~np.isin(unique, sides.on_axis).all(axis=1)])


def enclosed_volume(sides: Sides, rows: Ints, origin: Array) -> float:
    """Volume behind flat sides, seen from a point [m³]; negative where they enclose a cavity in the solid."""
    center = sides.positions[rows].mean(axis=1) - origin
    return float(np.einsum("fi,fi->", center, sides.vector_areas[rows]) / 3)


def is_cavity(sides: Sides, rows: Ints, mirrors: list[Ints]) -> bool:
    """Whether a part of the boundary closes a cavity: an inner surface, complete but for edges on mirror planes.

    Parameters
    ----------
    sides : Sides
    rows : (f,) int array
        The part.
    mirrors : list of int arrays
        Sides of each mirror plane.

    Returns
    -------
    bool
    """
    free = rim(sides, rows)
    for mirror in mirrors:
        free = free[~np.isin(free, sides.nodes[mirror]).all(axis=1)]
    return not len(free) and enclosed_volume(sides, rows, _common_point(sides, mirrors)) < 0


def _common_point(sides: Sides, mirrors: list[Ints]) -> Array:
    """A point on all mirror planes; seen from there the planes themselves enclose nothing."""
    if not mirrors:
        return np.asarray(sides.points.mean(axis=0))
    normals = np.stack([sides.vector_areas[mirror].sum(axis=0) for mirror in mirrors])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    on = np.stack([sides.positions[mirror].mean(axis=(0, 1)) for mirror in mirrors])
    return np.asarray(np.linalg.lstsq(normals, np.einsum("mi,mi->m", normals, on), rcond=None)[0])
