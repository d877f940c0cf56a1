"""Stability of equilibria of rods: whether the tangent is positive definite."""

import numpy as np

from turgor.fast_models.rod.loads import LineLoad, PlateForce
from turgor.fast_models.rod.state import RodState
from turgor.fast_models.rod.system import RodSystem


def is_stable(system: RodSystem, state: RodState) -> bool | None:
    """Return whether an equilibrium is a minimum of energy; None where loads have no energy.

    Forces that follow, and moments at plates, have none: such states may flutter, which a tangent cannot tell.
    """
    for load in system.model.loads:
        if isinstance(load, PlateForce) and (load.follows or any(load.moment)):
            return None
        if isinstance(load, LineLoad) and load.follows:
            return None
    at = system.evaluate(state)
    tangent = system.band.dense(at.blocks, at.own)
    scale = 1 / np.sqrt(np.abs(tangent.diagonal()))
    try:
        np.linalg.cholesky(0.5 * (tangent + tangent.T) * np.outer(scale, scale))
    except np.linalg.LinAlgError:
        return False
    return True
