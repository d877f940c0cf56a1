"""Nodes, cells, sets and surfaces of a mesh in .inp files."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.inp.context import Context, plain, rows_of
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.exchange.formats.abaqus_sets import SIDES
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Ints = NDArray[np.int64]


def mesh_lines(context: Context, reduced: bool) -> list[str]:
    """Write nodes, cells and sets; regions of foam have no hybrid cells in Abaqus, since they need none."""
    mesh = context.model.mesh
    tetrahedra = mesh.cell_type is TETRAHEDRON
    kind = "C3D10" if tetrahedra else ("C3D20R" if reduced else "C3D20")
    foams = [name for name, each in context.model.region_materials.items() if each.is_foam]
    cells = mesh.cells[:, : 10 if tetrahedra else 20]
    _account(context, kind)
    lines = ["*NODE, NSET=Nall", *node_lines(mesh.points, np.unique(cells))]
    for name, rows in mesh.regions.items():
        hybrid = "H" if context.for_abaqus and name not in foams else ""
        lines.append(f"*ELEMENT, TYPE={kind}{hybrid}, ELSET={plain(name)}")
        for row in rows.tolist():
            lines += rows_of([row + 1, *(cells[row] + 1).tolist()], first=16)
    lines += ["*ELSET, ELSET=Eall", *(f"{plain(name)}," for name in mesh.regions)]
    for name, sides in mesh.faces.items():
        nodes = np.unique(sides[:, : 6 if tetrahedra else 8])
        lines += [f"*NSET, NSET={plain(name)}", *rows_of((nodes + 1).tolist())]
        lines += surface_lines(plain(name), cell_faces(mesh, name))
    return lines


def _account(context: Context, kind: str) -> None:
    mesh = context.model.mesh
    cells = f"{len(mesh.cells)} cells {kind}{'H' if context.for_abaqus else ''}"
    own = "mean stresses as Abaqus has them" if context.for_abaqus else "without mean stresses"
    if mesh.cell_type.side.nodes == 9:
        context.approximated("mesh", f"{cells}, of 20 nodes instead of 27, {own}")
    else:
        context.written("mesh", f"{cells}, {own}")
    if mesh.revolved:
        context.approximated("mesh", "a quarter of a ring, whose nodes need not move alike around the axis")


def node_lines(points: NDArray[np.float64], rows: Ints, first: int = 1) -> list[str]:
    """Return a line for each of some points [m], whose row 0 has the number ``first``."""
    return [
        f"{node + first}, {x:.12g}, {y:.12g}, {z:.12g}"
        for node, (x, y, z) in zip(rows.tolist(), (points[rows] / mm).tolist(), strict=True)
    ]


def surface_lines(name: str, sides: list[tuple[int, int]]) -> list[str]:
    """Return a surface of sides of cells."""
    return [f"*SURFACE, NAME={name}, TYPE=ELEMENT", *(f"{cell + 1}, S{side}" for cell, side in sides)]


def cell_faces(mesh: Mesh, name: str) -> list[tuple[int, int]]:
    """Find the cell and the number of its face, as Abaqus counts them, of each side of a named face.

    Parameters
    ----------
    mesh : Mesh
    name : str
        Name of the face.

    Returns
    -------
    list of (int, int)
        Cell, counted from 0, and face, counted from 1.
    """
    places = faces_of_sides(mesh, mesh.face(name))
    if places is None:
        raise TurgorError(f"face '{name}' has sides that belong to no cell.")
    return places


def faces_of_sides(mesh: Mesh, sides: Ints) -> list[tuple[int, int]] | None:
    """Find the cell and its face of each of some sides (f, n); None where a side belongs to no cell."""
    corners = mesh.cell_type.corners
    width = mesh.cell_type.side.corners
    table = np.array(SIDES[corners])
    all_sides = np.sort(mesh.cells[:, table].reshape(-1, width), axis=1)
    requested = np.sort(sides[:, :width], axis=1)
    _, number = np.unique(np.concatenate([all_sides, requested]), axis=0, return_inverse=True)
    number = np.asarray(number).ravel()
    first = np.full(number.max(initial=0) + 1, -1, dtype=np.int64)
    first[number[: len(all_sides)][::-1]] = np.arange(len(all_sides))[::-1]
    places = first[number[len(all_sides) :]]
    if (places < 0).any():
        return None
    return [(place // len(table), place % len(table) + 1) for place in places.tolist()]
