"""Selectors by the numbers of nodes, as research meshes name their faces in lists next to the mesh."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from turgor.core.meshing.exchange.boundary import Sides, find_sides
from turgor.core.meshing.exchange.formats.raw import Ints, RawMesh
from turgor.core.meshing.exchange.solids import Solids
from turgor.foundation.errors import TurgorError

#: How many numbers that no node has an error lists.
LISTED = 3


@dataclass(frozen=True, slots=True)
class ByNodes:
    """Selector of the sides whose corners are all among some nodes.

    Parameters
    ----------
    nodes : sequence of int, str or Path
        Numbers of the nodes as the file of the mesh has them; VTK files have none, and count from 0. Or a text file
        of such numbers, in lines or columns; what follows a ``#`` is a remark.

    Examples
    --------
    >>> ByNodes([4, 7, 9]).nodes
    (4, 7, 9)
    """

    nodes: Sequence[int] | str | Path

    def __post_init__(self) -> None:
        rows = read_numbers(self.nodes) if isinstance(self.nodes, str | Path) else [self.nodes]
        object.__setattr__(self, "nodes", tuple(_whole("nodes", number) for row in rows for number in row))

    @property
    def listed(self) -> tuple[int, ...]:
        """Numbers of the nodes."""
        return self.nodes  # type: ignore[return-value]

    @property
    def numbers(self) -> Ints:
        """Numbers of all nodes that are named."""
        return np.unique(np.array(self.listed, dtype=np.int64))


@dataclass(frozen=True, slots=True)
class BySides:
    """Selector of sides by their corners.

    Parameters
    ----------
    sides : sequence of sequences of int, str or Path
        Numbers of the corners of each side in any order, as for `ByNodes`; mid-side nodes after them are passed over.
        Or a text file with a line for each side.

    Examples
    --------
    >>> BySides([[4, 7, 9], [7, 9, 12]]).sides
    ((4, 7, 9), (7, 9, 12))
    """

    sides: Sequence[Sequence[int]] | str | Path

    def __post_init__(self) -> None:
        rows = read_numbers(self.sides) if isinstance(self.sides, str | Path) else self.sides
        sides = tuple(tuple(_whole("sides", number) for number in row) for row in rows)
        short = next((row for row in sides if len(row) < 3), None)
        if short is not None:
            raise TurgorError(f"sides have the row {list(short)}; every side needs three or four corners.")
        object.__setattr__(self, "sides", sides)

    @property
    def numbers(self) -> Ints:
        """Numbers of all nodes that are named."""
        return np.unique([int(number) for row in self.rows for number in row])

    @property
    def rows(self) -> tuple[tuple[int, ...], ...]:
        """Numbers of the corners of each side."""
        return self.sides  # type: ignore[return-value]


def read_numbers(file: str | Path) -> list[list[int]]:
    """Read the whole numbers of a text file, line by line; lines without any are left out.

    Parameters
    ----------
    file : str or Path

    Returns
    -------
    list of lists of int

    Raises
    ------
    TurgorError
        If there is no such file, or a word of it is no whole number.
    """
    path = Path(file)
    if not path.is_file():
        raise TurgorError(f"there is no file '{path}' with numbers of nodes.")
    rows = []
    for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
        words = [word for word in re.split(r"[\s,;\[\]()]+", line.split("#")[0]) if word]
        wrong = next((word for word in words if not re.fullmatch(r"\d+", word)), None)
        if wrong is not None:
            raise TurgorError(f"'{path}', line {number}: '{wrong[:20]}' is no number of a node; allowed are 0, 1, 2, …")
        rows += [[int(word) for word in words]] if words else []
    return rows


def _whole(what: str, value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < 0:
        raise TurgorError(f"{what} have {value!r}; allowed are numbers of nodes, 0, 1, 2, …")
    return int(value)


def numbered_sides(
    selectors: Iterable[ByNodes | BySides], raw: RawMesh, solids: Solids, sides: Sides, rows: Ints
) -> Ints:
    """Find the sides that all selectors by number pick.

    Parameters
    ----------
    selectors : iterable of ByNodes or BySides
    raw : RawMesh
    solids : Solids
    sides : Sides
    rows : (f,) int array
        Rows of ``sides.nodes`` to choose from.

    Returns
    -------
    int array
        Some of ``rows``.

    Raises
    ------
    TurgorError
        If no node of the file has one of the numbers.
    """
    renumbered = np.append(solids.renumbered, -1)
    for each in selectors:
        known = np.arange(len(raw.points)) if raw.node_numbers is None else raw.node_numbers
        strange = np.setdiff1d(each.numbers, known)
        if len(strange):
            listed = ", ".join(map(str, strange[:LISTED]))
            raise TurgorError(
                f"'{raw.path}' has no node {listed}; its nodes are numbered {int(known.min())} to {int(known.max())}."
            )
        order = np.argsort(known, kind="stable")
        if isinstance(each, ByNodes):
            members = renumbered[np.flatnonzero(np.isin(known, each.numbers))]  # several of a section that was moved
            rows = rows[np.isin(sides.corners[rows], members[members >= 0]).all(axis=1)]
        else:
            count = sides.kind.side.corners
            corners = np.array([row[:count] for row in each.rows if len(row) >= count], dtype=np.int64)
            own_sides = find_sides(sides, renumbered[order[np.searchsorted(known[order], corners.reshape(-1, count))]])
            rows = np.intersect1d(rows, own_sides)
    return rows
