"""Meshes of planar sections: nine-node quadrilaterals that follow every outline of a sweep."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil, pi

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.extrusion import Layer
from turgor.core.geometry.shapes.arcs import edge_center, edge_radius
from turgor.core.geometry.shapes.sections import Outline, Point
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing.coinciding_points import same_places
from turgor.core.meshing.sizing.settings import SIZING

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Points are looked up a little aside, as a share of the size, so that none lies on a line between two corners.
OFF_LINES = np.array([6.18e-8, 7.55e-8])

#: Feature lines closer than this share of the size of the section are the same line.
SAME_LINE = TOLERANCE.round_off


@dataclass(frozen=True, slots=True, kw_only=True)
class Fineness:
    """How fine a swept mesh is.

    Parameters
    ----------
    size : float [m]
        Longest edge.
    wall_cells : int
        Cells between two neighboring feature lines at least: through a wall, for instance.
    curvature : float [-]
        Cells along an arc as long as its radius; with 2, a quadratic edge leaves its circle by 4e-5 of the radius.
    grading : float [-]
        How fast cells grow away from small ones where the section is no grid.
    edge : float or None [m]
        Length of the cells next to a feature line within, from which they grow to the size; None makes one cell of a
        third of the size there. Stresses have no bound along sharp edges; reference values need short cells there.
    lines : str
        Next to which feature lines within cells are short where no `edge` is stated: ``"all"``, ``"outer"`` for those
        along the path and the first and the last one in each direction of the section, which are the inner sides of
        outer walls, or ``"none"``.
    quarter_cells : int or None
        Cells around a quarter of a turn, even; None takes as many as size and curvature require.
    along : float or None [m]
        Longest edge along a straight path, if it is larger than the size: cells grow to it from a third of the size.
    corners : tuple of (2,) floats [m]
        Places in the section about which cells are as short as ``edge``.
    row : float
        Unknowns of chambers in a row beyond which middles follow and fewer cells are short, see `swept_mesh`.
    """

    size: float
    wall_cells: int = 1
    curvature: float = 2.0
    grading: float = 0.5
    edge: float | None = None
    lines: str = "all"
    quarter_cells: int | None = None
    along: float | None = None
    corners: tuple[Point, ...] = ()
    row: float = SIZING.row

    @property
    def of_path(self) -> "Fineness":
        """How fine cells are along a straight path."""
        if self.along is None or self.along <= self.size:
            return self if self.lines == "none" else replace(self, lines="all")
        return replace(self, size=self.along, edge=self.edge or SIZING.short * self.size)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SectionMesh:
    """Nine-node quadrilaterals in a plane.

    Parameters
    ----------
    points : (n, 2) array [m]
        Positions of the nodes; of (x, r) where the section is turned.
    quads : (q, 9) int array
        Nodes in the order of `turgor.core.meshing.cells.QUADRILATERAL`, counterclockwise.
    """

    points: Array
    quads: Ints

    @property
    def centers(self) -> Array:
        """Middle node of each quadrilateral, (q, 2)."""
        return self.points[self.quads[:, 8]]


def joined(meshes: Sequence[SectionMesh]) -> SectionMesh:
    """Join meshes that share nodes along their rims, found from where these are."""
    points = np.concatenate([mesh.points for mesh in meshes])
    starts = np.cumsum([0, *(len(mesh.points) for mesh in meshes)])
    number, first = same_places(points)
    quads = np.concatenate([mesh.quads + start for mesh, start in zip(meshes, starts, strict=False)])
    return SectionMesh(points=points[first], quads=number[quads])


def circle_of(start: Point, end: Point, arc: float) -> tuple[Point, float]:
    """Center and radius of the arc that turns by an angle on its way from start to end.

    Examples
    --------
    >>> from math import pi
    >>> (x, y), radius = circle_of((1.0, 0.0), (-1.0, 0.0), pi)
    >>> round(abs(x) + abs(y), 12), radius
    (0.0, 1.0)
    """
    return edge_center(start, end, arc), edge_radius(start, end, arc)


def inside(outline: Outline, points: Array) -> NDArray[np.bool_]:
    """Which points lie within an outline, (p,): within its polygon, corrected by the segments beyond its arcs.

    Parameters
    ----------
    outline : Outline
    points : (p, 2) array [m]
        None of them on the outline.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.sections import disc
    >>> inside(disc(1.0), np.array([[0.9, 0.0], [1.1, 0.0], [0.0, 0.9]])).tolist()
    [True, False, True]
    """
    x, y = points.T + OFF_LINES[:, None] * float(np.ptp(np.array(outline.corners), axis=0).max())
    inside = np.zeros(len(points), dtype=bool)
    for a, b, arc in outline.edges:
        crosses = (a[1] > y) != (b[1] > y)
        rise = b[1] - a[1] if a[1] != b[1] else 1.0
        inside ^= crosses & (x < a[0] + (y - a[1]) / rise * (b[0] - a[0]))
        if arc:
            center, radius = circle_of(a, b, arc)
            beyond = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
            inside ^= (np.hypot(x - center[0], y - center[1]) < radius) & (beyond * arc < 0)
    return inside


def names_at(layers: Sequence[Layer], points: Array) -> NDArray[np.object_]:
    """Name of what fills each layer at each point, (layers, p); None where there is air."""
    names = np.full((len(layers), len(points)), None, dtype=object)
    known: dict[Outline, NDArray[np.bool_]] = {}
    for row, layer in zip(names, layers, strict=True):
        for name, outline in layer.fill:
            if outline not in known:
                known[outline] = inside(outline, points)
            row[known[outline]] = name
    return names


def is_solid(name: object) -> bool:
    """Whether a name is that of a region: neither air nor the name of the walls of a hollow."""
    return isinstance(name, str) and name != "outside" and not name.startswith("cavity")


def feature_lines(values: Array, scale: float) -> Array:
    """Distinct values in order; those closer than rounding are one."""
    values = np.sort(values)
    return values[np.diff(values, prepend=-np.inf) > SAME_LINE * scale]


def divided(lines: Array, fine: Fineness) -> Array:
    """Cut the intervals between feature lines into cells, and put a node in the middle of each.

    Next to a feature line within, cells are a third of the size long: that is where walls meet and bend most.

    Parameters
    ----------
    lines : (k,) array [m]
        Feature lines, in order.
    fine : Fineness

    Examples
    --------
    >>> divided(np.array([0.0, 1.0, 5.0]), Fineness(size=3.0)).tolist()
    [0.0, 0.5, 1.0, 1.5, 2.0, 3.5, 5.0]
    """
    last = len(lines) - 2
    starts, ends = _refined(last, "all" if fine.edge else fine.lines)
    pieces = [_ticks(lines[i], lines[i + 1], (i in starts, i in ends), fine)[1:] for i in range(last + 1)]
    ticks = np.concatenate([lines[:1], *pieces]).astype(np.float64)
    nodes = np.empty(2 * len(ticks) - 1)
    nodes[::2], nodes[1::2] = ticks, (ticks[1:] + ticks[:-1]) / 2
    return nodes


def _refined(last: int, lines: str) -> tuple[Sequence[int], Sequence[int]]:
    """Which intervals between feature lines have short cells at their start and at their end."""
    if lines == "all":
        return range(1, last + 1), range(last)
    return ([1], [last - 1]) if lines == "outer" else ([], [])


def _ticks(start: float, end: float, refined: tuple[bool, bool], fine: Fineness) -> Array:
    """Ends of the cells of an interval, with short cells next to its start and its end if more is left between them."""
    count = max(fine.wall_cells, ceil((end - start) / fine.size - 1e-6))
    short = _short_cells((end - start) / max(sum(refined), 1), sum(refined), fine) if any(refined) else []
    if not short:
        return np.linspace(start, end, count + 1)
    taken = np.cumsum([0.0, *short])
    inner = [start + taken[-1] * refined[0], end - taken[-1] * refined[1]]
    longest = fine.size if fine.edge is None else min(fine.size, SIZING.growth * short[-1])
    count = max(1, fine.wall_cells - sum(refined) * len(short), ceil((inner[1] - inner[0]) / longest - 1e-6))
    ticks = np.linspace(inner[0], inner[1], count + 1)
    first, last = (start + taken[:-1])[: len(short) * refined[0]], (end - taken[-2::-1])[: len(short) * refined[1]]
    return np.concatenate([first, ticks, last])


def _short_cells(room: float, lines: int, fine: Fineness) -> list[float]:
    """Lengths of the short cells next to a feature line, of which there are one or two with so much room each."""
    short = SIZING.short * fine.size
    if fine.edge is None:
        return [short] if room * lines > (1 + lines) * short * (1 + 1e-6) else []
    lengths: list[float] = []
    short = fine.edge
    while short < fine.size and sum(lengths) + short * (1 + 1 / lines) <= room * (1 + 1e-6):
        lengths.append(short)
        short *= SIZING.growth
    return lengths


def divided_turn(lines: Array, radius: float, fine: Fineness, multiple: int = 1) -> Array:
    """Cut the angles between feature lines into cells whose quadratic edges follow a circle well.

    Parameters
    ----------
    lines : (k,) array [rad]
        Feature lines, in order.
    radius : float [m]
        Largest radius, where cells are as long as the size.
    fine : Fineness
    multiple : int
        The number of cells in each interval is a multiple of this.
    """
    if fine.quarter_cells is not None:
        return _cut(lines, [round(gap / (pi / 2) * fine.quarter_cells) for gap in np.diff(lines)])
    counts = [max(gap * fine.curvature, gap * radius / fine.size) for gap in np.diff(lines)]
    return _cut(lines, [multiple * ceil(count / multiple - 1e-6) for count in counts])


def _cut(lines: Array, counts: Sequence[int]) -> Array:
    pieces = [np.linspace(lines[i], lines[i + 1], 2 * count + 1)[1:] for i, count in enumerate(counts)]
    return np.concatenate([lines[:1], *pieces])


def lattice_quads(rows: int, columns: int, *, wrap: bool = False) -> Ints:
    """Quadrilaterals of a lattice of nodes numbered row by row, (q, 9).

    Parameters
    ----------
    rows, columns : int
        Number of nodes, odd; the first coordinate counts rows, the second columns.
    wrap : bool
        Whether the last column is the first one again; then ``columns`` is even.

    Examples
    --------
    >>> lattice_quads(3, 3).tolist()
    [[0, 6, 8, 2, 3, 7, 5, 1, 4]]
    """
    i, j = np.meshgrid(np.arange(0, rows - 1, 2), np.arange(0, columns - (not wrap), 2), indexing="ij")
    steps = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1))
    nodes = [(i + a) * columns + (j + b) % columns for a, b in steps]
    return np.stack([n.ravel() for n in nodes], axis=1).astype(np.int64)
