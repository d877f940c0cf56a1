"""Sections of binary .msh files: versions 2.2 and 4.1, in either byte order."""

import re
import struct
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.exchange.formats.raw import Array, Ints

_OPENING = re.compile(rb"\$(\w+)\s*?\n")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Elements:
    """Cells of one kind.

    Parameters
    ----------
    number : int
        gmsh's number of the kind.
    nodes : (n, k) int array
        Numbers of their nodes in the file.
    groups : list of list of int
        Physical groups of each cell.
    """

    number: int
    nodes: Ints
    groups: list[list[int]]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Content:
    """Nodes and cells of a file.

    Parameters
    ----------
    points : (n, 3) float array
    ids : (n,) int array
        Number of each point in the file.
    elements : list of Elements
    """

    points: Array
    ids: Ints
    elements: list[Elements]


def binary_sections(data: bytes) -> dict[str, bytes]:
    """Return the bytes between ``$Name`` and ``$EndName`` of each section."""
    parts, start = {}, 0
    while (match := _OPENING.search(data, start)) is not None:
        name = match[1].decode()
        end = data.find(b"$End" + match[1], match.end())
        if end < 0:
            raise ValueError(f"the section ${name} has no end")
        parts[name] = data[match.end() : end]
        start = end + len(name) + 4
    return parts


def byte_order(header: bytes) -> str:
    """Return ``"<"`` or ``">"`` from the section MeshFormat: a line of text, then the number one."""
    (one,) = struct.unpack("<i", header[header.index(b"\n") + 1 :][:4])
    return "<" if one == 1 else ">"


class _Reader:
    """Numbers of a section, one after the other."""

    def __init__(self, data: bytes, order: str) -> None:
        self.data, self.order, self.place = data, order, 0

    def take(self, kind: str, count: int) -> NDArray:
        """Return the next numbers of a kind such as ``"i4"``."""
        kind = self.order + kind
        if count < 0 or self.place + count * int(kind[2:]) > len(self.data):
            raise ValueError("a section is too short")
        values = np.frombuffer(self.data, dtype=kind, count=count, offset=self.place)
        self.place += values.nbytes
        return values

    def line(self) -> int:
        """Return the whole number of a line of text."""
        end = self.data.index(b"\n", self.place)
        number = int(self.data[self.place : end])
        self.place = end + 1
        return number


def content_2(sections: dict[str, bytes], order: str, size: Callable[[int], int]) -> Content:
    """Read nodes and cells of version 2.2.

    Parameters
    ----------
    sections : dict of str to bytes
    order : str
        Byte order.
    size : callable
        Returns the nodes of a cell of a kind, by gmsh's number.

    Raises
    ------
    ValueError
        If a section is too short.
    """
    nodes = _Reader(sections["Nodes"], order)
    count = nodes.line()
    row = np.dtype([("id", order + "i4"), ("x", order + "f8", 3)])
    table = nodes.take("u1", row.itemsize * count).view(row)
    cells, elements = _Reader(sections["Elements"], order), []
    remaining = cells.line()
    while remaining > 0:
        number, follow, tags = cells.take("i4", 3).tolist()
        width = 1 + tags + size(number)
        if follow < 1 or tags < 0:
            raise ValueError("a block of cells is empty")
        values = cells.take("i4", follow * width).reshape(follow, width).astype(np.int64)
        groups = [[tag] if tag else [] for tag in values[:, 1].tolist()] if tags else [[] for _ in range(follow)]
        elements.append(Elements(number=number, nodes=values[:, 1 + tags :], groups=groups))
        remaining -= follow
    return Content(points=table["x"].astype(np.float64), ids=table["id"].astype(np.int64), elements=elements)


def content_4(sections: dict[str, bytes], order: str, size: Callable[[int], int]) -> Content:
    """Read nodes and cells of version 4.1; as `content_2`."""
    groups = _entities(_Reader(sections["Entities"], order)) if "Entities" in sections else {}
    reader = _Reader(sections["Nodes"], order)
    points, ids = [np.zeros((0, 3))], [np.zeros(0, dtype=np.int64)]
    for _ in range(_blocks(reader)):
        dimension, _, parametric = reader.take("i4", 3).tolist()
        (count,) = reader.take("u8", 1).tolist()
        ids.append(reader.take("u8", count).astype(np.int64))
        columns = 3 + (dimension if parametric else 0)
        points.append(reader.take("f8", count * columns).reshape(count, columns)[:, :3].astype(np.float64))
    reader, elements = _Reader(sections["Elements"], order), []
    for _ in range(_blocks(reader)):
        dimension, entity, number = reader.take("i4", 3).tolist()
        (count,) = reader.take("u8", 1).tolist()
        width = 1 + size(number)
        values = reader.take("u8", count * width).reshape(count, width).astype(np.int64)
        own = groups.get((dimension, entity), [])
        elements.append(Elements(number=number, nodes=values[:, 1:], groups=[own] * count))
    return Content(points=np.concatenate(points), ids=np.concatenate(ids), elements=elements)


def _blocks(reader: _Reader) -> int:
    """Number of blocks, from the four numbers at the top of a section of version 4.1."""
    return int(reader.take("u8", 4)[0])


def _entities(reader: _Reader) -> dict[tuple[int, int], list[int]]:
    """Physical groups of each entity by dimension and number."""
    tags = {}
    for dimension, count in enumerate(reader.take("u8", 4).tolist()):
        for _ in range(count):
            (entity,) = reader.take("i4", 1).tolist()
            reader.take("f8", 3 if dimension == 0 else 6)
            tags[dimension, entity] = reader.take("i4", int(reader.take("u8", 1)[0])).tolist()
            if dimension:
                reader.take("i4", int(reader.take("u8", 1)[0]))
    return tags
