"""VTU files for ParaView: quadratic cells with shared nodes, one file a state, a PVD that lists them.

Everything is in SI units (m, Pa), points and displacement alike, so `Warp By Vector` needs no factor. Each array
carries its unit as VTK's information key ``UNITS_LABEL``.
"""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.refining.region_nodes import RegionNodes
from turgor.core.model.drive import common_pressure, rises
from turgor.core.results.drive import stage_column
from turgor.core.results.fields.contact import extents_of
from turgor.core.results.fields.path_fields import PathFields
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.files.vtu_overlays import obstacles_text, threads_text
from turgor.core.results.files.vtu_xml import VtuArray, numbered, opening, section
from turgor.core.solvers.solution import Solution, State
from turgor.foundation.errors import TurgorError
from turgor.foundation.symmetric import PAIRS
from turgor.units import kPa

#: Names of the six components of a symmetric tensor.
SYMMETRIC_NAMES = ("XX", "YY", "ZZ", "XY", "YZ", "XZ")


def write_state(path: str | Path, state: State | StateFields) -> None:
    """Write one state as a VTU file with its quadratic cells intact.

    Point data: ``displacement`` [m], ``mean_stress`` [Pa], ``cauchy_stress`` [Pa] (XX, YY, ZZ, XY, YZ, XZ),
    ``von_mises`` [Pa], ``stretch`` (largest principal), ``node``, ``contact_pressure`` [Pa] where anything may touch,
    and ``bond_damage`` where bodies are bonded.
    Cell data: ``region``, the number that the field data ``region:NAME`` give its name. Stresses and stretch
    are averaged at the nodes over the cells of one region. Where regions meet the points are doubled, one for each
    region, so that fields jump there as they should; ``node`` says which node of the mesh a point is. Field data:
    ``von_mises_p99`` [Pa] and ``principal_stretch_p99``, below which 99 % of the volume lie, the load, and
    ``stage:NAME`` in a sequence. All arrays hold numbers, so that meshio reads the files, too.

    Parameters
    ----------
    path : str or Path
        File to write, ending in ``.vtu``.
    state : State or StateFields
        What to write; the modeled part, not mirrored.
    """
    at = state if isinstance(state, StateFields) else StateFields(state)
    nodes = at.facts.region_nodes
    cauchy = np.stack([at.cauchy_stress[:, i, j] for i, j in PAIRS], axis=1)
    point_data = [
        VtuArray("displacement", at.displacement[nodes.node].astype("f8"), "m", ("X", "Y", "Z")),
        VtuArray("mean_stress", at.mean_stress.astype("f4"), "Pa"),
        VtuArray("cauchy_stress", cauchy.astype("f4"), "Pa", SYMMETRIC_NAMES),
        VtuArray("von_mises", at.von_mises.astype("f4"), "Pa"),
        VtuArray("stretch", at.stretch.astype("f4")),
        VtuArray("node", nodes.node.astype("i4")),
    ]
    if at.state.touches:
        point_data.append(VtuArray("contact_pressure", at.contact_pressure[nodes.node].astype("f4"), "Pa"))
    if at.model.bonds:
        point_data.append(VtuArray("bond_damage", at.bond_damage[nodes.node].astype("f4")))
    of_state = [
        VtuArray("load_factor", np.array([at.state.load_factor], dtype="f8")),
        VtuArray("von_mises_p99", np.array([at.von_mises_p99]), "Pa"),
        VtuArray("principal_stretch_p99", np.array([at.stretch_p99])),
    ]
    for face, pressure in at.state.pressures.items():
        of_state.append(VtuArray(f"{face}_pressure", np.array([pressure], dtype="f8"), "Pa"))
    if at.state.velocity is not None:
        point_data.append(VtuArray("velocity", at.state.velocity[nodes.node].astype("f4"), "m/s", ("X", "Y", "Z")))
    of_state += numbered("stage", [at.state.stage] if at.state.stage else [])
    Path(path).write_text(grid_text(at.mesh, point_data, [], of_state, nodes), encoding="utf-8")


def grid_text(
    mesh: Mesh,
    point_data: Sequence[VtuArray],
    cell_data: Sequence[VtuArray],
    field_data: Sequence[VtuArray],
    nodes: RegionNodes | None = None,
) -> str:
    """Write a mesh with its curved cells, the region of each, and fields, as the text of a VTU file.

    Parameters
    ----------
    mesh : Mesh
        The modeled part.
    point_data, cell_data, field_data : sequence of VtuArray
        Fields at the nodes, in the cells, and of the whole.
    nodes : RegionNodes, optional
        What the fields at the nodes belong to; by default the nodes of the mesh, which regions share.

    Returns
    -------
    str
    """
    alone = not len(mesh.cells)
    region = np.zeros(len(mesh.pieces), dtype="i4")
    for number, chosen in enumerate(mesh.regions.values()):
        region[chosen] = number
    points, cells = (mesh.points, mesh.pieces) if nodes is None else (mesh.points[nodes.node], nodes.cells)
    count = len(cells)
    connectivity = [
        VtuArray("connectivity", cells.astype("i4")),
        VtuArray("offsets", (np.arange(count, dtype="i4") + 1) * cells.shape[1]),
        VtuArray("types", np.full(count, mesh.cell_type.side.vtk if alone else mesh.cell_type.vtk, dtype="u1")),
    ]
    lines = [
        *opening("UnstructuredGrid"),
        "<UnstructuredGrid>",
        *section("FieldData", [*field_data, *numbered("region", list(mesh.regions))]),
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{count}">',
        *section("PointData", point_data),
        *section("CellData", [VtuArray("region", region), *cell_data]),
        *section("Points", [VtuArray("points", points.astype("f8"), "m", ("X", "Y", "Z"))]),
        *section("Cells", connectivity),
        "</Piece>",
        "</UnstructuredGrid>",
        "</VTKFile>",
    ]
    return "\n".join(lines) + "\n"


