"""Splitting: cut wedges, pyramids, collapsed hexahedra and cells of several kinds into tetrahedra that fit each other.

Each cell becomes a fan of tetrahedra: its corner of lowest rank is joined to the sides that do not have this corner. A
side of four corners is cut from its corner of lowest rank, too. Neighbors then cut the side that they share alike,
because ranks follow the places of nodes alone (Dompierre, Labbé, Vallet and Camarero 1999, "How to subdivide pyramids,
prisms and hexahedra into tetrahedra"). Corners at one place have one rank, so a collapsed cell loses its flat
tetrahedra.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from turgor.core.meshing.exchange.formats.raw import KINDS, Array, Block, Ints, RawMesh
from turgor.foundation.round_off import ROUND_OFF

Corners = tuple[int, ...]

#: Sides of each shape, counterclockwise seen from outside, and its edges in the order of its mid-side nodes.
SIDES: Mapping[str, tuple[Corners, ...]] = {
    "tetrahedron": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)),
    "pyramid": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    "wedge": ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    "hexahedron": ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
}
EDGES: Mapping[str, tuple[tuple[int, int], ...]] = {
    "tetrahedron": ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
    "pyramid": ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)),
    "wedge": ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    "hexahedron": (
        *((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)),
        *((0, 4), (1, 5), (2, 6), (3, 7)),
    ),
}


@dataclass(slots=True, eq=False)
class _Middles:
    """Mid-side nodes of the tetrahedra by the numbers of the ends of their edges; the first one for an edge stays."""

    numbers: Ints
    keys: list[Ints]
    nodes: list[Ints]
    places: list[Array]

    def add(self, ends: Ints, places: Array, nodes: Ints | None = None) -> None:
        """Add the places (k, 3) of middles of edges with ends (k, 2), and their nodes where the file has them."""
        self.keys.append(self.keys_of(ends))
        self.places.append(places)
        self.nodes.append(np.full(len(ends), -1) if nodes is None else nodes)

    def keys_of(self, ends: Ints) -> Ints:
        """A number for each edge with ends (k, 2), whatever its direction."""
        low, high = np.sort(self.numbers[ends], axis=1).T
        return np.asarray((low << 31) + high)


def needs_tetrahedra(raw: RawMesh) -> bool:
    """Whether the solid cells are of kinds that cannot be solved on, of several, or collapsed."""
    kinds = {block.kind for block in raw.solids()}
    if len(kinds) != 1 or not next(iter(kinds)).name.startswith(("tetrahedron", "hexahedron")):
        return bool(kinds)
    (kind,) = kinds
    if not kind.name.startswith("hexahedron"):
        return False
    corners = np.sort(np.concatenate([_ranks(raw)[block.nodes[:, :8]] for block in raw.solids()]), axis=1)
    return bool((corners[:, 1:] == corners[:, :-1]).any())


def as_tetrahedra(raw: RawMesh, merge: bool = True) -> tuple[RawMesh, str]:
    """Cut all solid cells of a file into tetrahedra, and its sides of four corners into triangles.

    Parameters
    ----------
    raw : RawMesh
    merge : bool
        Whether edges at the same place have one middle.

    Returns
    -------
    RawMesh
        The same content with one block of solid cells.
    str
        What was done, one clause.
    """
    ranks, solids = _ranks(raw), raw.solids()
    middles = _Middles(ranks if merge else np.arange(len(raw.points)), [], [], [])
    parts, groups, start = [], dict[str, list[Ints]](), 0
    for block in solids:
        tetrahedra, owner = _fans(block, ranks)
        for name, rows in block.groups.items():
            groups.setdefault(name, []).append(start + np.flatnonzero(np.isin(owner, rows)))
        parts.append(tetrahedra)
        start += len(tetrahedra)
        _add_middles(middles, block, raw.points)
    cells, curved = np.concatenate(parts), any(block.kind.nodes > block.kind.corners for block in solids)
    points = raw.points
    if curved:
        cells, points = _with_middles(cells, points, middles)
    cut = Block(
        kind=KINDS["tetrahedron10" if curved else "tetrahedron4"],
        nodes=cells,
        groups={name: np.concatenate(rows) for name, rows in groups.items()},
    )
    flat = tuple(_triangles(block, ranks) for block in raw.blocks if block.kind.dimension < 3)
    surfaces = {name: _cut_surface(corners, ranks) for name, corners in raw.surfaces.items()}
    what = ", ".join(f"{len(block.nodes)} {block.kind.name}" for block in solids)
    return (
        replace(raw, points=points, blocks=(cut, *flat), surfaces=surfaces, node_numbers=_numbers(raw, len(points))),
        f"cells of kinds that are not solved on together ({what}) were cut into {len(cells)} tetrahedra",
    )


def _ranks(raw: RawMesh) -> Ints:
    """Order of the places of nodes; nodes at one place have the same."""
    extent = float(np.ptp(raw.points, axis=0).max()) or 1.0
    places = np.rint((raw.points - raw.points.min(axis=0)) / (ROUND_OFF.mesh_digits * extent))
    return np.asarray(np.unique(places, axis=0, return_inverse=True)[1], dtype=np.int64).ravel()


def _shape(block: Block) -> str:
    return block.kind.name.rstrip("0123456789")


def _fans(block: Block, ranks: Ints) -> tuple[Ints, Ints]:
    """Tetrahedra (t, 4) of a block, and the cell of each (t,)."""
    corners = block.nodes[:, : block.kind.corners]
    lowest = ranks[corners].argmin(axis=1)
    parts, owners = [], []
    for first in range(block.kind.corners):
        cells = np.flatnonzero(lowest == first)
        for side in SIDES[_shape(block)]:
            if first in side:
                continue
            for triangle in _cut(corners[cells][:, list(side)], ranks):
                parts.append(np.column_stack([triangle[:, [0, 2, 1]], corners[cells, first]]))
                owners.append(cells)
    tetrahedra, owner = np.concatenate(parts), np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    tetrahedra, owner = tetrahedra[order], owner[order]
    sorted_ranks = np.sort(ranks[tetrahedra], axis=1)
    whole = (sorted_ranks[:, 1:] != sorted_ranks[:, :-1]).all(axis=1)
    return tetrahedra[whole], owner[whole]


def _cut(sides: Ints, ranks: Ints) -> Sequence[Ints]:
    """Triangles (s, 3) of sides with three corners, or both of sides with four, cut from the corner of lowest rank."""
    if sides.shape[1] == 3:
        return (sides,)
    odd = (ranks[sides].argmin(axis=1) % 2)[:, None] == 1
    return (
        np.where(odd, sides[:, (1, 2, 3)], sides[:, (0, 1, 2)]),
        np.where(odd, sides[:, (1, 3, 0)], sides[:, (0, 2, 3)]),
    )


def _add_middles(middles: _Middles, block: Block, points: Array) -> None:
    """Add the mid-side nodes of a block of second order, and the middles of its sides and cells for new edges."""
    if block.kind.nodes == block.kind.corners:
        return
    edges, count = EDGES[_shape(block)], block.kind.corners
    ends = block.nodes[:, :count]
    at = points[block.nodes]
    of_edge = {frozenset(edge): count + k for k, edge in enumerate(edges)}
    for edge, node in of_edge.items():
        middles.add(ends[:, sorted(edge)], at[:, node], block.nodes[:, node])
    for side in (side for side in SIDES[_shape(block)] if len(side) == 4):
        around = [of_edge[frozenset((side[k], side[k - 1]))] for k in range(4)]
        center = 0.5 * at[:, around].sum(axis=1) - 0.25 * at[:, list(side)].sum(axis=1)
        for diagonal in (side[0::2], side[1::2]):
            middles.add(ends[:, list(diagonal)], center)
    if count == 8:
        center = 0.25 * (at[:, 8:20].sum(axis=1) - at[:, :8].sum(axis=1))
        for diagonal in ((0, 6), (1, 7), (2, 4), (3, 5)):
            middles.add(ends[:, list(diagonal)], center)


def _with_middles(cells: Ints, points: Array, middles: _Middles) -> tuple[Ints, Array]:
    """Tetrahedra of ten nodes: the middles that are known, others half way between the ends."""
    pairs = cells[:, np.array(EDGES["tetrahedron"])]
    keys, first, place = np.unique(middles.keys_of(pairs.reshape(-1, 2)), return_index=True, return_inverse=True)
    places = points[pairs.reshape(-1, 2)[first]].mean(axis=1)
    nodes = np.full(len(keys), -1)
    known, there = np.unique(np.concatenate(middles.keys), return_index=True)
    at = np.minimum(np.searchsorted(known, keys), len(known) - 1)
    match = known[at] == keys
    nodes[match] = np.concatenate(middles.nodes)[there[at[match]]]
    places[match] = np.concatenate(middles.places)[there[at[match]]]
    new = nodes < 0
    nodes[new] = len(points) + np.arange(new.sum())
    return np.hstack([cells, nodes[place].reshape(pairs.shape[:2])]), np.vstack([points, places[new]])


def _triangles(block: Block, ranks: Ints) -> Block:
    """A block of quadrilaterals as triangles; other blocks as they are."""
    if block.kind.corners != 4:
        return block
    both = np.stack(_cut(block.nodes[:, :4], ranks), axis=1).reshape(-1, 3)
    groups = {name: np.concatenate([2 * rows, 2 * rows + 1]) for name, rows in block.groups.items()}
    return Block(kind=KINDS["triangle3"], nodes=both, groups=groups)


def _cut_surface(corners: Ints, ranks: Ints) -> Ints:
    """Sides (s, 4) of a surface with those of four corners cut; -1 in the last place of triangles."""
    triangles = corners[corners[:, 3] < 0, :3]
    cut = np.concatenate([triangles, *_cut(corners[corners[:, 3] >= 0], ranks)])
    return np.column_stack([cut, np.full(len(cut), -1)])


def _numbers(raw: RawMesh, count: int) -> Ints | None:
    """Numbers of the nodes in the file, and further ones for nodes that it lacks."""
    if raw.node_numbers is None:
        return None
    return np.concatenate([raw.node_numbers, raw.node_numbers.max() + 1 + np.arange(count - len(raw.points))])
