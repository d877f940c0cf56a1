"""Names of the mesh file that an import writes: faces, sets of nodes, bodies."""

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.exchange.formats.raw import KINDS
from turgor.job.decks.deck import Deck

Ints = NDArray[np.int64]

#: Types of solid and flat cells by their kind; flat ones become sheets on sides of solids.
TYPES = {
    "tetrahedron4": "C3D4", "tetrahedron10": "C3D10", "hexahedron8": "C3D8", "hexahedron20": "C3D20",
    "wedge6": "C3D6", "wedge15": "C3D15", "pyramid5": "C3D5",
    "triangle3": "M3D3", "triangle6": "M3D6", "quadrilateral4": "M3D4", "quadrilateral8": "M3D8",
}  # fmt: skip

#: Numbers on a line.
PER_LINE = 12


@dataclass(slots=True)
class MeshNames:
    """Names of a mesh, each once, with what they stand for.

    Parameters
    ----------
    deck : Deck
    bodies, sheets : dict of str to int array
        Numbers of the cells of each.
    sets : dict of str to int array
        Numbers of the nodes of each.
    surfaces : dict of str to tuple of (int, str)
        Cells and labels of the sides of each.
    mirrors : dict of str to int array
        Nodes of mirror planes, whose names have a meaning.
    loaded : set of str
        Surfaces with a load: a job has one load for each name.
    """

    deck: Deck
    bodies: dict[str, Ints] = field(default_factory=dict)
    sheets: dict[str, Ints] = field(default_factory=dict)
    sets: dict[str, Ints] = field(default_factory=dict)
    surfaces: dict[str, tuple[tuple[int, str], ...]] = field(default_factory=dict)
    mirrors: dict[str, Ints] = field(default_factory=dict)
    loaded: set[str] = field(default_factory=set)

    def free(self, wish: str, prefix: str = "face") -> str:
        """Return a name that is not taken, as near to a wish as a job file and its meanings of names allow."""
        plain = re.sub(r"[^A-Za-z0-9_-]", "_", wish) or prefix
        if plain.lower().startswith(("symmetry_", "cyclic_")):
            plain = f"plane_{plain.split('_', 1)[1]}"
        taken = {name.lower() for part in (self.bodies, self.sheets, self.sets, self.surfaces) for name in part}
        number, name = 1, plain
        while name.lower() in taken or name.lower() in ("outside", "pressure", "gravity"):
            number += 1
            name = f"{plain}_{number}"
        return name

    def named_set(self, wish: str, nodes: Ints) -> str:
        """Name nodes, or return the name that they have."""
        nodes = np.unique(nodes)
        for name, known in self.sets.items():
            if np.array_equal(known, nodes):
                return name
        return self.new_set(wish, nodes)

    def new_set(self, wish: str, nodes: Ints) -> str:
        """Name nodes once more, even where they have a name."""
        name = self.free(wish)
        self.sets[name] = np.unique(nodes)
        return name

    def loaded_surface(self, wish: str, sides: Iterable[tuple[int, str]]) -> str:
        """Name sides of cells for a load, with a name of their own where the one that they have has a load."""
        rows = tuple(sorted(set(sides)))
        name = self.named_surface(wish, rows)
        if name in self.loaded:
            name = self.free(wish)
            self.surfaces[name] = rows
        self.loaded.add(name)
        return name

    def named_surface(self, wish: str, sides: Iterable[tuple[int, str]]) -> str:
        """Name sides of cells, or return the name that they have."""
        rows = tuple(sorted(set(sides)))
        for name, known in self.surfaces.items():
            if known == rows:
                return name
        name = self.free("pressed" if wish.lower().startswith("cavity") and not self._is_closed(rows) else wish)
        self.surfaces[name] = rows
        return name

    def add_others(self) -> None:
        """Take the sets and surfaces of the deck whose names are free: measures and later loads may need them."""
        deck = self.deck
        for name in deck.content.surfaces:
            sides = deck.surface(name) or ()
            solid = [side for side in sides if side[0] in self._solid]
            if solid and self.free(name) == name:
                self.named_surface(name, solid)
        for name in deck.content.node_sets:
            numbers = deck.node_sets.numbers(name)
            nodes = np.intersect1d(deck.solid_nodes, numbers if numbers is not None else [])
            known = not len(nodes) or self.is_everything(nodes) or self.free(name) != name
            if not known and not name.lower().startswith("cavity"):  # a cavity is a closed surface
                self.sets[name] = nodes

    @property
    def _solid(self) -> frozenset[int]:
        return frozenset(self.deck.solid_numbers.tolist())

    def _is_closed(self, sides: Iterable[tuple[int, str]]) -> bool:
        """Whether each edge of the sides belongs to two of them."""
        if self.deck.plane:
            return False
        edges = Counter[tuple[int, ...]]()
        for cell, label in sides:
            corners, _ = self.deck.cell_table.side(cell, label)
            if corners is None:
                return False
            edges.update(tuple(sorted(pair)) for pair in zip(corners, np.roll(corners, 1), strict=True))
        planes = [set(nodes.tolist()) for nodes in self.mirrors.values()]
        open_edges = [edge for edge, count in edges.items() if count == 1]
        on_planes = all(any(plane.issuperset(edge) for plane in planes) for edge in open_edges)
        return on_planes and set(edges.values()) <= {1, 2}

    def is_face(self, nodes: Ints) -> bool:
        """Whether whole outer sides of cells hold all of these corners."""
        return self.deck.is_face(nodes)

    def is_everything(self, nodes: Ints) -> bool:
        """Whether these are all nodes of solid cells."""
        return bool(np.isin(self.deck.solid_nodes, nodes).all())

    def text(self) -> str:
        """Return the mesh as an .inp file of nodes, cells, sets and surfaces."""
        deck = self.deck
        used = set(deck.solid_nodes.tolist())
        lines = [f"** mesh of {deck.path.name} for a job of turgor", "*NODE"]
        lines += [f"{i}, " + ", ".join(f"{x:.15g}" for x in deck.place[i]) for i in deck.node_ids.tolist() if i in used]
        for name, numbers in self.bodies.items():
            lines += self._cell_lines(name, numbers, deck.solids)
            lines.append(f"*SOLID SECTION, ELSET={name}, MATERIAL={name}")
        for name, numbers in self.sheets.items():
            lines += self._cell_lines(name, numbers, deck.sheets)
        for name, nodes in (self.sets | self.mirrors).items():
            lines += [f"*NSET, NSET={name}", *_rows(nodes.tolist())]
        for name, sides in self.surfaces.items():
            lines += [f"*SURFACE, NAME={name}, TYPE=ELEMENT", *(f"{cell}, {label}" for cell, label in sides)]
        return "\n".join(lines) + "\n"

    def _cell_lines(self, name: str, numbers: Ints, tables: dict[str, Ints]) -> list[str]:
        lines = []
        for kind, table in tables.items():
            rows = table[np.isin(table[:, 0], numbers)]
            if len(rows):
                width = 1 + min(KINDS[kind].nodes, 20)
                cell = TYPES[kind].replace("M3D", self.deck.plane or "M3D")
                lines.append(f"*ELEMENT, TYPE={cell}, ELSET={name}")
                lines += [line for row in rows[:, :width].tolist() for line in _rows(row)]
        return lines


def _rows(numbers: list[int]) -> list[str]:
    """Numbers on as many lines as needed; all but the last end with a comma."""
    parts = [numbers[start : start + PER_LINE] for start in range(0, len(numbers), PER_LINE)]
    return [", ".join(map(str, part)) + ("," if i + 1 < len(parts) else "") for i, part in enumerate(parts)]
