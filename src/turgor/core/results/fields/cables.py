"""Cables in results: where each runs in a state, and its tension."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.tendon_term import cable_of
from turgor.core.results.fields.state_fields import StateFields

Array = NDArray[np.float64]


def cables_with_tension(at: StateFields) -> list[tuple[Array, Array]]:
    """Cables of the modeled part, (g, 3) [m] each, with the tension of the whole cable at their guides, (g,) [N]."""
    cables = []
    for load in at.model.loads:
        if load.cable is not None:
            guides, tensions = cable_of(at.mesh, load.cable, at.state.displacement, at.state.load_factor)
            cables.append((guides, np.append(tensions, tensions[-1])))
    return cables
