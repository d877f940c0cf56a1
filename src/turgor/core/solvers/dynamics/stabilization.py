"""Stabilization: the steps of `Stabilized` with viscous forces, then a hold until these have faded."""

from dataclasses import dataclass, replace
from math import inf
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.additions import Linear
from turgor.core.engine.cells.internal_variables import History
from turgor.core.engine.energy import contact_energy, lasting_loss, stored_energy, work_of_states
from turgor.core.engine.mass import even_mass
from turgor.core.engine.system import Evaluation, System
from turgor.core.model.drive import kinks
from turgor.core.solvers.checkpoints.loop import Loop
from turgor.core.solvers.checks.supports import free_motions
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.continuation.path_follower import step_loop
from turgor.core.solvers.continuation.step_control import StepControl
from turgor.core.solvers.dynamics.contact_work import Pushing, pushing, taken_by_friction, work_of_contacts
from turgor.core.solvers.dynamics.initial_stiffness import initial_stiffness
from turgor.core.solvers.dynamics.motion_outcomes import came_to_rest, no_state, restless
from turgor.core.solvers.dynamics.settings import STABILIZATION
from turgor.core.solvers.energies import Energies
from turgor.core.solvers.newton.contact_newton import newton_with_contact
from turgor.core.solvers.newton.convergence import relative_residual
from turgor.core.solvers.newton.newton_values import NewtonResult, NewtonSettings, Start
from turgor.core.solvers.outcomes import Outcome, stopped_by, too_many_steps
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.restart import unknowns_of
from turgor.core.solvers.solution import State, Step
from turgor.core.solvers.states import state_of
from turgor.core.solvers.step_reasons import Cause, Reason

Array = NDArray[np.float64]


@dataclass(slots=True, eq=False)
class _Run:
    """Constants and state of a run."""

    problem: Problem
    procedure: StepOptions
    control: StepControl
    kinks: tuple[float, ...]
    mass: Array
    viscosity: float
    at: Evaluation
    pushed: Pushing
    rate: Array
    viscous: Array
    energies: Energies
    history: History
    free: bool = False
    softened: float = 0.0
    rest_steps: int = 0
    hold: float = 0.0

    @property
    def system(self) -> System:
        return self.problem.system

    @property
    def states(self) -> list[State]:
        return self.problem.states

    @property
    def steps(self) -> list[Step]:
        return self.problem.steps


def follow_viscously(problem: Problem, procedure: StepOptions, share: float) -> Outcome:
    """Step from load factor 0 to 1 and let the actuator come to rest; what is found is added to the problem's lists.

    ``share`` is the energy that the viscous forces would take at most, over the strain energy.
    """
    system = problem.system
    run = _begin(problem, procedure, share)
    return step_loop(
        Loop(problem, [run]),
        lambda: _advance(run),
        lambda: len(problem.steps) >= procedure.max_steps and run.at.load_factor < 1.0,
        lambda: too_many_steps(system.model, problem.states[-1], procedure),
    )


def _begin(problem: Problem, procedure: StepOptions, share: float) -> _Run:
    system, tangent, turns = problem.system, problem.tangent, kinks(problem.system.model)
    unknowns = unknowns_of(system, problem.start)
    history = system.history(problem.memory, inf)
    at = system.evaluate(unknowns, 0.0, history=history)
    assert at is not None
    mass = even_mass(system)
    strain = stored_energy(system, unknowns, at.load_factor, history) + contact_energy(system, at)
    free = free_motions(system.model) > 0
    run = _Run(
        problem=problem, procedure=procedure, control=StepControl.of(procedure, turns), kinks=turns,
        mass=mass, viscosity=share * initial_stiffness(system, tangent, at, mass, free), at=at,
        free=free, pushed=pushing(system, at), rate=np.zeros(system.size), viscous=np.zeros(system.size),
        energies=Energies(kinetic=0.0, strain=strain, dissipated=0.0, work=strain),
        history=history,
    )  # fmt: skip
    run.softened = lasting_loss(system, at)
    problem.states.append(replace(_state(run, at, None), memory=history.memory))
    return run


def _advance(run: _Run) -> Outcome | None:
    """Attempt one step, or come to rest under the full load; return how the run ends, if it does."""
    now = run.at.load_factor
    if now >= 1.0:
        return _come_to_rest(run)
    load = run.control.next_load(now)
    result = _attempt(run, load, load - now)
    if result.converged and not _too_far(run, result):
        ending = _accept(run, result, load - now)
        run.control = _turned(run, run.control.accepted(load - now, result.iterations))
        return ending
    run.problem.listeners.rejected(len(run.steps), run.steps[-1])
    shorter = run.control.failed(load - now)
    if shorter is None:
        return no_state(run.states[-1], run.steps[-1])
    run.control = _turned(run, shorter)
    return None


def _turned(run: _Run, control: StepControl) -> StepControl:
    """Start again with a first step at a kink of the loads."""
    return control.turned(run.procedure.first_step) if run.at.load_factor in run.kinks else control


def _drag(run: _Run, length: float) -> Linear:
    """The viscous forces of a step of a length from the last state."""
    base, drag = run.system.layout.base, run.viscosity / length * run.mass
    return Linear(base, drag, -base.product(drag, run.at.unknowns))


