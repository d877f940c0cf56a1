"""Check of the steps in time: whether they are long for the rubber that relaxes, or for channels between cavities."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.model.loads.channel import Channel, closed_cavities
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


def steps_too_long_for_channels(states: Sequence[State]) -> tuple[Finding, ...]:
    """Say where steps in time were too long for a cavity that fills or empties through channels (L15).

    Parameters
    ----------
    states : sequence of State
    """
    if len(states) < 2 or states[-1].time is None:
        return ()
    channels = [load.channel for load in states[-1].model.loads if load.channel is not None]
    pressures = [abs(p) for state in states for p in state.pressures.values()]
    notable = TIME_STEPS.hold_share * max(pressures, default=0.0)
    for name in closed_cavities(states[-1].model.loads):
        softness = _softness(states, name)
        for channel in (each for each in channels if name in each.between and softness > 0):
            long = [step for step in _equalizing(states, channel, notable) if _too_long(*step, softness)]
            if long:
                return (_too_long_for(channel, max(long)[0], name, softness),)
    return ()


def _equalizing(states: Sequence[State], channel: Channel, notable: float) -> list[tuple[float, float]]:
    """Lengths [s] and resistances of the steps in which the difference of pressure along a channel changes [Pa]."""
    out = []
    here, there = channel.between
    gaps = [state.pressures.get(here, 0.0) - state.pressures.get(there, 0.0) for state in states]
    for (before, after), (one, other) in zip(pairwise(states), pairwise(gaps), strict=True):
        share = channel.share(after.load_factor)
        if share > 0 and abs(other - one) > notable:
            out.append(((after.time or 0.0) - (before.time or 0.0), channel.resistance / share))
    return out


def _softness(states: Sequence[State], name: str) -> float:
    """Change of the volume of a cavity over that of its pressure, in the state whose pressure differs most [m³/Pa]."""
    first = states[0].pressures.get(name, 0.0)
    most = max(states, key=lambda state: abs(state.pressures.get(name, 0.0) - first))
    change = most.pressures.get(name, 0.0) - first
    volumes = [cavity_volume(state.model.mesh, name, state.displacement) for state in (states[0], most)]
    return (volumes[1] - volumes[0]) / change if change else 0.0


def _too_long(step: float, resistance: float, softness: float) -> bool:
    return TIME_STEPS.long_relaxation_step < step / (resistance * softness) < TIME_STEPS.fast_relaxation


def _too_long_for(channel: Channel, step: float, name: str, softness: float) -> Finding:
    constant = channel.resistance * softness
    return Finding(
        code="L15",
        severity=Severity.WARNING,
        message=f"Steps of {step:.3g} s are long for the channel between {channel.place}, through which '{name}' fills "
        f"in a time of R dV/dp = {channel.resistance:.3g} Pa s/m³ × {softness:.3g} m³/Pa = {constant:.3g} s: pressures "
        "err by up to some percent, and may overshoot.",
        advice=f"Compare with steps of {TIME_STEPS.good_channel_step * constant:.2g} s: procedure.max_step times the "
        "duration, and as short a first_step.",
    )


def _finding(step: float, tau: float, duration: float) -> Finding:
    return Finding(
        code="L07",
        severity=Severity.WARNING,
        message=f"Steps of {step:.3g} s are long for rubber that relaxes in {tau:.3g} s while the actuator moves.",
        advice=f"Compare with procedure.max_step = {0.2 * tau / duration:.2g} and as short a first_step.",
    )
