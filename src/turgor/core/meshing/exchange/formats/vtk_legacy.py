"""Read legacy .vtk files: unstructured grids, ASCII or binary, of all versions."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.exchange.formats.raw import Ints, RawMesh
from turgor.core.meshing.exchange.formats.vtk_cells import VtkCells, vtk_mesh
from turgor.foundation.errors import TurgorError

#: Types of numbers; binary ones are written with the high byte first.
_TYPES = {
    "unsigned_char": ">u1",
    "char": ">i1",
    "unsigned_short": ">u2",
    "short": ">i2",
    "unsigned_int": ">u4",
    "int": ">i4",
    "unsigned_long": ">u8",
    "long": ">i8",
    "vtktypeint64": ">i8",
    "vtktypeint32": ">i4",
    "vtkidtype": ">i8",
    "float": ">f4",
    "double": ">f8",
}


class _Scanner:
    """A place in a file, from which words, lines and arrays are taken."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.data = path.read_bytes()
        self.place = 0
        self.binary = False

    def line(self) -> str:
        """Take the rest of the line."""
        end = self.data.find(b"\n", self.place)
        end = len(self.data) if end < 0 else end
        text = self.data[self.place : end].decode("ascii", errors="replace").strip()
        self.place = end + 1
        return text

    def header(self) -> list[str]:
        """Take the next line that is not empty, as words; nothing at the end of the file."""
        while self.place < len(self.data):
            words = self.line().split()
            if words:
                return words
        return []

    def array(self, count: int, type_name: str) -> NDArray:
        """Take numbers of a type."""
        if type_name.lower() not in _TYPES:
            raise TurgorError(f"'{self.path}' has numbers of type '{type_name}'; known: {', '.join(_TYPES)}.")
        if count < 0:  # and so would lead back in the file, again and again
            raise TurgorError(f"'{self.path}' is damaged: it states {count} numbers.")
        kind = np.dtype(_TYPES[type_name.lower()])
        if self.binary:
            end = self.place + count * kind.itemsize
            if end > len(self.data):
                raise TurgorError(f"'{self.path}' breaks off.")
            values = np.frombuffer(self.data[self.place : end], dtype=kind)
            self.place = end
            return values.astype(kind.newbyteorder("="))
        words = self.data[self.place :].split(None, count)
        if len(words) < count:
            raise TurgorError(f"'{self.path}' breaks off.")
        self.place = len(self.data) - (len(words[count]) if len(words) > count else 0)
        try:
            return np.array(words[:count], dtype=np.float64).astype(kind.newbyteorder("="))
        except ValueError:
            raise TurgorError(f"'{self.path}' is damaged: numbers are expected and something else is there.") from None


def read_vtk(path: Path) -> RawMesh:
    """Read a legacy .vtk file.

    Parameters
    ----------
    path : Path

    Returns
    -------
    RawMesh

    Raises
    ------
    TurgorError
        If it is no unstructured grid or breaks off.
    """
    scan = _Scanner(path)
    if "vtk datafile" not in scan.line().lower():
        raise TurgorError(f"'{path}' is no legacy VTK file: its first line does not say so.")
    scan.line()  # title
    scan.binary = scan.line().upper() == "BINARY"
    dataset = scan.header()
    if [word.upper() for word in dataset] != ["DATASET", "UNSTRUCTURED_GRID"]:
        raise TurgorError(f"'{path}' holds {' '.join(dataset[1:]) or 'nothing'}; an UNSTRUCTURED_GRID is needed.")
    return _read(scan)


def _read(scan: _Scanner) -> RawMesh:
    points = np.zeros((0, 3))
    connectivity, offsets, types = (np.zeros(0, dtype=np.int64) for _ in range(3))
    labels: dict[str, Ints] = {}
    while words := scan.header():
        match words[0].upper():
            case "POINTS":
                points = scan.array(3 * int(words[1]), words[2]).reshape(-1, 3).astype(np.float64)
            case "CELLS":
                connectivity, offsets = _cells(scan, int(words[1]), int(words[2]))
            case "CELL_TYPES":
                types = scan.array(int(words[1]), "int").astype(np.int64)
            case "CELL_DATA":
                labels = _labels(scan, int(words[1]))
                break
            case "POINT_DATA":
                break  # fields at nodes are not needed, and labels of cells that follow them are rare
            case "METADATA":
                while scan.line():
                    pass
    return vtk_mesh(scan.path, points, VtkCells(connectivity, offsets, types, labels))


def _cells(scan: _Scanner, count: int, size: int) -> tuple[Ints, Ints]:
    """Nodes of all cells and where each ends, from either of the two forms."""
    before = scan.place
    words = scan.header()
    if words and words[0].upper() == "OFFSETS":  # version 5: one offset more than there are cells
        offsets = scan.array(count, words[1]).astype(np.int64)
        words = scan.header()
        return scan.array(size, words[1]).astype(np.int64), offsets[1:]
    scan.place = before
    table = scan.array(size, "int").astype(np.int64)
    nodes = np.ones(size, dtype=bool)
    ends, place = np.empty(count, dtype=np.int64), 0
    for cell in range(count):  # each cell begins with the number of its nodes
        if place >= size:
            raise TurgorError(f"'{scan.path}' is damaged: its cells are longer than their table.")
        nodes[place] = False
        place += int(table[place]) + 1
        ends[cell] = place - cell - 1
    return table[nodes], ends


def _labels(scan: _Scanner, count: int) -> dict[str, Ints]:
    """Whole numbers of the cells; reading stops at the first thing that is not understood."""
    labels: dict[str, Ints] = {}
    while words := scan.header():
        if words[0].upper() == "SCALARS" and (len(words) < 4 or words[3] == "1"):
            after = scan.place
            if scan.line().split()[:1] != ["LOOKUP_TABLE"]:
                scan.place = after
            values = scan.array(count, words[2])
            if values.dtype.kind in "iu":
                labels[words[1]] = values.astype(np.int64)
        elif words[0].upper() == "FIELD":
            for _ in range(int(words[2])):
                name, width, rows, kind = scan.header()
                values = scan.array(int(width) * int(rows), kind)
                if values.dtype.kind in "iu" and width == "1" and int(rows) == count:
                    labels[name] = values.astype(np.int64)
        else:
            break
    return labels
