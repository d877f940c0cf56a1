"""The loop of `Static`: steps of the load from equilibrium to equilibrium."""

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise
from math import inf
from time import perf_counter

from turgor.engine.system import Evaluation, System
from turgor.engine.tangent import Tangent
from turgor.solvers.checks.distortion import distortion_text
from turgor.solvers.constraints.loads import load_control
from turgor.solvers.continuation.predictor import HISTORY, Known, predicted
from turgor.solvers.continuation.step_acceptance import doubt, roundabout
from turgor.solvers.continuation.step_control import StepControl
from turgor.solvers.continuation.tangent_response import rate_at, rate_in_step
from turgor.solvers.listeners import Listeners
from turgor.solvers.newton.contact_newton import newton_with_contact, touches
from turgor.solvers.newton.newton import NewtonResult, NewtonSettings
from turgor.solvers.newton.pseudo_transient import pseudo_transient
from turgor.solvers.outcomes import Outcome, converged, interrupted, stopped_by, stuck, too_many_steps
from turgor.solvers.procedures.static import Static
from turgor.solvers.reasons import Reason
from turgor.solvers.restart import Carried, unknowns_of
from turgor.solvers.solution import Iteration, LimitPoint, State, Status, Step

#: Where no step succeeds, a body may move against viscous forces to its next equilibrium, this often in a run, over at
#: most this share of the load, and if that fails over a smaller one.
RELAXATIONS, REACH, SHORTER_REACH = 20, 0.05, 0.1

#: From a first step of this share of the load on, it is looked at how the body moves for a small load.
FAR = 0.2

Report = Callable[[int, float, float, float], None]


@dataclass(slots=True)
class Path:
    """What the run has found so far; ``rate`` is how far nodes move with the load factor at the last state."""

    kinks: tuple[float, ...]
    carried: Carried | None = None
    states: list[State] = field(default_factory=list)
    history: list[Known] = field(default_factory=list)
    steps: list[Step] = field(default_factory=list)
    limits: list[LimitPoint] = field(default_factory=list)
    lost_stability: bool = False
    rate: float = inf
    relaxations: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class StaticRun:
    """What is solved and how, who listens, and the path to fill.

    ``patient`` says whether a body may move against viscous forces where Newton's method finds nothing.
    """

    system: System
    tangent: Tangent
    procedure: Static
    hooks: Listeners
    path: Path
    patient: bool = True

    @property
    def settings(self) -> NewtonSettings:
        """Of Newton's method."""
        return NewtonSettings(
            tolerance=self.procedure.tolerance, max_iterations=self.procedure.max_iterations, count_anew=True
        )


def follow_load(run: StaticRun) -> Outcome:
    """Step from 0 to 1; the path so far is in ``run.path`` whatever happens."""
    system, path = run.system, run.path
    rest = unknowns_of(system, None if path.carried is None else path.carried.state)
    at_rest = system.evaluate(rest, 0.0)
    assert at_rest is not None
    path.history.append((0.0, rest, system.stresses(at_rest)))
    path.states.append(_state(run, at_rest, None))
    control = StepControl.of(run.procedure, path.kinks)
    if control.length >= FAR and not path.kinks:  # where loads grow in proportion, all of them say how the first does
        path.rate = rate_at(system, run.tangent, at_rest)[0]
    try:
        while path.history[-1][0] < 1.0:
            if len(path.steps) >= run.procedure.max_steps:
                return too_many_steps(system.model, path.states[-1], run.procedure)
            following = _advance(run, control)
            if isinstance(following, Outcome):
                return following
            control = following
    except KeyboardInterrupt:
        return interrupted(system.model, path.states[-1])
    return converged(system.model, path.states, path.steps)


def _advance(run: StaticRun, control: StepControl) -> StepControl | Outcome:
    """Attempt one step; return the control for the next one, or how the run ends."""
    system, path = run.system, run.path
    now = path.history[-1][0]
    load, anchors = _next_load(run, control), system.contact.anchors
    shorter = control.failed(load - now)
    system.materials.begin_step(run.procedure.time_between(now, load))
    began = perf_counter()
    start = predicted(system, run.tangent, path.history, load)
    result = newton_with_contact(load_control(system), run.tangent, start, load, run.settings, _reporter(run, load))
    doubtful, rate = None, inf
    if result.converged and result.evaluation is not None:
        rate = rate_in_step(system, run.tangent, result.evaluation.unknowns, now, load)
        if shorter is not None:
            doubtful = doubt(system, path.states, path.history, result, (path.rate, rate))
    _note(run, result, load, perf_counter() - began, doubtful)
    if result.converged and doubtful is None:
        path.lost_stability, path.rate = False, rate
        return _accept(run, result, control)
    system.contact.anchors = anchors
    path.lost_stability |= bool(result.unstable_modes)
    return shorter or _relax(run, control)


