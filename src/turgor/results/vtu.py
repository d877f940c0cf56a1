"""VTU files for ParaView: quadratic cells with shared nodes, one file a state, a PVD that lists them.

Everything is in SI units (m, Pa), points and displacement alike, so `Warp By Vector` needs no factor. Each array
carries its unit as VTK's information key ``UNITS_LABEL``.
"""

import base64
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from turgor.meshing.mesh import Mesh
from turgor.model.drive import common_pressure, rises
from turgor.results.fibers import fiber_results
from turgor.results.fields import MeshFacts, StateFields
from turgor.solvers.solution import Solution, State
from turgor.units import kPa

#: Rows and columns of the six components of a symmetric tensor, in VTK's order.
SYMMETRIC = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
SYMMETRIC_NAMES = ("XX", "YY", "ZZ", "XY", "YZ", "XZ")

#: Number of a straight line in VTK files.
VTK_LINE = 3

#: Bytes of a block that is compressed by itself, as VTK's own writer has it.
BLOCK = 32768

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


def write_vtu(path: str | Path, state: State | StateFields) -> None:
    """Write one state as a VTU file with its quadratic cells intact.

    Point data: ``displacement`` [m], ``mean_stress`` [Pa], ``cauchy_stress`` [Pa] (XX, YY, ZZ, XY, YZ, XZ),
    ``von_mises`` [Pa], ``stretch`` (largest principal). Cell data: ``region``, counted in the order of the field
    data ``region_names``. Stresses and stretch are averaged at the nodes over the cells that share them.

    Parameters
    ----------
    path : str or Path
        File to write, ending in ``.vtu``.
    state : State or StateFields
        What to write; the modeled part, not mirrored.
    """
    at = state if isinstance(state, StateFields) else StateFields(state)
    mesh = at.mesh
    cauchy = np.stack([at.cauchy_stress[:, i, j] for i, j in SYMMETRIC], axis=1)
    point_data = [
        VtuArray("displacement", at.displacement.astype("f8"), "m", ("X", "Y", "Z")),
        VtuArray("mean_stress", at.mean_stress.astype("f4"), "Pa"),
        VtuArray("cauchy_stress", cauchy.astype("f4"), "Pa", SYMMETRIC_NAMES),
        VtuArray("von_mises", at.von_mises.astype("f4"), "Pa"),
        VtuArray("stretch", at.stretch.astype("f4")),
    ]
    load_factor = VtuArray("load_factor", np.array([at.state.load_factor], dtype="f8"))
    Path(path).write_text(grid_text(mesh, point_data, [], [load_factor]), encoding="utf-8")


def grid_text(
    mesh: Mesh, point_data: Sequence[VtuArray], cell_data: Sequence[VtuArray], field_data: Sequence[VtuArray]
) -> str:
    """Write a mesh with its curved cells, the region of each, and fields, as the text of a VTU file.

    Parameters
    ----------
    mesh : Mesh
        The modeled part.
    point_data, cell_data, field_data : sequence of VtuArray
        Fields at the nodes, in the cells, and of the whole.

    Returns
    -------
    str
    """
    region = np.empty(len(mesh.cells), dtype="i4")
    for number, cells in enumerate(mesh.regions.values()):
        region[cells] = number
    count = len(mesh.cells)
    connectivity = [
        VtuArray("connectivity", mesh.cells.astype("i4")),
        VtuArray("offsets", (np.arange(count, dtype="i4") + 1) * mesh.cells.shape[1]),
        VtuArray("types", np.full(count, mesh.cell_type.vtk, dtype="u1")),
    ]
    lines = [
        *_opening("UnstructuredGrid"),
        "<UnstructuredGrid>",
        *_section("FieldData", field_data, _region_names(mesh)),
        f'<Piece NumberOfPoints="{len(mesh.points)}" NumberOfCells="{count}">',
        *_section("PointData", point_data),
        *_section("CellData", [VtuArray("region", region), *cell_data]),
        *_section("Points", [VtuArray("points", mesh.points.astype("f8"), "m", ("X", "Y", "Z"))]),
        *_section("Cells", connectivity),
        "</Piece>",
        "</UnstructuredGrid>",
        "</VTKFile>",
    ]
    return "\n".join(lines) + "\n"


