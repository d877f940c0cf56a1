"""Plane meshes of files: moved along a line for plane strain, or turned about an axis for a body of revolution.

What comes out has hexahedra, so that names, laws, pressure, contact and pictures are those of any mesh.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.directions import FileAxes, rotation_to
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing.exchange.formats.raw import KINDS, Block, RawMesh
from turgor.core.meshing.exchange.frame import Frame
from turgor.core.meshing.mesh import PINHOLE
from turgor.core.meshing.revolved.axisymmetric import AROUND, roundness
from turgor.core.meshing.revolved.plane_cells import PlaneCells, plane_cells
from turgor.core.meshing.revolved.plane_state import Axisymmetric, PlaneState
from turgor.core.meshing.sweeping.hexahedra import PLACES, TURNED_OVER
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Mirror planes of a layer in plane strain. Two planes make four images, so the layer has a quarter of the thickness.
FRONT, BACK = "symmetry_front", "symmetry_back"
IMAGES = 4


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Layers:
    """Positions of the nodes at each station (s, n, 3), names of the first and the last, and of the axis if any."""

    stations: Array
    ends: tuple[str, str]
    revolved: str = ""


def spread(raw: RawMesh, state: PlaneState, frame: Frame) -> tuple[RawMesh, str]:
    """Make hexahedra out of the plane cells of a file.

    Parameters
    ----------
    raw : RawMesh
        With triangles or quadrilaterals in a plane across x, y or z, and no solid cells.
    state : PlaneStrain or Axisymmetric
    frame : Frame
        Unit and axes of the file.

    Returns
    -------
    RawMesh
        Groups are those of the cells, named edges are surfaces, and both cut faces are mirror planes.
    str
        What was done, one clause.

    Raises
    ------
    TurgorError
        If there are solid cells or no plane ones, if they lie in no such plane, or reach across the axis.
    """
    flat = [block for block in raw.blocks if block.kind.dimension == 2 and len(block.nodes)]
    if raw.solids() or not flat:
        what = "solid cells" if raw.solids() else "no triangles or quadrilaterals"
        raise TurgorError(f"'{raw.path}' has {what}; plane strain and axisymmetric states need a plane mesh.")
    normal = _normal(raw, flat)
    plane = [i for i in range(3) if i != normal]
    if isinstance(state, Axisymmetric) and state.axis == "xyz"[normal]:
        raise TurgorError(f"'{raw.path}' is plane across {state.axis}, so that {state.axis} cannot be its axis.")
    cells = plane_cells(raw.points[:, plane], flat)
    if isinstance(state, Axisymmetric):
        layers = _turned(raw, cells, frame, ("xyz".index(state.axis), normal))
    else:
        layers = _moved(raw, cells, normal, state.thickness / IMAGES / frame.scale)
    return _hexahedra(raw, cells, layers), _done(flat, cells, state)


def _normal(raw: RawMesh, flat: Sequence[Block]) -> int:
    used = raw.points[np.unique(np.concatenate([block.nodes.ravel() for block in flat]))]
    extent = np.ptp(used, axis=0)
    normal = int(extent.argmin())
    if not extent[normal] <= TOLERANCE.square * extent.max():
        raise TurgorError(f"'{raw.path}' has no solid cells, and its surface lies in no plane across x, y or z.")
    return normal


def _moved(raw: RawMesh, cells: PlaneCells, normal: int, depth: float) -> _Layers:
    """Three stations of one layer."""
    points = _in_space(cells, normal, float(raw.points[:, normal].mean()))
    step = np.zeros(3)
    step[normal] = depth / 2
    return _Layers(stations=np.stack([points + k * step for k in range(3)]), ends=(FRONT, BACK))


def _turned(raw: RawMesh, cells: PlaneCells, frame: Frame, axes: tuple[int, int]) -> _Layers:
    """Stations of a quarter: from the plane of the mesh about its axis to the normal of this plane."""
    axis, normal = axes
    radial = 3 - axis - normal
    points = _in_space(cells, normal, 0.0)
    radii = points[np.unique(cells.quads), radial]
    if radii.min() < -PINHOLE * radii.max():
        raise TurgorError(
            f"'{raw.path}' reaches across its axis {'xyz'[axis]}: to {'xyz'[radial]} = {radii.min():.6g}; an "
            "axisymmetric mesh has one side of the axis only."
        )
    radius = np.maximum(points[:, radial], PINHOLE * radii.max()) * roundness()
    angles = np.linspace(0.0, pi / 2, 2 * AROUND + 1)
    stations = np.repeat(points[None], len(angles), axis=0)
    stations[:, :, radial] = np.cos(angles)[:, None] * radius
    stations[:, :, normal] = np.sin(angles)[:, None] * radius
    ours = _letters(frame.axes)
    return _Layers(
        stations=stations,
        ends=(f"symmetry_{ours[normal]}", f"symmetry_{ours[radial]}"),
        revolved=ours[axis],
    )


def _letters(axes: FileAxes) -> str:
    """Our letter of each axis of the file."""
    rotation = np.abs(rotation_to(axes))
    if (np.sort(rotation, axis=1)[:, 1] > TOLERANCE.square).any():
        raise TurgorError(f"axes are {axes!r}; those of an axisymmetric mesh must be along x, y and z of the file.")
    return "".join("xyz"[i] for i in rotation.argmax(axis=0))


def _in_space(cells: PlaneCells, normal: int, level: float) -> Array:
    return np.insert(cells.points, normal, level, axis=1)


def _hexahedra(raw: RawMesh, cells: PlaneCells, layers: _Layers) -> RawMesh:
    """The content of the file on hexahedra between the stations."""
    count, size = layers.stations.shape[:2]
    station, node = np.array(PLACES).T
    quads = cells.quads if _is_right_handed(cells, layers) else cells.quads[:, TURNED_OVER]
    solid = np.concatenate([quads[:, node] + (2 * k + station) * size for k in range(count // 2)])
    number = len(quads)
    groups = {
        name: np.concatenate([rows + k * number for k in range(count // 2)]) for name, rows in cells.groups.items()
    }
    some = {
        name: rows for name, rows in raw.node_sets.items() if len(rows) < len(raw.points)
    }  # a set of all is no face
    node_sets = {name: _rows(_with_middles(cells, rows), size, count) for name, rows in some.items()}
    surfaces = {name: _sides(cells, ends[:, :2], size, count) for name, ends in raw.surfaces.items()}
    for block in raw.blocks:
        for name, rows in block.groups.items():
            if block.kind.dimension == 1:
                sides = _sides(cells, block.nodes[rows, :2], size, count)
                surfaces[name] = np.concatenate([surfaces.get(name, sides[:0]), sides])
            elif block.kind.dimension == 0:
                node_sets[name] = _rows(block.nodes[rows].ravel(), size, count)
    first, last = quads[:, :4], quads[:, :4] + (count - 1) * size
    return replace(
        raw,
        points=layers.stations.reshape(-1, 3),
        blocks=(Block(kind=KINDS["hexahedron27"], nodes=solid, groups=groups),),
        node_sets=node_sets,
        surfaces=surfaces | {layers.ends[0]: first, layers.ends[1]: last},
        node_numbers=np.tile(_numbers(raw, size), count),
        revolved=layers.revolved,
    )


def _numbers(raw: RawMesh, size: int) -> Ints:
    """Number in the file of each node of a station, and further ones for nodes that it lacks."""
    given = np.arange(len(raw.points)) if raw.node_numbers is None else raw.node_numbers
    return np.concatenate([given, given.max() + 1 + np.arange(size - len(given))])


def _is_right_handed(cells: PlaneCells, layers: _Layers) -> bool:
    a, b, c, d = (layers.stations[0][cells.quads[:, i]] for i in range(4))
    area = np.cross(c - a, d - b)
    step = (layers.stations[1] - layers.stations[0])[cells.quads[:, 8]]
    return float(np.einsum("qi,qi->", area, step)) > 0


def _with_middles(cells: PlaneCells, nodes: Ints) -> Ints:
    """Nodes of a set, and the middles at which edges between them were cut."""
    members = set(nodes.tolist())
    cut = (parts for ends, parts in cells.edges.items() if len(parts) == 2 and members.issuperset(ends))
    return np.array(sorted(members | {parts[0][1] for parts in cut}), dtype=np.int64)


def _rows(nodes: Ints, size: int, count: int) -> Ints:
    """The rows of nodes at all stations."""
    return (nodes[None] + size * np.arange(count)[:, None]).ravel()


def _sides(cells: PlaneCells, ends: Ints, size: int, count: int) -> Ints:
    """Corners (s, 4) of the sides that edges with these ends (e, 2) pass; edges of no cell pass none."""
    parts = [part for pair in np.sort(ends, axis=1).tolist() for part in cells.edges.get((pair[0], pair[1]), ())]
    a, b = np.array(parts, dtype=np.int64).reshape(-1, 2).T
    rows = [(k * size, (k + 2) * size) for k in range(0, count - 1, 2)]
    return np.concatenate([np.stack([a + low, b + low, b + high, a + high], axis=1) for low, high in rows])


def _done(flat: Sequence[Block], cells: PlaneCells, state: PlaneState) -> str:
    what = ", ".join(f"{len(block.nodes)} {block.kind.name}" for block in flat)
    straight = any(block.kind.nodes == block.kind.corners for block in flat)
    parts = [
        f"cells ({what}) were cut into {len(cells.quads)} quadrilaterals" if cells.was_cut else f"cells ({what})",
        *(["given mid-side nodes on straight edges"] if straight else []),
        "turned by a quarter for axisymmetric states"
        if isinstance(state, Axisymmetric)
        else "moved across their plane for plane strain",
    ]
    return ", ".join(parts[:-1]) + f" and {parts[-1]}" if cells.was_cut or straight else " were ".join(parts)
