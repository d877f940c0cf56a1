"""Read .inp files of Abaqus and CalculiX: nodes, solid cells, sets and surfaces."""

import re
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from turgor.core.meshing.exchange.formats.abaqus_sets import CellTable, Member, NumberSets, surface_sides
from turgor.core.meshing.exchange.formats.raw import KINDS, Block, RawMesh, numbers, rows_of
from turgor.foundation.errors import TurgorError

_SOLIDS = {4: "tetrahedron4", 10: "tetrahedron10", 8: "hexahedron8", 20: "hexahedron20"} | {
    6: "wedge6",
    15: "wedge15",
    5: "pyramid5",
}
_SHEETS = {3: "triangle3", 6: "triangle6", 4: "quadrilateral4", 8: "quadrilateral8", 9: "quadrilateral9"} | {
    65: "triangle6",  # STRI65, of five degrees of freedom per node
}

_PLANE = ("CPE", "CPS", "CAX")

#: Parameters with which the lines below a keyword are not all of it, or mean something else: of cells, of nodes.
_ELSEWHERE = (("input", "combine"), ("input", "system", "elset"))

_TYPE = re.compile(r"(D?C3D|AC3D|S|M3D|SFM3D|R3D|STRI|DS|CPS|CPE|CAX)(\d+)")


@dataclass(slots=True)
class Keyword:
    """One keyword with its parameters, the lines of data below it, and where it stands.

    ``label`` is what a message names instead of it, where it stands for an element of another format.
    """

    name: str
    given: dict[str, str]
    path: Path
    line: int
    lines: list[str] = field(default_factory=list)
    label: str = ""


@dataclass(slots=True)
class Content:
    """Content of the lines that were read, with the numbers of the file.

    ``omitted`` names the lines that were not understood, one clause each.
    """

    path: Path
    node_ids: list[int] = field(default_factory=list)
    points: list[list[float]] = field(default_factory=list)
    cells: dict[str, list[list[int]]] = field(default_factory=lambda: defaultdict(list))
    node_sets: dict[str, list[Member]] = field(default_factory=lambda: defaultdict(list))
    cell_sets: dict[str, list[Member]] = field(default_factory=lambda: defaultdict(list))
    surfaces: dict[str, list[tuple[str, str]]] = field(default_factory=lambda: defaultdict(list))
    sections: list[str] = field(default_factory=list)
    unread: list[str] = field(default_factory=list)
    omitted: list[str] = field(default_factory=list)
    plane: set[int] = field(default_factory=set)
    of_part: set[int] = field(default_factory=set)
    instances: int = 0


def read_abaqus(path: Path) -> RawMesh:
    """Read an .inp file; sets and surfaces become the names of its cells and faces.

    What no solid cell needs is left out, and `RawMesh.omitted` lists it: members of sets that the file does not define,
    lines, springs and the like, surfaces on them.

    Parameters
    ----------
    path : Path

    Returns
    -------
    RawMesh

    Raises
    ------
    TurgorError
        If the file has several parts or instances, a line is no line of numbers, or a cell has an unknown node.
    """
    return _mesh(content_of(path, keywords_of(path)))


def content_of(path: Path, keywords: Iterable[Keyword]) -> Content:
    """Return the nodes, cells, sets and surfaces of the keywords of a file."""
    content = Content(path)
    for keyword in keywords:
        _take(content, keyword)
    if not content.points:
        raise TurgorError(f"'{path}' has no *NODE with nodes in it.")
    return content


def keywords_of(path: Path, above: tuple[Path, ...] = ()) -> list[Keyword]:
    """Split a file into keywords, with the files that it includes in their places; ``above`` are those around it."""
    keywords: list[Keyword] = []
    pending = ""
    for number, line in enumerate(path.read_text(encoding="utf-8-sig", errors="replace").splitlines(), start=1):
        if line.startswith("**") or not line.strip():
            continue
        text = pending + line.strip()
        pending = ""
        if not text.startswith("*"):
            if keywords:
                keywords[-1].lines.append(text)
            continue
        if text.endswith(","):  # a keyword line goes on in the next line
            pending = text
            continue
        name, *parameters = (part.strip() for part in text[1:].split(","))
        given = {k.strip().lower(): v.strip().strip('"') for k, _, v in (p.partition("=") for p in parameters)}
        keyword = Keyword(" ".join(name.lower().split()), given, path, number)
        if keyword.name == "include":
            keywords += _included(path, given.get("input", ""), (*above, path.resolve()))
        keywords.append(keyword)
    return keywords


