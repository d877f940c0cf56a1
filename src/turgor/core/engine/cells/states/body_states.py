"""States of bodies: the deformation at which a body is free of stress, and the factor on its stiffness.

The deformation gradient is F = Fₑ F_g with the stress-free deformation F_g, and the energy per volume at rest is
J_g W(Fₑ). With the inverse Jacobians J⁻¹ F_g⁻¹ and the volumes J_g dV, a loop over cells computes all of it: it sees
cells that are at rest in the stress-free configuration, which need not fit together. F_g is exp of the sum of what all
loads on a body state, so that their order does not matter.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.states.networks import Network
from turgor.core.materials.laws.laws import Law
from turgor.core.model.model import Model

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Gradients (c, q, 3, 3) of cells (c,) at a displacement of the nodes (n, 3) [m].
Gradients = Callable[[Ints, Array], Array]


@dataclass(frozen=True, slots=True, eq=False)
class Rest:
    """The stress-free configuration of the cells.

    Parameters
    ----------
    inverse : (c, q, 3, 3) array
        F_g⁻¹.
    volume : (c, q) array
        J_g.
    """

    inverse: Array
    volume: Array


def has_states(model: Model) -> bool:
    """Whether a load states how a body is at rest, or its stiffness."""
    return any(model.states_of(body) for body in model.region_materials)


def rest_of(model: Model, points: Array, load_factor: float) -> Rest:
    """Return the stress-free configuration at a load factor.

    Parameters
    ----------
    model : Model
    points : (c, q, 3) array [m]
        Integration points at rest.
    load_factor : float
    """
    inverse = np.empty((*points.shape[:2], 3, 3))
    inverse[:] = np.eye(3)
    volume = np.ones(points.shape[:2])
    for body in model.region_materials:
        cells = model.mesh.regions[body]
        total = np.zeros((1, 1, 3, 3))
        for load in model.states_of(body):
            log = load.log_stretch(points[cells], load_factor)
            total = total if log is None else total + log
        values, vectors = np.linalg.eigh(total)
        inverse[cells] = np.einsum("cqik,cqk,cqjk->cqij", vectors, np.exp(-values), vectors)
        volume[cells] = np.exp(values.sum(axis=-1))
    return Rest(inverse, volume)


def stiffness_of(model: Model, load_factor: float) -> Array:
    """Return the factor (c,) on the isochoric stress of each cell at a load factor."""
    factors = np.ones(len(model.mesh.cells))
    for body in model.region_materials:
        for load in model.states_of(body):
            factors[model.mesh.regions[body]] *= load.stiffness(load_factor)
    return factors


def hardens(model: Model, body: str) -> bool:
    """Whether a load adds a network to a body."""
    return any(load.hardens for load in model.states_of(body))


def networks_of(model: Model, rows: Ints, rest: Rest, load_factor: float, gradients: Gradients) -> tuple[Network, ...]:
    """Return the networks at a load factor.

    Parameters
    ----------
    model : Model
    rows : (c,) int array
        Row of each cell among those whose laws need gradients.
    rest : Rest
    load_factor : float
    gradients : callable
    """
    out = []
    for body, material in model.region_materials.items():
        cells, law = model.mesh.regions[body], material.law
        for load in model.states_of(body):
            if not load.hardens or not load.network(load_factor) > 0:
                continue
            assert isinstance(law, Law)
            reference = np.linalg.inv(rest.inverse[cells])
            if load.shape is not None:
                reference = reference @ np.linalg.inv(gradients(cells, load.shape))
            factor = load.network(load_factor) / rest.volume[cells]
            out.append(Network(cells, rows[cells], law, factor, np.asarray(reference, dtype=np.float64)))
    return tuple(out)
