"""Membranes: thin sheets of Hooke's material on the sides of cells, free to bend.

The energy per reference area is ½ h E : ℂ : E with Green's strain of the surface and the plane-stress moduli. It is
integrated with three points. A sheet that does not stretch should not care how stiff it is: on the coarse PneuNet of
tests/verification/membranes_shells/test_membrane_locking.py a hundred times the stiffness changes the bending angle by
−0.14 % with three points, and by −1.7 % with six, which tie more strains than a bent quadratic triangle can keep at
zero: locking.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import reference_cell
from turgor.core.engine.compiled import INNER, LOOP
from turgor.core.materials.laws.laws import Hooke, Woven
from turgor.core.meshing.cells import side_type

#: Three points on triangles, 2 × 2 on quadrilaterals, by corners.
MEMBRANE_QUADRATURE_DEGREE = {3: 2, 4: 3}
Array = NDArray[np.float64]


def plane_stress_moduli(law: Hooke) -> Array:
    """Moduli (3, 3) between E₁₁, E₂₂, 2 E₁₂ and the stresses [Pa]; of a woven sheet, 1 is its warp."""
    weft = law.E_weft / law.E if isinstance(law, Woven) else 1.0
    stiff = law.E / (1 - law.nu**2 * weft)
    return np.array(
        [[stiff, law.nu * weft * stiff, 0], [law.nu * weft * stiff, weft * stiff, 0], [0, 0, law.shear_modulus]]
    )


@dataclass(frozen=True, slots=True, eq=False)
class Frames:
    """Orthonormal frames of a reference surface at its integration points.

    Parameters
    ----------
    e1, e2, normal : (f, q, 3) arrays
        Two directions in the surface and the normal.
    gradients : (f, q, n, 2) array
        Derivatives of the shape functions along e1 and e2.
    areas : (f, q) array
        Area that each point stands for.
    """

    e1: Array
    e2: Array
    normal: Array
    gradients: Array
    areas: Array


def surface_frames(points: Array, triangles: NDArray[np.int64], degree: int | None = None) -> Frames:
    """Compute the frames at the points where membranes are integrated, or at those of another degree."""
    nodes = triangles.shape[1]
    reference = reference_cell(nodes, degree or MEMBRANE_QUADRATURE_DEGREE[side_type(nodes).corners])
    tangents = np.einsum("qad,fai->fqid", reference.dN, points[triangles])
    r, s = tangents[..., 0], tangents[..., 1]
    normal = np.cross(r, s)
    size = np.linalg.norm(normal, axis=-1)
    normal = normal / size[..., None]
    e1 = r / np.linalg.norm(r, axis=-1)[..., None]
    e2 = np.cross(normal, e1)
    jacobian = np.empty((*r.shape[:-1], 2, 2))  # local coordinates by reference coordinates
    jacobian[..., 0, 0], jacobian[..., 0, 1] = (e1 * r).sum(-1), (e1 * s).sum(-1)
    jacobian[..., 1, 0], jacobian[..., 1, 1] = (e2 * r).sum(-1), (e2 * s).sum(-1)
    gradients = np.einsum("qad,fqdk->fqak", reference.dN, np.linalg.inv(jacobian))
    return Frames(e1, e2, normal, np.ascontiguousarray(gradients), size * reference.weights)


def surface_gradients(points: Array, triangles: NDArray[np.int64]) -> tuple[Array, Array]:
    """Shape function gradients in an orthonormal frame of the reference surface (f, q, n, 2), areas (f, q)."""
    frames = surface_frames(points, triangles)
    return frames.gradients, frames.areas


@njit(**INNER)
def _tangents(x, nodes, gradients, t):
    """Derivatives (2, 3) of the positions of a side along its reference frame."""
    for k in range(2):
        for i in range(3):
            total = 0.0
            for a in range(len(nodes)):
                total += gradients[a, k] * x[nodes[a], i]
            t[k, i] = total


@njit(**LOOP)
def membrane_stress(x, dx, triangles, gradients, areas, moduli):
    """Stress S + ℂ : ΔE linearized about nodal positions ``x`` for an update ``dx``, (f, q, 3)."""
    out = np.empty((len(triangles), areas.shape[1], 3))
    t, d, E = np.empty((2, 3)), np.empty((2, 3)), np.empty(3)
    for f in range(len(triangles)):
        for q in range(areas.shape[1]):
            _tangents(x, triangles[f], gradients[f, q], t)
            _tangents(dx, triangles[f], gradients[f, q], d)
            E[0], E[1], E[2] = -0.5, -0.5, 0.0
            for i in range(3):
                E[0] += t[0, i] * (0.5 * t[0, i] + d[0, i])
                E[1] += t[1, i] * (0.5 * t[1, i] + d[1, i])
                E[2] += t[0, i] * t[1, i] + t[0, i] * d[1, i] + t[1, i] * d[0, i]
            for v in range(3):
                out[f, q, v] = moduli[v, 0] * E[0] + moduli[v, 1] * E[1] + moduli[v, 2] * E[2]
    return out


@njit(**LOOP)
def membrane_forces(x, triangles, gradients, areas, stress):
    """Nodal forces (f, n, 3) of a stress (f, q, 3) at nodal positions ``x``."""
    out = np.empty((len(triangles), triangles.shape[1], 3))
    out[:] = 0.0  # np.zeros takes longer to compile
    t = np.empty((2, 3))
    for f in range(len(triangles)):
        for q in range(areas.shape[1]):
            _tangents(x, triangles[f], gradients[f, q], t)
            S0, S1, S2 = stress[f, q, 0], stress[f, q, 1], stress[f, q, 2]
            w = areas[f, q]
            for a in range(triangles.shape[1]):
                g0, g1 = gradients[f, q, a, 0], gradients[f, q, a, 1]
                for i in range(3):
                    out[f, a, i] += w * ((S0 * g0 + S2 * g1) * t[0, i] + (S1 * g1 + S2 * g0) * t[1, i])
    return out


@njit(**LOOP)
def membrane_tangents(x, triangles, gradients, areas, moduli, stress):
    """Stiffness (f, 3n, 3n) at nodal positions ``x``: moduli (f, q, 3, 3), stress (f, q, 3) in the geometric part."""
    out = np.empty((len(triangles), 3 * triangles.shape[1], 3 * triangles.shape[1]))
    out[:] = 0.0
    t, B = np.empty((2, 3)), np.empty((3, 3 * triangles.shape[1]))
    for f in range(len(triangles)):
        for q in range(areas.shape[1]):
            g, C = gradients[f, q], moduli[f, q]
            _tangents(x, triangles[f], g, t)
            for a in range(triangles.shape[1]):
                for i in range(3):
                    B[0, 3 * a + i] = g[a, 0] * t[0, i]
                    B[1, 3 * a + i] = g[a, 1] * t[1, i]
                    B[2, 3 * a + i] = g[a, 0] * t[1, i] + g[a, 1] * t[0, i]
            w = areas[f, q]
            S0, S1, S2 = stress[f, q, 0], stress[f, q, 1], stress[f, q, 2]
            for r in range(3 * triangles.shape[1]):
                h0 = C[0, 0] * B[0, r] + C[0, 1] * B[1, r] + C[0, 2] * B[2, r]
                h1 = C[1, 0] * B[0, r] + C[1, 1] * B[1, r] + C[1, 2] * B[2, r]
                h2 = C[2, 0] * B[0, r] + C[2, 1] * B[1, r] + C[2, 2] * B[2, r]
                for c in range(3 * triangles.shape[1]):
                    out[f, r, c] += w * (h0 * B[0, c] + h1 * B[1, c] + h2 * B[2, c])
            for a in range(triangles.shape[1]):
                for b in range(triangles.shape[1]):
                    k = w * (
                        S0 * g[a, 0] * g[b, 0] + S1 * g[a, 1] * g[b, 1] + S2 * (g[a, 0] * g[b, 1] + g[a, 1] * g[b, 0])
                    )
                    for i in range(3):
                        out[f, 3 * a + i, 3 * b + i] += k
    return out
