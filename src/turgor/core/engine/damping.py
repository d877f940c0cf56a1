"""Damping: viscous forces in proportion to the rate of strain, or of the gradient of the displacement."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells import kernels, kernels_geometry, kernels_tangent
from turgor.core.engine.faces.membranes import surface_frames
from turgor.core.engine.system import System
from turgor.foundation.errors import TurgorError
from turgor.foundation.symmetric import COLUMNS, ROWS

Array = NDArray[np.float64]


class StrainRateDamping:
    """Viscous stress S = 2 μ τ dev Ė with the rate of Green's strain, μ the initial shear modulus, τ a time.

    About the state at rest this is the damping matrix τ K of Rayleigh, with K the stiffness against change of shape. At
    large rotations it remains what it should be: no force resists a rigid motion, and the power S : Ė is never
    negative. Membranes and fibers are not damped; films without a solid are refused.

    Parameters
    ----------
    system : System
    time : float [s]
        τ, Rayleigh's β.
    rate, offset : float [1/s], (size,) array
        The scaled velocity is rate times the unknowns plus offset.
    """

    def __init__(self, system: System, time: float, rate: float, offset: Array) -> None:
        self._system, self._rate, self._offset = system, rate, offset
        model = system.model
        if not len(system.cells):
            raise TurgorError(
                f"stiffness_damping is {time:g} s; it acts on solids, and '{model.mesh.name}' consists of films. "
                "Leave it out, or take mass_damping."
            )
        viscosity = np.empty(len(model.mesh.cells))
        for name, material in model.region_materials.items():
            viscosity[model.mesh.regions[name]] = 2 * time * material.law.shear_modulus / system.stress_scale
        self._viscosity = viscosity
        self._rows = np.arange(len(viscosity))
        e, r = system.element, system.element.tables
        no_bulk = np.full(len(viscosity), 0.0 if e.modes else np.inf)  # the loops add no mean stress of their own
        no_penalty = np.zeros((*system.dV.shape, 0))
        self._cells = kernels.Cells(
            e.shape, e.modes, system.cells, e.mean, r.dN, r.M, system.Jinv, system.dV, no_bulk, no_penalty
        )
        self._mean = np.zeros(max(e.mean_count, 1))
        self._no_law = np.zeros((5, *system.dV.shape))

    def forces(self, unknowns: Array) -> Array:
        """Forces of the viscous stress (size,)."""
        u, none = self._system.split(unknowns)[0], np.zeros((1, 1, 21))
        by_cell = kernels.residual(self._cells, u, self._mean, self._response(unknowns, none))
        return self._system.gathered(by_cell[:, : 3 * len(self._cells.shape)])

    def data(self, unknowns: Array) -> Array:
        """Symmetric part of the derivative that matters: the viscosity, and the stress as it turns."""
        system, u = self._system, self._system.split(unknowns)[0]
        moduli = np.empty((*system.dV.shape, 21))
        moduli[:] = (self._rate * self._viscosity)[:, None, None] * _deviator_moduli()
        packed = kernels_tangent.tangent(
            self._cells, u, self._mean, self._response(unknowns, moduli), np.zeros((1, 1, 6)), False
        )
        rows, _ = np.tril_indices(system.cell_size)
        chosen = np.flatnonzero(rows < 3 * len(self._cells.shape))
        return system.scattered(chosen, packed[:, chosen])

    def _response(self, unknowns: Array, moduli: Array) -> kernels.Response:
        """The viscous stress in place of that of laws."""
        return kernels.Response(self._no_law, self._rows, self._stress(unknowns), moduli)

    def _stress(self, unknowns: Array) -> Array:
        """Viscous stress (c, q, 6)."""
        system, e, r = self._system, self._system.element, self._system.element.tables
        u = system.split(unknowns)[0]
        v = system.split(self._rate * unknowns + self._offset)[0]
        F = kernels_geometry.deformation_gradients(e.shape, system.cells, u, r.dN, system.Jinv)
        G = kernels_geometry.deformation_gradients(e.shape, system.cells, v, r.dN, system.Jinv) - np.eye(3)
        product = np.swapaxes(F, -1, -2) @ G
        rate = 0.5 * (product + np.swapaxes(product, -1, -2))
        rate -= np.trace(rate, axis1=-2, axis2=-1)[..., None, None] / 3 * np.eye(3)
        return np.ascontiguousarray(self._viscosity[:, None, None] * rate[..., ROWS, COLUMNS])


def gradient_stiffness(system: System) -> Array:
    """Lower triangle (nnz,) of ∫ ∇u · ∇u dV on the pattern of a system's tangent, scaled as for a modulus of 1.

    Films without a solid count as layers of an edge.

    It resists short waves most, in which thin cells turn inside out, and a flat film bulges against it as one piece.

    Parameters
    ----------
    system : System
    """
    if len(system.cells):
        gradients, volumes = np.einsum("qnj,cqji->cqni", system.element.tables.dN, system.Jinv), system.dV
    else:
        frames = surface_frames(system.points, system.model.mesh.film_sides)
        gradients, volumes = frames.gradients, frames.areas
    rows, columns = np.tril_indices(system.piece_unknowns.shape[1])
    same = (rows % 3 == columns % 3) & (rows < 3 * gradients.shape[2])
    a, b = rows[same] // 3, columns[same] // 3
    products = np.einsum("cq,cqni,cqmi->cnm", volumes, gradients, gradients)
    return system.scattered(np.flatnonzero(same), products[:, a, b])


def _deviator_moduli() -> Array:
    """Lower triangle (21,) of the tensor that takes the deviator of a symmetric one, as the kernels store it."""
    full = np.diag([1.0, 1.0, 1.0, 0.5, 0.5, 0.5])
    full[:3, :3] -= 1 / 3
    return full[np.tril_indices(6)]