def _next_load(run: StaticRun, control: StepControl) -> float:
    """The load factor to try next: no farther than supports go about straight."""
    now = run.path.history[-1][0]
    load = control.next_load(now)
    while load - now > control.min_step and roundabout(run.system, now, load):
        load = now + 0.5 * (load - now)
    return load


def _relax(run: StaticRun, control: StepControl) -> StepControl | Outcome:
    """Where no step succeeds, let the body move against viscous forces; say how the run ends if that fails too."""
    system, path = run.system, run.path
    ending = stuck(system.model, path.states, path.steps, path.lost_stability)
    if not run.patient or path.relaxations >= RELAXATIONS or ending.status is not Status.STEP_TOO_SMALL:
        return ending
    if distortion_text(path.states[-1]):  # a cell has collapsed, and nothing beyond it is of the body
        return ending
    path.relaxations += 1
    for share in (1.0, SHORTER_REACH):
        _, here, _ = path.history[-1]
        load, anchors, began = _reach(run, control, share), system.contact.anchors, perf_counter()
        system.materials.begin_step(run.procedure.time_between(path.history[-1][0], load))
        result = pseudo_transient(load_control(system), run.tangent, here, load, run.settings, _reporter(run, load))
        doubtful = doubt(system, path.states, path.history, result) if result.converged else None
        _note(run, result, load, perf_counter() - began, doubtful)
        if result.converged and doubtful is None:
            path.rate = inf
            return _accept(run, result, control)
        system.contact.anchors = anchors
    return ending


def _reach(run: StaticRun, control: StepControl, share: float) -> float:
    """Load factor to which a body moves against viscous forces: a share of the steps taken before it got hard."""
    factors = [factor for factor, _, _ in run.path.history]
    taken = max((b - a for a, b in pairwise(factors)), default=REACH)
    now = factors[-1]
    return min(now + share * min(taken, REACH), *(target for target in control.targets if target > now))


def _note(run: StaticRun, result: NewtonResult, load: float, seconds: float, doubtful: Reason | None = None) -> None:
    run.path.steps.append(
        Step(
            load_factor=load,
            increment=load - run.path.history[-1][0],
            iterations=result.iterations,
            residual=result.residual,
            accepted=result.converged and doubtful is None,
            seconds=seconds,
            why=result.reason or doubtful,
        )
    )


def _accept(run: StaticRun, result: NewtonResult, control: StepControl) -> StepControl | Outcome:
    system, path, hooks, evaluation = run.system, run.path, run.hooks, result.evaluation
    assert evaluation is not None
    increment = evaluation.load_factor - path.history[-1][0]
    path.history.append((evaluation.load_factor, evaluation.unknowns, system.stresses(evaluation)))
    del path.history[:-HISTORY]
    state = _state(run, evaluation, result.unstable_modes)
    system.contact.accept(evaluation.contacts)  # after the state has been read, which has slipped from the last one
    path.states.append(state)
    system.materials.memory = state.memory
    if hooks.progress is not None:
        last = _iteration(len(path.steps), state.load_factor, result.iterations, result.residual, 0.0, 1.0)
        hooks.progress(last, state)
    reason = hooks.stop(state) if hooks.stop is not None else None
    if reason is not None:
        return stopped_by(system.model, state, reason)
    control = control.accepted(increment, result.hardest or result.iterations)
    if state.unstable_modes and not path.states[-2].unstable_modes:
        control = control.resumed(run.procedure.first_step)
    if state.load_factor not in path.kinks:
        return control
    path.rate = inf
    del path.history[:-1]  # beyond a kink the path goes another way: its past predicts nothing
    return control.turned(run.procedure.first_step)


def _state(run: StaticRun, at: Evaluation, modes: int | None) -> State:
    system = run.system
    displacement, mean_stress = system.physical(at.unknowns)
    force = system.split(at.residual)[0] * system.stress * system.length**2
    return State(
        model=system.model,
        load_factor=at.load_factor,
        displacement=displacement,
        mean_stress=mean_stress,
        nodal_force=force,
        unstable_modes=modes,
        touches=touches(system, at),
        time=run.procedure.time_of(at.load_factor),
        memory=system.remembered(at),
    )


def _reporter(run: StaticRun, load: float) -> Report:
    number = len(run.path.steps) + 1

    def report(iteration: int, residual: float, correction: float, length: float) -> None:
        if run.hooks.progress is not None:
            run.hooks.progress(_iteration(number, load, iteration, residual, correction, length), None)

    return report


def _iteration(step: int, load: float, iteration: int, residual: float, correction: float, length: float) -> Iteration:
    return Iteration(
        step=step, iteration=iteration, load_factor=load, residual=residual, correction=correction, step_length=length
    )
