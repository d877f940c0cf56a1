"""Tip stiffness: how far a small force at the tip of an actuator under pressure moves it."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.faces import surfaces
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.engine.warmup.compiling import compile_kernels
from turgor.core.engine.warmup.needs import Needs
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.solvers.restart import unknowns_of
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def tip_compliance(at: StateFields) -> Array:
    """Mean displacement of the face tip along x, y and z for each newton on it along x, y and z, (3, 3) [m/N].

    The force is small, dead and spread evenly over the face, on the whole actuator; pressures stay as they are. It is
    one linear solve with the tangent at the state. Rubber that relaxes does so at once. A half bends only within its
    mirror plane; entries across it are nan.

    Parameters
    ----------
    at : StateFields

    Returns
    -------
    (3, 3) array [m/N]

    Raises
    ------
    TurgorError
        If there is no face tip, or the state is on the border of stability.
    """
    return at.once("tip compliance", lambda: _compliance(at))


def _compliance(at: StateFields) -> Array:
    model, options = at.model, EngineOptions()
    nodes = surfaces.nodal_weights(at.mesh.points, at.mesh.face("tip"))
    share = nodes / nodes.sum()
    loaded = {load.face for load in model.pressures}
    unknown_pressures = {face: pressure for face, pressure in at.state.pressures.items() if face not in loaded}
    compile_kernels(None, Needs.of(model))
    system = System(model, tuple(unknown_pressures))
    unknowns = unknowns_of(system, at.state)
    pressures = np.array(list(unknown_pressures.values())) / system.stress_scale if unknown_pressures else None
    history = system.history(at.state.memory, np.inf)
    here = system.evaluate(unknowns, at.state.load_factor, pressures, history=history)
    if here is None:
        raise TurgorError("the state turns a cell inside out; it is no equilibrium of this model.")
    tangent = Tangent(system, options.linear_solver, options.threads)
    try:
        tangent.factor(here)
    except SingularTangentError:
        raise TurgorError("the tangent is singular: the state is on the border of stability.") from None
    matrix = system.pattern.full(system.tangent_data(here))
    for part in (system.skew_matrix(here), system.rubbing(here)):
        matrix = matrix if part is None else matrix + part
    scale = system.stress_scale * system.length  # [N/m]: scaled displacement for each scaled force
    out = np.full((3, 3), np.nan)
    whole = [axis for axis in range(3) if axis not in across_the_model(at)]
    for axis in whole:
        force = np.zeros((system.node_count, 3))
        force[: len(share), axis] = share / at.mesh.symmetry_factor
        right = system.joined(force)
        right[system.prescribed] = 0.0
        moved = tangent.solve(right)
        for _ in range(3):  # factors may be of single precision, and friction is solved for four digits
            residual = np.where(system.prescribed, 0.0, right - matrix @ moved)
            moved = moved + tangent.solve(residual)
        out[whole, axis] = (share @ system.displacement(moved))[whole] / scale
    return out


def across_the_model(at: StateFields) -> set[int]:
    """Axes along which a force has no place in a model of a half, a quarter or a sector."""
    if at.mesh.revolved:
        return {0, 1, 2} - {"xyz".index(at.mesh.revolved)}
    if at.mesh.wedge is not None:
        return {1, 2}
    return {plane.axis for plane in at.facts.mirrors}
