"""Outcomes: every way in which a run ends, with its message and advice."""

from collections.abc import Sequence
from dataclasses import dataclass

from turgor.model.drive import drive_text
from turgor.model.model import Model
from turgor.solvers.procedures import Static
from turgor.solvers.solution import State, Status, Step


@dataclass(frozen=True, slots=True)
class Outcome:
    """A status with one sentence of what happened and one of what to do."""

    status: Status
    message: str
    advice: str = ""


def _load(model: Model, load_factor: float) -> str:
    """The load at a load factor, in words: the pressures where any drive."""
    pressures = drive_text(model, load_factor)
    return f"{pressures} (load factor {load_factor:.4g})" if pressures else f"load factor {load_factor:.4g}"


def converged(model: Model, states: Sequence[State], steps: Sequence[Step]) -> Outcome:
    """The full load was reached."""
    iterations = sum(step.iterations for step in steps)
    cut = sum(not step.accepted for step in steps)
    message = f"Reached {_load(model, 1.0)} in {len(states) - 1} steps and {iterations} iterations"
    message += f", {cut} steps cut back." if cut else "."
    unstable = next((state for state in states if state.unstable_modes), None)
    if unstable is None:
        return Outcome(Status.CONVERGED, message)
    return Outcome(
        Status.CONVERGED,
        f"{message} From {_load(model, unstable.load_factor)} on the equilibrium is unstable "
        f"({unstable.unstable_modes} negative modes): a real actuator would leave it.",
        "Treat what follows with care: the actuator may buckle or jump.",
    )


def stuck(model: Model, states: Sequence[State], steps: Sequence[Step], lost_stability: bool) -> Outcome:
    """The step fell below the smallest allowed."""
    last = states[-1].load_factor
    if lost_stability or states[-1].unstable_modes:
        return Outcome(
            Status.LIMIT_POINT,
            f"The load could not rise past {_load(model, last)}: the tangent lost positive definiteness there, "
            "which is a limit point (ballooning, snap-through) or buckling.",
            "Ask for less than this load; the path up to it is complete.",
        )
    return Outcome(
        Status.STEP_TOO_SMALL,
        f"No equilibrium was found beyond {_load(model, last)}: {steps[-1].reason}, "
        f"down to steps of {steps[-1].increment:.2g} of the load.",
        "Look at the last state for a badly distorted cell or walls that met; refine the mesh there.",
    )


def too_many_steps(model: Model, state: State, procedure: Static) -> Outcome:
    """The allowed number of steps was used up."""
    return Outcome(
        Status.STEP_LIMIT,
        f"Stopped at {_load(model, state.load_factor)} after {procedure.max_steps} steps.",
        "Raise procedure.max_steps to go on.",
    )


def stopped_by(model: Model, state: State, reason: str) -> Outcome:
    """The caller's stop condition was met."""
    return Outcome(Status.STOPPED, f"Stopped at {_load(model, state.load_factor)}: {reason}.")


def interrupted(model: Model, state: State) -> Outcome:
    """The user pressed Ctrl-C."""
    return Outcome(
        Status.INTERRUPTED,
        f"Interrupted at {_load(model, state.load_factor)}; the path so far is kept.",
        "Run again to reach the full load.",
    )
