"""Short row: the mesh of a row of equal parts, such as the chambers of a PneuNet, without some of those in its middle.

Equal parts under equal loads take equal shapes, up to a motion that leads from each to the next; only the ends differ.
They are recognized by the cells alone: moved by one pitch along the row, the cells of one part are those of the next.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import Mesh
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class ShortRowSettings:
    """Settings of short rows.

    Parameters
    ----------
    parts : int
        Equal parts that stay besides the two ends: the one that is repeated, and its neighbors. What the ends do
        differently has faded there to 1e-6 m in a PneuNet of 1 mm walls; with one less on either side it is 1e-4 m,
        and the guide fails where walls meet.
    spared : int
        Parts that must be gone for a short row to be of use.
    most_cells : int
        Cells of a mesh in which equal parts are looked for.
    """

    parts: int = 3
    spared: int = 3
    most_cells: int = 50_000


SHORT_ROW = ShortRowSettings()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ShortRow:
    """A row without some of its equal parts.

    Parameters
    ----------
    mesh : Mesh
        Its regions and faces are those of the long row.
    cells : (c,) int array
        For each cell of the long row, that of the short row which stands for it.
    turns : (c,) int array
        How many times the motion from one part to the next leads from the one to the other.
    ends : (2, k) int array
        Nodes of the short row at the beginning of its middle part, and the same nodes one part farther.
    """

    mesh: Mesh
    cells: Ints
    turns: Ints
    ends: Ints

    @property
    def spared(self) -> int:
        """How many parts it does without."""
        return int(self.turns.max())


def short_row(mesh: Mesh) -> ShortRow | None:
    """Shorten a row of equal parts along its longest extent.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    ShortRow or None
        None where the mesh has not enough equal parts, or is revolved, a wedge, or has bonds.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.sweeping.section import Fineness
    >>> from turgor.core.meshing.sweeping.swept import swept_mesh
    >>> long = swept_mesh(FastPneuNet(chambers=9, length=90e-3).build(), Fineness(size=6e-3))
    >>> short = short_row(long)
    >>> short.spared, len(long.cells), len(short.mesh.cells)
    (4, 1231, 679)
    """
    few = 0 < len(mesh.cells) <= SHORT_ROW.most_cells
    if not few or mesh.revolved or mesh.wedge is not None or mesh.parted:
        return None
    row = _Row.of(mesh)
    return None if row is None or row.parts < SHORT_ROW.parts + SHORT_ROW.spared else _shortened(row)


@dataclass(frozen=True, slots=True, eq=False)
class _Row:
    """Equal parts of a mesh.

    Parameters
    ----------
    mesh : Mesh
    shift : (3,) array [m]
        From one part to the next.
    next : (c,) int array
        For each cell the one that is the same, one part farther; -1 where there is none.
    part : (c,) int array
        Number of the equal part of each cell; negative before the first, ``parts`` and more after the last.
    parts : int
    """

    mesh: Mesh
    shift: Array
    next: Ints
    part: Ints
    parts: int

    @staticmethod
    def of(mesh: Mesh) -> "_Row | None":
        """Find the equal parts along the longest extent; None where there are none."""
        from scipy.spatial import cKDTree  # here: a run whose walls cannot meet does not load it

        axis = int(np.argmax(np.ptp(mesh.points, axis=0)))
        centers = mesh.points[mesh.cells].mean(axis=1)
        at, tree = centers[:, axis], cKDTree(centers)
        middle, reach = 0.5 * (at.min() + at.max()), np.ptp(at) / 2 / (SHORT_ROW.parts + SHORT_ROW.spared)
        near = np.flatnonzero(np.abs(at - middle) <= reach)
        for shift in _shifts(mesh, centers, axis, near):
            if (_twins(mesh, tree, near, shift) >= 0).all():
                break
        else:
            return None
        pitch = shift[axis]
        following = _twins(mesh, tree, np.arange(len(at)), shift)
        alone = at[following < 0]
        begin = max(alone[alone < middle], default=at.min()) + ROUND_OFF.mesh_digits * pitch
        end = min(alone[alone > middle], default=at.max()) + pitch
        part = np.floor((at - begin) / pitch).astype(np.int64)
        return _Row(mesh, shift, following, part, int((end - begin) / pitch))


def _shifts(mesh: Mesh, centers: Array, axis: int, near: Ints) -> Array:
    """Shifts (k, 3) [m] along an axis from the first of some cells to those that may be the same, shortest first."""
    away = centers - centers[near[0]]
    slack = ROUND_OFF.mesh_digits * float(np.ptp(mesh.points, axis=0).max())
    off_axis = np.delete(away, axis, axis=1)
    beyond = away[(np.abs(off_axis) <= slack).all(axis=1) & (away[:, axis] > slack), axis]
    return np.sort(beyond)[:, None] * np.eye(3)[axis]


def _twins(mesh: Mesh, tree: Any, cells: Ints, shift: Array) -> Ints:
    """The cell that is the same as each of some, and of the same region, farther by a shift; -1 where there is none."""
    slack = ROUND_OFF.mesh_digits * float(np.ptp(mesh.points, axis=0).max())
    off, twins = tree.query(tree.data[cells] + shift, distance_upper_bound=2 * slack)
    twins = np.where(np.isfinite(off), twins, -1)
    moved = np.abs(mesh.points[mesh.cells[twins]] - mesh.points[mesh.cells[cells]] - shift).max(axis=(1, 2))
    region = np.zeros(len(mesh.cells), dtype=np.int64)
    for number, rows in enumerate(mesh.regions.values()):
        region[rows] = number
    return np.where((twins >= 0) & (moved <= slack) & (region[twins] == region[cells]), twins, -1)


def _shortened(row: _Row) -> ShortRow:
    """The ends, the first two parts and the last one, joined; the second part stands for all between."""
    mesh, part, spared = row.mesh, row.part, row.parts - SHORT_ROW.parts
    tail = part > 1 + spared
    stays = np.flatnonzero((part <= 1) | tail)
    stand_ins, turns, copies = np.arange(len(part)), np.where(tail, spared, 0), np.flatnonzero(part == 1)
    seconds = copies
    for turn in range(1, spared + 1):
        copies = row.next[copies]
        stand_ins[copies], turns[copies] = seconds, turn
    joined = np.arange(len(mesh.points))
    joined[mesh.cells[copies]] = mesh.cells[seconds]  # what the last part that goes shares with the tail
    cells = np.where(tail[:, None], joined[mesh.cells], mesh.cells)[stays]
    nodes = np.unique(cells)
    new = np.full(len(mesh.points), -1, dtype=np.int64)
    new[nodes] = np.arange(len(nodes))
    points, own = mesh.points.copy(), np.setdiff1d(mesh.cells[tail], mesh.cells[copies])
    points[own] -= spared * row.shift
    number = np.full(len(part), -1, dtype=np.int64)
    number[stays] = np.arange(len(stays))
    short = replace(
        mesh,
        name=f"{mesh.name}, shorter",
        points=points[nodes],
        cells=new[cells],
        regions={name: number[rows[number[rows] >= 0]] for name, rows in mesh.regions.items()},
        faces={name: new[_sides(row, sides, tail, joined)] for name, sides in mesh.faces.items()},
        findings=(),
    )
    return ShortRow(mesh=short, cells=number[stand_ins], turns=turns, ends=new[_ends(row, seconds)])


def _sides(row: _Row, sides: Ints, tail: NDArray[np.bool_], joined: Ints) -> Ints:
    """Sides of a face whose cells stay, with the nodes of the long row; those of the tail joined."""
    cells, head = row.mesh.cells, row.part <= 1
    in_head = np.isin(sides, cells[head]).all(axis=1)
    in_tail = np.isin(sides, cells[tail]).all(axis=1)
    return np.concatenate([sides[in_head], joined[sides[in_tail]]])


def _ends(row: _Row, seconds: Ints) -> Ints:
    """Nodes that the first and the second part share, and the same ones between the second and the third (2, k)."""
    cells = row.mesh.cells
    farther = np.full(len(row.mesh.points), -1, dtype=np.int64)
    firsts = np.flatnonzero((row.part == 0) & (row.next >= 0))
    farther[cells[firsts]] = cells[row.next[firsts]]
    shared = np.intersect1d(cells[firsts], cells[seconds])
    return np.stack([shared, farther[shared]])