def _times(solution: Solution) -> tuple[list[float], str]:
    """Values that order the states in ParaView, and their meaning."""
    clock = [state.time for state in solution.states if state.time is not None]
    if len(clock) == len(solution.states):
        return clock, "time [s]"
    factors = [state.load_factor for state in solution.states]
    common, stages = common_pressure(solution.model.loads), stage_column(solution)
    order = stages[0].values.tolist() if stages else factors
    if any(b <= a for a, b in pairwise(order)):
        return [float(number) for number in range(len(order))], "number of the state"
    if stages:
        return order, "number of finished stages and the load factor of the next one"
    if common is not None and rises(common):
        return [factor * (common.pressure / kPa) for factor in factors], "pressure [kPa]"
    return factors, "load factor"


def write_vtu(of: Solution | State, path: str | Path) -> Path:
    """Write VTU files for ParaView: one file of a state, or a series of all states of a solution.

    The fields are those that `write_state` lists, in SI units; `write_series` says what lies next to them.

    Parameters
    ----------
    of : Solution or State
        What to write; the modeled part, not mirrored.
    path : str or Path
        A file that ends in ``.vtu`` for a state. For a solution a folder, in which the series is called
        ``state.pvd``, or a file that ends in ``.pvd``; the folder is made where it is not there.

    Returns
    -------
    Path
        The file to open: that of the state, or the PVD file.

    Raises
    ------
    TurgorError
        If the ending of the path does not fit.

    Examples
    --------
    >>> write_vtu("finger.vtu", None)
    Traceback (most recent call last):
    turgor.TurgorError: write_vtu takes a solution or a state first, then the path; the first is a str.
    """
    if not isinstance(of, Solution | State):
        raise TurgorError(
            f"write_vtu takes a solution or a state first, then the path; the first is a {type(of).__name__}."
        )
    path = Path(path)
    if isinstance(of, Solution):
        if path.suffix.lower() not in ("", ".pvd"):
            raise TurgorError(
                f"path '{path}' ends in '{path.suffix}'; a solution has {len(of.states)} states and needs a folder or "
                "a .pvd file. One of them is written by write_vtu(solution.states[-1], ...)."
            )
        return write_series(path.parent, of, path.stem) if path.suffix else write_series(path, of)
    if path.suffix.lower() != ".vtu":
        raise TurgorError(f"path '{path}' ends in '{path.suffix}'; the file of a state ends in .vtu.")
    path.parent.mkdir(parents=True, exist_ok=True)
    write_state(path, of)
    return path


def series_files(name: str, states: int) -> list[str]:
    """Return the names of all files that `write_series` may write for as many states.

    Examples
    --------
    >>> series_files("state", 1)[:3]
    ['state.pvd', 'state_0000.vtu', 'state_threads.pvd']
    """
    kinds = (name, f"{name}_threads", f"{name}_obstacles")
    return [file for kind in kinds for file in (f"{kind}.pvd", *(f"{kind}_{k:04d}.vtu" for k in range(states)))]


def write_series(folder: str | Path, solution: Solution, name: str = "state", fields: PathFields | None = None) -> Path:
    """Write every state of a path as VTU, and a PVD file that lists them for ParaView.

    Discrete threads go to files of their own, ``state_threads_0000.vtu`` … listed in ``state_threads.pvd``, and so do
    obstacles, ``state_obstacles_0000.vtu`` …, each at its place.

    The time of the PVD is that of a motion in seconds; else in a sequence how many stages are finished, with the load
    factor of the next one; else the pressure in kPa where one pressure acts and grows along the path, or the load
    factor. Where even that falls it is the number of the state. A comment in the file says which.

    Parameters
    ----------
    folder : str or Path
        Folder to write into; made where it is not there.
    solution : Solution
        The path, complete or not.
    name : str
        Beginning of the file names: ``state.pvd``, ``state_0000.vtu`` …
    fields : PathFields, optional
        Fields of the solution that others read, too.

    Returns
    -------
    Path
        The PVD file.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    times, meaning = _times(solution)
    path = fields or PathFields(solution, most=0)
    extents = extents_of(StateFields(state, path.facts) for state in solution.states)
    entries: dict[str, list[str]] = {name: []}
    for number, at in enumerate(path):
        texts = {name: "", f"{name}_threads": threads_text(at), f"{name}_obstacles": obstacles_text(at, extents)}
        for kind in [key for key, text in texts.items() if text or key == name]:
            file = f"{kind}_{number:04d}.vtu"
            if kind == name:
                write_state(folder / file, at)
            else:
                (folder / file).write_text(texts[kind], encoding="utf-8")
            time = f"{times[number]:.12g}"
            entries.setdefault(kind, []).append(f'<DataSet timestep="{time}" part="0" file={quoteattr(file)}/>')
    for kind, listed in entries.items():
        lines = [*opening("Collection"), f"<!-- timestep is the {meaning} -->", "<Collection>", *listed]
        text = "\n".join([*lines, "</Collection>", "</VTKFile>"]) + "\n"
        (folder / f"{kind}.pvd").write_text(text, encoding="utf-8")
    return folder / f"{name}.pvd"
