"""Check of the steps in time: whether they are long compared with the relaxation times of the rubber."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from turgor.core.model.model import Model
from turgor.core.solvers.checks.settings import TIME_STEPS
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.solution import State
from turgor.foundation.finding import Finding, Severity


def too_long_steps(model: Model, procedure: Procedure, states: Sequence[State]) -> tuple[Finding, ...]:
    """Say where steps in time were too long for the rubber (L07)."""
    duration = None if procedure.depends_on_path else procedure.duration  # steps of motion have an error of their own
    if duration is None:
        return ()
    series = [material.prony for material in model.region_materials.values()]
    times = sorted({tau for each in series if each is not None for tau in each.tau})
    largest = max((float(np.abs(state.displacement).max()) for state in states), default=0.0)
    moving = [
        (after.load_factor - before.load_factor) * duration
        for before, after in pairwise(states)
        if float(np.abs(after.displacement - before.displacement).max()) > TIME_STEPS.hold_share * largest
    ]
    for tau in times:
        missed = [
            step for step in moving if TIME_STEPS.long_relaxation_step * tau < step < TIME_STEPS.fast_relaxation * tau
        ]
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
