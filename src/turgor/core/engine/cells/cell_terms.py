"""Terms of the cells: what the rubber adds to residual and tangent, and where its entries stand."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.pattern import Pattern, cell_places, scatter_add
from turgor.core.engine.cells import kernels, kernels_geometry, kernels_tangent
from turgor.core.engine.cells.cell_materials import CellMaterials, Isochoric
from turgor.core.engine.cells.element import element_of
from turgor.core.engine.cells.internal_variables import History
from turgor.core.engine.cells.stabilization import REGULARIZATION, SERENDIPITY_REGULARIZATION, volume_penalty
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: Entries of cell matrices in memory at once when the tangent is formed: few enough to be added up while the processor
#: still has them close by, which spares a tenth of the time. And cells at least, so that threads have a share each.
CHUNK_ENTRIES, CHUNK_CELLS = 1_000_000, 600


class CellTerms:
    """Cells at rest, their materials, and the derivatives of their energy, in scaled units.

    Parameters
    ----------
    model : Model
    points : (n, 3) array
        Scaled positions at rest.
    stress : float [Pa]
        Scale of stresses.

    Attributes
    ----------
    cells : (c, k) int array
    element : Element
    Jinv, dV : (c, q, 3, 3), (c, q) arrays
        Inverse Jacobians and volumes of the quadrature points.
    materials : CellMaterials
    penalty : (c, q, k) array
        Scaled functions of the moments of volume that are penalized.
    mean_stress_volumes : (m,) array
        Volume that belongs to each mean stress.
    unknowns : (c, s) int array
        Unknowns of every cell: displacements node by node, then mean stresses.
    """

    def __init__(self, model: Model, points: Array, stress: float) -> None:
        self.element = element_of(model)
        self.cells = np.ascontiguousarray(self.element.cells)
        e, r = self.element, self.element.tables
        self.Jinv, self.dV = kernels_geometry.reference_geometry(e.shape, points, self.cells, r.dN, r.weights)
        if not (self.dV > 0).all():
            bad = int((self.dV <= 0).any(axis=1).sum())
            raise TurgorError(f"mesh '{model.mesh.name}': {bad} cells are inside out; refine or straighten the mesh.")
        shares = self.dV @ r.M[:, : len(e.modes)]
        self.mean_stress_volumes = np.bincount(e.mean.ravel(), shares.ravel(), minlength=e.mean_count)
        self.materials = CellMaterials(model, stress, len(r.weights))
        self.penalty = volume_penalty(model, r, self.dV, self.materials.compliance, stress)
        self._loops = kernels.Cells(
            e.shape, e.modes, self.cells, e.mean, r.dN, r.M, self.Jinv, self.dV, self.materials.compliance, self.penalty
        )
        least = SERENDIPITY_REGULARIZATION if model.mesh.serendipity else REGULARIZATION
        self._regular = self._loops._replace(compliance=np.maximum(self.materials.compliance, least))
        chosen = self.materials.gradient_cells
        self._gradient_Jinv = self.Jinv if len(chosen) == len(self.cells) else self.Jinv[chosen]
        self.unknowns = _unknowns(self.cells, e.mean, len(points))

    def locate(self, base: Pattern) -> None:
        """Find the places of all entries in a pattern."""
        self._positions = cell_places(base, self.unknowns)

    def _chunks(self) -> list[slice]:
        cells = max(CHUNK_CELLS, CHUNK_ENTRIES // self._positions.shape[1])
        return [slice(start, start + cells) for start in range(0, len(self.cells), cells)]

    def gradients(self, u: Array) -> Array:
        """Deformation gradients (c, q, 3, 3) of all cells at displacements (n, 3)."""
        return np.asarray(
            kernels_geometry.deformation_gradients(self.element.shape, self.cells, u, self.element.tables.dN, self.Jinv)
        )

    def laws(self, u: Array, history: History) -> Isochoric | None:
        """Stresses of the laws at displacements (n, 3); None where a cell is turned inside out."""
        e, r = self.element, self.element.tables
        I1, I2, _ = kernels_geometry.kinematics(e.shape, self.cells, u, r.dN, self.Jinv)
        if not np.isfinite(I1).all():
            return None
        chosen = self.cells[self.materials.gradient_cells]
        F = kernels_geometry.deformation_gradients(e.shape, chosen, u, r.dN, self._gradient_Jinv)
        return self.materials.isochoric(I1, I2, F, history)

    def _response(self, laws: Isochoric) -> kernels.Response:
        return kernels.Response(laws.derivatives, self.materials.rows, laws.stress, laws.tangent)

    def forces(self, u: Array, p: Array, laws: Isochoric) -> Array:
        """Gradient of the energy of every cell (c, s) at displacements (n, 3) and mean stresses (m,)."""
        return np.asarray(kernels.residual(self._loops, u, p, self._response(laws)))

    def add_tangents(
        self, data: Array, place: tuple[Array, Array], laws: Isochoric, geometric: Array | None, exact: bool
    ) -> None:
        """Add the Hessians of all cells at displacements and mean stresses to the tangent.

        They have linearized stresses (c, q, 7) of their own, and are regular enough to be factored, unless ``exact``.
        """
        response, nothing, loops = self._response(laws), np.zeros((1, 1, 6)), self._loops if exact else self._regular
        for chunk in self._chunks():
            stresses = nothing if geometric is None else geometric[chunk]
            cells, part = loops.part(chunk), response.part(chunk)
            packed = kernels_tangent.tangent(cells, *place, part, stresses, geometric is not None)
            scatter_add(data, self._positions[chunk].ravel(), packed.ravel())

    def add_entries(self, data: Array, entries: Integers, values: Array) -> None:
        """Add chosen entries (k,) of the lower triangles of cell matrices, values (c, k)."""
        for chunk in self._chunks():
            scatter_add(data, self._positions[chunk][:, entries].ravel(), values[chunk].ravel())

    def stresses(self, at: tuple[Array, Array], update: tuple[Array, Array], laws: Isochoric) -> Array:
        """Stresses (c, q, 7) linearized about displacements and mean stresses for an update of both."""
        return np.asarray(kernels.extrapolated_stress(self._loops, *at, *update, self._response(laws)))


def _unknowns(cells: Integers, mean: Integers, node_count: int) -> Integers:
    displacement = (3 * cells[:, :, None] + np.arange(3)).reshape(len(cells), 3 * cells.shape[1])
    return np.ascontiguousarray(np.hstack([displacement, 3 * node_count + mean]))
