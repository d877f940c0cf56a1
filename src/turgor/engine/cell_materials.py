"""Materials of the cells: derivatives of the energy at all points, stresses of laws in stretches, compressibility."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.engine import spectral
from turgor.materials.derivatives import energy_and_derivatives, energy_derivatives, stretch_derivatives
from turgor.materials.laws import InvariantLaw, StretchLaw
from turgor.model.model import Model

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Isochoric:
    """What the laws say at all points, scaled: the isochoric part of stress and tangent.

    Parameters
    ----------
    derivatives : (5, c, q) array
        First and second derivatives of the energy by the invariants; zero in cells of laws in stretches.
    stress : (s, q, 6) array
        Second Piola–Kirchhoff stress in the s cells of laws in stretches, in the order of the mesh.
    tangent : (s, q, 21) array
        Lower triangles of 4 ∂²W/∂C² there.
    """

    derivatives: Array
    stress: Array
    tangent: Array


class CellMaterials:
    """The laws of a model's regions, evaluated region by region on whole arrays.

    Parameters
    ----------
    model : Model
    stress : float [Pa]
        Scale that the results are divided by.

    Attributes
    ----------
    compliance : (c,) array
        1/κ, scaled; zero where incompressible.
    stretch_cells : (s,) array of int
        Cells of laws in stretches, in the order of the mesh.
    rows : (c,) array of int
        Place of each cell among them; −1 for the cells of laws in invariants.
    """

    def __init__(self, model: Model, stress: float) -> None:
        self._stress = stress
        regions = [(model.mesh.regions[name], m) for name, m in model.region_materials.items()]
        count = len(model.mesh.cells)
        self.compliance = np.empty(count)
        self.rows = np.full(count, -1, dtype=np.int64)
        for cells, material in regions:
            self.compliance[cells] = 0.0 if material.incompressible else stress / material.bulk_modulus
            if isinstance(material.law, StretchLaw):
                self.rows[cells] = 0
        self.stretch_cells = np.flatnonzero(self.rows == 0)
        self.rows[self.stretch_cells] = np.arange(len(self.stretch_cells))
        self._by_invariants = [(cells, m.law) for cells, m in regions if isinstance(m.law, InvariantLaw)]
        self._by_stretches = [(self.rows[cells], m.law) for cells, m in regions if isinstance(m.law, StretchLaw)]

    def isochoric(self, I1: Array, I2: Array, F: Array) -> Isochoric:
        """Evaluate all laws.

        Parameters
        ----------
        I1, I2 : (c, q) array
            Isochoric invariants.
        F : (s, q, 3, 3) array
            Deformation gradients of `stretch_cells`.
        """
        out = np.zeros((5, *I1.shape)) if self._by_stretches else np.empty((5, *I1.shape))
        for cells, law in self._by_invariants:
            for k, values in enumerate(energy_derivatives(law, I1[cells], I2[cells])):
                out[k, cells] = values / self._stress
        bar, directions, scale = spectral.principal_stretches(F)
        W = np.empty((9, *scale.shape))
        for rows, stretch_law in self._by_stretches:
            for k, values in enumerate(stretch_derivatives(stretch_law, *bar[:, rows])[1:]):
                W[k, rows] = values / self._stress
        return Isochoric(out, *spectral.spectral_response(bar, directions, scale, W[:3], W[3:]))

    def energy(self, I1: Array, I2: Array, F: Array) -> Array:
        """Isochoric strain energy density (c, q) [Pa]; arguments as in `isochoric`."""
        out = np.empty(I1.shape)
        for cells, law in self._by_invariants:
            out[cells] = energy_and_derivatives(law, I1[cells], I2[cells])[0]
        bar, _, _ = spectral.principal_stretches(F)
        for rows, stretch_law in self._by_stretches:
            out[self.stretch_cells[rows]] = stretch_derivatives(stretch_law, *bar[:, rows])[0]
        return out
