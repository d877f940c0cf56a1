"""Cables in results: where each runs in a state, and its tension."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.tendon_term import cable_of
from turgor.core.results.fields.state_fields import StateFields
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def cables_with_tension(at: StateFields) -> list[tuple[Array, Array]]:
    """Cables of the modeled part, (g, 3) [m] each, with the tension of the whole cable at their guides, (g,) [N]."""
    cables = []
    for load in at.model.loads:
        if load.cable is not None:
            guides, tensions = cable_of(at.mesh, load.cable, at.state.displacement, at.state.load_factor)
            cables.append((guides, np.append(tensions, tensions[-1])))
    return cables


def largest_tension(at: StateFields) -> float:
    """Largest tension of a cable at its motor [N]."""
    return float(max(tension[0] for _, tension in _some(at)))


def largest_travel(at: StateFields) -> float:
    """By how much the way of a cable through its guides is shorter than at rest [m], the largest."""
    starts = [np.array(load.cable.through) for load in at.model.loads if load.cable is not None]
    ends = [guides for guides, _ in _some(at)]
    return float(max(_length(start) - _length(end) for start, end in zip(starts, ends, strict=True)))


def _some(at: StateFields) -> list[tuple[Array, Array]]:
    cables = cables_with_tension(at)
    if not cables:
        raise TurgorError("the model has no cable.")
    return cables


def _length(guides: Array) -> float:
    return float(np.linalg.norm(np.diff(guides, axis=0), axis=1).sum())
