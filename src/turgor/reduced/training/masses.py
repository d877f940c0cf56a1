"""Masses: mass and viscosity of the full model in reduced coordinates."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.mass import mass_data, refuse_turning
from turgor.core.engine.system import System
from turgor.foundation.symmetric import PAIRS
from turgor.reduced.parts.inertia import Masses
from turgor.reduced.parts.polynomials import Sheets
from turgor.reduced.training import forms

Array = NDArray[np.float64]


def masses_of(system: System, vectors: Array) -> Masses:
    """Mass and viscosity for modes (3 n, r)."""
    n = len(vectors)
    refuse_turning(system.model)
    whole = system.layout.base.full(mass_data(system))[:n, :n]
    return Masses(np.asarray(vectors.T @ (whole @ vectors)), _viscosity(system, vectors))


def _viscosity(system: System, vectors: Array) -> Sheets:
    """Form of ∫ 2 μ dev Ė : Ė dV by products of q̂ with its rate; see `turgor.core.engine.damping`."""
    R = vectors.shape[1] + 1
    i, j = np.triu_indices(R)
    moduli = np.empty(len(system.cells))
    for name, material in system.model.region_materials.items():
        moduli[system.model.mesh.regions[name]] = 2 * material.law.shear_modulus / system.stress_scale
    form, double = np.zeros((len(i), len(i))), np.where(i == j, 0.5, 1.0)
    for cells in forms.chunks(len(system.cells)):
        moved = forms.gradients(system, vectors, cells)
        F = np.zeros((len(moved), 3, 3, R))
        F[..., 0] = np.eye(3)
        F[..., 1:] = moved.reshape(len(moved), 3, 3, -1)
        weights = np.sqrt(system.dV[cells] * moduli[cells][:, None]).ravel()
        strains = np.empty((len(PAIRS), len(moved), len(i)))
        for v, (a, b) in enumerate(PAIRS):
            product = np.einsum("pkR,pkS->pRS", F[:, :, a], F[:, :, b], optimize=True)
            both = 0.5 * (product[:, i, j] + product[:, j, i])
            strains[v] = (weights * (1.0 if a == b else np.sqrt(2.0)))[:, None] * double * both
        trace = strains[:3].sum(axis=0) / 3
        strains[:3] -= trace
        flat = strains.reshape(-1, len(i))
        form += flat.T @ flat
    return Sheets(form, R)
