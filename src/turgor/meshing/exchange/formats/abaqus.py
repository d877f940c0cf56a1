"""Read .inp files of Abaqus and CalculiX: nodes, solid cells, sets and surfaces."""

import re
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from turgor.errors import TurgorError, near_match
from turgor.meshing.exchange.formats.raw import KINDS, Block, Ints, RawMesh, numbers, rows_of

#: Corners of the faces S1, S2, … of solid cells, by the number of corners (Abaqus, "Element faces"; CalculiX alike).
SIDES = {
    4: ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)),
    8: ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)),
}

_SOLIDS = {4: "tetrahedron4", 10: "tetrahedron10", 8: "hexahedron8", 20: "hexahedron20", 6: "wedge6", 15: "wedge15"}
_SHEETS = {3: "triangle3", 6: "triangle6", 4: "quadrilateral4", 8: "quadrilateral8", 9: "quadrilateral9"}
_TYPE = re.compile(r"(D?C3D|AC3D|S|M3D|SFM3D|R3D|STRI|DS|CPS|CPE|CAX)(\d+)")


@dataclass(slots=True)
class _Keyword:
    """One keyword with its parameters and the lines of data below it."""

    name: str
    given: dict[str, str]
    lines: list[str] = field(default_factory=list)


@dataclass(slots=True)
class _Content:
    """What was read so far, with the numbers of the file."""

    path: Path
    node_ids: list[int] = field(default_factory=list)
    points: list[list[float]] = field(default_factory=list)
    cells: dict[str, list[list[int]]] = field(default_factory=lambda: defaultdict(list))
    node_sets: dict[str, list[int]] = field(default_factory=lambda: defaultdict(list))
    cell_sets: dict[str, list[int]] = field(default_factory=lambda: defaultdict(list))
    surfaces: dict[str, list[tuple[str, str]]] = field(default_factory=lambda: defaultdict(list))
    sections: list[str] = field(default_factory=list)


def read_abaqus(path: Path) -> RawMesh:
    """Read an .inp file; sets and surfaces become the names of its cells and faces.

    Parameters
    ----------
    path : Path

    Returns
    -------
    RawMesh

    Raises
    ------
    TurgorError
        If the file has several parts or instances, a line is no line of numbers, or a set is not defined.
    """
    content = _Content(path)
    for keyword in _keywords(path):
        _take(content, keyword)
    if not content.points:
        raise TurgorError(f"'{path}' has no *NODE with nodes in it.")
    return _mesh(content)


def _keywords(path: Path, depth: int = 0) -> list[_Keyword]:
    """Split a file into keywords, with the files that it includes in their places."""
    found: list[_Keyword] = []
    pending = ""
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        if line.startswith("**") or not line.strip():
            continue
        text = pending + line.strip()
        pending = ""
        if not text.startswith("*"):
            if found:
                found[-1].lines.append(text)
            continue
        if text.endswith(","):  # a keyword line goes on in the next line
            pending = text
            continue
        name, *parameters = (part.strip() for part in text[1:].split(","))
        given = {k.strip().lower(): v.strip().strip('"') for k, _, v in (p.partition("=") for p in parameters)}
        keyword = _Keyword(" ".join(name.lower().split()), given)
        if keyword.name == "include":
            found += _included(path, given.get("input", ""), depth)
        found.append(keyword)
    return found


def _included(path: Path, name: str, depth: int) -> list[_Keyword]:
    file = path.parent / name
    if not name or not file.is_file() or depth > 8:
        raise TurgorError(f"'{path}' includes '{name}', which is not there.")
    return _keywords(file, depth + 1)


def _take(content: _Content, keyword: _Keyword) -> None:
    take = _TAKERS.get(keyword.name)
    if take is not None:
        take(content, keyword)


def _take_nodes(content: _Content, keyword: _Keyword) -> None:
    for line in keyword.lines:
        values = [*numbers(line, content.path, "a node"), 0.0, 0.0, 0.0]
        content.node_ids.append(int(values[0]))
        content.points.append(values[1:4])
        if "nset" in keyword.given:
            content.node_sets[keyword.given["nset"]].append(int(values[0]))


def _take_cells(content: _Content, keyword: _Keyword) -> None:
    name = keyword.given.get("type", "").upper()
    match = _TYPE.match(name)
    solid = match is not None and match[1].endswith("C3D")
    kind = (_SOLIDS if solid else _SHEETS).get(int(match[2])) if match is not None else None
    if kind is None and solid:
        raise TurgorError(f"'{content.path}' has cells of type {name}; known are C3D4, C3D10, C3D8 and C3D20.")
    if kind is None:
        return  # lines, springs and the like bound no solid
    values = [int(value) for line in keyword.lines for value in numbers(line, content.path, "a cell")]
    width = KINDS[kind].nodes + 1
    if len(values) % width:
        raise TurgorError(f"'{content.path}': cells of type {name} need {width} numbers each; some lines are short.")
    for start in range(0, len(values), width):
        content.cells[kind].append(values[start : start + width])
        if "elset" in keyword.given:
            content.cell_sets[keyword.given["elset"]].append(values[start])


