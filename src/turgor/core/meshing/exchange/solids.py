"""Turn the solid cells of a file into the cells of a `Mesh`: one kind, quadratic, repaired, with positive volume."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON, CellType
from turgor.core.meshing.exchange.formats.raw import Array, Ints, RawMesh
from turgor.core.meshing.exchange.frame import Frame
from turgor.core.meshing.exchange.settings import MESH_FILE
from turgor.foundation.errors import TurgorError

#: The same cell seen in a mirror.
_MIRRORED = {
    10: (0, 2, 1, 3, 6, 5, 4, 7, 9, 8),
    27: (4, 5, 6, 7, 0, 1, 2, 3, *range(12, 16), *range(8, 12), *range(16, 24), 25, 24, 26),
}

#: Each corner with the three that an edge joins it to, right-handed.
_TETRAHEDRON_FRAMES = ((0, 1, 2, 3),)
_HEXAHEDRON_FRAMES = (
    *((0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7)),
    *((4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2), (7, 6, 4, 3)),
)


@dataclass(slots=True, kw_only=True, eq=False)
class Solids:
    """Cells of a file before they become a mesh.

    Parameters
    ----------
    points : (n, 3) array [m]
    cells : (c, m) int array
    groups : dict of str to (g,) int array
        Cells of each group of the file.
    renumbered : (N,) int array
        Row of ``points`` of each node of the file, -1 for removed nodes.
    done : list of str
        What was repaired, one clause each.
    overlapping : int array
        Cells that overlap their neighbors, although none is inverted.
    """

    points: Array
    cells: Ints
    groups: dict[str, Ints]
    renumbered: Ints
    done: list[str] = field(default_factory=list)
    overlapping: Ints = field(default_factory=lambda: np.zeros(0, dtype=np.int64))

    @property
    def kind(self) -> CellType:
        """Kind of the finished cells."""
        return TETRAHEDRON if self.cells.shape[1] in (4, 10) else HEXAHEDRON


def read_solids(raw: RawMesh, frame: Frame, merge: bool = True) -> Solids:
    """Take the solid cells of a file and make them cells that can be solved on.

    Parameters
    ----------
    raw : RawMesh
    frame : Frame
        Unit and axes of the file.
    merge : bool
        Whether nodes at the same place become one.

    Returns
    -------
    Solids

    Raises
    ------
    TurgorError
        If there are none, or cells are turned inside out.
    """
    solids = _gathered(raw, frame)
    _merge_nodes(solids, raw, merge)
    _drop_repeated(solids)  # with merged nodes, so that cells at one place are known as such
    _raise_order(solids)
    _turn(solids, raw)
    _number_vertices_first(solids, raw)
    return solids


def _gathered(raw: RawMesh, frame: Frame) -> Solids:
    blocks = raw.solids()
    if not blocks:
        other = ", ".join(f"{len(block.nodes)} {block.kind.name}" for block in raw.blocks)
        plane = ", or read a plane mesh as plane strain or axisymmetric" if other else ""
        what = f"no solid cells, only {other}" if other else "no cells"
        raise TurgorError(f"'{raw.path}' has {what}; export the volume mesh{plane}.")
    cells = np.concatenate([block.nodes for block in blocks])
    groups: dict[str, list[Ints]] = {}
    start = 0
    for block in blocks:
        for name, rows in block.groups.items():
            groups.setdefault(name, []).append(rows + start)
        start += len(block.nodes)
    if not np.isfinite(raw.points[cells]).all():
        raise TurgorError(f"'{raw.path}': a node of a cell has no finite position.")
    return Solids(
        points=frame.meters(raw.points),
        cells=cells,
        groups={name: np.concatenate(rows) for name, rows in groups.items()},
        renumbered=np.arange(len(raw.points)),
    )


def _drop_repeated(solids: Solids) -> None:
    """Keep one of cells with the same corners, such as those that gmsh 2.2 writes for each of their groups."""
    corners = np.sort(solids.cells[:, : solids.kind.corners], axis=1)
    same = np.unique(corners, axis=0, return_index=True, return_inverse=True)
    first, place = same[1], np.asarray(same[2]).ravel()
    if len(first) == len(solids.cells):
        return
    solids.done.append(f"{len(solids.cells) - len(first)} cells written twice were taken once")
    order = np.sort(first)
    number = np.empty(len(first), dtype=np.int64)
    number[np.argsort(first)] = np.arange(len(first))
    solids.groups = {name: np.unique(number[place[rows]]) for name, rows in solids.groups.items()}
    solids.cells = solids.cells[order]


def _merge_nodes(solids: Solids, raw: RawMesh, merge: bool) -> None:
    """Make nodes at the same place one where that is requested, and leave out those of no solid cell."""
    from scipy.spatial import cKDTree  # slow to load, and every job loads this file

    kind = solids.kind
    corners = solids.points[solids.cells[:, : kind.corners]]
    edges = np.stack([corners[:, b] - corners[:, a] for a, b in kind.edges], axis=1)
    length = np.linalg.norm(edges, axis=2)
    if not length.min() > 0:
        at = place_of(corners[length.min(axis=1) <= 0][0])
        raise TurgorError(f"'{raw.path}': a cell around {at} has two corners at one place.")
    used = np.unique(solids.cells)
    same = MESH_FILE.same_node * float(length.min())
    pairs = cKDTree(solids.points[used]).query_pairs(same, output_type="ndarray").tolist() if merge else []
    number = np.arange(len(solids.points))
    for a, b in sorted(map(tuple, pairs)):
        number[used[b]] = number[used[a]]
    unique = np.unique(number[used])
    if len(unique) < len(used):
        solids.done.append(f"{len(used) - len(unique)} nodes at the place of another one were merged with it")
    new = np.full(len(solids.points), -1, dtype=np.int64)
    new[unique] = np.arange(len(unique))
    free = len(solids.points) - len(used)
    if free:
        solids.done.append(f"{free} nodes that belong to no solid cell were left out")
    solids.renumbered = np.where(np.isin(number, unique), new[number], -1)
    solids.cells, solids.points = new[number[solids.cells]], solids.points[unique]


def _raise_order(solids: Solids) -> None:
    """Add the nodes that quadratic cells need; mid-side nodes of first-order cells lie on straight edges."""
    kind, width = solids.kind, solids.cells.shape[1]
    if width == kind.corners:
        ends = solids.cells[:, np.array(kind.edges)]
        solids.points, mids = _with_middles(solids.points, ends, np.full(2, 0.5), 2)
        solids.cells = np.hstack([solids.cells, mids])
        solids.done.append(f"{len(ends)} cells of first order were given mid-side nodes on their straight edges")
    if kind is HEXAHEDRON and solids.cells.shape[1] == 20:
        # where the eight- and twelve-node interpolation of a 20-node cell puts the middles: its shape is unchanged
        sides = solids.cells[:, np.array([side[:8] for side in kind.sides])]
        solids.points, middles = _with_middles(solids.points, sides, np.repeat([-0.25, 0.5], 4), 4)
        weights = np.repeat([-0.25, 0.25], [8, 12])
        centers = np.einsum("cni,n->ci", solids.points[solids.cells], weights)
        number = len(solids.points) + np.arange(len(centers))[:, None]
        solids.points = np.vstack([solids.points, centers])
        solids.cells = np.hstack([solids.cells, middles, number])


def _with_middles(points: Array, parts: Ints, weights: Array, corners: int) -> tuple[Array, Ints]:
    """Add one node for each part (an edge or a side) of the cells, shared by cells that share the part."""
    flat = parts.reshape(-1, parts.shape[2])
    keys = np.sort(flat[:, :corners], axis=1)
    _, first, place = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    middles = np.einsum("pni,n->pi", points[flat[first]], weights)
    return np.vstack([points, middles]), len(points) + np.asarray(place).reshape(parts.shape[:2])


def side_numbers(sides: Ints, corners: int) -> Ints:
    """Number the sides (s, m) so that those with the same corners get the same number."""
    return np.asarray(np.unique(np.sort(sides[:, :corners], axis=1), axis=0, return_inverse=True)[1]).ravel()


def _turn(solids: Solids, raw: RawMesh) -> None:
    """Turn cells that are written in mirrored order; refuse cells that are inverted relative to their neighbors."""
    low, high = _corner_jacobians(solids)
    mirrored, mixed = high < 0, (low <= 0) & (high >= 0)
    if mixed.any():
        raise TurgorError(
            f"'{raw.path}': {int(mixed.sum())} of {len(mixed)} cells are flat or partly turned inside out, around "
            f"{_places(solids, np.flatnonzero(mixed))}; repair the mesh where it was made."
        )
    if mirrored.any():
        solids.cells = np.where(mirrored[:, None], solids.cells[:, _MIRRORED[solids.kind.nodes]], solids.cells)
        solids.done.append(f"{int(mirrored.sum())} cells written in mirrored order were turned")
    _check_overlaps(solids, raw, mirrored)


def _corner_jacobians(solids: Solids) -> tuple[Array, Array]:
    """Smallest and largest of six times the volume between the three edges at each corner, of straight cells."""
    frames = _TETRAHEDRON_FRAMES if solids.kind is TETRAHEDRON else _HEXAHEDRON_FRAMES
    values = []
    for origin, *ends in frames:
        a, b, c = (solids.points[solids.cells[:, end]] - solids.points[solids.cells[:, origin]] for end in ends)
        values.append(np.einsum("ci,ci->c", a, np.cross(b, c)))
    return np.min(values, axis=0), np.max(values, axis=0)


def _check_overlaps(solids: Solids, raw: RawMesh, turned: NDArray[np.bool_]) -> None:
    """Look for cells that lie on the same side of a shared side as their neighbor; refuse them if they were turned."""
    kind = solids.kind
    sides = solids.cells[:, np.array(kind.sides)].reshape(-1, kind.side.nodes)
    number = side_numbers(sides, kind.side.corners)
    owner = np.repeat(np.arange(len(solids.cells)), len(kind.sides))
    count = np.bincount(number)
    if (count > 2).any():
        bad = np.unique(owner[count[number] > 2])
        raise TurgorError(
            f"'{raw.path}': {len(bad)} cells share a side with two others, around {_places(solids, bad)}; "
            "remove the cells that lie on others."
        )
    total = np.bincount(number, weights=_sense(sides[:, : kind.side.corners]))
    wrong = (count[number] == 2) & (np.abs(total[number]) > 1)
    bad = np.unique(owner[wrong & turned[owner]])
    if len(bad):
        raise TurgorError(
            f"'{raw.path}': {len(bad)} of {len(turned)} cells have a negative volume and are not just written "
            f"mirrored, they overlap their neighbors, around {_places(solids, bad)}; repair the mesh where it was made."
        )
    solids.overlapping = np.unique(owner[wrong])


def _sense(corners: Ints) -> Array:
    """+1 or -1 for each side: which way its corners run around, counted from the smallest to its smaller neighbor."""
    count = corners.shape[1]
    first = corners.argmin(axis=1)
    row = np.arange(len(corners))
    after, before = corners[row, (first + 1) % count], corners[row, (first - 1) % count]
    return np.where(after < before, 1.0, -1.0)


def _places(solids: Solids, cells: Ints) -> str:
    centers = solids.points[solids.cells[cells][:, : solids.kind.corners]].mean(axis=1)
    return ", ".join(place_of(center) for center in centers[:3])


def place_of(position: Array) -> str:
    """Write the middle of some positions [m] in millimeters."""
    x, y, z = np.reshape(position, (-1, 3)).mean(axis=0) * 1e3
    return f"({x:.4g}, {y:.4g}, {z:.4g}) mm"


def _number_vertices_first(solids: Solids, raw: RawMesh) -> None:
    corners = solids.kind.corners
    ends, middles = np.unique(solids.cells[:, :corners]), np.unique(solids.cells[:, corners:])
    both = np.intersect1d(ends, middles)
    if len(both):
        raise TurgorError(
            f"'{raw.path}': {len(both)} nodes are a corner of one cell and lie in the middle of an edge or side of "
            f"another, around {', '.join(place_of(solids.points[node]) for node in both[:3])}; the cells do not fit "
            "each other there: mesh the part where it was made so that neighbors share whole sides."
        )
    order = np.concatenate([ends, middles])
    number = np.full(len(solids.points), -1, dtype=np.int64)
    number[order] = np.arange(len(order))
    solids.cells, solids.points = number[solids.cells], solids.points[order]
    renumbered = np.append(number, -1)  # the last place stands for nodes that were removed already
    solids.renumbered = renumbered[solids.renumbered]
