"""solve: follow the equilibrium path of a model."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from math import inf
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.engine.contact.build import may_touch
from turgor.engine.runtime import EngineOptions, compile_kernels, use_threads
from turgor.engine.system import Evaluation, Stresses, System
from turgor.engine.tangent import Tangent
from turgor.model.drive import kinks
from turgor.model.model import DISPLACEMENT, Model
from turgor.solvers.carried import Carried, unknowns_of
from turgor.solvers.checks import check_supports
from turgor.solvers.contact_checks import deep_penetrations, meeting_walls
from turgor.solvers.dynamic import Dynamic
from turgor.solvers.dynamic_run import Listeners
from turgor.solvers.in_turn import in_turn
from turgor.solvers.moving import energy_findings, follow_moving
from turgor.solvers.newton import NewtonResult, NewtonSettings, Start, evaluate, relative_residual
from turgor.solvers.outcome import Outcome, converged, interrupted, stopped_by, stuck, too_many_steps
from turgor.solvers.path_outcomes import limit_point_findings
from turgor.solvers.paths import Problem, controlled_faces, follow_path
from turgor.solvers.predictor import HISTORY, lagrange_weights
from turgor.solvers.procedures import Static, question_of
from turgor.solvers.solution import (
    Iteration,
    LimitPoint,
    Procedure,
    Solution,
    SolveError,
    State,
    Step,
    Timing,
)
from turgor.solvers.stabilized import Stabilized
from turgor.solvers.stages import OneProcedure, Stages
from turgor.solvers.stepping import StepControl
from turgor.solvers.time_checks import too_long_steps
from turgor.solvers.touching import newton_with_contact, touches

#: An extrapolation that leaves a smaller relative residual is taken without trying a lower order.
GOOD_PREDICTION = 0.05

#: Below this size threads wait for each other longer than they work.
FEW_UNKNOWNS = 10_000

#: An extrapolation is shortened this often at most where it presses walls into each other.
SHORTENINGS = 3

Array = NDArray[np.float64]
Progress = Callable[[Iteration, State | None], None]
Stop = Callable[[State], str | None]


@dataclass(slots=True)
class _Path:
    """What the run has found so far."""

    kinks: tuple[float, ...]
    carried: Carried | None = None
    states: list[State] = field(default_factory=list)
    history: list[tuple[float, Array, Stresses]] = field(default_factory=list)
    steps: list[Step] = field(default_factory=list)
    limits: list[LimitPoint] = field(default_factory=list)
    lost_stability: bool = False


def solve(
    model: Model,
    procedure: Procedure | None = None,
    *,
    progress: Progress | None = None,
    stop: Stop | None = None,
    options: EngineOptions | None = None,
    throw: bool = True,
) -> Solution:
    """Follow the equilibrium path of a model from the undeformed state to the full load.

    Parameters
    ----------
    model : Model
        The question.
    procedure : Static, BlockedForce, Grasp, VolumeControl, GasMass, ArcLength, Auto, Stabilized, Dynamic or Stages
        How the path is followed; `Static` if it is not given. `BlockedForce` and `Grasp` add to the question what
        stops the tip or moves the object; ``solution.model`` is the model with it. `Stages` follows several in turn.
    progress : callable
        ``progress(iteration, state)``, called after every Newton update (state None) and after every accepted step.
    stop : callable
        ``stop(state)`` ends the run early by returning the reason, a few words.
    options : EngineOptions
        Linear solver, threads, where notices go, Newton's method.
    throw : bool
        Whether a run that stops early raises `SolveError` (which holds the path so far) or returns the path.

    Returns
    -------
    Solution
        The path with its status, message and advice.

    Raises
    ------
    TurgorError
        If the supports leave a rigid motion free, or prescribe the whole surface of an incompressible body.
    SolveError
        If the full load was not reached and ``throw`` is set.
    """
    procedure, hooks = procedure or Static(), Listeners(progress, stop)
    one = partial(_solved, options or EngineOptions())
    if isinstance(procedure, Stages):
        solution = in_turn(model, procedure, hooks, one)
    else:
        solution, _ = one(question_of(model, procedure), procedure, hooks, None)
    if throw and not solution.complete:
        raise SolveError(solution)
    return solution


def _solved(
    options: EngineOptions, model: Model, procedure: OneProcedure, hooks: Listeners, carried: Carried | None
) -> tuple[Solution, Carried]:
    """Follow one procedure from rest, or from what a former stage left; and what it leaves itself."""
    start = perf_counter()
    check_supports(model, inertia=isinstance(procedure, Dynamic))
    threads = options.threads if model.mesh.unknown_count >= FEW_UNKNOWNS else 1
    with use_threads(threads):
        cell, mixed = model.mesh.cell_type, model.formulation != DISPLACEMENT
        compiling = compile_kernels(options.notify, cell.nodes, mixed, cell.side.nodes if may_touch(model) else 0)
        setup = perf_counter()
        system = System(model, controlled_faces(model, procedure))
        system.materials.begin_step(inf)  # slow enough to relax, unless the procedure knows its time
        tangent = Tangent(system, options.linear_solver, threads, options.iteration)
        setup = perf_counter() - setup
        path = _Path(kinks(model), carried)
        if carried is not None:
            carried.restore(system)
        outcome = _outcome(system, tangent, procedure, hooks, path)
    clock = tangent.clock
    timing = Timing(
        compile=compiling,
        setup=setup,
        assembly=clock.assembly,
        residual=clock.residual,
        factorization=clock.factorization,
        solve=clock.solve,
        total=perf_counter() - start,
        factorizations=clock.factorizations,
        linear_solver=tangent.name,
    )
    solution = Solution(
        model=model,
        procedure=procedure,
        states=tuple(path.states),
        status=outcome.status,
        message=outcome.message,
        advice=outcome.advice,
        steps=tuple(path.steps),
        findings=(
            *meeting_walls(model, path.states),
            *deep_penetrations(path.states),
            *limit_point_findings(path.limits, procedure),
            *energy_findings(procedure, path.states),
            *too_long_steps(model, procedure, path.states),
        ),
        timing=timing,
        limit_points=tuple(path.limits),
    )
    return solution, Carried.of(system, path.states[-1])


def _outcome(system: System, tangent: Tangent, procedure: OneProcedure, hooks: Listeners, path: _Path) -> Outcome:
    """Follow the path as the procedure says."""
    if isinstance(procedure, Static):
        return _follow(system, tangent, procedure, hooks, path)
    if isinstance(procedure, Dynamic | Stabilized):
        start = None if path.carried is None else path.carried.state
        return follow_moving(system, tangent, procedure, hooks, (path.states, path.steps), start)
    problem = Problem(
        system=system,
        tangent=tangent,
        procedure=procedure,
        progress=hooks.progress,
        stop=hooks.stop,
        states=path.states,
        steps=path.steps,
        limits=path.limits,
        carried=path.carried,
    )

    def by_load(static: Static, until: Stop) -> Outcome:
        return _follow(system, tangent, static, Listeners(hooks.progress, until), path)

    return follow_path(problem, by_load, path.history)


def _follow(system: System, tangent: Tangent, procedure: Static, hooks: Listeners, path: _Path) -> Outcome:
    """Step from 0 to 1; the path so far is in ``path`` whatever happens."""
    rest = unknowns_of(system, None if path.carried is None else path.carried.state)
    at_rest = system.evaluate(rest, 0.0)
    assert at_rest is not None
    path.history.append((0.0, rest, system.stresses(at_rest)))
    path.states.append(_state(system, procedure, at_rest, None))
    control = StepControl.of(procedure, path.kinks)
    try:
        while path.history[-1][0] < 1.0:
            if len(path.steps) >= procedure.max_steps:
                return too_many_steps(system.model, path.states[-1], procedure)
            following = _advance(system, tangent, procedure, control, hooks, path)
            if isinstance(following, Outcome):
                return following
            control = following
    except KeyboardInterrupt:
        return interrupted(system.model, path.states[-1])
    return converged(system.model, path.states, path.steps)


def _advance(
    system: System, tangent: Tangent, procedure: Static, control: StepControl, hooks: Listeners, path: _Path
) -> StepControl | Outcome:
    """Attempt one step; return the control for the next one, or how the run ends."""
    now = path.history[-1][0]
    load = control.next_load(now)
    system.materials.begin_step(procedure.time_between(now, load))
    began = perf_counter()
    number = len(path.steps) + 1

    def report(iteration: int, residual: float, correction: float, length: float) -> None:
        if hooks.progress is not None:
            hooks.progress(_iteration(number, load, iteration, residual, correction, length), None)

    settings = NewtonSettings(tolerance=procedure.tolerance, max_iterations=procedure.max_iterations)
    result = newton_with_contact(system, tangent, _predict(system, tangent, path, load), load, settings, report)
    path.steps.append(
        Step(
            load_factor=load,
            increment=load - now,
            iterations=result.iterations,
            residual=result.residual,
            accepted=result.converged,
            seconds=perf_counter() - began,
            reason=result.reason,
        )
    )
    if not result.converged:
        path.lost_stability |= bool(result.unstable_modes)
        shorter = control.failed(load - now)
        if shorter is None:
            return stuck(system.model, path.states, path.steps, path.lost_stability)
        return shorter
    path.lost_stability = False
    return _accept(system, result, procedure, control, hooks, path)


def _accept(
    system: System, result: NewtonResult, procedure: Static, control: StepControl, hooks: Listeners, path: _Path
) -> StepControl | Outcome:
    evaluation = result.evaluation
    assert evaluation is not None
    increment = evaluation.load_factor - path.history[-1][0]
    path.history.append((evaluation.load_factor, evaluation.unknowns, system.stresses(evaluation)))
    del path.history[:-HISTORY]
    state = _state(system, procedure, evaluation, result.unstable_modes)
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
    if state.load_factor not in path.kinks:
        return control
    del path.history[:-1]  # beyond a kink the path goes another way: its past predicts nothing
    return control.turned(procedure.first_step)


def _predict(system: System, tangent: Tangent, path: _Path, load: float) -> Start:
    """Extrapolate with the highest order whose residual a lower order does not improve."""
    _, unknowns, stresses = path.history[-1]
    best, smallest = Start(unknowns, stresses), np.inf
    if tangent.plain:
        return best
    for count in range(len(path.history), 0, -1):
        used = path.history[-count:]
        weights = lagrange_weights([factor for factor, _, _ in used], load)
        trial = np.asarray(sum(w * x for w, (_, x, _) in zip(weights, used, strict=True)))
        at = evaluate(system, tangent, trial, load)
        if at is not None and system.contact.parts and count > 1:
            trial, at = _not_deeper(system, tangent, unknowns, at)
        residual = np.inf if at is None else relative_residual(system, at)
        if np.isfinite(smallest) and residual >= smallest:
            break
        if residual < smallest:
            stresses = Stresses.combine([(w, s) for w, (_, _, s) in zip(weights, used, strict=True)])
            best = Start(trial, stresses, at)
            smallest = residual
        if smallest <= GOOD_PREDICTION:
            break
    return best


def _not_deeper(system: System, tangent: Tangent, last: Array, at: Evaluation) -> tuple[Array, Evaluation | None]:
    """Shorten an extrapolation until it presses no wall much deeper into another."""
    here = evaluate(system, tangent, last, at.load_factor)
    found: Evaluation | None = at
    for _ in range(SHORTENINGS):
        if found is None or here is None:
            break
        share = system.contact.shortening(here.contacts, found.contacts)
        if share == 1:
            return found.unknowns, found
        found = evaluate(system, tangent, last + share * (found.unknowns - last), at.load_factor)
    return (last, here) if found is None else (found.unknowns, found)


def _state(system: System, procedure: Static, at: Evaluation, modes: int | None) -> State:
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
        time=procedure.time_of(at.load_factor),
        memory=system.remembered(at),
    )


def _iteration(step: int, load: float, iteration: int, residual: float, correction: float, length: float) -> Iteration:
    return Iteration(
        step=step, iteration=iteration, load_factor=load, residual=residual, correction=correction, step_length=length
    )
