"""Fluid: the volume that went into the cavities, and the work that their pressure did."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.cavities import enclosed_volume
from turgor.core.solvers.pressures import pressures_of
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def injected(at: StateFields) -> float:
    """Volume by which all cavities of the whole actuator have grown since rest [m³]."""
    return float(volumes(at).sum()) - at.facts.once("volume at rest", lambda: _at_rest(at))


def _at_rest(at: StateFields) -> float:
    rest = replace(at.state, displacement=np.zeros_like(at.displacement))
    return float(volumes(StateFields(rest, at.facts)).sum())


def volumes(at: StateFields) -> Array:
    """Current volume of each cavity of the whole actuator, (c,) [m³]."""
    if not at.mesh.cavities:
        raise TurgorError("the part has no cavity, no face named cavity.")
    return at.once("volumes", lambda: np.array([enclosed_volume(at, [name]) for name in at.mesh.cavities]))


def fluid_works(path: Sequence[StateFields]) -> Array:
    """Work of the fluid on the whole actuator up to each state of a path, (n,) [J]: ∫ p dV over all cavities.

    Between two states the pressure counts with its mean, so the error falls with the square of the steps.

    Parameters
    ----------
    path : sequence of StateFields
    """
    volume = np.array([volumes(at) for at in path])
    acting = [pressures_of(at.state) for at in path]
    pressure = np.array([[each.get(name, 0.0) for name in path[0].mesh.cavities] for each in acting])
    steps = ((pressure[1:] + pressure[:-1]) / 2 * np.diff(volume, axis=0)).sum(axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)])
