"""Draw the boundary nodes of tetrahedra onto the surface that they approximate."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.meshing.tetwild.nearest import NearestPlaces, SharpEdges
from turgor.core.meshing.tetwild.settings import TETWILD

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def faces_at(nodes: Ints, face: Ints) -> dict[int, frozenset[int]]:
    """Return the faces that meet at each node, from the faces of the triangles (b, k) around it."""
    faces_of: dict[int, set[int]] = {}
    for row, number in zip(nodes.tolist(), face.tolist(), strict=True):
        for node in row:
            faces_of.setdefault(node, set()).add(number)
    return {node: frozenset(numbers) for node, numbers in faces_of.items()}


def snapped(
    points: Array, around: dict[int, frozenset[int]], surface: NearestPlaces, edges: SharpEdges, envelope: float
) -> Array:
    """Return points whose boundary nodes lie on the surface.

    Nodes between two faces go to their common edge, nodes between three to their corner.

    Parameters
    ----------
    points : (n, 3) array [CAD units]
    around : dict of int to frozenset
        Faces at each boundary node.
    surface : NearestPlaces
    edges : SharpEdges
    envelope : float [CAD units]
        Largest distance of the boundary from the surface.
    """
    out = points.copy()
    nodes = np.array(list(around), dtype=np.int64)
    first = np.array([min(faces) for faces in around.values()], dtype=np.int64)
    out[nodes] = surface.on_face(points[nodes], first)
    for node, faces in around.items():
        if len(faces) > 1:
            place = edges.at_corner(points[node], faces) if len(faces) > 2 else None
            if place is None or np.linalg.norm(place - points[node]) > TETWILD.reach * envelope:
                place = edges.on_edge(points[node], faces)
            if place is not None:
                out[node] = place
    moved = np.linalg.norm(out - points, axis=1) > TETWILD.reach * envelope
    out[moved] = points[moved]
    return out


def pressed_flat(before: Array, after: Array, cells: Ints, sides: Ints, around: dict[int, frozenset[int]]) -> Ints:
    """Return cells that the boundary can do without: their four corners come to lie on one face of the surface.

    fTetWild leaves such a cell where a node next to a face is within its envelope, but not on it. Of two cells that
    share a corner one is returned.

    Parameters
    ----------
    before, after : (n, 3) arrays [CAD units]
        Nodes where they are, and on the surface.
    cells : (c, 4) int array
    sides : (b, 3) int array
        The boundary of the cells.
    around : dict of int to frozenset
        Faces at each boundary node.

    Returns
    -------
    (k,) int array
        Numbers of the cells. Without them, each edge of the boundary still belongs to two triangles.
    """
    spoiled = np.flatnonzero(volumes(after, cells) < TETWILD.least_volume * volumes(before, cells))
    outer = {frozenset(side) for side in sides.tolist()}
    edges = {frozenset(pair) for a, b, c in sides.tolist() for pair in ((a, b), (b, c), (c, a))}
    flat: list[int] = []
    taken: set[int] = set()
    for number in spoiled.tolist():
        corners = frozenset(cells[number].tolist())
        if taken & corners or not frozenset.intersection(*(around.get(node, frozenset()) for node in corners)):
            continue
        inner = [corners - {node} for node in corners if corners - {node} not in outer]
        if len(inner) == 1 or (len(inner) == 2 and inner[0] & inner[1] not in edges):
            flat.append(number)
            taken |= corners
    return np.array(flat, dtype=np.int64)


def unspoiled(before: Array, after: Array, cells: Ints) -> Array:
    """Send the corners of cells back that would lose most of their volume, and return the positions."""
    out, size = after.copy(), volumes(before, cells)
    while True:
        back = np.unique(cells[volumes(out, cells) < TETWILD.least_volume * size])
        if (out[back] == before[back]).all():
            return out
        out[back] = before[back]


def on_mirrors(points: Array, nodes: Ints, face: Ints, shape: SurfaceShape) -> Array:
    """Put the nodes of the faces ``symmetry_*`` on their planes, because a mirror plane holds no node off it.

    Nodes that another wall drew away, or that went back for the sake of a cell, are off by the width of the envelope.

    Parameters
    ----------
    points : (n, 3) array [CAD units]
    nodes : (b, k) int array
        Nodes of each side of the boundary.
    face : (b,) int array
        Face of each side.
    shape : SurfaceShape
        Whose faces have names.
    """
    out = points.copy()
    for number, each in enumerate(shape.faces):
        if each.name.startswith("symmetry_"):
            plane = shape.corners[shape.face == number].reshape(-1, 3)
            axis = int(np.ptp(plane, axis=0).argmin())
            out[np.unique(nodes[face == number]), axis] = np.median(plane[:, axis])
    return out


def volumes(points: Array, cells: Ints) -> Array:
    """Volume of each tetrahedron, (c,); negative for one that is inside out."""
    a, b, c, d = (points[cells[:, i]] for i in range(4))
    return np.asarray(np.einsum("ci,ci->c", b - a, np.cross(c - a, d - a)) / 6)
