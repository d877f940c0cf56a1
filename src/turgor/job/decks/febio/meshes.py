"""Mesh of a .feb file: nodes, cells, sets and surfaces as keywords of a deck."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.meshing.exchange.formats.abaqus_sets import SIDES
from turgor.foundation.errors import near_match
from turgor.job.decks.febio.elements import Element

#: Types of cells: the one of a deck, how many nodes FEBio gives it, how many of these are taken, and how many corners.
#: Nodes in the middle of faces and cells come last and are left out; turgor makes its own.
CELLS: Mapping[str, tuple[str, int, int, int]] = {
    "hex8": ("C3D8", 8, 8, 8), "hex20": ("C3D20", 20, 20, 8), "hex27": ("C3D20", 27, 20, 8),
    "tet4": ("C3D4", 4, 4, 4), "tet10": ("C3D10", 10, 10, 4), "tet15": ("C3D10", 15, 10, 4),
    "penta6": ("C3D6", 6, 6, 6), "penta15": ("C3D15", 15, 15, 6), "pyra5": ("C3D5", 5, 5, 5),
    "quad4": ("S4", 4, 4, 4), "q4eas": ("S4", 4, 4, 4), "q4ans": ("S4", 4, 4, 4), "quad8": ("S8", 8, 8, 4),
    "quad9": ("S8", 9, 8, 4), "tri3": ("S3", 3, 3, 3), "tri6": ("S6", 6, 6, 3),
}  # fmt: skip

#: Largest number of a node or cell, that of a file of FEBio.
LARGEST = 2**31 - 1

#: Corners of the facets of a surface by their type.
FACETS: Mapping[str, int] = {
    "tri3": 3, "tri6": 3, "tri7": 3, "tri10": 3, "quad4": 4, "quad8": 4, "quad9": 4,
}  # fmt: skip


@dataclass(slots=True)
class FebMesh:
    """Mesh of a .feb file while it is read.

    Parameters
    ----------
    points : dict of int to tuple of float
        Coordinates of the nodes.
    parts : dict of str to dict of int to list of int
        Nodes of the cells of each part.
    solids : dict of str to bool
        Whether the cells of a part are solid ones.
    corners : dict of str to int
        How many corners the cells of a part have.
    node_sets : dict of str to list of int
    facets : dict of str to list of tuple of int
        Corners of the facets of each surface.
    owners : dict of str to Element
        Where parts and surfaces are defined.
    pairs : dict of str to tuple of str
        Two surfaces that touch or are tied.
    cell_sets : dict of str to list of int
        Numbers of cells.
    backs, middles : dict of int to int
        Nodes behind those of shells that have become solid cells, and the nodes between by those behind.
    obstacles : dict of str to (int, int)
        Rigid parts that others touch, with the nodes that state their shifts and turns.
    """

    points: dict[int, tuple[float, ...]] = field(default_factory=dict)
    parts: dict[str, dict[int, list[int]]] = field(default_factory=dict)
    solids: dict[str, bool] = field(default_factory=dict)
    corners: dict[str, int] = field(default_factory=dict)
    node_sets: dict[str, list[int]] = field(default_factory=dict)
    facets: dict[str, list[tuple[int, ...]]] = field(default_factory=dict)
    owners: dict[str, Element] = field(default_factory=dict)
    pairs: dict[str, tuple[str, str]] = field(default_factory=dict)
    cell_sets: dict[str, list[int]] = field(default_factory=dict)
    backs: dict[int, int] = field(default_factory=dict)
    middles: dict[int, int] = field(default_factory=dict)
    obstacles: dict[str, tuple[int, int]] = field(default_factory=dict)

    def nodes_in(self, parts: Iterable[str]) -> set[int]:
        """Nodes of the cells of some parts."""
        return {node for part in parts for nodes in self.parts[part].values() for node in nodes}

    def nodes_of(self, user: Element, name: str) -> list[int]:
        """Nodes of a set that an element names, or of a surface or part behind a sign such as ``@surface:``."""
        sign, _, rest = name.rpartition(":")
        if sign == "@surface":
            return sorted({node for facet in self.facet_rows(user, rest) for node in facet})
        if sign == "@elem_set" and rest in self.cell_sets:
            cells = {number: nodes for rows in self.parts.values() for number, nodes in rows.items()}
            return sorted({node for number in self.cell_sets[rest] for node in cells.get(number, ())})
        if sign in ("@part", "@elem_set", "@part_list"):
            if rest not in self.parts:
                user.fail(f"there is no part '{rest}'{near_match(rest, self.parts) or '.'}")
            return sorted({node for nodes in self.parts[rest].values() for node in nodes})
        if name in self.facets and name not in self.node_sets:  # FEBio 2 names surfaces alike
            return sorted({node for facet in self.facets[name] for node in facet})
        if name not in self.node_sets:
            user.fail(f"there is no node set '{name}'{near_match(name, self.node_sets) or '.'}")
        return self.node_sets[name]

    def facet_rows(self, user: Element, name: str) -> list[tuple[int, ...]]:
        """Facets of a surface that an element names."""
        if name not in self.facets:
            user.fail(f"there is no surface '{name}'{near_match(name, self.facets) or '.'}")
        return self.facets[name]

    def sides(self, left_out: Iterable[str]) -> dict[frozenset[int], tuple[int, str]]:
        """Cell and label of each side of the solid cells, by its corners, but for some parts."""
        table: dict[frozenset[int], tuple[int, str]] = {}
        rigid = set(left_out)
        for part, cells in self.parts.items():
            if not self.solids[part] or part in rigid:
                continue
            for number, nodes in cells.items():
                for place, side in enumerate(SIDES.get(self.corners[part], ()), start=1):
                    table.setdefault(frozenset(nodes[i] for i in side), (number, f"S{place}"))
        return table


def read_mesh(root: Element) -> tuple[FebMesh, list[Keyword]]:
    """Read ``<Mesh>``, or ``<Geometry>`` of FEBio 2; return it, and the elements that cannot be read.

    Raises
    ------
    TurgorError
        If a cell, set or surface has a node that is not defined, or too few or too many nodes.
    """
    mesh, rest = FebMesh(), []
    for section in root.all("Mesh", "Geometry"):
        for each in section.children:
            take = _TAKERS.get(each.tag)
            if take is None:
                rest.append(each.missing("it has no form here.") if each.children else each.unneeded("it is empty"))
            else:
                rest += take(mesh, each)
    if not mesh.points:
        root.fail("there are no <Nodes> with nodes in them.")
    for part, cells in mesh.parts.items():
        _check_nodes(mesh, mesh.owners[f"part {part}"], cells)
    return mesh, rest


def _check_nodes(mesh: FebMesh, owner: Element, cells: Mapping[int, list[int]]) -> None:
    lines = {child.given.get("id", ""): child for child in owner.children}
    for number, nodes in cells.items():
        wrong = [node for node in nodes if node not in mesh.points]
        if wrong:
            lines.get(str(number), owner).fail(f"node {wrong[0]} is used, but the file does not define it.")


def _take_nodes(mesh: FebMesh, section: Element) -> Iterator[Keyword]:
    for node in section.all("node"):
        values = node.numbers()
        if len(values) != 3:
            node.fail(f"it has {len(values)} numbers; three coordinates are needed.")
        mesh.points[node.first_of_its_name(mesh.points, _number(node))] = tuple(values)
    if section.given.get("name"):
        mesh.node_sets.setdefault(section.given["name"], [_number(node) for node in section.all("node")])
    yield from ()


def _take_cells(mesh: FebMesh, section: Element) -> Iterator[Keyword]:
    kind = section.given.get("type", "")
    if kind not in CELLS:
        yield section.missing(f"cells of the type '{kind}' have no form here; these have one: {', '.join(CELLS)}.")
        return
    word, count, used, corners = CELLS[kind]
    name = section.given.get("name") or section.given.get("elset") or f"part{len(mesh.parts) + 1}"
    cells = mesh.parts.setdefault(name, {})
    if mesh.owners.get(f"part {name}", section).given.get("type") != kind:
        section.fail(f"another part '{name}' before it has cells of another type; give each its own name.")
    for cell in section.all("elem"):
        nodes = cell.whole_numbers()
        if len(nodes) != count:
            cell.fail(f"it has {len(nodes)} nodes; cells of the type {kind} have {count}.")
        cells[cell.first_of_its_name(cells, _number(cell))] = nodes[:used]
    mesh.solids[name], mesh.corners[name] = word.startswith("C3D"), corners
    mesh.owners[f"part {name}"] = section


def _take_node_set(mesh: FebMesh, section: Element) -> Iterator[Keyword]:
    nodes = section.whole_numbers()
    wrong = [node for node in nodes if node not in mesh.points]
    if wrong:
        section.fail(f"node {wrong[0]} is used, but the file does not define it.")
    name = section.given.get("name", "")  # may be that of all nodes
    mesh.owners[section.first_of_its_name(mesh.owners, f"node set {name}")] = section
    mesh.node_sets[name] = nodes
    yield from ()


def _take_surface(mesh: FebMesh, section: Element) -> Iterator[Keyword]:
    rows = []
    for facet in section.children:
        if facet.tag not in FACETS:
            facet.fail(f"such facets are not read; these are: {', '.join(FACETS)}.")
        nodes = [int(value) for value in facet.numbers()]
        wrong = [node for node in nodes if node not in mesh.points]
        if wrong:
            facet.fail(f"node {wrong[0]} is used, but the file does not define it.")
        rows.append(tuple(nodes[: FACETS[facet.tag]]))
    mesh.facets[section.first_of_its_name(mesh.facets, section.given.get("name", ""))] = rows
    mesh.owners[f"surface {section.given.get('name', '')}"] = section
    yield from ()


def _take_pair(mesh: FebMesh, section: Element) -> Iterator[Keyword]:
    one, other = section.word("primary"), section.word("secondary")
    mesh.pairs[section.given.get("name", "")] = one, other
    yield from ()


def _take_cell_set(mesh: FebMesh, section: Element) -> Iterator[Keyword]:
    mesh.cell_sets[section.given.get("name", "")] = section.whole_numbers()
    yield section.unneeded("a set of cells, for supports that name it")


def _pass(mesh: FebMesh, section: Element) -> Iterator[Keyword]:
    yield section.unneeded("it changes no result")


def _number(element: Element) -> int:
    word = element.given.get("id", "")
    if not (word.isdecimal() and int(word) <= LARGEST):
        element.fail(f"its id is '{word}'; a whole number up to {LARGEST} is needed.")
    return int(word)


_TAKERS = {
    "Nodes": _take_nodes,
    "Elements": _take_cells,
    "NodeSet": _take_node_set,
    "Surface": _take_surface,
    "SurfacePair": _take_pair,
    "ElementSet": _take_cell_set,
    "PartList": _pass,
}