def _included(path: Path, name: str, above: tuple[Path, ...]) -> list[Keyword]:
    file = path.parent / name
    if not name or not file.is_file():  # a device, such as /dev/zero, is no file
        raise TurgorError(f"'{path}' includes '{name}', which is no file.")
    if file.resolve() in above:
        raise TurgorError(f"'{path}' includes '{name}', which includes '{path.name}' in turn.")
    return keywords_of(file, above)


def _take(content: Content, keyword: Keyword) -> None:
    take = _TAKERS.get(keyword.name)
    if take is None:
        return
    for key in _ELSEWHERE[keyword.name in ("node", "nset")]:
        if keyword.given.get(key, "R").upper() != "R":  # SYSTEM=R is Cartesian
            raise TurgorError(
                f"'{keyword.path}', line {keyword.line}: *{keyword.name.upper()} with {key.upper()} is not read; "
                "write its lines below it, nodes in Cartesian coordinates."
            )
    take(content, keyword)


def _take_nodes(content: Content, keyword: Keyword) -> None:
    for line in keyword.lines:
        values = [*numbers(line, content.path, "a node"), 0.0, 0.0, 0.0]
        if int(values[0]) in content.of_part:
            raise TurgorError(
                f"'{keyword.path}', line {keyword.line}: node {int(values[0])} of the assembly has the number of a "
                "node of the part; leave out reference points, or write a file without parts and assemblies."
            )
        content.node_ids.append(int(values[0]))
        content.points.append(values[1:4])
        if "nset" in keyword.given:
            content.node_sets[keyword.given["nset"]].append(int(values[0]))


def _take_cells(content: Content, keyword: Keyword) -> None:
    name = keyword.given.get("type", "").upper()
    match = _TYPE.match(name)
    solid = match is not None and match[1].endswith("C3D")
    kind = (_SOLIDS if solid else _SHEETS).get(int(match[2])) if match is not None else None
    if kind is None and solid:
        raise TurgorError(f"'{content.path}' has cells of type {name}; known are C3D4, C3D10, C3D8 and C3D20.")
    if kind is None:  # lines, springs and the like bound no solid, but their sets may be named in others
        content.unread.append(name or "without a type")
        if "elset" in keyword.given:
            content.cell_sets[keyword.given["elset"]] += []
        return
    rows, width = [numbers(line, content.path, "a cell") for line in keyword.lines], KINDS[kind].nodes + 1
    if all(len(row) > width for row in rows):  # what is left of cells of another order; the programs skip it
        rows = [row[:width] for row in rows]
    values = [int(value) for row in rows for value in row]
    if len(values) % width:
        raise TurgorError(f"'{content.path}': cells of type {name} need {width} numbers each; some lines are short.")
    for start in range(0, len(values), width):
        content.cells[kind].append(values[start : start + width])
        if name.startswith(_PLANE):
            content.plane.add(values[start])
        if "elset" in keyword.given:
            content.cell_sets[keyword.given["elset"]].append(values[start])


def _take_node_set(content: Content, keyword: Keyword) -> None:
    _take_set(content, keyword, content.node_sets, "nset")


def _take_cell_set(content: Content, keyword: Keyword) -> None:
    _take_set(content, keyword, content.cell_sets, "elset")