def write_series(folder: str | Path, solution: Solution, name: str = "state") -> Path:
    """Write every state of a path as VTU, and a PVD file that lists them for ParaView.

    Discrete threads go to files of their own, ``state_threads_0000.vtu`` … listed in ``state_threads.pvd``.

    The time of the PVD is the pressure in kPa where one pressure acts and grows along the path, or else the load
    factor; a comment in the file says which.

    Parameters
    ----------
    folder : str or Path
        Existing folder to write into.
    solution : Solution
        The path, complete or not.
    name : str
        Beginning of the file names: ``state.pvd``, ``state_0000.vtu`` …

    Returns
    -------
    Path
        The PVD file.
    """
    folder = Path(folder)
    common = common_pressure(solution.model)
    grows = common is not None and rises(common)
    scale, meaning = (common.pressure / kPa, "pressure [kPa]") if common and grows else (1.0, "load factor")
    facts = MeshFacts(solution.model.mesh)
    entries: dict[str, list[str]] = {name: []}
    for number, state in enumerate(solution.states):
        at = StateFields(state, facts)
        texts = {name: "", f"{name}_threads": threads_text(at)}
        for kind in [key for key, text in texts.items() if text or key == name]:
            file = f"{kind}_{number:04d}.vtu"
            if kind == name:
                write_vtu(folder / file, at)
            else:
                (folder / file).write_text(texts[kind], encoding="utf-8")
            time = f"{state.load_factor * scale:.12g}"
            entries.setdefault(kind, []).append(f'<DataSet timestep="{time}" part="0" file={quoteattr(file)}/>')
    for kind, listed in entries.items():
        lines = [*_opening("Collection"), f"<!-- timestep is the {meaning} -->", "<Collection>", *listed]
        text = "\n".join([*lines, "</Collection>", "</VTKFile>"]) + "\n"
        (folder / f"{kind}.pvd").write_text(text, encoding="utf-8")
    return folder / f"{name}.pvd"


def threads_text(at: StateFields) -> str:
    """Write the discrete threads of a state as the text of a VTU file; empty where there are none.

    Every truss is a line between current positions, thread after thread. Cell data: ``tension`` [N], ``stretch``,
    ``winding`` and ``thread``, counted from 0.

    Parameters
    ----------
    at : StateFields
        The modeled part, not mirrored.
    """
    found = [(number, each, each.threads) for number, each in enumerate(fiber_results(at)) if each.threads is not None]
    if not found:
        return ""
    ends = [threads.ends(at.points) for _, _, threads in found]
    points = np.concatenate([pair.reshape(-1, 3) for pair in ends])
    count = len(points) // 2
    lines = [
        VtuArray("connectivity", np.arange(2 * count, dtype="i4")),
        VtuArray("offsets", 2 * (np.arange(count, dtype="i4") + 1)),
        VtuArray("types", np.full(count, VTK_LINE, dtype="u1")),
    ]
    cell_data = [
        VtuArray("tension", np.concatenate([each.tension for _, each, _ in found]).astype("f4"), "N"),
        VtuArray("stretch", np.concatenate([each.stretch for _, each, _ in found]).astype("f4")),
        VtuArray("winding", np.concatenate([np.full(len(t.thread), n, dtype="i4") for n, _, t in found])),
        VtuArray("thread", np.concatenate([threads.thread.astype("i4") for _, _, threads in found])),
    ]
    text = [
        *_opening("UnstructuredGrid"),
        "<UnstructuredGrid>",
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{count}">',
        *_section("CellData", cell_data),
        *_section("Points", [VtuArray("points", points.astype("f8"), "m", ("X", "Y", "Z"))]),
        *_section("Cells", lines),
        "</Piece>",
        "</UnstructuredGrid>",
        "</VTKFile>",
    ]
    return "\n".join(text) + "\n"


def _opening(kind: str) -> list[str]:
    return [
        '<?xml version="1.0"?>',
        f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt32" '
        'compressor="vtkZLibDataCompressor">',
    ]


def _region_names(mesh: Mesh) -> str:
    """Names of the regions as VTK writes strings: the codes of their letters, each name ended by a zero."""
    codes = b"".join(name.encode() + b"\0" for name in mesh.regions)
    return (
        f'<Array type="String" Name="region_names" NumberOfTuples="{len(mesh.regions)}" format="ascii">'
        f"{' '.join(map(str, codes))}</Array>"
    )


def _section(tag: str, arrays: Sequence[VtuArray], more: str = "") -> list[str]:
    return [f"<{tag}>", *(_data_array(array, tag) for array in arrays), *([more] if more else []), f"</{tag}>"]


def _data_array(array: VtuArray, tag: str) -> str:
    values = np.ascontiguousarray(array.values)
    names = "".join(f' ComponentName{k}="{name}"' for k, name in enumerate(array.components))
    components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 and tag != "Cells" else ""
    tuples = f' NumberOfTuples="{len(values)}"' if tag == "FieldData" else ""
    key = '<InformationKey name="UNITS_LABEL" location="vtkDataArray">'
    unit = f"{key}{array.unit}</InformationKey>" if array.unit else ""
    kind = _TYPES[values.dtype.str[1:]]
    head = f'<DataArray type="{kind}" Name="{array.name}"{components}{names}{tuples} format="binary">'
    return f"{head}{_encoded(values)}{unit}</DataArray>"


def _encoded(values: NDArray[Any]) -> str:
    """Compress the bytes of an array in blocks, as VTK reads them: sizes first, then the blocks, both in base64."""
    raw = values.astype(values.dtype.newbyteorder("<")).tobytes()
    blocks = [zlib.compress(raw[start : start + BLOCK], 6) for start in range(0, len(raw), BLOCK)]
    sizes = [len(blocks), BLOCK, len(raw) % BLOCK, *map(len, blocks)]
    header = np.array(sizes, dtype="<u4").tobytes()
    return base64.b64encode(header).decode() + base64.b64encode(b"".join(blocks)).decode()
