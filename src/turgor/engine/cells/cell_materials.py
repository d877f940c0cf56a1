"""Materials of the cells: derivatives of the energy at all points, stresses of laws in stretches, compressibility."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.engine.cells import spectral
from turgor.engine.cells.known_stress import add_known_stress
from turgor.engine.cells.memory import Memory, RegionMemory, invariant_stress
from turgor.materials.history.softening import INVARIANT_PAIRS
from turgor.materials.laws.derivatives import STRETCH_PAIRS, energy_and_derivatives, stretch_derivatives
from turgor.materials.laws.laws import InvariantLaw, Law, StretchLaw
from turgor.model.model import Model

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Isochoric:
    """What the laws say at all points, scaled: the isochoric part of stress and tangent.

    Parameters
    ----------
    derivatives : (5, c, q) array
        First and second derivatives of the energy by the invariants; zero in cells of laws in stretches.
    stress : (s, q, 6) array
        Second Piola–Kirchhoff stress in the s `gradient_cells` besides that, in the order of the mesh: of laws in
        stretches, and what a rubber that relaxes remembers.
    tangent : (s, q, 21) array
        Lower triangles of 4 ∂²W/∂C² of it.
    """

    derivatives: Array
    stress: Array
    tangent: Array


@dataclass(frozen=True, slots=True, eq=False)
class _Region:
    """Cells of one material, their rows among the gradient cells, and what they remember."""

    name: str
    cells: Ints
    rows: Ints
    law: Law
    memory: RegionMemory | None

    @property
    def relaxes(self) -> bool:
        return self.memory is not None and self.memory.stress is not None


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
        1/κ, scaled; zero where incompressible.
    gradient_cells : (s,) array of int
        Cells whose deformation gradients are needed, in the order of the mesh: those of laws in stretches, and those
        that relax.
    rows : (c,) array of int
        Place of each cell among them; −1 for the cells that invariants are enough for.
    """

    def __init__(self, model: Model, stress: float, points: int) -> None:
        self._stress = stress
        regions = [(name, model.mesh.regions[name], m) for name, m in model.region_materials.items()]
        count = len(model.mesh.cells)
        self.compliance = np.empty(count)
        self.rows = np.full(count, -1, dtype=np.int64)
        in_stretches = np.zeros(count, dtype=bool)
        for _, cells, material in regions:
            self.compliance[cells] = 0.0 if material.incompressible else stress / material.bulk_modulus
            in_stretches[cells] = isinstance(material.law, StretchLaw)
            if isinstance(material.law, StretchLaw) or material.viscoelasticity is not None:
                self.rows[cells] = 0
        self.gradient_cells = np.flatnonzero(self.rows == 0)
        self.rows[self.gradient_cells] = np.arange(len(self.gradient_cells))
        self._spectral = np.flatnonzero(in_stretches[self.gradient_cells])
        self._regions = []
        for name, cells, material in regions:
            assert isinstance(material.law, Law)
            remembers = material.viscoelasticity is not None or material.stress_softening is not None
            memory = RegionMemory(material, (len(cells), points)) if remembers else None
            self._regions.append(_Region(name, cells, self.rows[cells], material.law, memory))
        self._remembering = [region for region in self._regions if region.memory is not None]

    @property
    def remembers(self) -> bool:
        """Whether any rubber relaxes or softens."""
        return bool(self._remembering)

    @property
    def memory(self) -> Memory | None:
        """Internal variables of the last converged state; set them to continue from another state."""
        pairs = [(region.name, region.memory) for region in self._regions]
        return _memory(
            {name: memory.stress for name, memory in pairs if memory and memory.stress is not None},
            {name: memory.largest for name, memory in pairs if memory and memory.largest is not None},
        )

    @memory.setter
    def memory(self, memory: Memory | None) -> None:
        for region in self._remembering if memory is not None else ():
            assert region.memory is not None and memory is not None
            region.memory.stress = memory.stress.get(region.name)
            region.memory.largest = memory.largest.get(region.name)

    def begin_step(self, step: float) -> None:
        """Begin a step of a length [s] from what is remembered; 0 is a sudden one, infinite an infinitely slow one."""
        for region in self._remembering:
            assert region.memory is not None
            region.memory.begin_step(step)

    def isochoric(self, I1: Array, I2: Array, F: Array) -> Isochoric:
        """Evaluate all laws.

        Parameters
        ----------
        I1, I2 : (c, q) array
            Isochoric invariants.
        F : (s, q, 3, 3) array
            Deformation gradients of `gradient_cells`.
        """
        out = np.zeros((5, *I1.shape)) if len(self._spectral) else np.empty((5, *I1.shape))
        for region in self._regions:
            if isinstance(region.law, InvariantLaw):
                found = energy_and_derivatives(region.law, I1[region.cells], I2[region.cells])
                for k, values in enumerate(_response(region, found, INVARIANT_PAIRS)):
                    out[k, region.cells] = values / self._stress
        stress, tangent = self._in_stretches(F)
        for region in self._remembering:
            if region.memory is not None and region.memory.known is not None:
                add_known_stress(F, region.rows, region.memory.known, self._stress, stress, tangent)
        return Isochoric(out, stress, tangent)

    def _in_stretches(self, F: Array) -> tuple[Array, Array]:
        """Stress and tangent in the gradient cells whose law is one in stretches; zero in the others."""
        among, count = self._spectral, len(self.gradient_cells)
        bar, directions, scale = spectral.principal_stretches(F if len(among) == count else F[among])
        W = np.empty((9, *scale.shape))
        for region in self._regions:
            if isinstance(region.law, StretchLaw):
                at = np.searchsorted(among, region.rows)
                derivatives = stretch_derivatives(region.law, *bar[:, at])
                for k, values in enumerate(_response(region, derivatives, STRETCH_PAIRS)):
                    W[k, at] = values / self._stress
        found = spectral.spectral_response(bar, directions, scale, W[:3], W[3:])
        if len(among) == count:
            return found[0], found[1]
        stress, tangent = np.zeros((count, F.shape[1], 6)), np.zeros((count, F.shape[1], spectral.TANGENT))
        stress[among], tangent[among] = found
        return stress, tangent

    def energy(self, I1: Array, I2: Array, F: Array) -> Array:
        """Isochoric strain energy density (c, q) [Pa] that can be got back; arguments as in `isochoric`.

        Of a rubber that relaxes or softens it is what infinitely slow unloading gives back.
        """
        out = np.empty(I1.shape)
        for region in self._regions:
            W = self._law_energy(region, I1, I2, F)
            out[region.cells] = W if region.memory is None else region.memory.recoverable(W)
        return out

    def remembered(self, F: Array) -> Memory | None:
        """What the state at the end of the step that has begun remembers.

        Parameters
        ----------
        F : (c, q, 3, 3) array
            Deformation gradients of all cells.
        """
        stress, largest = {}, {}
        for region in self._remembering:
            assert region.memory is not None
            here = F[region.cells]
            S, W = _own_stress(region, here)
            if region.relaxes:
                stress[region.name] = region.memory.next_stress(S, here)
            if region.memory.largest is not None:
                largest[region.name] = region.memory.next_largest(W)
        return _memory(stress, largest)

    def softening_loss(self, memory: Memory) -> Array:
        """Energy density (c, q) [Pa] that softening has taken, as infinitely slow cycles would measure it."""
        count, points = len(self.rows), next(iter(memory.largest.values())).shape[1]
        out = np.zeros((count, points))
        for region in self._remembering:
            if region.memory is not None and region.name in memory.largest:
                out[region.cells] = region.memory.lost(memory.largest[region.name])
        return out

    def _law_energy(self, region: _Region, I1: Array, I2: Array, F: Array) -> Array:
        """Energy density (c, q) [Pa] of a region's law itself."""
        if isinstance(region.law, InvariantLaw):
            return energy_and_derivatives(region.law, I1[region.cells], I2[region.cells])[0]
        bar, _, _ = spectral.principal_stretches(F[region.rows])
        return stretch_derivatives(region.law, *bar)[0]


