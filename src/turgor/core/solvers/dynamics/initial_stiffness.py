"""Initial stiffness: the stiffness of an actuator against its load, which sets the viscosity of `Stabilized`."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.system import Evaluation, System
from turgor.core.model.drive import extremes

Array = NDArray[np.float64]


def initial_stiffness(system: System, tangent: Tangent, at: Evaluation, mass: Array, free: bool) -> float:
    """Strain energy over ∫ |u|² dV of the linear response to the largest load: half the stiffness against the load.

    A body with free rigid motions has no such response; the stiffness of a bar of rubber of its size replaces it.
    """
    if free:
        youngs_modulus = 3.0  # of rubber, in shear moduli
        return 0.5 * youngs_modulus / float(np.ptp(system.points, axis=0).max()) ** 2
    factor = max(extremes(system.model), key=lambda each: float(np.linalg.norm(_driving(system, at, each))))
    jump = system.prescribed_values(factor) - at.unknowns[system.prescribed]
    try:
        coupling = tangent.factor(at, None, jump)
    except SingularTangentError:
        return float(np.abs(system.tangent_data(at)).max()) / float(np.abs(mass).max())
    right = _driving(system, at, factor) - coupling
    right[system.prescribed] = jump
    answer = tangent.solve(right)
    answer[~system.moving] = 0.0
    data = system.tangent_data(at)  # first: contact may change the pattern
    stretched = float(answer @ system.pattern.product(data, answer))
    moved = float(answer @ system.layout.base.product(mass, answer))
    return 0.5 * abs(stretched) / moved if moved > 0 else 1.0


def _driving(system: System, at: Evaluation, factor: float) -> Array:
    """Forces (size,) of the loads at a load factor, and what states of bodies change up to it."""
    force = system.external(at.unknowns, factor)
    if not system.has_states:
        return force
    states = system.state_forces(at.unknowns, at.load_factor) - system.state_forces(at.unknowns, factor)
    return np.asarray(force + states)
