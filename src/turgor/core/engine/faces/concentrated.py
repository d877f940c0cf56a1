"""Concentrated loads: nodal forces of point forces and line forces."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.attached import attach
from turgor.core.engine.faces.settings import SIDE_SEARCH
from turgor.core.meshing.cells import side_type
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.loads.load import Vector
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Gauss points and weights on an edge from -1 to 1; shape functions of its ends and its middle, and their slopes.
GAUSS = np.array([-np.sqrt(0.6), 0.0, np.sqrt(0.6)])
WEIGHTS = np.array([5.0, 8.0, 5.0]) / 9
N = np.stack([GAUSS * (GAUSS - 1) / 2, GAUSS * (GAUSS + 1) / 2, 1 - GAUSS**2], axis=1)
SLOPES = np.stack([GAUSS - 0.5, GAUSS + 0.5, -2 * GAUSS], axis=1)


def point_force(mesh: Mesh, at: Vector, force: Vector) -> Array:
    """Forces (n, 3) [N] on the nodes of the mesh.

    Parameters
    ----------
    mesh : Mesh
    at : (3,) floats [m]
        Where it acts at rest.
    force : (3,) floats [N]

    Returns
    -------
    array

    Raises
    ------
    TurgorError
        If the point is not on the surface, or the force points across the mirror plane in which it lies.
    """
    fixed = attach(mesh, at, mesh.mirror_planes)
    size = float(np.ptp(mesh.points, axis=0).max())
    away = float(np.linalg.norm(fixed.arm))
    if away > SIDE_SEARCH.point_force_within * size:
        raise TurgorError(
            f"point force at {_text(at)}: the surface is {away / mm:.4g} mm away; it acts on the surface, or "
            f"within {SIDE_SEARCH.point_force_within * size / mm:.3g} mm of it."
        )
    if mesh.revolved:
        raise TurgorError(
            f"point force at {_text(at)}: an axisymmetric mesh would spread it around the axis; use a Force on a "
            "face, or another kind of cells."
        )
    share = 1.0
    for axis, position in mesh.mirror_planes:
        if abs(at[axis] - position) <= ROUND_OFF.mesh_digits * size:
            share *= 0.5
            if force[axis]:
                raise TurgorError(
                    f"point force at {_text(at)}: it points across the mirror plane normal to {'xyz'[axis]} in "
                    "which the point lies; model the whole actuator (symmetric = false)."
                )
    out = np.zeros_like(mesh.points)
    np.add.at(out, fixed.nodes, share * fixed.shares[:, None] * (fixed.mirrored * np.array(force)))
    return out


def line_force(mesh: Mesh, faces: tuple[str, str], force: Vector) -> Array:
    """Forces (n, 3) [N] on the nodes of the mesh.

    Parameters
    ----------
    mesh : Mesh
    faces : (str, str)
        Faces that meet along the line.
    force : (3,) floats [N/m]
        Force per length at rest.

    Returns
    -------
    array

    Raises
    ------
    TurgorError
        If the faces do not meet, or the force points across a mirror plane.
    """
    first, second = (_edges(mesh.face(name)) for name in faces)
    keys = {tuple(sorted(edge[:2])) for edge in second.tolist()}
    edges = np.array([edge for edge in first.tolist() if tuple(sorted(edge[:2])) in keys], dtype=np.int64)
    if not len(edges):
        raise TurgorError(
            f"line force: the faces '{faces[0]}' and '{faces[1]}' do not meet along an edge. Along a line "
            "within a face, take a point force every few millimeters, or divide the face along the line in the CAD "
            "program and name both parts."
        )
    points, share = mesh.points[edges], np.ones(len(edges))
    for axis, position in mesh.mirror_planes:
        if force[axis]:
            raise TurgorError(
                f"line force on '{faces[0]}' and '{faces[1]}': it points across the mirror plane normal to "
                f"{'xyz'[axis]}; model the whole actuator (symmetric = false)."
            )
        inside = np.abs(points[:, :, axis] - position).max(axis=1) <= ROUND_OFF.mesh_digits * float(
            np.ptp(mesh.points, axis=0).max()
        )
        share[inside] *= 0.5
    length = np.linalg.norm(np.einsum("qa,eai->eqi", SLOPES, points), axis=2) * WEIGHTS
    by_node = share[:, None] * (length @ N)
    out = np.zeros_like(mesh.points)
    np.add.at(out, edges.ravel(), by_node.ravel()[:, None] * np.array(force))
    return out


def _edges(sides: Ints) -> Ints:
    """Each edge of some sides once, (e, 3): its ends and its middle."""
    kind = side_type(sides.shape[1])
    edges = np.concatenate([sides[:, [a, b, kind.corners + i]] for i, (a, b) in enumerate(kind.edges)])
    _, index = np.unique(np.sort(edges[:, :2], axis=1), axis=0, return_index=True)
    return np.asarray(edges[index])


def _text(point: tuple[float, float, float]) -> str:
    return f"({', '.join(f'{value / mm:.4g}' for value in point)}) mm"