def _response(
    region: _Region, values: tuple[Array, ...], pairs: tuple[tuple[int, int], ...]
) -> Sequence[Array] | Array:
    """First and second derivatives of the energy in the step; ``values`` are the law's, its energy first."""
    return values[1:] if region.memory is None else region.memory.response(values, pairs)


def _own_stress(region: _Region, F: Array) -> tuple[Array, Array]:
    """Isochoric stress (c, q, 6) of the softened law and energy density (c, q) of the law [Pa]."""
    assert region.memory is not None
    bar, directions, scale = spectral.principal_stretches(F)
    if isinstance(region.law, StretchLaw):
        values = stretch_derivatives(region.law, *bar)
        W = np.ascontiguousarray(region.memory.softened(values, STRETCH_PAIRS))
        return spectral.spectral_response(bar, directions, scale, W[:3], W[3:])[0], values[0]
    I1 = (bar**2).sum(axis=0)
    I2 = (bar[0] * bar[1]) ** 2 + (bar[1] * bar[2]) ** 2 + (bar[0] * bar[2]) ** 2
    values = energy_and_derivatives(region.law, I1, I2)
    first = region.memory.softened(values, INVARIANT_PAIRS)
    return invariant_stress(first[0], first[1], F), values[0]


def _memory(stress: dict[str, Array], largest: dict[str, Array]) -> Memory | None:
    return Memory(stress=stress, largest=largest) if stress or largest else None
