"""Read gmsh's .msh files: versions 2.2 and 4.1, text or binary, with physical groups."""

import struct
from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from turgor.core.meshing.exchange.formats.gmsh_binary import Content, binary_sections, byte_order, content_2, content_4
from turgor.core.meshing.exchange.formats.raw import KINDS, Block, Ints, RawMesh, rows_of
from turgor.foundation.errors import TurgorError

#: gmsh's numbers of the kinds of cells.
_KINDS = {
    1: "line2",
    2: "triangle3",
    3: "quadrilateral4",
    4: "tetrahedron4",
    5: "hexahedron8",
    6: "wedge6",
    7: "pyramid5",
    8: "line3",
    9: "triangle6",
    10: "quadrilateral9",
    11: "tetrahedron10",
    12: "hexahedron27",
    13: "wedge18",
    14: "pyramid14",
    15: "point",
    16: "quadrilateral8",
    17: "hexahedron20",
    18: "wedge15",
    19: "pyramid13",
}

#: Place in gmsh's order of each node in VTK's order, where they differ.
_HEXAHEDRON = (0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15)
_WEDGE = (0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11)
_PYRAMID = (0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12)
_ORDER = {
    "tetrahedron10": (0, 1, 2, 3, 4, 5, 6, 7, 9, 8),
    "hexahedron20": _HEXAHEDRON,
    "hexahedron27": (*_HEXAHEDRON, 22, 23, 21, 24, 20, 25, 26),
    "wedge15": _WEDGE,
    "wedge18": (*_WEDGE, 15, 17, 16),
    "pyramid13": _PYRAMID,
    "pyramid14": (*_PYRAMID, 13),
}

_GROUP = ("point", "curve", "surface", "volume")


def read_gmsh(path: Path) -> RawMesh:
    """Read a .msh file; physical groups become the names of its cells.

    Parameters
    ----------
    path : Path

    Returns
    -------
    RawMesh

    Raises
    ------
    TurgorError
        If the file is of another version, or breaks off.
    """
    sections = _sections(path)
    if "MeshFormat" not in sections:
        raise TurgorError(f"'{path}' is no gmsh file: it has no section $MeshFormat.")
    version, binary = sections["MeshFormat"][0].split()[:2]
    readers = {"2": _read_2, "4.1": _read_4} if binary == "0" else {"2": _read_binary_2, "4.1": _read_binary_4}
    reader = readers.get(version) or readers.get(version.split(".")[0])
    if reader is None:
        raise TurgorError(f"'{path}' is gmsh version {version}; 2.2 and 4.1 can be read (gmsh: Mesh.MshFileVersion).")
    for name in ("Nodes", "Elements"):
        if name not in sections:
            raise TurgorError(f"'{path}' has no section ${name}.")
    try:
        return reader(path, sections)
    except (ValueError, IndexError, StopIteration, struct.error) as error:
        if isinstance(error, TurgorError):
            raise
        raise TurgorError(f"'{path}' breaks off or is damaged: {error or 'a section is too short'}.") from error


def _sections(path: Path) -> dict[str, list[str]]:
    sections: dict[str, list[str]] = {}
    name = ""
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        if line.startswith("$End"):
            name = ""
        elif line.startswith("$"):
            name = line[1:].strip()
            sections[name] = []
        elif name and line.strip():
            sections[name].append(line)
    return sections


def _names(sections: dict[str, list[str]]) -> dict[tuple[int, int], str]:
    """Names of the physical groups by dimension and number."""
    names = {}
    for line in sections.get("PhysicalNames", [])[1:]:
        dimension, tag, name = line.split(maxsplit=2)
        names[int(dimension), int(tag)] = name.strip().strip('"')
    return names


def _read_2(path: Path, sections: dict[str, list[str]]) -> RawMesh:
    table = np.array([line.split()[:4] for line in sections["Nodes"][1:]], dtype=np.float64)
    names = _names(sections)
    cells: dict[str, list[tuple[list[int], list[str]]]] = defaultdict(list)
    for line in sections["Elements"][1:]:
        values = [int(word) for word in line.split()]
        kind, tags = _kind(path, values[1]), values[2]
        groups = [_group(names, KINDS[kind].dimension, values[3])] if tags and values[3] else []
        cells[kind].append((values[3 + tags :], groups))
    return _mesh(path, table[:, 1:], table[:, 0].astype(np.int64), cells)


