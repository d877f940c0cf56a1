"""Deck: an .inp file, or a .feb file as keywords: nodes, cells, sets and steps, by the numbers of the file."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.exchange.formats.abaqus import Content, Keyword, content_of, keywords_of
from turgor.core.meshing.exchange.formats.abaqus_sets import SIDES, CellTable, NumberSets
from turgor.core.meshing.exchange.formats.raw import KINDS, numbers
from turgor.foundation.errors import TurgorError
from turgor.job.decks.febio.reading import keywords_of_febio

Ints = NDArray[np.int64]

#: Keywords that begin and end a step.
_STEP, _END = "step", ("end step", "endstep")

#: Types of plane cells: plane strain, bodies of revolution about y, and plane stress, which has no form here.
STRAIN, ROUND, STRESS = "CPE", "CAX", "CPS"


@dataclass(frozen=True, kw_only=True, eq=False)
class Deck:
    """An .inp file before it becomes a job.

    Parameters
    ----------
    path : Path
    model : tuple of Keyword
        What stands before the first step.
    steps : tuple of tuple of Keyword
        Each step, beginning with its ``*STEP``.
    content : Content
        Nodes, cells, sets and surfaces.
    """

    path: Path
    model: tuple[Keyword, ...]
    steps: tuple[tuple[Keyword, ...], ...]
    content: Content

    @cached_property
    def node_ids(self) -> Ints:
        """Numbers of all nodes."""
        return np.array(self.content.node_ids, dtype=np.int64)

    @cached_property
    def place(self) -> dict[int, Sequence[float]]:
        """Coordinates of each node, in the unit of the deck; the last definition counts."""
        return dict(zip(self.content.node_ids, self.content.points, strict=True))

    @cached_property
    def plane(self) -> str:
        """Type of the plane cells of a plane model; empty for others."""
        if not self.content.plane or any(KINDS[kind].dimension == 3 for kind in self._cells):
            return ""
        types = [each.given.get("type", "").upper()[:3] for each in self.model if each.name == "element"]
        return next(each for each in types if each in (STRAIN, ROUND, STRESS))

    @cached_property
    def thickness(self) -> float:
        """Thickness of a plane model, in the unit of the deck: that of its first section, 1 where it states none."""
        lines = (line for each in self.model if each.name == "solid section" for line in each.lines)
        return next((numbers(line, self.path, "a thickness")[0] for line in lines), 1.0)

    @property
    def freedoms(self) -> tuple[int, ...]:
        """Degrees of freedom of its nodes."""
        return (1, 2) if self.plane else (1, 2, 3)

    @cached_property
    def solids(self) -> dict[str, Ints]:
        """Rows (number, nodes …) of the solid cells of each kind; of a plane model all cells."""
        rigid = np.concatenate([np.zeros(0, dtype=np.int64), *(cells for _, cells in self.rigid_bodies)])
        return {kind: rows[~np.isin(rows[:, 0], rigid)] for kind, rows in self.every_solid.items()}

    @cached_property
    def every_solid(self) -> dict[str, Ints]:
        """Those with the cells of rigid bodies."""
        dimension = 2 if self.plane else 3
        return {kind: rows for kind, rows in self._cells.items() if KINDS[kind].dimension == dimension}

    @cached_property
    def rigid_bodies(self) -> tuple[tuple[Keyword, Ints], ...]:
        """Rigid bodies of solid cells with nodes of their own."""
        bodies = []
        for keyword in self.model:
            cells = self.cells(keyword.given.get("elset", "")) if keyword.name == "rigid body" else None
            if cells is None or not len(cells) or self.plane:
                continue
            own = [rows[np.isin(rows[:, 0], cells)] for rows in self.every_solid.values()]
            others = [rows[~np.isin(rows[:, 0], cells)] for rows in self.every_solid.values()]
            nodes, shared = (np.concatenate([rows[:, 1:].ravel() for rows in part]) for part in (own, others))
            if sum(map(len, own)) == len(cells) and not np.isin(nodes, shared).any():
                bodies.append((keyword, cells))
        return tuple(bodies)

    @cached_property
    def sheets(self) -> dict[str, Ints]:
        """Rows (number, nodes …) of the flat cells of each kind."""
        return {} if self.plane else {kind: r for kind, r in self._cells.items() if KINDS[kind].dimension == 2}

    @cached_property
    def _cells(self) -> dict[str, Ints]:
        return {kind: np.array(rows, dtype=np.int64) for kind, rows in self.content.cells.items()}

    @cached_property
    def solid_numbers(self) -> Ints:
        """Numbers of all solid cells, sorted."""
        return np.sort(np.concatenate([np.zeros(0, dtype=np.int64), *(rows[:, 0] for rows in self.solids.values())]))

    @cached_property
    def solid_nodes(self) -> Ints:
        """Numbers of all nodes of solid cells, sorted."""
        return np.unique(
            np.concatenate([np.zeros(0, dtype=np.int64), *(rows[:, 1:].ravel() for rows in self.solids.values())])
        )

    @cached_property
    def corner_nodes(self) -> Ints:
        """Numbers of all corners of solid cells, sorted."""
        corners = [rows[:, 1 : 1 + KINDS[kind].corners].ravel() for kind, rows in self.solids.items()]
        return np.unique(np.concatenate([np.zeros(0, dtype=np.int64), *corners]))

    @cached_property
    def twins(self) -> Ints:
        """Corners of solid cells that lie at the place of another one."""
        corners = self.corner_nodes
        points = np.round([self.place[node] for node in corners.tolist()], 9)
        _, place, count = np.unique(points, axis=0, return_inverse=True, return_counts=True)
        return corners[count[place.ravel()] > 1]

    @cached_property
    def node_sets(self) -> NumberSets:
        """Sets of nodes."""
        return NumberSets(self.content.node_sets, self.node_ids, "", [])

    @cached_property
    def cell_sets(self) -> NumberSets:
        """Sets of cells."""
        numbers = np.concatenate([np.zeros(0, dtype=np.int64), *(rows[:, 0] for rows in self._cells.values())])
        return NumberSets(self.content.cell_sets, numbers, "", [])

    @cached_property
    def cell_table(self) -> CellTable:
        """Corners of the cells, by the numbers of their nodes."""
        table = CellTable(plane=self.content.plane)
        for kind, rows in self._cells.items():
            table.add(KINDS[kind].dimension, rows[:, 0], rows[:, 1 : 1 + KINDS[kind].corners])
        return table

    @cached_property
    def outer_sides(self) -> list[Ints]:
        """Corners of the sides that bound one cell only, for two, three and four corners."""
        every: dict[int, list[Ints]] = {2: [], 3: [], 4: []}
        for kind, rows in self.solids.items():
            for side in sides_of(kind):
                every[len(side)].append(rows[:, 1:][:, list(side)])
        outer = []
        for width, parts in every.items():
            sides = np.concatenate([np.zeros((0, width), dtype=np.int64), *parts])
            _, first, count = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
            outer.append(sides[first[count == 1]])
        return outer

    def is_face(self, nodes: Ints) -> bool:
        """Whether whole outer sides of cells hold all of these corners."""
        corners = np.intersect1d(nodes, self.corner_nodes)
        covered = [sides[np.isin(sides, corners).all(axis=1)].ravel() for sides in self.outer_sides]
        return bool(len(corners)) and bool(np.isin(corners, np.concatenate(covered)).all())

    @cached_property
    def _references(self) -> frozenset[int]:
        """Nodes of rigid bodies, which need no coordinates where they turn."""
        bodies = (each for each in self.model if each.name == "rigid body")
        return frozenset(node for each in bodies for node in self.reference_nodes(each))

    def reference_nodes(self, keyword: Keyword) -> tuple[int, int]:
        """Return the reference node of a rigid body and the node that states its turns; 0 where there is none."""
        given = {key.replace(" ", ""): value for key, value in keyword.given.items()}
        words = (given.get(key, "") for key in ("refnode", "rotnode"))
        first, second = (int(word) if word.isdigit() else 0 for word in words)
        return first, second

    def nodes(self, word: str) -> Ints | None:
        """Numbers of the nodes that a line names by a number or a set; None for an unknown one."""
        if word.isdigit():
            known = int(word) in self.place or int(word) in self._references
            return np.array([int(word)], dtype=np.int64) if known else None
        return self.node_sets.numbers(word.strip('"'))

    def cells(self, word: str) -> Ints | None:
        """Numbers of the cells that a line names by a number or a set; None for an unknown one."""
        if word.isdigit():
            known = int(word) in self.cell_table.corners
            return np.array([int(word)], dtype=np.int64) if known else None
        return self.cell_sets.numbers(word.strip('"'))

    def surface_name(self, name: str) -> str | None:
        """The surface that a line names, whatever its case; the instance before a point is left away."""
        plain = name.replace('"', "").lower()
        names = (plain, plain.rpartition(".")[2])
        return next((key for key in self.content.surfaces if key.lower() in names), None)

    def surface(self, name: str) -> tuple[tuple[int, str], ...] | None:
        """Cells and labels of the sides of a surface; None for an unknown one."""
        known = self.surface_name(name)
        if known is None:
            return None
        sides = []
        for where, label in self.content.surfaces[known]:
            numbers = self.cells(where)
            sides += [(int(number), label) for number in (() if numbers is None else numbers)]
        return tuple(sides)


def read_deck(path: Path) -> Deck:
    """Read an .inp file with all that it includes, or a .feb file.

    Raises
    ------
    TurgorError
        If there is no such file, it has no nodes, or its lines are damaged.
    """
    if not path.is_file():
        raise TurgorError(f"'{path}' is a folder, no deck." if path.is_dir() else f"there is no deck '{path}'.")
    keywords = keywords_of_febio(path) if path.suffix.lower() == ".feb" else keywords_of(path)
    model: list[Keyword] = []
    steps: list[list[Keyword]] = []
    within = False
    for keyword in keywords:
        if keyword.name == _STEP:
            steps.append([keyword])
            within = True
        elif keyword.name in _END:
            within = False
        elif within:
            steps[-1].append(keyword)
        else:
            model.append(keyword)
    try:
        content = content_of(path, keywords)
        return Deck(path=path, model=tuple(model), steps=tuple(map(tuple, steps)), content=content)
    except TurgorError:
        raise
    except (ArithmeticError, LookupError, TypeError, ValueError) as error:  # what a parser stumbles over
        raise TurgorError(f"'{path}' cannot be read, the deck seems damaged ({error}).") from error


def sides_of(kind: str) -> tuple[tuple[int, ...], ...]:
    """Return the corners of the sides of a kind of cell: S1, S2, …; edges of plane ones."""
    count = KINDS[kind].corners
    return tuple((k, (k + 1) % count) for k in range(count)) if KINDS[kind].dimension == 2 else SIDES.get(count, ())


def words_of(line: str) -> list[str]:
    """Return the words between the commas of a line of data, without those that are empty at its end.

    Examples
    --------
    >>> words_of("12, 3, , 0.5,")
    ['12', '3', '', '0.5']
    """
    words = [word.strip() for word in line.split(",")]
    while words and not words[-1]:
        words.pop()
    return words
