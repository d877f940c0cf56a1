"""XML of VTK files: arrays compressed as VTK's own writer does it, and grids of simple cells."""

import base64
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any
from xml.sax.saxutils import escape, quoteattr

import numpy as np
from numpy.typing import NDArray

#: Numbers of a straight line and of a flat triangle in VTK files, by how many points they have.
SIMPLE = {2: 3, 3: 5}

#: Bytes of a block that is compressed by itself, as VTK's own writer has it, and how hard: numbers do not get smaller
#: by more than 1 %, whatever is tried.
BLOCK, LEVEL = 32768, 1

_TYPES = {"f8": "Float64", "f4": "Float32", "i4": "Int32", "u1": "UInt8"}


@dataclass(frozen=True, slots=True, eq=False)
class VtuArray:
    """A named array with its unit and the names of its components.

    Parameters
    ----------
    name : str
        Name under which ParaView lists it.
    values : (n,) or (n, k) array
        A row for each point or cell.
    unit : str
        Unit, empty for a pure number.
    components : tuple of str
        Names of the k columns.
    """

    name: str
    values: NDArray[Any]
    unit: str = ""
    components: tuple[str, ...] = ()


def opening(kind: str) -> list[str]:
    """Begin a file of a kind."""
    return [
        '<?xml version="1.0"?>',
        f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt32" '
        'compressor="vtkZLibDataCompressor">',
    ]


def numbered(kind: str, names: Sequence[str]) -> list[VtuArray]:
    """Field data that say which number stands for which name: ``region:body`` holds the number of the region body.

    VTK has arrays of text, but meshio reads no file that has one.

    Examples
    --------
    >>> [(each.name, each.values.tolist()) for each in numbered("region", ["body", "base"])]
    [('region:body', [0]), ('region:base', [1])]
    """
    return [VtuArray(f"{kind}:{name}", np.array([number], dtype="i4")) for number, name in enumerate(names)]


def simple_grid(
    points: NDArray[np.float64],
    cells: NDArray[np.int64],
    cell_data: Sequence[VtuArray],
    field_data: Sequence[VtuArray] = (),
) -> str:
    """Write lines or flat triangles with a field in each, as the text of a VTU file.

    Parameters
    ----------
    points : (p, 3) array [m]
    cells : (c, 2) or (c, 3) int array
    cell_data, field_data : sequence of VtuArray
        Fields in the cells, and of the whole.
    """
    count, corners = cells.shape
    connectivity = [
        VtuArray("connectivity", cells.astype("i4")),
        VtuArray("offsets", corners * (np.arange(count, dtype="i4") + 1)),
        VtuArray("types", np.full(count, SIMPLE[corners], dtype="u1")),
    ]
    text = [
        *opening("UnstructuredGrid"),
        "<UnstructuredGrid>",
        *(section("FieldData", field_data) if field_data else []),
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{count}">',
        *section("CellData", cell_data),
        *section("Points", [VtuArray("points", points.astype("f8"), "m", ("X", "Y", "Z"))]),
        *section("Cells", connectivity),
        "</Piece>",
        "</UnstructuredGrid>",
        "</VTKFile>",
    ]
    return "\n".join(text) + "\n"


def section(tag: str, arrays: Sequence[VtuArray]) -> list[str]:
    """Write arrays into a section."""
    return [f"<{tag}>", *(_data_array(array, tag) for array in arrays), f"</{tag}>"]


def _data_array(array: VtuArray, tag: str) -> str:
    values = np.ascontiguousarray(array.values)
    names = "".join(f' ComponentName{k}="{name}"' for k, name in enumerate(array.components))
    components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 and tag != "Cells" else ""
    tuples = f' NumberOfTuples="{len(values)}"' if tag == "FieldData" else ""
    key = '<InformationKey name="UNITS_LABEL" location="vtkDataArray">'
    unit = f"{key}{escape(array.unit)}</InformationKey>" if array.unit else ""
    kind = _TYPES[values.dtype.str[1:]]
    head = f'<DataArray type="{kind}" Name={quoteattr(array.name)}{components}{names}{tuples} format="binary">'
    return f"{head}{_encoded(values)}{unit}</DataArray>"


def _encoded(values: NDArray[Any]) -> str:
    """Compress the bytes of an array in blocks, as VTK reads them: sizes first, then the blocks, both in base64."""
    raw = values.astype(values.dtype.newbyteorder("<")).tobytes()
    blocks = [zlib.compress(raw[start : start + BLOCK], LEVEL) for start in range(0, len(raw), BLOCK)]
    sizes = [len(blocks), BLOCK, len(raw) % BLOCK, *map(len, blocks)]
    header = np.array(sizes, dtype="<u4").tobytes()
    return base64.b64encode(header).decode() + base64.b64encode(b"".join(blocks)).decode()
