"""Path: answers of a reduced model as a solution of the full one."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.solution import Solution, Status
from turgor.foundation.errors import TurgorError
from turgor.reduced.states.answer import ReducedState


def solution_of(answers: Sequence[ReducedState]) -> Solution:
    """Return answers as a path of the full model, the state at rest first, for `turgor.measure` and reports.

    Parameters
    ----------
    answers : sequence of ReducedState

    Returns
    -------
    Solution
        Its message states the largest held-out error of the reduced model.
    """
    if not answers:
        raise TurgorError("a path needs an answer of a reduced model; there is none.")
    states = [answer.state() for answer in answers]
    last = states[-1]
    rest = replace(
        last, load_factor=0.0, displacement=np.zeros_like(last.displacement), touches={},
        mean_stress=np.zeros_like(last.mean_stress), nodal_force=np.zeros_like(last.nodal_force),
        pressures=dict.fromkeys(last.pressures, 0.0),
    )  # fmt: skip
    shares = np.arange(1, len(states) + 1) / len(states)
    path = (rest, *(replace(state, load_factor=float(share)) for state, share in zip(states, shares, strict=True)))
    worst = answers[0].reduced.held_out.worst
    message = f"States of a reduced model; its largest held-out error is {worst:.2g} of the largest displacement."
    return Solution(model=last.model, procedure=Static(), states=path, status=Status.FOLLOWED, message=message)
