"""Going past: what `Auto` does before, at and beyond a limit point."""

from collections.abc import Callable, Sequence
from math import inf

import numpy as np

from turgor.engine.chambers import Chambers
from turgor.engine.system import Stresses
from turgor.solvers.arcs import arc_run, bounds, nothing
from turgor.solvers.controls import Control, LoadFactor, WorkTarget
from turgor.solvers.following import follow
from turgor.solvers.leaps import LEAP, leap
from turgor.solvers.outcome import Outcome, stuck
from turgor.solvers.path_procedures import Auto
from turgor.solvers.points import Point, Run
from turgor.solvers.problem import Array, Problem, begin, run_of
from turgor.solvers.procedures import Static
from turgor.solvers.solution import State, Status
from turgor.solvers.stepping import StepControl

History = Sequence[tuple[float, Array, Stresses]]

#: Longest step by volume, in the injected volume at which it takes over, over the longest step of the load.
FARTHER = 4.0

#: Smallest step of load control before `Auto` lets something else drive.
AUTO_MIN_STEP = 2e-3


def load_control(procedure: Auto) -> Static:
    """The part of `Auto` before a limit point."""
    smallest = min(max(procedure.min_step, AUTO_MIN_STEP), procedure.first_step)
    return Static(
        first_step=procedure.first_step,
        max_step=procedure.max_step,
        min_step=smallest,
        at=procedure.at,
        tolerance=procedure.tolerance,
        max_iterations=procedure.max_iterations,
        max_steps=procedure.max_steps,
    )


def stop_if_unstable(
    stop: Callable[[State], str | None] | None, states: Sequence[State]
) -> Callable[[State], str | None]:
    """End load control at the first state that could not be held or that a leap led to, besides what the caller says.

    ``states`` is the list that load control fills, the state in question last.
    """

    def decide(state: State) -> str | None:
        if _passed(states):
            return "the equilibrium is unstable, or beyond a leap"
        return None if stop is None else stop(state)

    return decide


def lost(outcome: Outcome, states: Sequence[State]) -> bool:
    """Whether load control ended at what may be a limit point."""
    return outcome.status in (Status.LIMIT_POINT, Status.STEP_TOO_SMALL) or _passed(states)


def _passed(states: Sequence[State]) -> bool:
    return bool(states[-1].unstable_modes) or leap(states) > LEAP


def go_past(problem: Problem, history: History) -> Outcome:
    """Go on from the last stable state of load control with what can drive past a limit point."""
    system, procedure = problem.system, problem.procedure
    assert isinstance(procedure, Auto)
    while _passed(problem.states) and len(problem.states) > 1:
        problem.states.pop()
    load = problem.states[-1].load_factor
    unknowns = next((u for factor, u, _ in history if factor == load), None)
    if unknowns is None or not load:
        return stuck(system.model, problem.states, problem.steps, True)
    faces = [load.face for load in system.model.pressures]
    if len(faces) < len(system.model.loads) or not set(faces) <= set(system.model.mesh.cavities):
        return follow(arc_run(problem, unknowns, load, procedure.max_stretch))
    chambers = Chambers(system, faces)
    weights = np.array([load.pressure for load in system.model.pressures])
    weights /= np.abs(weights).max()
    rest, first = (float(weights @ chambers.volumes(at)) for at in (np.zeros(system.size), unknowns))
    target = WorkTarget(chambers, weights, first, first + (first - rest))
    stepping = StepControl(
        length=procedure.first_step, max_step=FARTHER * procedure.max_step, min_step=procedure.min_step, targets=(inf,)
    )

    def enough(now: Point, run: Run) -> bool:
        if not run.limits:
            return False
        state = run.states[run.limits[0].state]
        turn = float(weights @ chambers.volumes(system.unknowns(state.displacement, state.mean_stress)))
        return float(weights @ chambers.volumes(now.unknowns)) - rest >= procedure.past * (turn - rest)

    ends = bounds(procedure.max_stretch, enough)
    run = run_of(problem, Control(LoadFactor(system), target), stepping, nothing, ends)
    begin(run, 0.0, unknowns, np.array([load]))
    return follow(run)
