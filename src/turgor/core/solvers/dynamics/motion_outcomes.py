"""Motion outcomes: every way in which runs with inertia or viscous forces end, with its message and advice."""

from collections.abc import Sequence

import numpy as np

from turgor.core.solvers.energies import TOLERATED, imbalance
from turgor.core.solvers.outcomes import Outcome
from turgor.core.solvers.pressures import pressure_text
from turgor.core.solvers.procedures.time_options import TimeOptions
from turgor.core.solvers.solution import State, Status, Step
from turgor.foundation.display import counted


def moved(states: Sequence[State], steps: Sequence[Step], time: float, accepted: int) -> Outcome:
    """The end of the duration was reached."""
    iterations = sum(step.iterations for step in steps)
    cut = sum(not step.accepted for step in steps)
    message = f"Reached {time:.4g} s in {accepted} steps and {iterations} iterations"
    message += f", {cut} steps taken back" if cut else ""
    return Outcome(Status.CONVERGED, f"{message}; the energies balance to {100 * imbalance(states):.2g} %.")


def no_motion(time: float, last: Step) -> Outcome:
    """The time step fell below the shortest."""
    return Outcome(
        Status.STEP_TOO_SMALL,
        f"No motion was found beyond {time:.4g} s: {last.reason}, down to steps of {last.increment:.2g} of the "
        "duration.",
        "Look at the last state for a badly distorted cell; refine the mesh there, or add stiffness_damping.",
    )


def out_of_time_steps(time: float, procedure: TimeOptions) -> Outcome:
    """The allowed number of time steps was used up."""
    return Outcome(
        Status.STEP_LIMIT,
        f"Stopped at {time:.4g} s after {procedure.max_steps} steps.",
        "Raise procedure.max_steps to go on, or allow a larger error with procedure.accuracy.",
    )


def came_to_rest(states: Sequence[State], steps: Sequence[Step]) -> Outcome:
    """The full load was reached, and the viscous forces have faded."""
    iterations = sum(step.iterations for step in steps)
    message = f"Reached {_load(states[-1])} in {len(states) - 1} steps and {iterations} iterations; {_taken(states)}."
    if not states[-1].unstable_modes:
        return Outcome(Status.CONVERGED, message)
    return Outcome(
        Status.CONVERGED,
        f"{message} The last state is unstable ({counted(states[-1].unstable_modes, 'negative mode')}).",
        "Disturb the symmetry a little, so that the actuator finds the way it would take.",
    )


def no_state(last: State, step: Step) -> Outcome:
    """The step fell below the smallest."""
    return Outcome(
        Status.STEP_TOO_SMALL,
        f"No state was found beyond {_load(last)}: {step.reason}.",
        "There may be no equilibrium at this load; look at the last state, raise the stabilization, or drive by volume "
        "instead of pressure.",
    )


def restless(last: State) -> Outcome:
    """The viscous forces do not fade under the full load."""
    return Outcome(
        Status.STEP_TOO_SMALL,
        f"At {_load(last)} the actuator did not come to rest: it keeps moving under the constant load.",
        "There may be no equilibrium at this load; ask for less, or drive by volume instead of pressure.",
    )


def _load(state: State) -> str:
    """The load of a state, in words: the pressures where any drive."""
    pressures = pressure_text(state)
    factor = f"load factor {state.load_factor:.4g}"
    return f"{pressures} ({factor})" if pressures else factor


def _taken(states: Sequence[State]) -> str:
    """Energy that the viscous forces dissipated, and where most of it if it was much."""
    energies = [state.energies for state in states if state.energies is not None]
    last = energies[-1]
    share = last.viscous / last.strain if last.strain > 0 else 0.0
    sentence = f"viscous forces took {last.viscous:.3g} J, {100 * share:.2g} % of the strain energy"
    if share <= TOLERATED:
        return sentence
    taken = np.diff([each.viscous for each in energies])
    most = int(taken.argmax())
    return f"{sentence}, {100 * taken[most] / last.viscous:.0f} % of that in the step after {_load(states[most])}"
