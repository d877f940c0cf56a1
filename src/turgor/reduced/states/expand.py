"""Expand: fields of a reduced model as a state of the full one."""

from collections.abc import Mapping, Sequence
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.gradients.model_keys import with_number
from turgor.core.engine.system import System
from turgor.core.model.model import Model
from turgor.core.solvers.solution import State
from turgor.core.solvers.states import state_of
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def expand(
    model: Model, values: Mapping[str, float], fields: tuple[Array, Array], penalties: Sequence[NDArray[np.float32]]
) -> State:
    """Return displacement and mean stress as a state of a model with other loads.

    Its nodal forces are those of the full equations, so they are not quite zero at free nodes: that is what the modes
    and the sampling miss. Rubber that relaxes counts as relaxed.

    Parameters
    ----------
    model : Model
    values : mapping of str to float [SI]
        Numbers of the model by key.
    fields : ((nodes, 3) array [m], (m,) array [Pa])
        Displacement and mean stress.
    penalties : sequence of arrays
        Factors on the penalty of each part of contact.

    Returns
    -------
    State

    Raises
    ------
    TurgorError
        If a cell is turned inside out.
    """
    for key, value in values.items():
        model = with_number(model, key, value)
    system = System(model)
    for part, scale in zip(system.contact.parts, penalties, strict=True):
        part.penalty_scale = scale.astype(np.float64)
    at = system.evaluate(system.unknowns(*fields), 1.0, history=system.history(step=inf))
    if at is None:
        raise TurgorError("a cell is turned inside out in this answer of the reduced model; train it more densely.")
    return state_of(system, at, None)