def _attempt(run: _Run, load: float, length: float) -> NewtonResult:
    """Solve for a load with the viscous forces of a step of a length."""
    system, began = run.system, perf_counter()
    report = run.problem.listeners.reporter(len(run.steps) + 1, load)
    constraint = load_control(system, history=run.history, addition=_drag(run, length))
    settings = NewtonSettings(tolerance=run.procedure.tolerance, max_iterations=run.procedure.max_iterations)
    result = newton_with_contact(
        constraint, run.problem.tangent, _start(run, constraint, load, length), load, settings, report
    )
    run.steps.append(
        Step(
            load_factor=load,
            increment=load - run.at.load_factor,
            iterations=result.iterations,
            residual=result.residual,
            accepted=result.converged,
            seconds=perf_counter() - began,
            why=result.reason,
        )
    )
    return result


def _start(run: _Run, constraint: Constraint, load: float, length: float) -> Start:
    """Start Newton's method from the extrapolated or the last state, whichever has the smaller residual."""
    system, best, smallest = run.system, run.at.unknowns, np.inf
    for trial in (run.at.unknowns + length * run.rate, run.at.unknowns):
        at = constraint.evaluate(trial, load, np.empty(0))
        residual = np.inf if at is None else relative_residual(system, at)
        if residual < smallest:
            best, smallest = trial, residual
    return Start(best, system.stresses(run.at, best - run.at.unknowns))


def _too_far(run: _Run, result: NewtonResult) -> bool:
    """Whether a step jumped so far that its work is inaccurate; it is then marked as rejected."""
    at = result.evaluation
    assert at is not None and at.addition is not None
    after = _energies(run, at, at.addition.forces(at.unknowns))
    lost = abs(after.missing - run.energies.missing)
    moved = np.abs(at.unknowns - run.at.unknowns)[run.system.moving].max()
    most = max(after.strain, run.energies.strain, after.dissipated if run.free else 0.0)  # a fall strains little
    if moved < STABILIZATION.small_move or lost <= STABILIZATION.energy_error * most:
        return False
    why = Reason(Cause.ENERGY_ERROR, 100 * lost / most)
    run.steps[-1] = replace(run.steps[-1], accepted=False, why=why)
    return True


def _accept(run: _Run, result: NewtonResult, length: float) -> Outcome | None:
    """Take a step, count its energies, and return how the run ends if the caller wants that."""
    at, system = result.evaluation, run.system
    assert at is not None and at.addition is not None
    viscous = at.addition.forces(at.unknowns)
    run.energies = _energies(run, at, viscous)
    run.softened = lasting_loss(system, at)
    run.rate = (at.unknowns - run.at.unknowns) / length
    same_load = at.load_factor == run.at.load_factor
    run.at, run.pushed, run.viscous = at, pushing(system, at), viscous
    state = _state(run, at, None)
    run.history = system.history(state.memory, inf)
    if same_load:
        run.states.pop()  # while the load is constant, only the last state counts
    run.states.append(state)
    reason = run.problem.listeners.accepted(len(run.steps), state, result)
    return None if reason is None else stopped_by(system.model, state, reason)


def _come_to_rest(run: _Run) -> Outcome | None:
    """Hold the load for one more step, until the viscous forces have faded; return how the run ends, if it does."""
    length = run.hold or run.procedure.first_step
    at = run.system.evaluate(run.at.unknowns, 1.0, history=run.history)
    assert at is not None
    if run.rest_steps == STABILIZATION.holds:
        return restless(run.states[-1])
    if relative_residual(run.system, at) <= run.procedure.tolerance:
        return _at_rest(run, at)
    run.rest_steps += 1
    result = _attempt(run, 1.0, length)
    if not result.converged or _too_far(run, result):
        run.problem.listeners.rejected(len(run.steps), run.steps[-1])
        run.hold = 0.25 * length
        return no_state(run.states[-1], run.steps[-1]) if run.hold < run.procedure.min_step else None
    ended = _accept(run, result, length)
    if ended is not None:
        return ended
    run.rate = np.zeros_like(run.rate)
    run.hold = STABILIZATION.hold_growth * length
    return None


def _at_rest(run: _Run, at: Evaluation) -> Outcome:
    """Make the state in which viscous forces have faded the last one, and count its unstable modes."""
    run.at = at
    # where nothing holds it, the tangent is singular by itself
    run.problem.tangent.factor(replace(at, addition=_drag(run, 1.0)) if run.free else at)
    last = _state(run, at, run.problem.tangent.unstable_modes())
    run.states[-1] = replace(last, memory=run.history.memory)
    return came_to_rest(run.states, run.steps)


def _energies(run: _Run, at: Evaluation, viscous: Array) -> Energies:
    """Energies at the end of a step; work by the trapezoidal rule."""
    system, before, unit = run.system, run.energies, run.system.stress_scale * run.system.length**3
    moved = at.unknowns - run.at.unknowns
    moved[~system.moving] = 0.0
    pushed = work_of_contacts(system, run.pushed, pushing(system, at))
    support = np.where(system.prescribed, 0.5 * (run.at.residual + at.residual), 0.0)
    lasting = taken_by_friction(system, at) + lasting_loss(system, at) - run.softened
    return Energies(
        kinetic=0.0,
        strain=stored_energy(system, at.unknowns, at.load_factor, at.history) + contact_energy(system, at),
        dissipated=before.dissipated + 0.5 * unit * float((run.viscous + viscous) @ moved) + lasting,
        lasting=before.lasting + lasting,
        work=before.work
        + pushed
        + work_of_states(system, run.at, at)
        + unit * float((0.5 * (run.at.external + at.external) + support) @ moved),
    )


def _state(run: _Run, at: Evaluation, modes: int | None) -> State:
    return replace(state_of(run.system, at, modes), energies=run.energies)
