"""Materials of the cells: derivatives of the energy at all points, stresses of laws in stretches, compressibility."""

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells import spectral
from turgor.core.engine.cells.element import tables_with
from turgor.core.engine.cells.internal_variables import (
    History,
    Memory,
    RegionMemory,
    joined_memory,
    right_cauchy_green,
)
from turgor.core.engine.cells.known_stress import add_known_stress
from turgor.core.engine.cells.states.body_states import hardens
from turgor.core.engine.cells.states.networks import Network
from turgor.core.materials.history.softening import INVARIANT_PAIRS
from turgor.core.materials.laws.derivatives import STRETCH_PAIRS, energy_and_derivatives, stretch_derivatives
from turgor.core.materials.laws.fiber_family import elongation, family_response
from turgor.core.materials.laws.foam_volume import foam_bulk, less_volume, less_volume_energy
from turgor.core.materials.laws.laws import FiberLaw, FoamLaw, InvariantLaw, Law, StretchLaw
from turgor.core.materials.material import Material
from turgor.core.materials.oriented import families_at
from turgor.core.model.model import Model

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Isochoric:
    """Answer of the laws at all points, scaled: the isochoric part of stress and tangent.

    Parameters
    ----------
    derivatives : (5, c, q) array
        First and second derivatives of the energy by the invariants; zero in cells of laws in stretches.
    stress : (s, q, 6) array
        Second Piola–Kirchhoff stress in the s `gradient_cells` besides that, in the order of the mesh: of laws in
        stretches, of fibers, and what a rubber that relaxes remembers.
    tangent : (s, q, 21) array
        Lower triangles of 4 ∂²W/∂C² of it.
    """

    derivatives: Array
    stress: Array
    tangent: Array


@dataclass(frozen=True, slots=True, eq=False)
class _Region:
    """Cells of one material, and their rows among the gradient cells."""

    name: str
    cells: Ints
    rows: Ints
    material: Material

    @property
    def law(self) -> Law:
        law = self.material.law
        assert isinstance(law, Law | FiberLaw)
        return law.matrix if isinstance(law, FiberLaw) else law

    @property
    def foam(self) -> FoamLaw | None:
        return self.material.law if isinstance(self.material.law, FoamLaw) else None

    @property
    def remembers(self) -> bool:
        return self.material.remembers

    @property
    def sets(self) -> bool:
        """Whether a network that flows replaces the law."""
        return self.material.permanent_set is not None


