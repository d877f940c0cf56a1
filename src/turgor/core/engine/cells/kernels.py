"""Compiled loops over quadratic cells: residual and stress of the mixed formulation.

The tangent is in `turgor.core.engine.cells.kernels_tangent`.

The energy of a cell is ∫ W(Ī₁, Ī₂) + p (J − 1) − p² / (2κ) dV with quadratic displacement and linear mean stress p. In
hexahedra a few moments of J − 1 − p/κ over the cell are penalized, ½ Σ (∫ φₖ (J − 1 − p/κ) dV)², with the functions φ,
``penalty`` (c, q, k) in the loops, of `turgor.core.engine.cells.stabilization`; in tetrahedra k is zero. A cell without
mean stresses of its own, for comparison with codes that have no mixed element, takes p = κ (J − 1) at each point.

Stress and tangent are formed once per point in the reference configuration (`turgor.core.engine.cells.kernels_point`),
pushed to ∂P/∂F and contracted with the shape function gradients; node loops run over contiguous arrays so that the
compiler vectorizes them. Laws in stretches bring the isochoric S and 4 ∂²W/∂C² along
(`turgor.core.engine.cells.spectral`). Symbols follow the review's section 3.1.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.cells import kernels_geometry, kernels_point, kernels_volume
from turgor.core.engine.cells.kernels_geometry import (
    FAST,
    cofactor_at,
    deformation_gradient_at,
    load_cell,
    side_by_side,
    slopes_of,
)
from turgor.core.engine.cells.kernels_point import (
    add_moduli,
    add_stress,
    moduli_at,
    strain_at,
    strain_change_at,
    stress_at,
)
from turgor.core.engine.cells.kernels_volume import (
    Cell,
    bulk_modulus,
    lost_moments,
    lost_volume_at,
    mean_stress_at,
    moment_changes,
    penalty_stress_at,
)
from turgor.core.engine.compiled import LOOP, calls, over

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


class Cells(NamedTuple):
    """Cells at rest, as the loops take them.

    Parameters
    ----------
    shape, modes : tuple of int
        As long as a cell has nodes and mean stresses, so that the compiler knows these numbers and unrolls: one
        compiled version for each kind of cell.
    nodes : (c, n) int array
    mean : (c, m) int array
        Mean stresses of each cell.
    dN, M : (q, n, 3), (q, m) arrays
        Reference gradients of displacement, and shape functions of the mean stress.
    Jinv, dV : (c, q, 3, 3), (c, q) arrays
        Inverse Jacobians and volumes of the Gauss points.
    compliance : (c,) array
        1/κ.
    penalty : (c, q, k) array
        Functions φₖ.
    unit : float
        1 where the loops take displacements; 0 where they take positions, because cells have a rest of their own.
    """

    shape: tuple[int, ...]
    modes: tuple[int, ...]
    nodes: Ints
    mean: Ints
    dN: Array
    M: Array
    Jinv: Array
    dV: Array
    compliance: Array
    penalty: Array
    unit: float = 1.0

    def part(self, chosen: slice) -> "Cells":
        """Some of the cells."""
        return self._replace(
            nodes=self.nodes[chosen], mean=self.mean[chosen], Jinv=self.Jinv[chosen], dV=self.dV[chosen],
            compliance=self.compliance[chosen], penalty=self.penalty[chosen],
        )  # fmt: skip


class Response(NamedTuple):
    """Stresses and tangents of the laws, as the loops take them.

    Parameters
    ----------
    W : (5, c, q) array
        Derivatives of the energy by the isochoric invariants: W₁, W₂, W₁₁, W₁₂, W₂₂.
    rows : (c,) int array
        Row of each cell in ``stress`` and ``moduli``; −1 for none.
    stress, moduli : (s, q, 6), (s, q, 21) arrays
        Isochoric S and lower triangles of 4 ∂²W/∂C² that are added.
    """

    W: Array
    rows: Ints
    stress: Array
    moduli: Array

    def part(self, chosen: slice) -> "Response":
        """That of some of the cells."""
        return self._replace(W=np.ascontiguousarray(self.W[:, chosen]), rows=self.rows[chosen])


@njit(**LOOP, fastmath=FAST)
@calls(kernels_geometry, kernels_point, kernels_volume)
def _residual(begin, end, out, cells, u, p, laws):
    shape, modes, nodes, mean, dN, M, Jinv, dV, compliance, penalty, unit = cells
    W1, W2, rows, stress = laws.W[0], laws.W[1], laws.rows, laws.stress
    table, ue = np.empty((len(shape), 3 * len(dN))), np.empty((3, len(shape)))
    H, P = np.empty((3, 3 * len(dN))), np.empty((3, 3 * len(dN)))
    F, Cof, FS = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
    C, Ci, S = np.empty(6), np.empty(6), np.empty(6)
    s1, s2, T = np.empty(6), np.empty(6), np.empty(6)
    side_by_side(shape, dN, table)
    for c in range(begin, end):
        cell = Cell(mean[c], Jinv[c], dV[c], compliance[c], penalty[c], unit)
        load_cell(shape, nodes[c], u, ue)
        slopes_of(shape, ue, table, H)
        out[c, :] = 0.0
        moments = lost_moments(shape, modes, H, p, M, cell)
        for q in range(len(dN)):
            deformation_gradient_at(H, q, Jinv[c, q], unit, F)
            J = cofactor_at(F, Cof)
            pq = mean_stress_at(modes, M[q], p, mean[c], J, compliance[c])
            strain_at(J, F, Cof, C, Ci)
            lost = lost_volume_at(modes, J, pq, compliance[c])
            extra = penalty_stress_at(shape, penalty[c, q], moments)
            stress_at(C, Ci, (J, W1[c, q], W2[c, q], pq + extra), s1, s2, T, S)
            if rows[c] >= 0:
                add_stress(stress[rows[c], q], S)
            w = dV[c, q]
            for i in range(3):
                FS[i, 0] = w * (F[i, 0] * S[0] + F[i, 1] * S[3] + F[i, 2] * S[5])
                FS[i, 1] = w * (F[i, 0] * S[3] + F[i, 1] * S[1] + F[i, 2] * S[4])
                FS[i, 2] = w * (F[i, 0] * S[5] + F[i, 1] * S[4] + F[i, 2] * S[2])
                for k in range(3):  # by slopes in the reference cell
                    P[i, 3 * q + k] = (
                        FS[i, 0] * Jinv[c, q, k, 0] + FS[i, 1] * Jinv[c, q, k, 1] + FS[i, 2] * Jinv[c, q, k, 2]
                    )
            volume = w * (lost - extra * compliance[c])
            for m in range(len(modes)):
                out[c, 3 * len(shape) + m] += M[q, m] * volume
        for a in range(len(shape)):
            for i in range(3):
                total = 0.0
                for j in range(table.shape[1]):
                    total += P[i, j] * table[a, j]
                out[c, 3 * a + i] = total


def residual(cells: Cells, u: Array, p: Array, laws: Response) -> Array:
    """Gradient of the energy by cell: internal forces (node by node), then volume constraints.

    Parameters
    ----------
    cells : Cells
    u, p : (n, 3), (m,) arrays
        Displacements and mean stresses.
    laws : Response
    """
    out = np.empty((len(cells.nodes), 3 * len(cells.shape) + len(cells.modes)))
    over(len(out), _residual, out, cells, u, p, laws)
    return out


@njit(**LOOP, fastmath=FAST)
@calls(kernels_geometry, kernels_point, kernels_volume)
def _extrapolated_stress(begin, end, out, cells, u, p, du, dp, laws):
    shape, modes, nodes, mean, dN, M, Jinv, dV, compliance, penalty, unit = cells
    W, rows, stress, moduli = laws
    table, ue = np.empty((len(shape), 3 * len(dN))), np.empty((3, len(shape)))
    H, dH = np.empty((3, 3 * len(dN))), np.empty((3, 3 * len(dN)))
    F, dF, Cof = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
    C, Ci, S = np.empty(6), np.empty(6), np.empty(6)
    s1, s2, T = np.empty(6), np.empty(6), np.empty(6)
    D = np.empty((6, 6))
    E = np.empty(6)
    side_by_side(shape, dN, table)
    for c in range(begin, end):
        cell = Cell(mean[c], Jinv[c], dV[c], compliance[c], penalty[c], unit)
        load_cell(shape, nodes[c], u, ue)
        slopes_of(shape, ue, table, H)
        load_cell(shape, nodes[c], du, ue)
        slopes_of(shape, ue, table, dH)
        moments = lost_moments(shape, modes, H, p, M, cell)
        changes = moment_changes(shape, modes, H, (dH, dp), M, cell)
        for q in range(len(dN)):
            deformation_gradient_at(H, q, Jinv[c, q], unit, F)
            deformation_gradient_at(dH, q, Jinv[c, q], 0.0, dF)
            J = cofactor_at(F, Cof)
            pq = mean_stress_at(modes, M[q], p, mean[c], J, compliance[c])
            dpq = 0.0
            for m in range(len(modes)):
                dpq += M[q, m] * dp[mean[c, m]]
            of_penalty = penalty_stress_at(shape, penalty[c, q], moments)
            change_of_penalty = penalty_stress_at(shape, penalty[c, q], changes)
            pq += of_penalty
            dpq += change_of_penalty
            out[c, q, 6] = of_penalty + change_of_penalty
            strain_at(J, F, Cof, C, Ci)
            scalars = stress_at(C, Ci, (J, W[0, c, q], W[1, c, q], pq), s1, s2, T, S)
            derivatives = (W[0, c, q], W[1, c, q], W[2, c, q], W[3, c, q], W[4, c, q])
            moduli_at(Ci, T, s1, s2, derivatives, (scalars, pq, bulk_modulus(modes, compliance[c])), D)
            if rows[c] >= 0:
                add_stress(stress[rows[c], q], S)
                add_moduli(moduli[rows[c], q], D)
            strain_change_at(F, dF, E)
            for v in range(6):
                total = S[v] + dpq * J * Ci[v]
                for w in range(6):
                    total += D[v, w] * E[w]
                out[c, q, v] = total


def extrapolated_stress(cells: Cells, u: Array, p: Array, du: Array, dp: Array, laws: Response) -> Array:
    """Stress S + D : ΔE linearized about (u, p) for the update (du, dp), (c, q, 7); the last is that of the penalty.

    It enters the geometric stiffness of the next iteration in place of the stress itself: the mixed integration
    point iteration of Magisano, Leonetti and Garcea (2017), doi 10.1016/j.cma.2016.10.023. The other parameters are
    those of `residual`.
    """
    out = np.empty((*cells.dV.shape, 7))
    over(len(out), _extrapolated_stress, out, cells, u, p, du, dp, laws)
    return out