def _read_4(path: Path, sections: dict[str, list[str]]) -> RawMesh:
    names, entities = _names(sections), _entities(sections.get("Entities", []))
    lines = iter(sections["Nodes"])
    blocks = int(next(lines).split()[0])
    ids: list[int] = []
    points: list[list[str]] = []
    for _ in range(blocks):
        count = int(next(lines).split()[3])
        ids += [int(next(lines)) for _ in range(count)]
        points += [next(lines).split()[:3] for _ in range(count)]
    lines = iter(sections["Elements"])
    cells: dict[str, list[tuple[list[int], list[str]]]] = defaultdict(list)
    for _ in range(int(next(lines).split()[0])):
        dimension, entity, number, count = (int(word) for word in next(lines).split())
        groups = [_group(names, dimension, tag) for tag in entities.get((dimension, entity), [])]
        kind = _kind(path, number)
        for _ in range(count):
            cells[kind].append(([int(word) for word in next(lines).split()[1:]], groups))
    return _mesh(path, np.array(points, dtype=np.float64), np.array(ids, dtype=np.int64), cells)


def _read_binary_2(path: Path, sections: dict[str, list[str]]) -> RawMesh:
    return _read_binary(path, sections, content_2)


def _read_binary_4(path: Path, sections: dict[str, list[str]]) -> RawMesh:
    return _read_binary(path, sections, content_4)


def _read_binary(path: Path, sections: dict[str, list[str]], content: Callable[..., Content]) -> RawMesh:
    """Read nodes and cells from the bytes of a file, and names, which are text, from its lines."""
    parts, names = binary_sections(path.read_bytes()), _names(sections)
    blocks = content(parts, byte_order(parts["MeshFormat"]), lambda number: KINDS[_kind(path, number)].nodes)
    cells: dict[str, list[tuple[list[int], list[str]]]] = defaultdict(list)
    for block in blocks.elements:
        kind = _kind(path, block.number)
        for nodes, tags in zip(block.nodes.tolist(), block.groups, strict=True):
            cells[kind].append((nodes, [_group(names, KINDS[kind].dimension, tag) for tag in tags]))
    return _mesh(path, blocks.points, blocks.ids, cells)


def _entities(lines: list[str]) -> dict[tuple[int, int], list[int]]:
    """Physical groups of each entity by dimension and number."""
    if not lines:
        return {}
    tags, rest = {}, iter(lines[1:])
    for dimension, count in enumerate(int(word) for word in lines[0].split()):
        for words in (line.split() for _, line in zip(range(count), rest, strict=False)):
            start = 4 if dimension == 0 else 7
            number = int(words[start])
            tags[dimension, int(words[0])] = [int(word) for word in words[start + 1 : start + 1 + number]]
    return tags


def _group(names: dict[tuple[int, int], str], dimension: int, tag: int) -> str:
    """Name of a physical group; a negative number only turns its cells over."""
    return names.get((dimension, abs(tag)), f"{_GROUP[dimension]}_{abs(tag)}")


def _kind(path: Path, number: int) -> str:
    if number not in _KINDS:
        raise TurgorError(f"'{path}' has cells of gmsh's kind {number}; only first and second order can be read.")
    return _KINDS[number]


def _mesh(path: Path, points: np.ndarray, ids: Ints, cells: dict[str, list[tuple[list[int], list[str]]]]) -> RawMesh:
    return RawMesh(path=path, points=points, blocks=tuple(_blocks(path, ids, cells)), node_numbers=ids)


def _blocks(path: Path, ids: Ints, cells: dict[str, list[tuple[list[int], list[str]]]]) -> Iterator[Block]:
    for kind, of_kind in cells.items():
        order = list(_ORDER.get(kind, range(KINDS[kind].nodes)))
        nodes = rows_of(np.array([nodes for nodes, _ in of_kind], dtype=np.int64), ids, path, "node")
        groups: dict[str, list[int]] = defaultdict(list)
        for row, (_, names) in enumerate(of_kind):
            for name in names:
                groups[name].append(row)
        yield Block(
            kind=KINDS[kind],
            nodes=nodes[:, order],
            groups={name: np.array(rows, dtype=np.int64) for name, rows in groups.items()},
        )