def _take_node_set(content: _Content, keyword: _Keyword) -> None:
    _take_set(content, keyword, content.node_sets, "nset")


def _take_cell_set(content: _Content, keyword: _Keyword) -> None:
    _take_set(content, keyword, content.cell_sets, "elset")


def _take_set(content: _Content, keyword: _Keyword, sets: dict[str, list[int]], key: str) -> None:
    name = keyword.given.get(key)
    if name is None:
        raise TurgorError(f"'{content.path}': *{keyword.name.upper()} names no {key.upper()}.")
    members: list[int] = []
    for line in keyword.lines:
        words = [word.strip().strip('"') for word in line.split(",") if word.strip()]
        if "generate" in keyword.given:
            first, last, step = ([int(word) for word in words] + [1])[:3]
            members += range(first, last + 1, step)
            continue
        for word in words:
            members += [int(word)] if re.fullmatch(r"\d+", word) else _known(content, word, sets, key)
    sets[name] += members


def _known(content: _Content, name: str, sets: dict[str, list[int]], key: str) -> list[int]:
    """Members of a set by its name, whatever its case; the instance before a point is left away."""
    for known, members in sets.items():
        if known.lower() in (name.lower(), name.lower().rpartition(".")[2]):
            return members
    raise TurgorError(f"'{content.path}': unknown {key.upper()} '{name}'{near_match(name, sets) or '.'}")


def _take_surface(content: _Content, keyword: _Keyword) -> None:
    name = keyword.given.get("name", "")
    node = keyword.given.get("type", "").lower() == "node"
    for line in keyword.lines:
        words = [word.strip().strip('"') for word in line.split(",") if word.strip()]
        if node:
            word = words[0]
            found = [int(word)] if word.isdigit() else _known(content, word, content.node_sets, "nset")
            content.node_sets[name] += found
        elif len(words) == 2:
            content.surfaces[name].append((words[0], words[1].upper()))


def _take_section(content: _Content, keyword: _Keyword) -> None:
    if "elset" in keyword.given:
        content.sections.append(keyword.given["elset"])


def _take_part(content: _Content, keyword: _Keyword) -> None:
    if content.points:
        raise TurgorError(
            f"'{content.path}' has several parts; merge them into one, or write a file without parts and assemblies."
        )


def _take_instance(content: _Content, keyword: _Keyword) -> None:
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
    "instance": _take_instance,
}


def _mesh(content: _Content) -> RawMesh:
    ids = np.array(content.node_ids, dtype=np.int64)
    blocks: list[Block] = []
    corners: dict[int, Ints] = {}
    for kind, cells in content.cells.items():
        table = np.array(cells, dtype=np.int64)
        nodes = rows_of(table[:, 1:], ids, content.path, "node")
        corners.update(zip(table[:, 0].tolist(), nodes[:, : KINDS[kind].corners], strict=True))
        groups = {name: np.flatnonzero(np.isin(table[:, 0], members)) for name, members in content.cell_sets.items()}
        blocks.append(Block(kind=KINDS[kind], nodes=nodes, groups={n: rows for n, rows in groups.items() if len(rows)}))
    return RawMesh(
        path=content.path,
        points=np.array(content.points, dtype=np.float64),
        blocks=tuple(blocks),
        node_sets={
            name: np.unique(rows_of(np.array(members, dtype=np.int64), ids, content.path, "node"))
            for name, members in content.node_sets.items()
        },
        surfaces={name: _sides(content, name, parts, corners) for name, parts in content.surfaces.items()},
        sections=_sections(content),
    )


def _sections(content: _Content) -> tuple[str, ...]:
    names = {name.lower(): name for name in content.cell_sets}
    return tuple(dict.fromkeys(names[name.lower()] for name in content.sections if name.lower() in names))


def _sides(content: _Content, name: str, parts: list[tuple[str, str]], corners: dict[int, Ints]) -> Ints:
    """Corners of the sides that a surface lists by cell, or set of cells, and face."""
    found = []
    for where, label in parts:
        cells = [int(where)] if where.isdigit() else _known(content, where, content.cell_sets, "elset")
        for cell in cells:
            if cell not in corners:
                raise TurgorError(f"'{content.path}': surface '{name}' uses cell {cell}, which is not a solid cell.")
            sides = SIDES.get(len(corners[cell]), ())
            place = int(label[1:]) - 1 if re.fullmatch(r"[SP]\d", label) else -1
            if not 0 <= place < len(sides):
                raise TurgorError(f"'{content.path}': surface '{name}' uses face '{label}' of cell {cell}.")
            side = corners[cell][list(sides[place])]
            found.append([*side, -1][:4])
    return np.array(found, dtype=np.int64).reshape(-1, 4)
