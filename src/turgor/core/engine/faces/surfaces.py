"""Sides of cells on the body: follower pressure with its consistent tangent, enclosed volume, vector area."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.compiled import LOOP
from turgor.core.engine.faces.openings import NO_AXIS, cap_volume
from turgor.core.meshing.cells import side_type
from turgor.core.meshing.mesh import Mesh

Array = NDArray[np.float64]
Triangles = NDArray[np.int64]


def _tangents(points: Array, triangles: Triangles) -> tuple[Array, Array, Array]:
    """Position and surface tangents x,r and x,s at the quadrature points, (f, q, 3) each."""
    reference = side_tables(triangles.shape[1])
    corners = points[triangles]
    x = np.einsum("qa,fai->fqi", reference.N, corners)
    t = np.einsum("qad,fai->fqid", reference.dN, corners)
    return x, t[..., 0], t[..., 1]


def enclosed_volume(points: Array, triangles: Triangles, mesh: Mesh | None = None) -> float:
    """Volume enclosed by a surface, ⅓ ∮ x·n da, positive for outward normals.

    The surface may be open where it meets coordinate planes through the origin (mirror planes): their share is zero.
    Neither counts what is missing at the two cut faces of a wedge about an axis through the origin, which cancels.
    Any other opening, such as an air inlet, is closed by the fan of `turgor.core.engine.faces.openings.cap_volume`.

    Parameters
    ----------
    points : (n, 3) array [m]
    triangles : (f, 6), (f, 8) or (f, 9) int array
    mesh : Mesh, optional
        Whose sides they are; needed where that is a wedge.

    Returns
    -------
    float [m³]
    """
    weights = side_tables(triangles.shape[1]).weights
    x, r, s = _tangents(points, triangles)
    walls = float(np.einsum("q,fqi,fqi->", weights, x, np.cross(r, s)) / 3)
    axis = NO_AXIS if mesh is None or mesh.wedge is None else mesh.wedge.number
    return walls + cap_volume(points, open_rim(mesh, triangles), axis)


def vector_area(points: Array, triangles: Triangles) -> Array:
    """Integral of the normal over a surface, ∫ n da, (3,) [m²]; it depends on the rim alone."""
    weights = side_tables(triangles.shape[1]).weights
    _, r, s = _tangents(points, triangles)
    return np.asarray(np.einsum("q,fqi->i", weights, np.cross(r, s)))


def area(points: Array, triangles: Triangles) -> float:
    """Area of a surface [m²]."""
    return float(side_areas(points, triangles).sum())


def side_areas(points: Array, triangles: Triangles) -> Array:
    """Area of each side of a surface, (f,) [m²]."""
    weights = side_tables(triangles.shape[1]).weights
    _, r, s = _tangents(points, triangles)
    return np.asarray(np.linalg.norm(np.cross(r, s), axis=2) @ weights)


def nodal_weights(points: Array, triangles: Triangles) -> Array:
    """Lumped integrals ∫ N da of every node's shape function over a surface, (n,) [m²]."""
    reference = side_tables(triangles.shape[1])
    _, r, s = _tangents(points, triangles)
    local = np.einsum("q,qa,fq->fa", reference.weights, reference.N, np.linalg.norm(np.cross(r, s), axis=2))
    return np.bincount(triangles.ravel(), local.ravel(), minlength=len(points)).astype(float)


@njit(**LOOP)
def pressure_forces(x, triangles, N, dN, pressures):
    """Pressure on each triangle: ∫ p N n da per node, (f, n, 3); n points out of the solid.

    ``pressures`` (f, q) are those at the quadrature points times their weights.
    """
    out = np.empty((len(triangles), triangles.shape[1], 3))
    out[:] = 0.0  # np.zeros takes longer to compile
    r, s = np.empty(3), np.empty(3)
    for f in range(len(triangles)):
        for q in range(pressures.shape[1]):
            for i in range(3):
                r[i], s[i] = 0.0, 0.0
                for a in range(triangles.shape[1]):
                    r[i] += dN[q, a, 0] * x[triangles[f, a], i]
                    s[i] += dN[q, a, 1] * x[triangles[f, a], i]
            n = (r[1] * s[2] - r[2] * s[1], r[2] * s[0] - r[0] * s[2], r[0] * s[1] - r[1] * s[0])
            for a in range(triangles.shape[1]):
                for i in range(3):
                    out[f, a, i] += pressures[f, q] * N[q, a] * n[i]
    return out


