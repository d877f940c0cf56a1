"""Rubber of a section: displacement and mean stress in nine-node quadrilaterals, as in the hexahedra of the engine.

The energy for each length is ∫ W(F) + p (J − 1) − p²/(2κ) dA, with biquadratic positions and a bilinear mean stress
that jumps where stiffness or traction jumps. A few moments of J − 1 − p/κ over each cell are penalized, as in
`turgor.core.engine.cells.stabilization`.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.cell_materials import CellMaterials
from turgor.core.engine.cells.internal_variables import History
from turgor.core.engine.cells.mean_stress_jumps import mean_stress_numbers
from turgor.core.engine.cells.point_stress import isochoric_invariants, stress_and_moduli
from turgor.core.engine.cells.stabilization import REGULARIZATION, STIFFNESS
from turgor.core.engine.percentiles import weighted_percentile
from turgor.core.model.model import Model
from turgor.fast_models.section.kinematics import Vectors
from turgor.fast_models.section.plane import Plane, gradients, tables
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Rubber:
    """The solids of a section, scaled.

    Parameters
    ----------
    vectors : Vectors
        The three columns of F.
    mean : (c, 4) int array
        Number of the mean stress at each corner.
    mean_count : int
    shapes : (q, 4) array
        Shape functions of the mean stress.
    materials : CellMaterials
    history : History
        What the laws begin with: nothing, and as much time as it takes.
    penalty : (c, q, m) array
        Functions of the moments of volume that are penalized.
    """

    vectors: Vectors
    mean: Ints
    mean_count: int
    shapes: Array
    materials: CellMaterials
    history: History
    penalty: Array

    def forces(self, y: Array, strains: Array, p: Array) -> tuple[Array, Array] | None:
        """Gradient (c, 31 + 4) and Hessian of the energy of each cell; None where one is turned inside out."""
        vectors, w = self.vectors, self.vectors.weights
        F = vectors.at(y, strains)
        I1, I2, J = isochoric_invariants(F)
        if not (J > 0).all():
            return None
        laws = self.materials.isochoric(I1, I2, F[self.materials.gradient_cells], self.history)
        c = self.materials.compliance[:, None]
        mean = p[self.mean] @ self.shapes.T
        lost = J - 1 - mean * c
        moments = np.einsum("cqm,cq,cq->cm", self.penalty, w, lost)
        extra = np.einsum("cqm,cm->cq", self.penalty, moments)
        P, A, cofactor = stress_and_moduli(F, mean + extra, laws, self.materials.rows)
        B = vectors.derivatives(y, strains)
        by_volume = np.einsum("cqr,cqrd->cqd", cofactor, B, optimize=True) * w[..., None]
        r = np.hstack([vectors.gradient(B, P), (w * (lost - extra * c)) @ self.shapes])
        size, modes = vectors.unknowns, self.shapes.shape[1]
        K = np.zeros((len(B), size + modes, size + modes))
        K[:, :size, :size] = vectors.hessian(B, P, A)
        mixed = np.swapaxes(by_volume, 1, 2) @ self.shapes
        K[:, :size, size:], K[:, size:, :size] = mixed, np.swapaxes(mixed, 1, 2)
        c = np.maximum(c, REGULARIZATION)
        by_mean = -(w * c)[..., None] * self.shapes
        K[:, size:, size:] = np.einsum("cqm,qn->cmn", by_mean, self.shapes)
        by_moment = np.swapaxes(self.penalty, 1, 2) @ np.concatenate([by_volume, by_mean], axis=2)
        K += np.swapaxes(by_moment, 1, 2) @ by_moment
        return r, K

    def largest_stretches(self, y: Array, strains: Array) -> tuple[float, float]:
        """Principal stretch that 99 % of the area stay below, and the largest at the integration points."""
        stretches = np.linalg.norm(self.vectors.at(y, strains), ord=2, axis=(-2, -1))
        return weighted_percentile(stretches, self.vectors.weights), float(stretches.max())


def rubber_of(model: Model, plane: Plane, stress: float) -> Rubber:
    """Tabulate the solids of a slice for its section.

    Parameters
    ----------
    model : Model
        Its mesh is the slice.
    plane : Plane
    stress : float [Pa]
        Scale of stresses.
    """
    for name, material in model.region_materials.items():
        if material.has_fibers or material.is_foam:
            what = "has directions" if material.has_fibers else "is a foam"
            raise TurgorError(f"materials.{name}: '{material.name}' {what}, which a section does not take yet.")
    table = tables()
    by_place, areas = gradients(plane.points, plane.quads)
    plain = np.zeros((*by_place.shape[:3], 3))
    plain[..., 1:] = by_place
    along = np.zeros_like(plain)
    along[..., 0] = table.N
    numbers, _ = mean_stress_numbers(model)
    used, mean = np.unique(numbers[:, :4], return_inverse=True)
    materials = CellMaterials(model, stress, len(table.weights))
    return Rubber(
        vectors=Vectors(nodes=plane.quads, plain=plain, along=along, weights=areas),
        mean=mean.reshape(-1, 4),
        mean_count=len(used),
        shapes=table.M,
        materials=materials,
        history=materials.history(None, np.inf),
        penalty=_penalty(model, areas, table.points, materials.compliance, stress),
    )


def _penalty(model: Model, areas: Array, points: Array, compliance: Array, stress: float) -> Array:
    """√γ φₖ (c, q, 4) with functions 1, ξ, η, ξη made orthonormal in each cell."""
    x, y = (points - 0.5).T
    functions = np.column_stack([np.ones(len(x)), x, y, x * y])
    products = np.einsum("qk,cq,ql->ckl", functions, areas, functions)
    lower = np.linalg.cholesky(products)
    orthonormal = np.linalg.solve(lower, np.broadcast_to(functions.T, (len(areas), *functions.T.shape)))
    gamma = np.empty(len(areas))
    for name, material in model.region_materials.items():
        gamma[model.mesh.regions[name]] = STIFFNESS * material.law.shear_modulus / stress
    gamma /= 1 + gamma * compliance
    return np.ascontiguousarray(np.sqrt(gamma)[:, None, None] * np.swapaxes(orthonormal, 1, 2))
