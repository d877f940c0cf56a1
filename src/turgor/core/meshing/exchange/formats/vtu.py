"""Read .vtu files: unstructured grids in XML, with text, base64 or raw appended data, compressed or not."""

import base64
import lzma
import re
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.exchange.formats.raw import RawMesh
from turgor.core.meshing.exchange.formats.vtk_cells import VtkCells, vtk_mesh, with_names
from turgor.foundation.errors import TurgorError
from turgor.foundation.store.limits import check_unpacked

_TYPES = {
    "Int8": "i1",
    "UInt8": "u1",
    "Int16": "i2",
    "UInt16": "u2",
    "Int32": "i4",
    "UInt32": "u4",
    "Int64": "i8",
    "UInt64": "u8",
    "Float32": "f4",
    "Float64": "f8",
}
#: What unpacks a block, to at most so many bytes.
_COMPRESSORS: Mapping[str, Callable[[bytes, int], bytes]] = {
    "vtkZLibDataCompressor": lambda data, most: zlib.decompressobj().decompress(data, most),
    "vtkLZMADataCompressor": lambda data, most: lzma.LZMADecompressor().decompress(data, most),
}
_APPENDED = re.compile(rb"<AppendedData\s+encoding=\"(raw|base64)\"\s*>\s*_", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class _File:
    """Settings of all arrays of a file."""

    path: Path
    order: str
    header: str
    compressor: str
    appended: bytes
    appended_encoding: str


def read_vtu(path: Path) -> RawMesh:
    """Read a .vtu file; the pieces of a file with several are put together.

    A file of our own has the names of its regions, its faces and its unit.

    Parameters
    ----------
    path : Path

    Returns
    -------
    RawMesh

    Raises
    ------
    TurgorError
        If it is no unstructured grid, is damaged, or is compressed in a way that cannot be read.
    """
    file, root = _open(path)
    grid = root.find("UnstructuredGrid")
    if grid is None:
        raise TurgorError(f"'{path}' holds {root.get('type', 'nothing')}; an UnstructuredGrid is needed.")
    points, nodes, ends, types, labels = [], [], [], [], []
    node_count = used = 0
    for piece in grid.findall("Piece"):
        arrays = {array.get("Name"): _values(file, array) for array in piece.iterfind("Cells/DataArray")}
        position = piece.find("Points/DataArray")
        if position is None or not {"connectivity", "offsets", "types"} <= set(arrays):
            raise TurgorError(f"'{path}' is damaged: a piece has no points or no cells.")
        points.append(_values(file, position).reshape(-1, 3).astype(np.float64))
        nodes.append(arrays["connectivity"].astype(np.int64) + node_count)
        ends.append(arrays["offsets"].astype(np.int64) + used)
        types.append(arrays["types"].astype(np.int64))
        node_count, used = node_count + len(points[-1]), used + len(nodes[-1])
        labels.append(_labels(file, piece))
    if not points:
        raise TurgorError(f"'{path}' has no piece in it.")
    common = {name for name in labels[0] if all(name in each for each in labels)}
    joined = {name: np.concatenate([each[name] for each in labels]) for name in sorted(common)}
    cells = VtkCells(np.concatenate(nodes), np.concatenate(ends), np.concatenate(types), joined)
    raw = vtk_mesh(path, np.concatenate(points), cells)
    regions = _names(file, grid, "region")
    return _ours(file, grid, raw, regions) if regions else raw


def _ours(file: _File, grid: ElementTree.Element, raw: RawMesh, regions: list[str]) -> RawMesh:
    """Names and unit in a file that `turgor.core.results.files` wrote."""
    arrays = {array.get("Name"): array for array in grid.iterfind("FieldData/DataArray")}
    faces = {}
    names = _names(file, grid, "face")
    if names and {"face_corners", "face_ends"} <= set(arrays):
        corners = _values(file, arrays["face_corners"]).reshape(-1, 4).astype(np.int64)
        ends = _values(file, arrays["face_ends"]).astype(np.int64)
        faces = dict(zip(names, np.split(corners, ends[:-1]), strict=True))
    unit = grid.findtext("Piece/Points/DataArray/InformationKey", default="").strip()
    return replace(with_names(raw, regions, faces), unit=unit)


def _names(file: _File, grid: ElementTree.Element, kind: str) -> list[str]:
    """Names by their numbers, see `turgor.core.results.files.vtu_xml.numbered`; none where they are missing."""
    arrays = {array.get("Name", "").partition(":"): array for array in grid.iterfind("FieldData/DataArray")}
    numbers = {name: int(_values(file, array)[0]) for (of, _, name), array in arrays.items() if of == kind and name}
    if numbers:
        return sorted(numbers, key=numbers.__getitem__)
    for texts in grid.iterfind("FieldData/Array"):  # as turgor wrote them before
        if texts.get("Name") == f"{kind}_names" and texts.get("format") == "ascii":
            return bytes(map(int, (texts.text or "").split())).decode().split("\0")[:-1]
    return []


def _open(path: Path) -> tuple[_File, ElementTree.Element]:
    data = path.read_bytes()
    appended, encoding = b"", "raw"
    match = _APPENDED.search(data)
    if match is not None:  # raw bytes are no XML: they are cut out before the rest is parsed
        end = data.rfind(b"</AppendedData>")
        appended, encoding = data[match.end() : end], match[1].decode().lower()
        data = data[: match.start()] + data[end + len(b"</AppendedData>") :]
    try:
        root = ElementTree.fromstring(data)
    except ElementTree.ParseError as error:
        raise TurgorError(f"'{path}' is no VTU file: {error}.") from error
    return (
        _File(
            path=path,
            order=">" if root.get("byte_order") == "BigEndian" else "<",
            header=_TYPES.get(root.get("header_type", "UInt32"), "u4"),
            compressor=root.get("compressor", ""),
            appended=appended,
            appended_encoding=encoding,
        ),
        root,
    )


def _labels(file: _File, piece: ElementTree.Element) -> dict[str, NDArray]:
    labels = {}
    for array in piece.iterfind("CellData/DataArray"):
        whole = array.get("type", "").startswith(("Int", "UInt"))
        if whole and array.get("NumberOfComponents", "1") in ("1", "0"):
            labels[array.get("Name", "label")] = _values(file, array).astype(np.int64)
    return labels


def _values(file: _File, array: ElementTree.Element) -> NDArray:
    """Numbers of a DataArray."""
    name, kind = array.get("type", ""), _TYPES.get(array.get("type", ""))
    if kind is None:
        raise TurgorError(f"'{file.path}' has numbers of type '{name}'; known: {', '.join(_TYPES)}.")
    form, text = array.get("format", "ascii"), array.text or ""
    try:
        if form == "ascii":
            return np.array(text.split(), dtype=np.float64 if kind[0] == "f" else np.int64).astype(kind)
        if form == "appended":
            start = int(array.get("offset", "0"))
            data, encoded = file.appended[start:], file.appended_encoding == "base64"
        else:
            data, encoded = "".join(text.split()).encode(), True
        return np.frombuffer(_bytes(file, data, encoded), dtype=file.order + kind).astype(kind)
    except (ValueError, IndexError, zlib.error, lzma.LZMAError) as error:
        if isinstance(error, TurgorError):
            raise
        raise TurgorError(f"'{file.path}' is damaged: its array '{array.get('Name', '')}' cannot be read.") from error


def _bytes(file: _File, data: bytes, encoded: bool) -> bytes:
    """Content of an array behind its header: the size, or for compressed data the sizes of its blocks."""
    header = np.dtype(file.order + file.header)
    if not file.compressor:
        size = int(np.frombuffer(_part(data, encoded, 0, header.itemsize), dtype=header)[0])
        return _part(data, encoded, 0, header.itemsize + size)[header.itemsize :]
    unpack = _COMPRESSORS.get(file.compressor)
    if unpack is None:
        known = ", ".join(_COMPRESSORS)
        raise TurgorError(f"'{file.path}' is compressed by {file.compressor}; known: {known}. Save it uncompressed.")
    count = int(np.frombuffer(_part(data, encoded, 0, header.itemsize), dtype=header)[0])
    length = (3 + count) * header.itemsize
    numbers = np.frombuffer(_part(data, encoded, 0, length), dtype=header)
    block, sizes = int(numbers[1]), numbers[3:].astype(np.int64)
    check_unpacked(f"'{file.path}'", len(data), count * block)
    start = 4 * -(-length // 3) if encoded else length  # header and blocks are encoded apart
    packed = _part(data[start:], encoded, 0, int(sizes.sum()))
    ends = np.cumsum(sizes)
    return b"".join(unpack(packed[end - size : end], block) for end, size in zip(ends, sizes, strict=True))


def _part(data: bytes, encoded: bool, start: int, end: int) -> bytes:
    """Some bytes of an array, decoded if need be."""
    if not encoded:
        return data[start:end]
    letters = 4 * -(-end // 3)
    return base64.b64decode(data[:letters])[start:end]