@njit(**LOOP)
def pressure_tangents(x, triangles, N, dN, pressures):
    """Derivative of `pressure_forces` by the nodal positions, (f, 3n, 3n); it is not symmetric triangle by triangle."""
    out = np.empty((len(triangles), 3 * triangles.shape[1], 3 * triangles.shape[1]))
    out[:] = 0.0
    r, s, v = np.empty(3), np.empty(3), np.empty(3)
    for f in range(len(triangles)):
        for q in range(pressures.shape[1]):
            for i in range(3):
                r[i], s[i] = 0.0, 0.0
                for a in range(triangles.shape[1]):
                    r[i] += dN[q, a, 0] * x[triangles[f, a], i]
                    s[i] += dN[q, a, 1] * x[triangles[f, a], i]
            for b in range(triangles.shape[1]):
                for i in range(3):
                    v[i] = dN[q, b, 1] * r[i] - dN[q, b, 0] * s[i]  # ∂n/∂x_b = [v]×
                for a in range(triangles.shape[1]):
                    w = pressures[f, q] * N[q, a]
                    out[f, 3 * a, 3 * b + 1] -= w * v[2]
                    out[f, 3 * a, 3 * b + 2] += w * v[1]
                    out[f, 3 * a + 1, 3 * b] += w * v[2]
                    out[f, 3 * a + 1, 3 * b + 2] -= w * v[0]
                    out[f, 3 * a + 2, 3 * b] -= w * v[1]
                    out[f, 3 * a + 2, 3 * b + 1] += w * v[0]
    return out


def rim_edges(triangles: Triangles) -> NDArray[np.int64]:
    """Edges that belong to one side only: (e, 3) nodes, two vertices and the mid-side node between them."""
    kind = side_type(triangles.shape[1])
    edges = np.concatenate([triangles[:, [a, b, kind.corners + i]] for i, (a, b) in enumerate(kind.edges)])
    key = np.sort(edges[:, :2], axis=1)
    _, index, count = np.unique(key, axis=0, return_index=True, return_counts=True)
    return np.asarray(edges[index[count == 1]])


def open_rim(mesh: Mesh | None, triangles: Triangles) -> NDArray[np.int64]:
    """Rim of a surface as of `rim_edges`, without the edges in the cuts of a wedge, where the surface goes on."""
    edges = rim_edges(triangles)
    if mesh is None or mesh.wedge is None:
        return edges
    key = np.sort(mesh.leaders[edges[:, :2]], axis=1)
    _, place, count = np.unique(key, axis=0, return_inverse=True, return_counts=True)
    return np.asarray(edges[count[place.ravel()] == 1])


def has_potential(points: Array, triangles: Triangles, prescribed: NDArray[np.bool_]) -> bool:
    """Whether a uniform follower pressure on the surface derives from a potential, so that its tangent is symmetric.

    It does where the surface is closed, or where every edge of its rim slides in a coordinate plane or is fixed:
    the asymmetry is the rim integral p ∮ (δu × Δu)·dl.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (f, 6), (f, 8) or (f, 9) int array
    prescribed : (n, 3) bool array
        Displacement components that a support prescribes.
    """
    tolerance = 1e-9 * float(np.ptp(points, axis=0).max())
    for edge in rim_edges(triangles):
        planar = np.ptp(points[edge], axis=0) <= tolerance
        if not (planar & prescribed[edge].all(axis=0)).any() and prescribed[edge].all(axis=0).sum() < 2:
            return False
    return True
