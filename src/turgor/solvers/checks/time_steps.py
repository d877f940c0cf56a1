"""Check of a path over time: steps that are long against the times in which the rubber relaxes."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from turgor.finding import Finding, Severity
from turgor.model.model import Model
from turgor.solvers.procedures.dynamic import Dynamic
from turgor.solvers.solution import Procedure, State

#: A term is followed badly by steps longer than the first of these shares of its time. Terms much faster than the
#: steps, beyond the second, are nearly relaxed all the time, and no harm is done.
LONG, FAST = 0.6, 20.0

#: A step in which no node moves by more than this share of the largest displacement counts as a hold, which is exact.
HELD = 0.02


def too_long_steps(model: Model, procedure: Procedure, states: Sequence[State]) -> tuple[Finding, ...]:
    """Say where steps in time were too long for the rubber (L07)."""
    duration = None if isinstance(procedure, Dynamic) else getattr(procedure, "duration", None)
    if duration is None:
        return ()
    series = [material.viscoelasticity for material in model.region_materials.values()]
    times = sorted({tau for each in series if each is not None for tau in each.tau})
    largest = max((float(np.abs(state.displacement).max()) for state in states), default=0.0)
    moving = [
        (after.load_factor - before.load_factor) * duration
        for before, after in pairwise(states)
        if float(np.abs(after.displacement - before.displacement).max()) > HELD * largest
    ]
    for tau in times:
        missed = [step for step in moving if LONG * tau < step < FAST * tau]
        if missed:
            return (_finding(max(missed), tau, duration),)
    return ()


def _finding(step: float, tau: float, duration: float) -> Finding:
    return Finding(
        code="L07",
        severity=Severity.WARNING,
        message=f"Steps of {step:.3g} s are long for rubber that relaxes in {tau:.3g} s while the actuator moves.",
        advice=f"Compare with procedure.max_step = {0.2 * tau / duration:.2g} and as short a first_step.",
    )