def _take_set(content: Content, keyword: Keyword, sets: dict[str, list[Member]], key: str) -> None:
    name = keyword.given.get(key)
    if name is None:
        raise TurgorError(f"'{content.path}': *{keyword.name.upper()} names no {key.upper()}.")
    members: list[Member] = []
    for line in keyword.lines:
        words = [word.strip().strip('"') for word in line.split(",") if word.strip()]
        if "generate" in keyword.given:
            first, last, step = ([int(word) for word in words] + [1])[:3]
            members.append(range(first, last + 1, max(step, 1)))
            continue
        members += [int(word) if re.fullmatch(r"\d+", word) else word for word in words]
    sets[name] += members


def _take_surface(content: Content, keyword: Keyword) -> None:
    name = keyword.given.get("name", "")
    node = keyword.given.get("type", "").lower() == "node"
    for line in keyword.lines:
        words = [word.strip().strip('"') for word in line.split(",") if word.strip()]
        if node:
            content.node_sets[name].append(int(words[0]) if words[0].isdigit() else words[0])
        elif words:
            content.surfaces[name].append((words[0], words[1].upper() if len(words) > 1 else ""))


def _take_section(content: Content, keyword: Keyword) -> None:
    if "elset" in keyword.given:
        content.sections.append(keyword.given["elset"])


def _take_part(content: Content, keyword: Keyword) -> None:
    if content.points:
        raise TurgorError(
            f"'{content.path}' has several parts; merge them into one, or write a file without parts and assemblies."
        )


def _end_part(content: Content, keyword: Keyword) -> None:
    content.of_part.update(content.node_ids)


def _take_instance(content: Content, keyword: Keyword) -> None:
    content.instances += 1
    if content.instances > 1:
        raise TurgorError(
            f"'{content.path}' has several instances; merge them into one part, or write a file without assemblies."
        )
    moved = any(value for line in keyword.lines for value in numbers(line, content.path, "an instance"))
    if moved:
        raise TurgorError(
            f"'{content.path}' moves an instance; merge it into one part, or write a file without assemblies."
        )


_TAKERS = {
    "node": _take_nodes,
    "element": _take_cells,
    "nset": _take_node_set,
    "elset": _take_cell_set,
    "surface": _take_surface,
    "solid section": _take_section,
    "part": _take_part,
    "end part": _end_part,
    "instance": _take_instance,
}


def _mesh(content: Content) -> RawMesh:
    ids = np.array(content.node_ids, dtype=np.int64)
    tables = {kind: np.array(cells, dtype=np.int64) for kind, cells in content.cells.items()}
    numbered = np.concatenate([np.zeros(0, dtype=np.int64), *(table[:, 0] for table in tables.values())])
    if content.unread:
        content.omitted.append(f"cells of the types {', '.join(sorted(set(content.unread)))}")
    node_sets = NumberSets(content.node_sets, ids, "node", content.omitted)
    cell_sets = NumberSets(content.cell_sets, numbered, "" if content.unread else "cell", content.omitted)
    members = {name: numbered[rows] for name, rows in cell_sets.all().items()}
    blocks, corners = [], CellTable(plane=content.plane)
    for kind, table in tables.items():
        nodes = rows_of(table[:, 1:], ids, content.path, "node")
        corners.add(KINDS[kind].dimension, table[:, 0], nodes[:, : KINDS[kind].corners])
        groups = {name: np.flatnonzero(np.isin(table[:, 0], known)) for name, known in members.items()}
        blocks.append(Block(kind=KINDS[kind], nodes=nodes, groups={n: rows for n, rows in groups.items() if len(rows)}))
    return RawMesh(
        path=content.path,
        points=np.array(content.points, dtype=np.float64),
        blocks=tuple(blocks),
        node_sets=node_sets.all(),
        surfaces={
            name: surface_sides(name, parts, cell_sets, corners, content.omitted)
            for name, parts in content.surfaces.items()
        },
        sections=_sections(content),
        omitted=tuple(content.omitted),
        node_numbers=ids,
    )


def _sections(content: Content) -> tuple[str, ...]:
    names = {name.lower(): name for name in content.cell_sets}
    return tuple(dict.fromkeys(names[name.lower()] for name in content.sections if name.lower() in names))
