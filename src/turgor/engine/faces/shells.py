"""Shells on hexahedra: sheets that resist bending too, as two layers of a membrane above and below their face.

The strain of each layer is that of the cells on its side of the face. Its distance from the face is h/(2√3) for a
plate of thickness h: the two points of Gauss give the membrane stiffness and the bending stiffness E h³/(12 (1 − ν²)).
A fabric that bends more easily has layers nearer to the face. A sheet does not shear as rubber does: the angle between
its surface and the line across it, which the cells on both sides carry, is held by the sheet's own shear stiffness
5/6 G h (Mindlin's plate). Without it a stiff sheet would bend by shearing the rubber beside it, the sooner the shorter
its span.

On tetrahedra the layers would be cut along every edge, because only the displacement is continuous there, not its
slope across the face, and the bending stiffness would get lost with refinement. There the sheet bends on its own
triangles: `turgor.engine.faces.plate_terms`.
"""

import numpy as np
from numpy.typing import NDArray

from turgor.engine.cells.reference import reference_cell, reference_nodes, tables_at
from turgor.engine.faces.membranes import MEMBRANE_QUADRATURE_DEGREE, surface_frames
from turgor.errors import TurgorError
from turgor.materials.laws.laws import Hooke
from turgor.meshing.cells import side_type
from turgor.meshing.mesh import Mesh
from turgor.meshing.surface import cell_sides, corner_keys

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def shell_layers(mesh: Mesh, face: str, distance: float, length: float) -> list[tuple[Ints, Array, Array]]:
    """The two layers of a sheet, at a distance [m]: nodes of cells (f, n), gradients (f, q, n, 2), areas (f, q)."""
    sides = mesh.face(face)
    points = mesh.points / length
    frames = surface_frames(points, sides)
    owners = _cells_at(mesh, sides)
    layers = []
    for sign in (1.0, -1.0):
        cells = mesh.cells[_on_side(mesh, sides, owners, frames.normal.mean(axis=1) * sign)]
        gradients = np.empty((len(sides), frames.areas.shape[1], mesh.cells.shape[1], 2))
        for f, nodes in enumerate(cells):
            G = _gradients(points[nodes], _local(nodes, sides[f]), sign * distance / length * frames.normal[f])
            gradients[f, ..., 0] = np.einsum("qad,qd->qa", G, frames.e1[f])
            gradients[f, ..., 1] = np.einsum("qad,qd->qa", G, frames.e2[f])
        layers.append((np.ascontiguousarray(cells), gradients, frames.areas / 2))
    return layers


def shear_layers(mesh: Mesh, face: str, length: float) -> list[tuple[Ints, Array, Array]]:
    """What shears across a sheet, as layers between a direction in the sheet and its normal."""
    sides = mesh.face(face)
    points = mesh.points / length
    frames = surface_frames(points, sides)
    owners = _cells_at(mesh, sides)
    layers = []
    for sign in (1.0, -1.0):
        cells = mesh.cells[_on_side(mesh, sides, owners, frames.normal.mean(axis=1) * sign)]
        at_face = np.zeros_like(frames.normal[0])
        G = np.stack(
            [_gradients(points[nodes], _local(nodes, side), at_face) for nodes, side in zip(cells, sides, strict=True)]
        )
        across = np.einsum("fqad,fqd->fqa", G, frames.normal)
        for direction in (frames.e1, frames.e2):
            gradients = np.stack([np.einsum("fqad,fqd->fqa", G, direction), across], axis=-1)
            layers.append((np.ascontiguousarray(cells), np.ascontiguousarray(gradients), frames.areas / 2))
    return layers


def shear_moduli(law: Hooke) -> Array:
    """Moduli (3, 3) of a layer of `shear_layers` [Pa]: only its change of angle counts."""
    return np.diag([0.0, 0.0, 5 / 6 * law.shear_modulus])


def _cells_at(mesh: Mesh, sides: Ints) -> Ints:
    """The one or two cells at each side, (f, 2); a side of one cell names it twice."""
    all_sides = cell_sides(mesh.cells)
    per_cell = len(mesh.cell_type.sides)
    keys = corner_keys(all_sides, len(mesh.points))
    order = np.argsort(keys, kind="stable")
    wanted = corner_keys(sides, len(mesh.points))
    first = np.searchsorted(keys[order], wanted, side="left")
    last = np.searchsorted(keys[order], wanted, side="right") - 1
    if (last < first).any():
        raise TurgorError("a sheet lies on triangles that are no sides of cells.")
    return np.column_stack([order[first], order[last]]) // per_cell


def _on_side(mesh: Mesh, sides: Ints, owners: Ints, direction: Array) -> Ints:
    """Of the cells at each side, the one that lies in a direction."""
    corners = mesh.cell_type.corners
    middle = mesh.points[mesh.cells[owners][:, :, :corners]].mean(axis=2)
    arm = middle - mesh.points[sides].mean(axis=1)[:, None]
    ahead = np.einsum("fki,fi->fk", arm, direction).argmax(axis=1)
    return np.asarray(owners[np.arange(len(sides)), ahead])


def _local(nodes: Ints, side: Ints) -> Ints:
    """Places of the nodes of a side among those of its cell."""
    return np.array([int(np.flatnonzero(nodes == node)[0]) for node in side])


def _gradients(cell: Array, local: Ints, offsets: Array) -> Array:
    """∂N/∂X (q, n, 3) of a cell at its side's integration points, moved by the offsets (q, 3)."""
    rule = reference_cell(len(local), MEMBRANE_QUADRATURE_DEGREE[side_type(len(local)).corners])
    where = rule.N @ reference_nodes(len(cell))[local]
    at_side = tables_at(len(cell), where, rule.weights)
    jacobian = np.einsum("ai,qad->qid", cell, at_side.dN)
    moved = where + np.linalg.solve(jacobian, offsets[..., None])[..., 0]
    table = tables_at(len(cell), moved, rule.weights)
    jacobian = np.einsum("ai,qad->qid", cell, table.dN)
    return np.einsum("qad,qdi->qai", table.dN, np.linalg.inv(jacobian))
