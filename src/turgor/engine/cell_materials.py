"""Materials of the cells: derivatives of the energy at all points, compressibility by cell."""

import numpy as np
from numpy.typing import NDArray

from turgor.materials.derivatives import energy_and_derivatives, energy_derivatives
from turgor.materials.laws import Law
from turgor.model.model import Model

Array = NDArray[np.float64]


class CellMaterials:
    """The laws of a model's regions, evaluated region by region on whole arrays.

    Parameters
    ----------
    model : Model
    stress : float [Pa]
        Scale that the results are divided by.
    """

    def __init__(self, model: Model, stress: float) -> None:
        self._stress = stress
        self._regions = [(model.mesh.regions[name], m) for name, m in model.region_materials.items()]
        self.compliance = np.empty(len(model.mesh.cells))  # 1/κ, scaled; zero where incompressible
        for cells, material in self._regions:
            self.compliance[cells] = 0.0 if material.incompressible else stress / material.bulk_modulus

    def derivatives(self, I1: Array, I2: Array) -> Array:
        """Scaled first and second derivatives of the energy, (5, c, q)."""
        out = np.empty((5, *I1.shape))
        for cells, material in self._regions:
            assert isinstance(material.law, Law)
            for k, values in enumerate(energy_derivatives(material.law, I1[cells], I2[cells])):
                out[k, cells] = values / self._stress
        return out

    def energy(self, I1: Array, I2: Array) -> Array:
        """Isochoric strain energy density (c, q) [Pa]."""
        out = np.empty(I1.shape)
        for cells, material in self._regions:
            assert isinstance(material.law, Law)
            out[cells] = energy_and_derivatives(material.law, I1[cells], I2[cells])[0]
        return out
