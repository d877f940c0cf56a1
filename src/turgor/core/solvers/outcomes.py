"""Outcomes: every way in which a run ends, with its message and advice."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from turgor.core.model.drive import drive_text, kinks, pressures_at
from turgor.core.model.model import Model
from turgor.core.solvers.checks.causes import balloon, cause_in, cause_text, turned_law, wrinkled_film
from turgor.core.solvers.checks.distortion import distortion_text
from turgor.core.solvers.checks.fibers import stiff_threads_text
from turgor.core.solvers.continuation.branch_jump import first_branch_jump, move_ratio_to
from turgor.core.solvers.continuation.extrema import extremum_ahead
from turgor.core.solvers.pressures import pressure_text, pressures_of
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.solution import State, Status, Step
from turgor.core.solvers.step_reasons import Cause

#: A maximum of the load this near ahead of the last state, relative to it, is why the path ended, whatever the factors
#: say. A maximum within the second distance is stated if the factors show a loss of stability.
NEAR, STATED = 1e-3, 1e-2

#: A tolerance that is met for certain, over the round-off that was found.
ROUND_OFF_MARGIN = 5.0

#: Advice where no step from rest succeeds: no cell is distorted there.
AT_REST = (
    "Nothing has moved yet, so no cell is distorted: check supports, loads and the units of the laws. A flat film or "
    "wall that resists its load too little may start with the procedure stabilized, or from a slightly curved shape."
)


#: On the way to a limit point a body moves this many times as much for the load as before at least.
SOFTENING = 1.5


@dataclass(frozen=True, slots=True)
class Outcome:
    """A status with one sentence of what happened and one of what to do."""

    status: Status
    message: str
    advice: str = ""


def _load(model: Model, load_factor: float, digits: int = 4) -> str:
    """The load at a load factor, in words: the pressures where any drive."""
    acts = any(pressures_at(model, load_factor).values())
    return _with_factor(drive_text(model, load_factor, digits), acts, load_factor, digits)


def _at(state: State) -> str:
    """The load of a state, in words."""
    return _with_factor(pressure_text(state), any(pressures_of(state).values()), state.load_factor)


def _with_factor(pressures: str, acts: bool, load_factor: float, digits: int = 4) -> str:
    """Pressures with their load factor; the load factor alone where no pressure acts."""
    factor = f"load factor {load_factor:.{digits}g}"
    return f"{pressures} ({factor})" if pressures and (acts or not load_factor) else factor


def converged(model: Model, states: Sequence[State], steps: Sequence[Step]) -> Outcome:
    """The full load was reached."""
    iterations = sum(step.iterations for step in steps)
    cut = sum(not step.accepted for step in steps)
    message = f"Reached {_load(model, 1.0)} in {len(states) - 1} steps and {iterations} iterations"
    message += f", {cut} steps cut back." if cut else "."
    message += _falls(model, steps)
    unstable = next((state for state in states if state.unstable_modes), None)
    jumped = first_branch_jump(states) if not kinks(model) else None
    if unstable is None and jumped is not None:
        return Outcome(
            Status.CONVERGED,
            f"{message} Between {_at(states[jumped - 1])} and {_at(states[jumped])} it moved "
            f"{move_ratio_to(states, jumped):.3g} times as much for the load as in the step before: it may have "
            "jumped past a limit point.",
            "Look at what lies between with the procedure auto, or with a smaller max_step.",
        )
    if unstable is None:
        return Outcome(Status.CONVERGED, message)
    return Outcome(
        Status.CONVERGED,
        f"{message} From {_at(unstable)} on the equilibrium is unstable "
        f"({unstable.unstable_modes} negative modes): a real actuator would leave it.",
        "Treat what follows with care: the actuator may buckle or jump.",
    )


def _falls(model: Model, steps: Sequence[Step]) -> str:
    """Where contact opened, or a film folded, and the body jumped to another equilibrium close by."""
    falls = [step.load_factor for step in steps if step.accepted and step.cause is Cause.INERTIA_CORRECTED]
    if not falls:
        return ""
    more = f", first of {len(falls)} times" if len(falls) > 1 else ""
    return f" On the way to {_load(model, falls[0])}{more} it slipped or snapped to another equilibrium close by."


def stuck(model: Model, states: Sequence[State], steps: Sequence[Step], lost_stability: bool) -> Outcome:
    """The step fell below the smallest allowed, or shorter steps do not help."""
    last = states[-1]
    if steps[-1].cause is Cause.ROUND_OFF:
        return _out_of_reach(last, steps[-1])
    top = extremum_ahead(
        [state.load_factor for state in states], [float(np.linalg.norm(state.displacement)) for state in states]
    )
    ahead, distorted = np.inf if top is None else top - last.load_factor, distortion_text(last)
    if last.unstable_modes or (
        not distorted
        and ((lost_stability and softens(states)) or ahead <= max(10 * steps[-1].increment, NEAR * last.load_factor))
    ):
        turned, estimate = turned_law(last), ""
        film = None if turned else wrinkled_film(last)
        swollen = None if turned or film else balloon(states)
        if top is not None and ahead <= STATED * last.load_factor:
            estimate = f" The path up to there points to a maximum of {_load(model, top, 5)}."
        hints = [turned.advice] if turned else []
        hints += [film.advice] if film else [_past_limit(last)]
        hints += [swollen.advice] if swollen else []
        return Outcome(
            Status.LIMIT_POINT,
            f"The load could not rise past {_at(last)}: the tangent lost positive definiteness there, which is a limit "
            f"point (ballooning, snap-through) or buckling.{cause_text(turned or film or swollen)}{estimate}"
            f"{_lost_before(states)}",
            " ".join(hints),
        )
    why = cause_in(last) or (balloon(states) if softens(states) else None)
    stiff = stiff_threads_text(model)
    if stiff and why is None:
        distorted += " Fibers are so stiff that it was not found which of them are slack."
    look = "Look at the last state for a badly distorted cell or walls that met; refine the mesh there."
    advice = stiff or (look if last.displacement.any() else AT_REST)
    return Outcome(
        Status.STEP_TOO_SMALL,
        f"No equilibrium was found beyond {_at(last)}: {steps[-1].reason}, "
        f"down to steps of {steps[-1].increment:.2g} of the load.{cause_text(why) or distorted}",
        advice if why is None else why.advice,
    )


def _out_of_reach(last: State, step: Step) -> Outcome:
    """The tolerance is smaller than the round-off of the equations."""
    reached = 10.0 ** np.ceil(np.log10(ROUND_OFF_MARGIN * step.residual))
    return Outcome(
        Status.STEP_TOO_SMALL,
        f"The tolerance is out of reach beyond {_at(last)}: {step.reason}. Nothing fails mechanically.",
        f"Raise procedure.tolerance to {reached:.0e} or more.",
    )


def _past_limit(last: State) -> str:
    """How to go past a limit point."""
    driven = any(pressures_of(last).values())
    return (
        "Ask for less than this load; the path up to it is complete. To go past it, "
        f"{'let the volume of the cavities drive (VolumeControl), ' if driven else ''}"
        "follow the path by its length (ArcLength), or choose the procedure auto."
    )


def _lost_before(states: Sequence[State]) -> str:
    """Whether stability was lost before the last state; a real body does not follow the path from there on."""
    first = next((n for n, state in enumerate(states) if state.unstable_modes), len(states))
    if first >= len(states) - 1:
        return ""
    return (
        f" Stability was lost before, between {_at(states[first - 1])} and {_at(states[first])}: a real actuator "
        "leaves the path there."
    )


def softens(states: Sequence[State]) -> bool:
    """Whether a body moved more for the load in the last step than in some step before, as towards a limit point.

    Negative pivots of iterates that failed do not prove a limit point: a thin sheet has them on the way to a stable
    state.
    """
    rates = [
        float(np.linalg.norm(b.displacement - a.displacement)) / abs(b.load_factor - a.load_factor)
        for a, b in pairwise(states)
        if b.load_factor != a.load_factor
    ]
    return len(rates) > 1 and rates[-1] > SOFTENING * min(rates[:-1])


def too_many_steps(model: Model, state: State, procedure: StepOptions) -> Outcome:
    """The allowed number of steps was used up."""
    return Outcome(
        Status.STEP_LIMIT,
        f"Stopped at {_at(state)} after {procedure.max_steps} steps.",
        "Raise procedure.max_steps to go on.",
    )


def stopped_by(model: Model, state: State, reason: str) -> Outcome:
    """The caller's stop condition was met."""
    return Outcome(Status.STOPPED, f"Stopped at {_at(state)}: {reason}.")


def interrupted(model: Model, state: State) -> Outcome:
    """The user pressed Ctrl-C."""
    return Outcome(
        Status.INTERRUPTED,
        f"Interrupted at {_at(state)}; the path so far is saved.",
        "Run again to reach the full load; a run that is saved in a folder can be resumed.",
    )
