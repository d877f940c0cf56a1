"""Cracking energy: the energy density that opens small cracks across the largest stretch, along a path.

Of the strain energy density only the part counts that the stress across the crack has spent (W. V. Mars, Rubber Chem.
Technol. 75 (2002) 1): W_c = ∫ σ₁ d(ln λ₁), with the Cauchy stress σ₁ and the stretch λ₁ across the crack. In simple
tension this is the whole energy, in equibiaxial tension half of it. A crack that is pressed together does not open.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import inf, nan

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fields import CellFields, cell_fields
from turgor.core.engine.percentiles import weighted_percentile
from turgor.core.materials.crack_growth import CrackGrowth, tearing_energy_of_crack
from turgor.core.model.model import Model
from turgor.core.solvers.solution import State

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Cracking:
    """Cracks of a model in one state, at the point that 99 % of the volume stay below.

    Parameters
    ----------
    energy : float [J/m³]
        Cracking energy density of the whole solid.
    region : str
        Region that tears first; empty where no material states how cracks grow.
    tearing : float [J/m²]
        Tearing energy of the first flaw there; nan without a region.
    share : float or None [-]
        This energy over the tear strength, where that is known.
    cycles : tuple of three floats
        Cycles from rest to this state until it tears: at rates ``spread`` times as large, as stated, and ``spread``
        times as small; nan without a region.
    """

    energy: float
    region: str = ""
    tearing: float = nan
    share: float | None = None
    cycles: tuple[float, float, float] = (nan, nan, nan)


def cracking_along(states: Sequence[State]) -> Iterator[Cracking]:
    """Yield the cracks of each state of a path; the energy is summed up by the trapezoidal rule.

    Parameters
    ----------
    states : sequence of State
        From rest.
    """
    energy = stress = logarithm = np.zeros(())
    for state in states:
        cells = cell_fields(state.model, state.displacement, state.mean_stress, state.memory)
        opening, stretched = np.maximum(cells.principal_stress, 0.0), np.log(cells.stretch)
        energy = np.maximum(energy + 0.5 * (stress + opening) * (stretched - logarithm), 0.0)
        stress, logarithm = opening, stretched
        yield _cracking(state.model, cells, energy)


def _cracking(model: Model, cells: CellFields, energy: Array) -> Cracking:
    whole = weighted_percentile(energy, cells.weight)
    growing = [
        _of_region(name, material.crack_growth, model, cells, energy)
        for name, material in model.region_materials.items()
        if material.crack_growth is not None
    ]
    first = min(growing, key=lambda each: (each.cycles[1], -each.tearing), default=Cracking(energy=whole))
    return replace(first, energy=whole)


def _of_region(name: str, growth: CrackGrowth, model: Model, cells: CellFields, energy: Array) -> Cracking:
    chosen, strength = model.mesh.regions[name], model.region_materials[name].strength
    per_length = tearing_energy_of_crack(energy[chosen], cells.stretch[chosen], 1.0)
    each = weighted_percentile(per_length, cells.weight[chosen])
    critical = None if strength is None else strength.tear_strength
    fast, usual, slow = (
        float(growth.cycles(each, inf if critical is None else critical, faster))
        for faster in (growth.spread, 1.0, 1 / growth.spread)
    )
    tearing = each * growth.flaw
    share = None if critical is None else tearing / critical
    return Cracking(energy=0.0, region=name, tearing=tearing, share=share, cycles=(fast, usual, slow))