class CellMaterials:
    """The laws of a model's regions, evaluated region by region on whole arrays.

    Parameters
    ----------
    model : Model
    stress : float [Pa]
        Scale that the results are divided by.
    points : int
        Integration points of a cell.

    Attributes
    ----------
    compliance : (c,) array
        1/κ, scaled; zero where incompressible, and of a share of the resistance where a foam has its own.
    gradient_cells : (s,) array of int
        Cells whose deformation gradients are needed, in the order of the mesh: those of laws in stretches or with
        fibers, and those that relax.
    rows : (c,) array of int
        Place of each cell among them; −1 for the cells that invariants are enough for.
    rest : History
        That of a sudden step from rest.
    """

    def __init__(self, model: Model, stress: float, points: int) -> None:
        self._stress = stress
        regions = [(name, model.mesh.regions[name], m) for name, m in model.region_materials.items()]
        count = len(model.mesh.cells)
        self.compliance = np.empty(count)
        self.rows = np.full(count, -1, dtype=np.int64)
        in_stretches = np.zeros(count, dtype=bool)
        for name, cells, material in regions:
            bulk = foam_bulk(material.law) if isinstance(material.law, FoamLaw) else material.bulk_modulus
            self.compliance[cells] = stress / bulk
            in_stretches[cells] = isinstance(material.law, StretchLaw) and material.permanent_set is None
            in_gradients = isinstance(material.law, StretchLaw | FiberLaw) or hardens(model, name)
            if in_gradients or material.viscoelasticity is not None or material.permanent_set is not None:
                self.rows[cells] = 0
        self.gradient_cells = np.flatnonzero(self.rows == 0)
        self.rows[self.gradient_cells] = np.arange(len(self.gradient_cells))
        self._spectral = np.flatnonzero(in_stretches[self.gradient_cells])
        self._regions = []
        for name, cells, material in regions:
            self._regions.append(_Region(name, cells, self.rows[cells], material))
        self._points = points
        self._fibers = {
            name: families_at(m, _places(model, cells, points)) for name, cells, m in regions if m.has_fibers
        }
        self._factors: Array | None = None
        self._networks: tuple[Network, ...] = ()
        self._remembering = [region for region in self._regions if region.remembers]
        self.rest = self.history()

    def with_states(self, factors: Array, networks: tuple[Network, ...]) -> "CellMaterials":
        """The same materials with a factor (c,) on the isochoric stress of each cell, and with networks besides."""
        out = copy(self)
        out._factors, out._networks = factors, networks
        return out

    @property
    def remembers(self) -> bool:
        """Whether any rubber relaxes or softens."""
        return bool(self._remembering)

    def history(self, memory: Memory | None = None, step: float = 0.0) -> History:
        """Memory that a state brings into a step of a length [s]; None is the state at rest."""
        return History(
            {
                region.name: RegionMemory.of(
                    region.material, (len(region.cells), self._points), memory, region.name, step
                )
                for region in self._remembering
            }
        )

    def isochoric(self, I1: Array, I2: Array, F: Array, history: History) -> Isochoric:
        """Evaluate all laws.

        Parameters
        ----------
        I1, I2 : (c, q) array
            Isochoric invariants.
        F : (s, q, 3, 3) array
            Deformation gradients of `gradient_cells`.
        history : History
        """
        partial = len(self._spectral) or any(region.sets for region in self._regions)
        out = np.zeros((5, *I1.shape)) if partial else np.empty((5, *I1.shape))
        for region in self._regions:
            if isinstance(region.law, InvariantLaw) and not region.sets:
                derivatives = energy_and_derivatives(region.law, I1[region.cells], I2[region.cells])
                for k, values in enumerate(_response(history, region, derivatives, INVARIANT_PAIRS)):
                    out[k, region.cells] = values / self._stress
        stress, tangent = self._in_stretches(F, history)
        for region in self._remembering:
            its = history.regions[region.name]
            if its.known is not None:
                add_known_stress(F, region.rows, its.known, self._stress, stress, tangent)
            its.add_flow(F, region.rows, self._stress, (stress, tangent))
        self._add_fibers(F, stress, tangent)
        if self._factors is not None:
            out *= self._factors[:, None]
            stress *= self._factors[self.gradient_cells, None, None]
            tangent *= self._factors[self.gradient_cells, None, None]
        for network in self._networks:
            network.add_response(F, stress, tangent, self._stress)
        return Isochoric(out, stress, tangent)

    def _add_fibers(self, F: Array, stress: Array, tangent: Array) -> None:
        """Add what fibers in bodies resist, in place."""
        for region in self._regions:
            for family, H in self._fibers.get(region.name, ()):
                S, D = family_response(family, H, right_cauchy_green(F[region.rows]))
                stress[region.rows] += S / self._stress
                tangent[region.rows] += D / self._stress

    def _in_stretches(self, F: Array, history: History) -> tuple[Array, Array]:
        """Stress and tangent in the gradient cells whose law is one in stretches; zero in the others."""
        among, count = self._spectral, len(self.gradient_cells)
        if not len(among):
            return np.zeros((count, F.shape[1], 6)), np.zeros((count, F.shape[1], spectral.TANGENT))
        bar, directions, scale = spectral.principal_stretches(F if len(among) == count else F[among])
        W, projected = np.empty((9, *scale.shape)), np.ones(len(scale))
        for region in self._regions:
            if isinstance(region.law, StretchLaw) and not region.sets:
                at = np.searchsorted(among, region.rows)
                if region.foam is not None:
                    bar[:, at] *= scale[at]
                    scale[at], projected[at] = 1.0, 0.0
                derivatives = stretch_derivatives(region.law, *bar[:, at])
                for k, values in enumerate(_response(history, region, derivatives, STRETCH_PAIRS)):
                    W[k, at] = values / self._stress
                if region.foam is not None:
                    W[:, at] = less_volume(region.foam, bar[:, at], W[:, at], self._stress)
        response = spectral.spectral_response(bar, directions, scale, W[:3], W[3:], projected)
        if len(among) == count:
            return response[0], response[1]
        stress, tangent = np.zeros((count, F.shape[1], 6)), np.zeros((count, F.shape[1], spectral.TANGENT))
        stress[among], tangent[among] = response
        return stress, tangent

    def energy(self, I1: Array, I2: Array, F: Array, history: History) -> Array:
        """Isochoric strain energy density (c, q) [Pa] that can be got back; arguments as in `isochoric`.

        Of a rubber that relaxes or softens it is what infinitely slow unloading gives back.
        """
        out = np.empty(I1.shape)
        for region in self._regions:
            its = history.regions.get(region.name)
            if its is not None and region.sets:
                W = its.networks[0].energy(F[region.rows])
            else:
                W = self._law_energy(region, I1, I2, F)
            for family, H in self._fibers.get(region.name, ()):
                W = W + family.energy(elongation(H, right_cauchy_green(F[region.rows])))[0]
            out[region.cells] = its.recoverable(W) if its is not None else W
        if self._factors is not None:
            out *= self._factors[:, None]
        for network in self._networks:
            out[network.cells] += network.energy(F)
        return out

    def remembered(self, F: Array, history: History) -> Memory | None:
        """Memory of the state at the end of a step.

        Parameters
        ----------
        F : (c, q, 3, 3) array
            Deformation gradients of all cells.
        history : History
            What the step began with.
        """
        stress, largest, flow = {}, {}, {}
        for region in self._remembering:
            here, its = F[region.cells], history.regions[region.name]
            if its.networks:
                flow[region.name] = its.next_flow(here)
            if its.stress is None and its.largest is None:
                continue
            S, W = its.own_stress(here)
            if its.stress is not None:
                stress[region.name] = its.next_stress(S, here)
            if its.largest is not None:
                largest[region.name] = its.next_largest(its.networks[0].energy(here) if region.sets else W)
        return joined_memory(stress, largest, flow=flow)

    def softening_loss(self, memory: Memory) -> Array:
        """Energy density (c, q) [Pa] that softening and set have taken, as infinitely slow cycles would measure it."""
        out = np.zeros((len(self.rows), self._points))
        for region in self._remembering:
            out[region.cells] = self.rest.regions[region.name].lost(memory, region.name)
        return out

    def _law_energy(self, region: _Region, I1: Array, I2: Array, F: Array) -> Array:
        """Energy density (c, q) [Pa] of a region's law itself."""
        if isinstance(region.law, InvariantLaw):
            return energy_and_derivatives(region.law, I1[region.cells], I2[region.cells])[0]
        bar, _, scale = spectral.principal_stretches(F[region.rows])
        if region.foam is not None:
            return less_volume_energy(region.foam, bar * scale)
        return stretch_derivatives(region.law, *bar)[0]


def _response(
    history: History, region: _Region, values: tuple[Array, ...], pairs: tuple[tuple[int, int], ...]
) -> Sequence[Array] | Array:
    """First and second derivatives of the energy in the step; ``values`` are the law's, its energy first."""
    return history.regions[region.name].response(values, pairs) if region.remembers else values[1:]


def _places(model: Model, cells: Ints, points: int) -> Array:
    """Where the integration points of cells are at rest, (c, q, 3) [m]."""
    nodes = model.mesh.carrying_cells[cells]
    N = tables_with(nodes.shape[1], points).N
    return np.einsum("qa,cai->cqi", N, model.mesh.points[nodes])
