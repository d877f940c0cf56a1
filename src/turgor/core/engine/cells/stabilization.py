"""Stabilization of hexahedra: moments of the lost volume that are penalized in every cell.

27-node hexahedra with mean stresses at their corners have 24 displacements for each mean stress. Modes that change the
volume within cells have no energy, and where the rubber is compressed they buckle although the body would not: a block
in exact flexure loses stability at 77°, where its inner face is compressed to 0.85 of its length. The energy gets the
term ½ Σ (∫ φₖ (J − 1 − p/κ) dV)² with functions φₖ that are orthonormal in the cell times √γ. It is consistent: it
vanishes with the exact solution. The functions are 1, ξ, η, ζ and the products ξη, ηζ, ζξ.

Measured with γ = 5 μ on that block, 8 × 16 cells: the first unstable mode comes at 260°, where the inner face is
compressed to 0.62 and rubber creases; with 1, ξ, η, ζ alone at 174°, with the mean alone at 84°. A penalty on all of
J − 1 − p/κ has none up to 270°, but punishes moments of second order that long cells cannot avoid: a closed tube of
5 mm cells extended 3 % too little with it, 0.6 % with these functions.

Cells whose middles follow (20 nodes) get the mean alone, with γ = 2 μ. On the same block the first unstable mode comes
at 176° (0.74); at 108° without a penalty, and at 193° with 5 μ or 15 μ. All seven functions lock: the tube of 4 mm
cells extends 1.9 % too little with 5 μ, 0.6 % with the mean and 2 μ, 0.4 % with 27 nodes.
"""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import ReferenceCell
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.model.model import MIXED, Model

Array = NDArray[np.float64]

#: γ over the initial shear modulus.
STIFFNESS = 5.0

#: The same where the middles of cells follow, and their volume alone is penalized.
SERENDIPITY_STIFFNESS = 2.0

#: Relative compressibility added to the tangent alone: keeps it regular where the mean stress is undetermined.
REGULARIZATION = 1e-9

#: The same where middles follow. No unknown is then within a cell alone, and factors may meet a mean stress before any
#: displacement next to it: with 1e-8, those of a finger on paper failed in double precision.
SERENDIPITY_REGULARIZATION = 1e-7


def volume_penalty(
    model: Model, tables: ReferenceCell, dV: Array, compliance: Array, stress: float, factors: Array | float = 1.0
) -> Array:
    """Tabulate √γ φₖ (c, q, k) at the points of all cells; k is zero where cells are stable without it.

    Parameters
    ----------
    model : Model
    tables : ReferenceCell
    dV : (c, q) array
        Volumes of the points.
    compliance : (c,) array
        1/κ, scaled by ``stress``; γ stays below κ.
    stress : float [Pa]
    factors : (c,) array or float
        On the shear moduli of the cells.
    """
    if model.mesh.cell_type is not HEXAHEDRON or model.formulation != MIXED:
        return np.zeros((*dV.shape, 0))
    x, y, z = (tables.points - 0.5).T
    functions, stiffness = np.ones((len(x), 1)), SERENDIPITY_STIFFNESS
    if not model.mesh.serendipity:
        functions, stiffness = np.column_stack([functions, x, y, z, x * y, y * z, z * x]), STIFFNESS
    products = np.einsum("qk,cq,ql->ckl", functions, dV, functions)
    lower = np.linalg.cholesky(products)
    orthonormal = np.linalg.solve(lower, np.broadcast_to(functions.T, (len(dV), *functions.T.shape)))
    gamma = np.empty(len(dV))
    for name, material in model.region_materials.items():
        gamma[model.mesh.regions[name]] = stiffness * material.law.shear_modulus / stress
    gamma *= factors
    gamma /= 1 + gamma * compliance
    return np.ascontiguousarray(np.sqrt(gamma)[:, None, None] * np.swapaxes(orthonormal, 1, 2))


def penalty_energy(penalty: Array, dV: Array, lost: Array) -> Array:
    """Energy (c,) of the penalty, from the lost volume J − 1 − p/κ (c, q)."""
    moments = np.einsum("cqk,cq,cq->ck", penalty, dV, lost)
    return np.asarray(0.5 * np.einsum("ck,ck->c", moments, moments))
