"""Branch switch: how `Auto` goes from load control to a volume or an arc length at a limit point."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.solvers.constraints.arc import Arc
from turgor.core.solvers.constraints.clock import Clock
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.constraints.load_factor import ArcTarget, LoadFactor, WorkTarget, displacement_of
from turgor.core.solvers.continuation.branch_jump import move_ratio_to
from turgor.core.solvers.continuation.load_control import load_run
from turgor.core.solvers.continuation.path_follower import follow
from turgor.core.solvers.continuation.path_points import begin, nothing
from turgor.core.solvers.continuation.path_run import Point, Run
from turgor.core.solvers.continuation.scalar_control.arc_length import (
    Bounds,
    arc_run,
    bounds,
    check_proportional,
    check_still,
    displacement_scale,
    from_rest,
    slowly,
    start_of,
)
from turgor.core.solvers.continuation.scalar_control.scalar_path import Goal, scalar_run
from turgor.core.solvers.continuation.settings import BRANCH_JUMP, BRANCH_SWITCH, STEP_CONTROL
from turgor.core.solvers.continuation.step_control import StepControl
from turgor.core.solvers.continuation.tangent_response import exceeds_tangent, rate_at
from turgor.core.solvers.outcomes import Outcome
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.restart import Restart, unknowns_of
from turgor.core.solvers.solution import State, Status
from turgor.core.solvers.step_reasons import Cause, Reason

Array = NDArray[np.float64]


def load_steps(procedure: StepOptions) -> StepOptions:
    """The steps before a limit point."""
    smallest = min(max(procedure.min_step, BRANCH_SWITCH.auto_min_step), procedure.first_step)
    steps = {each.name: getattr(procedure, each.name) for each in fields(StepOptions)}
    return StepOptions(**steps | {"min_step": smallest})


@dataclass(slots=True, eq=False)
class Watch:
    """Ends load control at the first state that is unstable or lies beyond a branch jump.

    The last state before it is saved with the history of contact there: another constraint goes on from it.

    Parameters
    ----------
    problem : Problem
        Whose list of states load control fills, the state in question last.
    history : sequence of Point
        The last points of load control.
    good : Restart or None
        The last good state; None where there was none but rest.
    rate : float
        How far its nodes move with the load factor.
    reason : Reason or None
        Why load control was ended; None where it was not.
    """

    problem: Problem
    history: Sequence[Point]
    good: Restart | None = None
    rate: float = inf
    reason: Reason | None = None

    @staticmethod
    def at_rest(problem: Problem, history: Sequence[Point]) -> "Watch":
        """Compute how the body moves for a small load, so that a branch jump in the first step is found, too."""
        at = problem.system.evaluate(start_of(problem), 0.0, history=problem.history)
        assert at is not None
        return Watch(problem, history, rate=rate_at(problem.system, problem.tangent, at)[0])

    def __call__(self, state: State) -> str | None:
        """End load control with a reason: of its own, or of the caller."""
        system, last = self.problem.system, self.history[-1]
        at = system.evaluate(last.unknowns, last.parameter, history=last.history)
        assert at is not None
        rate, modes = rate_at(system, self.problem.tangent, at)
        if modes is not None and modes != state.unstable_modes:
            state = replace(state, unstable_modes=modes)
            self.problem.states[-1] = state
        self.reason = self._why(state, rate)
        if self.reason is not None:
            return str(self.reason)
        self.good, self.rate = Restart.of(system, state), rate
        stop = self.problem.listeners.stop
        return None if stop is None else stop(state)

    def _why(self, state: State, rate: float) -> Reason | None:
        if state.unstable_modes:
            return Reason(Cause.UNSTABLE)
        before, now = self.history[-2:]
        rates = self.rate, rate
        faster = move_ratio_to(self.problem.states, len(self.problem.states) - 1) > BRANCH_JUMP.jump_ratio
        change, rise = now.unknowns - before.unknowns, now.parameter - before.parameter
        jumped = faster or exceeds_tangent(self.problem.system, change, rise, rates)
        return Reason(Cause.BRANCH_JUMP) if jumped else None


def follow_auto(problem: Problem, procedure: StepOptions, limit: Bounds) -> Outcome:
    """Follow the path under load control, and past limit points by volume or arc length."""
    check_proportional(problem.system.model, "procedure auto")
    check_still(problem.system, "procedure auto")
    history: list[Point] = []
    watch = Watch.at_rest(problem, history)
    outcome = follow(load_run(problem, load_steps(procedure), False, watch, history), watch)
    return continue_past(problem, procedure, limit, watch) if lost(outcome, watch) else outcome


def lost(outcome: Outcome, watch: Watch) -> bool:
    """Whether load control ended at what may be a limit point."""
    return watch.reason is not None or outcome.status in (Status.LIMIT_POINT, Status.STEP_TOO_SMALL)


def continue_past(problem: Problem, procedure: StepOptions, limit: Bounds, watch: Watch) -> Outcome:
    """Go on from the last good state of load control by volume or arc length."""
    system = problem.system
    if watch.reason is not None:
        problem.states.pop()
        problem.steps[-1] = replace(problem.steps[-1], accepted=False, why=watch.reason)
        problem.listeners.rejected(len(problem.steps), problem.steps[-1])
    ends = bounds(limit)
    if watch.good is None:
        lengths = STEP_CONTROL.step_cut * procedure.first_step, BRANCH_SWITCH.longest_step * procedure.max_step
        return from_rest(problem, procedure, lengths, ends)
    watch.good.restore(system)
    problem = slowly(problem, watch.good.state.memory)
    unknowns, load = unknowns_of(system, watch.good.state), watch.good.state.load_factor
    faces = [load.face for load in system.model.pressures]
    other = len(faces) < len(system.model.loads) or not set(faces) <= set(system.model.mesh.cavities)
    if other or problem.restart is not None:
        return follow(arc_run(problem, procedure, (unknowns, load), _arcs(problem, procedure, unknowns, load), ends))
    volume = _by_volume(problem, procedure, limit, unknowns, load)
    outcome = follow(volume)
    if outcome.status is not Status.STEP_TOO_SMALL or volume.history[-1].change is None:
        return outcome
    return follow(_by_arc(problem, procedure, volume))  # the volume turns too


def _arcs(problem: Problem, procedure: StepOptions, unknowns: Array, load: float) -> tuple[float, float]:
    """First and longest arc from a state of load control on: the first is shorter than the last step of the load."""
    system, before = problem.system, problem.states[-2]
    moved = displacement_of(system, unknowns - unknowns_of(system, before))
    size = displacement_scale(problem, unknowns, load)
    step = float(np.hypot(np.linalg.norm(moved) / size, load - before.load_factor))
    return STEP_CONTROL.step_cut * step, BRANCH_SWITCH.longest_step * procedure.max_step


def _by_volume(problem: Problem, procedure: StepOptions, limit: Bounds, unknowns: Array, load: float) -> Run:
    """A run by the volume of the cavities, weighted with their pressures, from a state of load control on."""
    system = problem.system
    chambers = Chambers(system, [load.face for load in system.model.pressures])
    weights = np.array([load.pressure for load in system.model.pressures])
    weights /= np.abs(weights).max()
    rest, first = (float(weights @ chambers.volumes(at)) for at in (np.zeros(system.size), unknowns))
    target = WorkTarget(chambers, weights, first, first + (first - rest))
    stepping = StepControl(
        length=procedure.first_step,
        max_step=BRANCH_SWITCH.longest_step * procedure.max_step,
        min_step=procedure.min_step,
        targets=(inf,),
    )

    def enough(now: Point, run: Run) -> bool:
        if not run.limits:
            return False
        state = run.states[run.limits[0].state]
        turn = float(weights @ chambers.volumes(system.unknowns(state.displacement, state.mean_stress)))
        return float(weights @ chambers.volumes(now.unknowns)) - rest >= limit.past * (turn - rest)

    ends = bounds(limit, enough)
    constraint = Constraint.of(LoadFactor(system), target, history=problem.history)
    run = scalar_run(problem, procedure, constraint, stepping, Goal(nothing, ends))
    run.size = displacement_scale(problem, unknowns, load)
    begin(run, 0.0, unknowns, np.array([load]))
    return run


def _by_arc(problem: Problem, procedure: StepOptions, volume: Run) -> Run:
    """A run by the arc length from where the volume turned too, onward as it grew until then."""
    system = problem.system
    last, before = volume.history[-1], volume.history[-2:][0]
    here = replace(last, parameter=0.0)
    upward = Arc(np.zeros(system.size), 1.0)
    target = ArcTarget(system, volume.size, 0.0, last.unknowns, last.scalars, upward).onward(before, here)
    longest = BRANCH_SWITCH.longest_step * procedure.max_step
    chord = displacement_of(system, last.unknowns - before.unknowns)
    step = float(np.hypot(np.linalg.norm(chord) / volume.size, (last.scalars - before.scalars)[0]))
    stepping = StepControl(
        length=min(max(step, procedure.min_step), longest),
        max_step=longest,
        min_step=procedure.min_step,
        targets=(inf,),
    )
    goal = Goal(nothing, volume.task.finished)
    constraint = replace(volume.constraint, target=target, clock=Clock())
    run = scalar_run(problem, procedure, constraint, stepping, goal)
    run.size = volume.size
    run.bifurcations += volume.bifurcations
    begin(run, 0.0, last.unknowns, last.scalars)
    return run
