"""Sets and surfaces of .inp files: which nodes, cells and sides they name, and what of them is left out."""

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from turgor.core.meshing.exchange.formats.raw import Ints
from turgor.foundation.errors import near_match

#: A member of a set: a number, numbers in equal steps, or the name of another set.
Member: TypeAlias = int | range | str

#: Corners of the faces S1, S2, … of solid cells, by the number of corners (Abaqus, "Element faces"; CalculiX alike).
SIDES = {
    4: ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)),
    6: ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    8: ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)),
}

#: Labels of the two faces of a shell or membrane; those with a number are CalculiX's.
SHEET_SIDES = ("SPOS", "SNEG", "POS", "NEG", "S1", "S2", "P1", "P2")


@dataclass(frozen=True, slots=True, eq=False)
class NumberSets:
    """Sets of nodes or of cells, by the numbers of the file.

    Parameters
    ----------
    sets : mapping of str to sequence of Member
    known : (n,) int array
        Numbers that the file defines.
    what : str
        ``"node"`` or ``"cell"`` for notes about members that the file does not define; empty for no such notes.
    omitted : list of str
        Takes the notes.
    """

    sets: Mapping[str, Sequence[Member]]
    known: Ints
    what: str
    omitted: list[str]

    def all(self) -> dict[str, Ints]:
        """Rows of ``known`` in each set, sorted."""
        sets = {}
        for name in self.sets:
            rows, undefined = self._rows(name, ())
            if undefined and self.what:
                self.omitted.append(f"{undefined} {self.what}s of set '{name}' that the file does not define")
            sets[name] = rows
        return sets

    def numbers(self, name: str) -> Ints | None:
        """Numbers that a set holds and the file defines; None for an unknown set."""
        called = self._called(name)
        return None if called is None else np.asarray(self.known[self._rows(called, ())[0]])

    def _called(self, name: str) -> str | None:
        """A set by its name, whatever its case; the instance before a point is left away."""
        names = (name.lower(), name.lower().rpartition(".")[2])
        return next((known for known in self.sets if known.lower() in names), None)

    def _rows(self, name: str, within: tuple[str, ...]) -> tuple[Ints, int]:
        """Rows of one set, and how many of its own numbers are not defined."""
        hit, undefined = np.zeros(len(self.known), dtype=bool), 0
        single = np.array([one for one in self.sets[name] if isinstance(one, int)], dtype=np.int64)
        hit |= np.isin(self.known, single)
        undefined += int((~np.isin(single, self.known)).sum())
        for member in self.sets[name]:
            if isinstance(member, range):  # a range may name more numbers than memory holds
                inside = (self.known >= member.start) & (self.known < member.stop)
                inside &= (self.known - member.start) % member.step == 0
                undefined += len(member) - int(inside.sum())
                hit |= inside
            elif isinstance(member, str):
                other = self._called(member)
                if other is None:
                    hint = near_match(member, self.sets) or ""
                    note = f"set '{member}' in set '{name}', which the file does not define{hint}".rstrip("?.")
                    if note not in self.omitted:
                        self.omitted.append(note)
                elif other not in (*within, name):
                    hit[self._rows(other, (*within, name))[0]] = True
        return np.flatnonzero(hit), undefined


@dataclass(frozen=True, slots=True, eq=False)
class CellTable:
    """Corners of the cells of a file by their numbers, and their dimension: 3 for solids, 2 for shells.

    ``plane`` are cells of plane and axisymmetric states, whose sides S1, S2, … are edges.
    """

    corners: dict[int, tuple[int, Ints]] = field(default_factory=dict)
    plane: set[int] = field(default_factory=set)

    def add(self, dimension: int, numbers: Ints, corners: Ints) -> None:
        """Add cells (c,) with their corners (c, k)."""
        self.corners.update((n, (dimension, row)) for n, row in zip(numbers.tolist(), corners, strict=True))

    def side(self, number: int, label: str) -> tuple[Ints | None, str]:
        """Corners of one side of a cell, or why there are none."""
        if number not in self.corners:
            return None, "on cells that are not read"
        dimension, corners = self.corners[number]
        if number in self.plane:
            place = int(label[1:]) - 1 if re.fullmatch(r"[SP]\d", label) else -1
            if not 0 <= place < len(corners):
                return None, f"'{label}' of plane cells"
            return corners[[place, (place + 1) % len(corners)]], ""
        if dimension == 2:
            return (corners, "") if label in SHEET_SIDES else (None, f"'{label}' of shells")
        sides = SIDES.get(len(corners), ())
        place = int(label[1:]) - 1 if re.fullmatch(r"[SP]\d", label) else -1
        if not 0 <= place < len(sides):
            return None, f"'{label}' of solid cells" if label else "of cells without a side"
        return corners[list(sides[place])], ""


def surface_sides(
    name: str, parts: Sequence[tuple[str, str]], sets: NumberSets, cells: CellTable, omitted: list[str]
) -> Ints:
    """Corners of the sides that a surface lists by cell, or set of cells, and face.

    Parameters
    ----------
    name : str
        Name of the surface.
    parts : sequence of (str, str)
        Cell or set of cells, and the label of its side.
    sets : NumberSets
        Sets of cells.
    cells : CellTable
    omitted : list of str
        Takes notes on what is no side of a cell.

    Returns
    -------
    (s, 4) int array
        -1 in the last place of triangles, and in the last two of edges.
    """
    sides_of_set, why = [], Counter[str]()
    for where, label in parts:
        numbers = [int(where)] if where.isdigit() else sets.numbers(where)
        if numbers is None or not len(numbers):
            why[f"of set '{where}', which {'is not defined' if numbers is None else 'has no cell that is read'}"] += 1
            continue
        for number in numbers:
            side, reason = cells.side(int(number), label)
            if side is None:
                why[reason] += 1
            else:
                sides_of_set.append([*side, -1, -1][:4])
    omitted += [f"{count} sides of surface '{name}' {reason}" for reason, count in why.items()]
    return np.array(sides_of_set, dtype=np.int64).reshape(-1, 4)
