"""Expand: answers of a reduced model as states and solutions of the full one."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from turgor.accuracy.gradients.model_keys import with_number
from turgor.core.engine.system import System
from turgor.core.model.model import Model
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.solution import Solution, State, Status
from turgor.core.solvers.states import state_of
from turgor.foundation.errors import TurgorError
from turgor.reduced.answer import Answer
from turgor.reduced.reduced import Reduced


def model_at(reduced: Reduced, answer: Answer) -> Model:
    """Return the full model with the inputs of an answer."""
    model = reduced.model
    for key, value in zip(reduced.inputs.keys, answer.inputs.tolist(), strict=True):
        model = with_number(model, key, value)
    return model


def expand(answer: Answer) -> State:
    """Return an answer as a state of the full model.

    Its nodal forces are those of the full equations, so they are not quite zero at free nodes: that is what the modes
    and the sampling miss.

    Parameters
    ----------
    answer : Answer

    Returns
    -------
    State

    Raises
    ------
    TurgorError
        If a cell is turned inside out.
    """
    reduced = answer.reduced
    system = System(model_at(reduced, answer))
    for part, scale in zip(system.contact.parts, reduced.penalties, strict=True):
        part.penalty_scale = scale.astype(np.float64)
    at = system.evaluate(system.unknowns(answer.displacement, answer.mean_stress), 1.0)
    if at is None:
        raise TurgorError("a cell is turned inside out in this answer of the reduced model; train it more densely.")
    return state_of(system, at, None)


def solution_of(answers: Sequence[Answer]) -> Solution:
    """Return answers as a path of the full model, the state at rest first, for `turgor.measure` and reports.

    Parameters
    ----------
    answers : sequence of Answer

    Returns
    -------
    Solution
        Its message states the largest held-out error of the reduced model.
    """
    if not answers:
        raise TurgorError("a path needs an answer of a reduced model; there is none.")
    reduced = answers[0].reduced
    states = [expand(answer) for answer in answers]
    shares = np.linspace(0, 1, len(states) + 1)
    rest = replace(
        states[-1], load_factor=0.0, displacement=np.zeros_like(states[-1].displacement), touches={},
        mean_stress=np.zeros_like(states[-1].mean_stress), nodal_force=np.zeros_like(states[-1].nodal_force),
        pressures={face: 0.0 for face in states[-1].pressures},
    )  # fmt: skip
    path = (rest, *(replace(state, load_factor=float(share)) for state, share in zip(states, shares[1:], strict=True)))
    message = f"States of a reduced model; largest held-out error {reduced.held_out.worst:.2g} of the largest displacement."
    return Solution(model=states[-1].model, procedure=Static(), states=path, status=Status.FOLLOWED, message=message)
