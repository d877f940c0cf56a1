"""Terms of the cells: what the rubber adds to residual and tangent, and where its entries stand."""

from copy import copy

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.pattern import Pattern, cell_places, scatter_add
from turgor.core.engine.cells import kernels, kernels_geometry, kernels_tangent
from turgor.core.engine.cells.cell_materials import CellMaterials, Isochoric
from turgor.core.engine.cells.element import element_of
from turgor.core.engine.cells.internal_variables import History
from turgor.core.engine.cells.stabilization import REGULARIZATION, SERENDIPITY_REGULARIZATION, volume_penalty
from turgor.core.engine.cells.states.body_states import has_states, networks_of, rest_of, stiffness_of
from turgor.core.engine.compiled import in_order
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: Entries of cell matrices that one thread computes at once when the tangent is formed: few enough to be added up while
#: the processor still has them close by, which spares a tenth of the time, and that no thread waits long for another.
CHUNK_ENTRIES = 200_000


class CellTerms:
    """Cells at rest, their materials, and the derivatives of their energy, in scaled units.

    Parameters
    ----------
    model : Model
    points : (n, 3) array
        Scaled positions at rest.
    length, stress : float [m], [Pa]
        Scales.

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

    def __init__(self, model: Model, points: Array, length: float, stress: float) -> None:
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
        self._gradient_Jinv = self._of_gradient_cells(self.Jinv)
        self.unknowns = _unknowns(self.cells, e.mean, len(points))
        self._model, self._points, self._scales = model, points, (length, stress)
        self._unit, self._states = 1.0, has_states(model)
        self._last: tuple[float, CellTerms] | None = None

    def _of_gradient_cells(self, values: Array) -> Array:
        chosen = self.materials.gradient_cells
        return values if len(chosen) == len(self.cells) else values[chosen]

    def at(self, load_factor: float) -> "CellTerms":
        """The same cells with the stress-free configuration and the stiffness that loads give them at a load factor."""
        if not self._states:
            return self
        if self._last is None or self._last[0] != load_factor:
            self._last = (load_factor, self._changed(load_factor))
        return self._last[1]

    def _changed(self, load_factor: float) -> "CellTerms":
        out, r, (length, stress) = copy(self), self.element.tables, self._scales
        places = np.einsum("qa,cai->cqi", r.N, self._points[self.cells]) * length
        rest, factors = rest_of(self._model, places, load_factor), stiffness_of(self._model, load_factor)
        out.Jinv, out.dV, out._unit = self.Jinv @ rest.inverse, self.dV * rest.volume, 0.0
        out._states = False
        out._gradient_Jinv = self._of_gradient_cells(out.Jinv)
        networks = networks_of(self._model, self.materials.rows, rest, load_factor, self._shape_gradients)
        out.materials = self.materials.with_states(factors.copy(), networks)
        for network in networks:
            factors[network.cells] += network.factor.mean(axis=1)
        out.penalty = volume_penalty(self._model, r, self.dV, self.materials.compliance, stress, factors)
        changed = {"Jinv": out.Jinv, "dV": out.dV, "penalty": out.penalty, "unit": 0.0}
        out._loops, out._regular = self._loops._replace(**changed), self._regular._replace(**changed)
        return out

    def _shape_gradients(self, cells: Integers, displacement: Array) -> Array:
        e, scaled = self.element, displacement / self._scales[0]
        return np.asarray(
            kernels_geometry.deformation_gradients(e.shape, self.cells[cells], scaled, e.tables.dN, self.Jinv[cells])
        )

    def _moved(self, u: Array) -> Array:
        """What the loops take: displacements (n, 3), or positions where cells have a rest of their own."""
        return u if self._unit else self._points + u

    def locate(self, base: Pattern) -> None:
        """Find the places of all entries in a pattern."""
        self._positions = cell_places(base, self.unknowns)
        self._last = None  # a copy has no places

    def _chunks(self) -> list[slice]:
        cells = max(1, CHUNK_ENTRIES // self._positions.shape[1])
        return [slice(start, start + cells) for start in range(0, len(self.cells), cells)]

    def gradients(self, u: Array) -> Array:
        """Deformation gradients (c, q, 3, 3) of all cells from the stress-free configuration."""
        return self._gradients(self.cells, u, self.Jinv)

    def _gradients(self, cells: Integers, u: Array, Jinv: Array) -> Array:
        e, moved = self.element, self._moved(u)
        return np.asarray(kernels_geometry.deformation_gradients(e.shape, cells, moved, e.tables.dN, Jinv, self._unit))

    def kinematics(self, u: Array) -> tuple[Array, Array, Array]:
        """Isochoric invariants and volume ratio (c, q) from the stress-free configuration."""
        e = self.element
        return kernels_geometry.kinematics(e.shape, self.cells, self._moved(u), e.tables.dN, self.Jinv, self._unit)

    def laws(self, u: Array, history: History) -> Isochoric | None:
        """Stresses of the laws at displacements (n, 3); None where a cell is turned inside out."""
        I1, I2, _ = self.kinematics(u)
        if not np.isfinite(I1).all():
            return None
        return self.materials.isochoric(I1, I2, self.gradients_of_laws(u), history)

    def gradients_of_laws(self, u: Array) -> Array:
        """Deformation gradients (s, q, 3, 3) of the cells whose laws need them."""
        return self._gradients(self.cells[self.materials.gradient_cells], u, self._gradient_Jinv)

    def _response(self, laws: Isochoric) -> kernels.Response:
        return kernels.Response(laws.derivatives, self.materials.rows, laws.stress, laws.tangent)

    def forces(self, u: Array, p: Array, laws: Isochoric) -> Array:
        """Gradient of the energy of every cell (c, s) at displacements (n, 3) and mean stresses (m,)."""
        return np.asarray(kernels.residual(self._loops, self._moved(u), p, self._response(laws)))

    def add_tangents(
        self, data: Array, place: tuple[Array, Array], laws: Isochoric, geometric: Array | None, exact: bool
    ) -> None:
        """Add the Hessians of all cells at displacements and mean stresses to the tangent.

        They have linearized stresses (c, q, 7) of their own, and are regular enough to be factored, unless ``exact``.
        """
        response, nothing, loops = self._response(laws), np.zeros((1, 1, 6)), self._loops if exact else self._regular
        moved = self._moved(place[0])

        def tangents(chunk: slice) -> Array:
            stresses = nothing if geometric is None else geometric[chunk]
            cells, part = loops.part(chunk), response.part(chunk)
            return np.asarray(kernels_tangent.tangent(cells, moved, place[1], part, stresses, geometric is not None))

        chunks = self._chunks()
        for chunk, packed in zip(chunks, in_order(tangents, chunks), strict=True):
            scatter_add(data, self._positions[chunk].ravel(), packed.ravel())

    def add_entries(self, data: Array, entries: Integers, values: Array) -> None:
        """Add chosen entries (k,) of the lower triangles of cell matrices, values (c, k)."""
        for chunk in self._chunks():
            scatter_add(data, self._positions[chunk][:, entries].ravel(), values[chunk].ravel())

    def stresses(self, at: tuple[Array, Array], update: tuple[Array, Array], laws: Isochoric) -> Array:
        """Stresses (c, q, 7) linearized about displacements and mean stresses for an update of both."""
        return np.asarray(
            kernels.extrapolated_stress(self._loops, self._moved(at[0]), at[1], *update, self._response(laws))
        )


def _unknowns(cells: Integers, mean: Integers, node_count: int) -> Integers:
    displacement = (3 * cells[:, :, None] + np.arange(3)).reshape(len(cells), 3 * cells.shape[1])
    return np.ascontiguousarray(np.hstack([displacement, 3 * node_count + mean]))
